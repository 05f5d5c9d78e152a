// SPDX-License-Identifier: Apache-2.0
#include "ui/state/selection.h"

#include "engine/engine.h"
#include "preset/choices.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

using Kind = Selection::Kind;

} // namespace

bool has_scene(const preset::Preset& preset) { return engine::engine_of(preset).has_scene; }

Selection in_preset(const Selection& selection, const preset::Preset* preset)
{
  if (!preset || !has_scene(*preset)) return {};
  const bool there = selection.kind == Kind::object  ? selection.index < preset->scene.objects.size()
                     : selection.kind == Kind::light ? selection.index < preset->scene.lights.size()
                                                     : selection.kind == Kind::camera;
  return there ? selection : Selection{};
}

std::vector<Selection> selectable(const preset::Preset& preset)
{
  std::vector<Selection> all;
  if (!has_scene(preset)) return all;
  for (std::size_t i = 0; i < preset.scene.objects.size(); ++i) all.push_back({Kind::object, i});
  for (std::size_t i = 0; i < preset.scene.lights.size(); ++i) all.push_back({Kind::light, i});
  all.push_back({Kind::camera, 0});
  return all;
}

std::string name_of(const preset::Preset& preset, const Selection& selection)
{
  const std::size_t i = selection.index;
  switch (selection.kind) {
  case Kind::object: {
    const std::string& name = preset.scene.objects[i].name;
    return name.empty() ? fmt::format("object {}", i + 1) : name;
  }
  case Kind::light:
    return fmt::format("light {} ({})", i + 1, preset::word(preset.scene.lights[i].type));
  case Kind::camera:
    return "camera's target";
  case Kind::nothing:
    break;
  }
  return {};
}

std::string unit_word(const preset::Preset& preset) { return std::string(preset::word(preset.unit)); }

std::string pointer_of(const Selection& selection)
{
  switch (selection.kind) {
  case Kind::object:
    return fmt::format("/scene/objects/{}", selection.index);
  case Kind::light:
    return fmt::format("/scene/lights/{}", selection.index);
  case Kind::camera:
    return "/scene/camera";
  case Kind::nothing:
    break;
  }
  return {};
}

} // namespace nephroid::ui
