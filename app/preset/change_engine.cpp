// SPDX-License-Identifier: Apache-2.0
#include "preset/change_engine.h"

#include "preset/read.h"
#include "preset/settings_type.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace nephroid::preset {
namespace {

bool leads_into(const Json& path, const std::vector<std::string>& keys) {
  return path.is_string() && std::ranges::any_of(keys, [text = path.get<std::string>() + "."](const std::string& key) {
           return text.starts_with(key + ".");
         });
}

/// The part of the preset, where it is there and of that kind.
Json* part_of(Json& preset, const char* name, Json::value_t kind) {
  const auto part = preset.find(name);
  return part != preset.end() && part->type() == kind ? &*part : nullptr;
}

/// A key such as "scene.lights"; false where there is what a new preset has, or nothing.
bool take(Json& preset, std::string_view key, const Json& standard) {
  const std::size_t dot = key.find('.');
  const std::string name(key.substr(0, dot));
  if (!preset.is_object() || !preset.contains(name)) return false;
  const Json& usual = standard.is_object() && standard.contains(name) ? standard[name] : Json();
  if (dot != std::string_view::npos) return take(preset[name], key.substr(dot + 1), usual);
  const bool is_given =
      !preset[name].is_null() && !(preset[name].is_structured() && preset[name].empty()) && preset[name] != usual;
  preset.erase(name);
  return is_given;
}

} // namespace

std::vector<std::string> take_foreign(Json& preset, std::string_view engine) {
  const auto& types = settings_types();
  const auto own = std::ranges::find(types, engine, &SettingsType::name);
  if (own == types.end() || !preset.is_object()) return {};
  std::vector<std::string> foreign;
  for (const SettingsType* other : types)
    if (other != *own)
      for (const char* before : {"", "reference."}) foreign.push_back(before + std::string(other->name));
  for (const std::string_view key : (*own)->without) foreign.emplace_back(key);

  static const Json standard = Json::parse(to_json(Preset()));
  std::vector<std::string> taken;
  for (const std::string& key : foreign)
    if (take(preset, key, standard)) taken.push_back(key);
  if (Json* sweep = part_of(preset, "sweep", Json::value_t::object)) {
    const Json axes = *sweep;
    for (const auto& [key, values] : axes.items())
      if (leads_into(key, foreign) && sweep->erase(key) > 0) taken.push_back("sweep: " + key);
  }
  if (Json* animation = part_of(preset, "animation", Json::value_t::object))
    if (Json* tracks = part_of(*animation, "tracks", Json::value_t::array)) {
      const auto path_of = [](const Json& track) { return track.is_object() ? track.value("path", Json()) : Json(); };
      Json kept = Json::array();
      for (const Json& track : *tracks)
        if (leads_into(path_of(track), foreign))
          taken.push_back("animation: " + path_of(track).get<std::string>());
        else
          kept.push_back(track);
      const bool lost_all = kept.empty() && !tracks->empty();
      *tracks = std::move(kept);
      if (lost_all) preset.erase("animation"); // all of its frames would be alike
    }
  return taken;
}

std::string left_out_note(std::string_view engine, const std::vector<std::string>& keys) {
  return fmt::format("left out what the engine '{}' does not know: {}", engine, fmt::join(keys, ", "));
}

} // namespace nephroid::preset
