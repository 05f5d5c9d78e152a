// SPDX-License-Identifier: Apache-2.0
#include "report/overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace nephroid::report {
namespace {

using Strings = std::vector<std::string>;

bool all_differ(const Strings& labels) { return std::set<std::string>(labels.begin(), labels.end()).size() == labels.size(); }

/// A sweep's runs are called "NAME,key=value".
std::string sweep_of(const RunFolder& run) { return run.name().substr(0, run.name().find(',')); }

bool have_one_sweep(std::span<const RunFolder> runs)
{
  return std::all_of(runs.begin(), runs.end(), [&](const RunFolder& run) { return sweep_of(run) == sweep_of(runs.front()); });
}

/// A row of a table: what each run has of it, null where it has nothing.
template <class Value>
Json each(std::span<const RunFolder> runs, Value value)
{
  Json values = Json::array();
  for (const RunFolder& run : runs) values.push_back(value(run));
  return values;
}

} // namespace

std::vector<std::string> labels_of(std::span<const RunFolder> runs)
{
  Strings names, swept, with_folder, with_path;
  for (const RunFolder& run : runs) {
    const std::string name = run.name();
    swept.push_back(name.substr(std::min(sweep_of(run).size() + 1, name.size())));
    names.push_back(name);
    with_folder.push_back(fmt::format("{} ({})", name, std::filesystem::weakly_canonical(run.folder).filename().string()));
    with_path.push_back(fmt::format("{} ({})", name, run.folder.string()));
  }
  if (have_one_sweep(runs) && std::find(swept.begin(), swept.end(), "") == swept.end() && all_differ(swept)) return swept;
  return all_differ(names) ? names : all_differ(with_folder) ? with_folder : with_path;
}

std::string title_of(std::span<const RunFolder> runs)
{
  if (runs.size() == 1) return labels_of(runs).front();
  return have_one_sweep(runs) ? fmt::format("{}: {} runs", sweep_of(runs.front()), runs.size()) : fmt::format("{} runs compared", runs.size());
}

Json differing_settings(std::span<const RunFolder> runs)
{
  std::set<std::string> keys;
  for (const RunFolder& run : runs)
    for (const auto& [key, value] : run.settings)
      if (key != "name" && key != "description") keys.insert(key);
  Json rows = Json::array();
  for (const std::string& key : keys) {
    const Json values = each(runs, [&](const RunFolder& run) {
      const auto setting = run.settings.find(key);
      return setting == run.settings.end() ? Json() : Json(setting->second);
    });
    if (std::set<Json>(values.begin(), values.end()).size() > 1) rows.push_back({{"key", key}, {"values", values}});
  }
  return rows;
}

Json final_errors(std::span<const RunFolder> runs)
{
  Strings columns;
  for (const RunFolder& run : runs)
    if (run.history)
      for (const std::string& column : run.history->columns)
        if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  Json rows = Json::array();
  for (const std::string& column : columns) {
    const auto last = [&](const RunFolder& run) {
      const double error = run.history && !run.history->rows.empty() ? job::error_in(*run.history, run.history->rows.back(), column) : NAN;
      return std::isfinite(error) ? Json(error) : Json();
    };
    const auto floor = [&](const RunFolder& run) {
      if (!run.history || run.history->noise_floor.empty()) return Json();
      const double error = job::error_in(*run.history, {0, 0, 0, 0, run.history->noise_floor}, column);
      return std::isfinite(error) ? Json(error) : Json();
    };
    rows.push_back({{"column", column}, {"values", each(runs, last)}, {"floors", each(runs, floor)}});
  }
  return rows;
}

} // namespace nephroid::report
