// SPDX-License-Identifier: Apache-2.0
#include "engine/engine.h"

#include "base/error.h"
#include "preset/settings_type.h"

#include <fmt/format.h>

#include <stdexcept>

namespace nephroid::engine {

const std::vector<check::Check>& checks() {
  static const std::vector<check::Check> all = [] {
    std::vector<check::Check> list = check::checks();
    for (const Engine* engine : engines())
      for (check::Check& check : engine->checks()) list.push_back(std::move(check));
    return list;
  }();
  return all;
}

const Engine& engine_of(const preset::Preset& preset) {
  for (const Engine* engine : engines())
    if (&engine->settings() == &preset.settings.type()) return *engine;
  throw std::logic_error("settings of an engine that is not in app/engines.cpp");
}

void require_engine(const preset::Preset& preset, const Engine& engine, std::string_view lacks) {
  if (&engine.settings() == &preset.settings.type()) return;
  throw bad_input(Location(preset.source, "/engine"), fmt::format("is '{}', which {}", preset.settings.engine(), lacks),
                  fmt::format("expected '{}'", name_of(engine)), "choose a preset of that engine");
}

preset::Camera camera_of(const preset::Preset& preset) {
  const auto camera = engine_of(preset).camera;
  return camera ? camera(preset) : preset.scene.camera;
}

std::string_view name_of(const Engine& engine) { return engine.settings().name; }

bool adoptable(const preset::Preset& before, const preset::Preset& now) {
  const Engine& engine = engine_of(before);
  preset::Preset same = now;
  same.display = before.display;
  return (now.white || !before.white) && engine.adoptable && &engine == &engine_of(now) &&
         engine.adoptable(before, same);
}

} // namespace nephroid::engine

const std::vector<const nephroid::preset::SettingsType*>& nephroid::preset::settings_types() {
  static const std::vector<const SettingsType*> all = [] {
    std::vector<const SettingsType*> types;
    for (const engine::Engine* engine : engine::engines()) types.push_back(&engine->settings());
    return types;
  }();
  return all;
}
