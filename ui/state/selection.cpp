// SPDX-License-Identifier: Apache-2.0
#include "ui/state/selection.h"

#include "base/files.h"
#include "engine/engine.h"
#include "optics/dispersion.h"
#include "preset/choices.h"
#include "scatter/spectra.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using Kind = Selection::Kind;

} // namespace

bool has_scene(const preset::Preset& preset) { return engine::engine_of(preset).has_scene; }

Selection in_preset(const Selection& selection, const preset::Preset* preset) {
  if (!preset || !has_scene(*preset)) return {};
  const bool there = selection.kind == Kind::object        ? selection.index < preset->scene.objects.size()
                     : selection.kind == Kind::light       ? selection.index < preset->scene.lights.size()
                     : selection.kind == Kind::environment ? preset->scene.environment.has_value()
                                                           : selection.kind == Kind::camera;
  return there ? selection : Selection{};
}

std::vector<Selection> selectable(const preset::Preset& preset) {
  std::vector<Selection> all;
  if (!has_scene(preset)) return all;
  for (std::size_t i = 0; i < preset.scene.objects.size(); ++i) all.push_back({Kind::object, i});
  for (std::size_t i = 0; i < preset.scene.lights.size(); ++i) all.push_back({Kind::light, i});
  all.push_back({Kind::camera, 0});
  return all;
}

std::string name_of(const preset::Preset& preset, const Selection& selection) {
  const std::size_t i = selection.index;
  switch (selection.kind) {
  case Kind::object: {
    const std::string& name = preset.scene.objects[i].name;
    return name.empty() ? fmt::format("object {}", i + 1) : name;
  }
  case Kind::light: return fmt::format("light {} ({})", i + 1, preset::word(preset.scene.lights[i].type));
  case Kind::camera: return "camera's target";
  case Kind::environment: return "environment";
  case Kind::nothing: break;
  }
  return {};
}

std::string unit_word(const preset::Preset& preset) { return std::string(preset::word(preset.unit)); }

std::string pointer_of(const Selection& selection) {
  if (selection.kind == Kind::object) return fmt::format("/scene/objects/{}", selection.index);
  if (selection.kind == Kind::light) return fmt::format("/scene/lights/{}", selection.index);
  if (selection.kind == Kind::environment) return "/scene/environment";
  return selection.kind == Kind::camera ? "/scene/camera" : "";
}

double rounded(double value, int decimals) {
  const double power = std::pow(10.0, std::abs(decimals));
  const double result = decimals >= 0 ? std::round(value * power) / power : std::round(value / power) * power;
  return result == 0 ? 0.0 : result; // not -0
}

double with_digits(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value;
  return rounded(value, digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
}

preset::Vec3 rounded_place(const glm::dvec3& place, double size) {
  const int decimals = size > 0 && std::isfinite(size) ? 3 - static_cast<int>(std::floor(std::log10(size))) : 0;
  return {rounded(place.x, decimals), rounded(place.y, decimals), rounded(place.z, decimals)};
}

std::string new_bookmark_name(const preset::Preset& preset, const std::vector<Bookmark>& bookmarks) {
  std::string of = preset.name.empty() ? std::filesystem::path(preset.source).stem().string() : preset.name;
  if (of.empty()) of = "Camera";
  for (int number = 1;; ++number) {
    std::string name = fmt::format("{} {}", of, number);
    if (std::ranges::none_of(bookmarks, [&](const Bookmark& bookmark) { return bookmark.name == name; })) return name;
  }
}

std::vector<std::string> dielectrics(const preset::Preset& preset) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    const auto found = preset.scene.materials.find(name);
    if (found == preset.scene.materials.end() || !is_refractive(found->second.type)) return;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const preset::Object& object : preset.scene.objects) add(object.material);
  for (const auto& [name, material] : preset.scene.materials) add(name);
  return names;
}

std::string shown_dielectric(const preset::Preset& preset, const std::string& chosen) {
  const std::vector<std::string> names = dielectrics(preset);
  if (std::find(names.begin(), names.end(), chosen) != names.end()) return chosen;
  return names.empty() ? std::string() : names.front();
}

preset::Dispersion load_dispersion(const std::string& file, const std::string& preset_source) {
  preset::Dispersion dispersion;
  dispersion.type = preset::Dispersion::Type::file;
  // A path is relative to the current folder, as in a shell. A name is looked up as in a preset.
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::absolute(file, ignored);
  dispersion.file = !file.empty() && is_there(path) ? path.string() : file;
  const FileFinder finder(std::filesystem::path(preset_source).parent_path());
  optics::sample_n(scatter::make_curve(dispersion, finder, file.empty() ? "load dispersion" : file),
                   optics::Extrapolation::automatic);
  return dispersion;
}

} // namespace nephroid::ui
