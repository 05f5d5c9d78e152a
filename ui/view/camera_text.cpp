// SPDX-License-Identifier: Apache-2.0
#include "ui/view/camera_text.h"

#include "preset/read.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nephroid::ui {
namespace {

nlohmann::ordered_json camera(const preset::Preset& preset)
{
  return nlohmann::ordered_json::parse(preset::to_json(preset)).at("scene").at("camera");
}

} // namespace

std::string camera_json(const preset::Preset& preset) { return nlohmann::ordered_json{{"camera", camera(preset)}}.dump(2) + "\n"; }

std::string camera_settings(const preset::Preset& preset)
{
  const nlohmann::ordered_json fields = camera(preset);
  std::string text;
  for (const auto& [name, value] : fields.items())
    text += fmt::format("{}--set 'scene.camera.{}={}'", text.empty() ? "" : " ", name, value.dump());
  return text;
}

} // namespace nephroid::ui
