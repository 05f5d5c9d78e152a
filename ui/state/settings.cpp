// SPDX-License-Identifier: Apache-2.0
#include "ui/state/settings.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/json_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nephroid::ui {
namespace {

using SettingsJson = nlohmann::ordered_json;

constexpr int settings_version = 2;
constexpr std::size_t most_panels = 64;

/// Dear ImGui trusts what it reads: whatever it did not write itself is refused here.
std::string checksum(const std::string& ini) { return fmt::format("{:016x}", hash_of(ini)); }

EngineLayout read_engine_layout(const SettingsJson& value)
{
  EngineLayout layout{value.at("ini").get<std::string>(), {}};
  if (value.at("checksum").get<std::string>() != checksum(layout.ini)) throw std::out_of_range("a layout is not as the window wrote it");
  if (value.at("closed").size() > most_panels) throw std::out_of_range("there are too many panels");
  for (const SettingsJson& panel : value.at("closed")) layout.closed.insert(panel.get<std::string>());
  return layout;
}

} // namespace

std::string to_json(const Settings& settings)
{
  SettingsJson engines = SettingsJson::object();
  for (const auto& [engine, layout] : settings.engines)
    engines[engine] = {{"closed", layout.closed}, {"ini", layout.ini}, {"checksum", checksum(layout.ini)}};
  return json_text({{"version", settings_version},
                    {"theme", settings.theme == Theme::light ? "light" : "dark"},
                    {"text_size", settings.text_size},
                    {"engines", engines}},
                   2);
}

Settings parse_settings(const std::string& text, const std::string& source)
{
  try {
    const SettingsJson value = SettingsJson::parse(text);
    if (value.at("version").get<int>() != settings_version) throw std::out_of_range("the version is another one");
    Settings settings;
    settings.theme = value.at("theme").get<std::string>() == "light" ? Theme::light : Theme::dark;
    settings.text_size = value.at("text_size").get<double>();
    if (!(settings.text_size >= Settings::smallest_text && settings.text_size <= Settings::largest_text))
      throw std::out_of_range(fmt::format("{} is not in {}..{}", settings.text_size, Settings::smallest_text, Settings::largest_text));
    for (const auto& [engine, layout] : value.at("engines").items()) settings.engines[engine] = read_engine_layout(layout);
    return settings;
  } catch (const std::exception& error) { // of the JSON library, or of the checks above
    throw bad_input(source, fmt::format("these are no settings of the window ({})", error.what()), "",
                    "delete the file; the window writes a new one");
  }
}

} // namespace nephroid::ui
