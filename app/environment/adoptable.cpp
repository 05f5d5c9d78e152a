// SPDX-License-Identifier: Apache-2.0
#include "environment/engine.h"

#include <algorithm>

namespace nephroid::environment {

preset::Preset with_view_of(const preset::Preset& preset, const preset::Preset& other)
{
  preset::Preset result = preset;
  result.scene.camera = other.scene.camera;
  if (result.scene.environment && other.scene.environment) result.scene.environment->rotate_deg = other.scene.environment->rotate_deg;
  result.white = other.white;
  result.name = other.name;
  result.description = other.description;
  Settings& s = settings(result);
  const Settings& o = settings(other);
  s.lights = o.lights;
  s.segmentation = o.segmentation;
  s.threshold = o.threshold;
  return result;
}

preset::Preset with_places_of(const preset::Preset& preset, const preset::Preset& other)
{
  preset::Preset result = preset;
  for (std::size_t i = 0; i < result.scene.objects.size(); ++i) {
    result.scene.objects[i].transform.rotate_deg = other.scene.objects[i].transform.rotate_deg;
    result.scene.objects[i].transform.translate = other.scene.objects[i].transform.translate;
  }
  return result;
}

bool adoptable(const preset::Preset& before, const preset::Preset& now)
{
  const auto may_be_lit = [](const preset::Preset& preset) { return preset.scene.environment || !preset.scene.lights.empty(); };
  if (before.scene.camera.resolution != now.scene.camera.resolution || before.scene.objects.size() != now.scene.objects.size() ||
      may_be_lit(before) != may_be_lit(now))
    return false;
  // What is baked together may not move apart.
  const auto is_caster = [&](const preset::Object& object) { return casts(before, object); };
  const std::vector<preset::Object>& objects = before.scene.objects;
  const bool alone = std::ranges::count_if(objects, is_caster) == 1;
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (!alone && is_caster(objects[i]) && objects[i].transform != now.scene.objects[i].transform) return false;
  preset::Preset same = with_view_of(before, now);
  same.scene.environment = now.scene.environment;
  same.scene.lights = now.scene.lights;
  same = with_places_of(same, now);
  Settings& s = settings(same);
  const Settings& n = settings(now);
  s.cast = n.cast;
  s.extinction = n.extinction;
  s.albedo = n.albedo;
  s.phase = n.phase;
  s.anisotropy = n.anisotropy;
  return same == now;
}

} // namespace nephroid::environment
