// SPDX-License-Identifier: Apache-2.0
#include "measure/run_files.h"

#include "base/error.h"
#include "base/files.h"
#include "measure/history_file.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::measure {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Type = RunDocument::Type;

Json parsed(const fs::path& file)
{
  if (!is_there(file)) throw bad_input(file.string(), "is missing", "expected the files of a finished run");
  const std::string text = read_file(file);
  if (text.empty()) throw bad_input(file.string(), "is empty", {}, "run it again");
  const auto refuse_depth = [&](int depth, Json::parse_event_t, const Json&) {
    constexpr int max_depth = 64; // what walks through a value calls itself at every level
    if (depth > max_depth) throw bad_input(file.string(), fmt::format("is nested deeper than {} levels", max_depth));
    return true;
  };
  Json json = Json::parse(text, refuse_depth, false);
  if (json.is_discarded()) throw bad_input(file.string(), "is cut or no JSON", {}, "run it again");
  if (!json.is_object()) throw bad_input(file.string(), "is no object");
  return json;
}

/// What is wrong with a value; null where it is of the type.
const char* complaint(const Json& value, Type type)
{
  switch (type) {
  case Type::text:
    return value.is_string() ? nullptr : "is no text";
  case Type::number:
    return value.is_number() ? nullptr : "is no number";
  case Type::whole:
    return value.is_number_unsigned() ? nullptr : "is no whole number from 0";
  case Type::flag:
    return value.is_boolean() ? nullptr : "is neither true nor false";
  case Type::list:
    return value.is_array() ? nullptr : "is no list";
  case Type::object:
  case Type::numbers:
    return value.is_object() ? nullptr : "is no object";
  }
  return nullptr;
}

} // namespace

RunDocument::RunDocument(const fs::path& file) : place_(file.string() + "#"), json_(parsed(file)) {}

const Json& RunDocument::at(const std::string& pointer, Type type) const
{
  if (!has(pointer)) throw bad_input(place_ + pointer, "is missing");
  const Json& value = json_.at(Json::json_pointer(pointer));
  if (const char* wrong = complaint(value, type)) throw bad_input(place_ + pointer, wrong);
  if (type == Type::numbers)
    for (const auto& [key, number] : value.items())
      if (!number.is_null() && !number.is_number()) throw bad_input(fmt::format("{}{}/{}", place_, pointer, key), "is no number");
  return value;
}

job::History read_run_history(const fs::path& folder)
{
  job::History history = read_history(folder / "history.csv");
  if (!is_there(folder / "run.json")) return history;
  const RunDocument run(folder / "run.json");
  if (run.has("/error_column")) history.error_column = run.at("/error_column", Type::text);
  if (!run.has("/reference")) return history;
  run.at("/reference/origin", Type::text);
  if (!run.has("/reference/noise_floor")) return history;
  const Json& floors = run.at("/reference/noise_floor", Type::numbers);
  for (const std::string& column : history.columns)
    history.noise_floor.push_back(floors.contains(column) && floors[column].is_number() ? floors[column].get<double>() : std::nan(""));
  return history;
}

} // namespace nephroid::measure
