// SPDX-License-Identifier: Apache-2.0
#include "ui/state/settings.h"

#include "base/error.h"
#include "base/json_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using Json = nlohmann::ordered_json;

constexpr int settings_version = 1;
constexpr int deepest = 16;                                   ///< parts in parts: nobody splits a window so often
constexpr std::size_t most_panels = 64;                       ///< in one place
constexpr const char* splits[] = {"none", "columns", "rows"}; // in the order of Dock::Split

Json to_json(const Dock& dock)
{
  if (dock.split == Dock::Split::none) return {{"tabs", dock.tabs}, {"front", dock.front}};
  Json parts = Json::array();
  for (const Dock& part : dock.parts) parts.push_back(to_json(part));
  return {{"split", splits[static_cast<std::size_t>(dock.split)]}, {"first_part", dock.first_part}, {"parts", parts}};
}

double number(const Json& value, double low, double high)
{
  const double read = value.get<double>();
  if (!(read >= low && read <= high)) throw std::out_of_range(fmt::format("{} is not in {}..{}", read, low, high));
  return read;
}

std::vector<std::string> names(const Json& list)
{
  if (list.size() > most_panels) throw std::out_of_range("there are too many panels");
  return list.get<std::vector<std::string>>();
}

Dock read_dock(const Json& value, int depth)
{
  if (depth > deepest) throw std::out_of_range("parts are split too often");
  Dock dock;
  if (!value.contains("split")) {
    dock.tabs = names(value.at("tabs"));
    dock.front = value.at("front").get<std::string>();
    return dock;
  }
  const auto split = value.at("split").get<std::string>();
  dock.split = split == splits[1] ? Dock::Split::columns : Dock::Split::rows;
  if (split != splits[1] && split != splits[2]) throw std::out_of_range("a split is \"columns\" or \"rows\"");
  dock.first_part = number(value.at("first_part"), Dock::smallest_part, 1 - Dock::smallest_part);
  if (value.at("parts").size() != 2) throw std::out_of_range("a split has two parts");
  for (const Json& part : value.at("parts")) dock.parts.push_back(read_dock(part, depth + 1));
  return dock;
}

EngineLayout read_layout(const Json& value)
{
  EngineLayout read;
  if (value.contains("docks")) read.layout.docks = read_dock(value.at("docks"), 0);
  const std::vector<std::string> closed = names(value.at("closed"));
  read.closed.insert(closed.begin(), closed.end());
  if (value.at("floating").size() > most_panels) throw std::out_of_range("there are too many panels");
  for (const Json& one : value.at("floating")) {
    Floating floating{one.at("panel").get<std::string>(), {}};
    if (one.at("place").size() != floating.place.size()) throw std::out_of_range("a place is x, y, width and height");
    std::transform(one.at("place").begin(), one.at("place").end(), floating.place.begin(), [](const Json& v) { return number(v, -1, 2); });
    read.layout.floating.push_back(std::move(floating));
  }
  return read;
}

} // namespace

std::string to_json(const Settings& settings)
{
  Json engines = Json::object();
  for (const auto& [engine, of_engine] : settings.engines) {
    Json& value = engines[engine];
    value["closed"] = of_engine.closed;
    value["floating"] = Json::array();
    for (const Floating& one : of_engine.layout.floating) value["floating"].push_back({{"panel", one.panel}, {"place", one.place}});
    if (!(of_engine.layout.docks == Dock{})) value["docks"] = to_json(of_engine.layout.docks);
  }
  return json_text({{"version", settings_version},
                    {"theme", settings.theme == Theme::light ? "light" : "dark"},
                    {"text_size", settings.text_size},
                    {"engines", engines}},
                   2);
}

Settings parse_settings(const std::string& text, const std::string& source)
{
  try {
    const Json value = Json::parse(text);
    if (value.at("version").get<int>() != settings_version) throw std::out_of_range("the version is another one");
    Settings settings;
    settings.theme = value.at("theme").get<std::string>() == "light" ? Theme::light : Theme::dark;
    settings.text_size = number(value.at("text_size"), Settings::smallest_text, Settings::largest_text);
    for (const auto& [engine, of_engine] : value.at("engines").items()) settings.engines[engine] = read_layout(of_engine);
    return settings;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) { // of the JSON library, or of the checks above
    throw bad_input(source, fmt::format("these are no settings of the window ({})", error.what()), "",
                    "delete the file; the window writes a new one");
  }
}

} // namespace nephroid::ui
