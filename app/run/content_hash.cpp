// SPDX-License-Identifier: Apache-2.0
#include "run/content_hash.h"

#include "preset/read.h"

#include <type_traits>

namespace nephroid::run {
namespace {

template <class T>
std::string_view bytes_of(const std::vector<T>& items)
{
  static_assert(std::is_standard_layout_v<T>);
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

template <class T, std::size_t count>
std::string_view bytes_of(const std::array<T, count>& items)
{
  return {reinterpret_cast<const char*>(items.data()), sizeof items};
}

/// The preset without what changes no sum, and without the names of files, whose contents are hashed by themselves.
preset::Preset settings_only(preset::Preset preset)
{
  preset.name = preset.description = preset.source = "";
  preset.stop = {};
  preset.reference = {};
  preset.animation.reset(); // its fields are in their places
  preset.measure.perceptual = false;
  preset.measure.mask.reset();
  for (preset::Object& object : preset.scene.objects)
    if (object.mesh) object.mesh = "mesh";
  for (auto& [name, material] : preset.scene.materials)
    if (material.dispersion.type == preset::Dispersion::Type::file) material.dispersion.file = "dispersion";
  if (preset.scene.environment) preset.scene.environment->file = "environment";
  return preset;
}

} // namespace

std::uint64_t content_hash(const preset::Preset& preset, const scene::Scene& scene)
{
  std::uint64_t hash = hash_of(preset::to_json(settings_only(preset)));
  hash = hash_of(bytes_of(scene.geometry.positions), hash);
  hash = hash_of(bytes_of(scene.geometry.normals), hash);
  hash = hash_of(bytes_of(scene.geometry.triangles), hash);
  for (const scene::Material& material : scene.materials)
    for (const optics::Spectrum* spectrum : {&material.n, &material.k, &material.reflectance}) hash = hash_of(bytes_of(*spectrum), hash);
  for (const scene::Light& light : scene.lights) hash = hash_of(bytes_of(light.spectrum), hash);
  if (scene.environment) hash = hash_of(bytes_of(scene.environment->rgb), hash);
  return hash;
}

} // namespace nephroid::run
