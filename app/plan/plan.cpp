// SPDX-License-Identifier: Apache-2.0
#include "plan/plan.h"

#include "base/json_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::plan {

namespace {

using Json = nlohmann::ordered_json;

template <class Items, class Name>
std::size_t widest(const Items& items, Name name) {
  std::size_t width = 0;
  for (const auto& item : items) width = std::max(width, name(item).size());
  return width;
}

/// "; to compute it: --set leave_out=false", for what a field can turn back on.
std::string way_back(const Decision& decision) {
  if (decision.runs || decision.field.empty()) return "";
  std::string key = decision.field.substr(1); // names of fields hold no '/' and no '~'
  std::replace(key.begin(), key.end(), '/', '.');
  return fmt::format("; to compute it: --set {}={}", key, decision.run_value);
}

Json json_of(const Plan& plan) {
  Json decisions = Json::array(), buffers = Json::array(), defines = Json::object(), inputs = Json::array();
  for (const Decision& decision : plan.decisions) {
    Json entry{{"name", decision.name}, {"runs", decision.runs}, {"reason", decision.reason}};
    if (!decision.field.empty()) {
      entry["field"] = decision.field;
      entry["run_value"] = decision.run_value;
    }
    decisions.push_back(std::move(entry));
  }
  for (const PlannedBuffer& buffer : plan.buffers) buffers.push_back({{"name", buffer.name}, {"bytes", buffer.bytes}});
  for (const auto& [name, value] : plan.defines) defines[name] = value;
  for (const Input& input : plan.inputs) inputs.push_back({{"file", input.file}, {"content", input.content}});
  return {{"engine", plan.engine},
          {"passes", decisions},
          {"buffers", buffers},
          {"defines", defines},
          {"inputs", inputs},
          {"notes", plan.notes},
          {"not_imported", plan.not_imported}};
}

} // namespace

std::string readable_bytes(std::uint64_t bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  double amount = static_cast<double>(bytes);
  int unit = 0;
  for (; amount >= 1024 && unit < 4; ++unit) amount /= 1024;
  return unit == 0 ? fmt::format("{} B", bytes)
                   : fmt::format("{:.{}f} {}", amount,
                                 amount < 10    ? 2
                                 : amount < 100 ? 1
                                                : 0,
                                 units[unit]);
}

std::string to_json(const Plan& plan) { return json_text(json_of(plan), 2); }

std::vector<Input> inputs_of(const std::string& plan_json) {
  std::vector<Input> inputs;
  try {
    const Json plan = Json::parse(plan_json);
    for (const Json& input : plan.at("inputs"))
      inputs.push_back({input.at("file").get<std::string>(), input.at("content").get<std::string>()});
  } catch (const Json::exception&) {
    inputs.clear(); // written by something else
  }
  return inputs;
}

std::string to_json_line(const Plan& plan, const std::string& name) {
  Json line{{"name", name}};
  line.update(json_of(plan));
  return json_text(line);
}

std::string to_text(const Plan& plan) {
  std::string text = fmt::format("Engine: {}\n\nDecisions\n", plan.engine);
  const std::size_t name_width = widest(plan.decisions, [](const Decision& decision) { return decision.name; });
  for (const Decision& decision : plan.decisions)
    text += fmt::format("  {:<{}}  {}  {}{}\n", decision.name, name_width, decision.runs ? "runs    " : "left out",
                        decision.reason, way_back(decision));
  text += "\nMemory\n";
  const std::size_t buffer_width =
      std::max<std::size_t>(5, widest(plan.buffers, [](const PlannedBuffer& buffer) { return buffer.name; }));
  std::uint64_t total = 0;
  for (const PlannedBuffer& buffer : plan.buffers) {
    text += fmt::format("  {:<{}}  {:>9}\n", buffer.name, buffer_width, readable_bytes(buffer.bytes));
    total += buffer.bytes;
  }
  text += fmt::format("  {:<{}}  {:>9}\n", "total", buffer_width, readable_bytes(total));
  if (!plan.defines.empty()) {
    text += "\nKernel settings\n";
    for (const auto& [name, value] : plan.defines)
      text += fmt::format("  -D {}{}{}\n", name, value.empty() ? "" : "=", value);
  }
  const auto section = [&text](const char* title, const std::vector<std::string>& lines) {
    if (!lines.empty()) text += fmt::format("\n{}\n", title);
    for (const std::string& line : lines) text += fmt::format("  {}\n", line);
  };
  section("Notes", plan.notes);
  section("Not imported", plan.not_imported);
  return text;
}

} // namespace nephroid::plan
