// SPDX-License-Identifier: Apache-2.0
// From folders to data, and the data into the page, which holds its style, its script and the chart library itself.
// What every run writes is required: a report with holes would be believed.
#include "report/report.h"

#include "base/files.h"
#include "base/json_output.h"
#include "base/numbers.h"
#include "measure/difference.h"
#include "measure/run_files.h"
#include "preset/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <sstream>

namespace nephroid::report {
namespace fs = std::filesystem;
namespace {

using measure::RunDocument;
using Type = RunDocument::Type;

/// An engine has a name of its own for what it counts.
std::string where_stopped(const RunDocument& run) {
  return run.has("/passes")
             ? fmt::format(": it stopped in pass {}", run.at("/passes", Type::whole).get<std::int64_t>() + 1)
             : "";
}

Json read_run_json(const fs::path& folder) {
  const RunDocument run(folder / "run.json");
  if (!run.at("/finished", Type::flag))
    throw bad_input(folder.string(), "this run is not finished" + where_stopped(run), "expected a finished run",
                    "go on with `nephroid run --resume`");
  for (const char* text : {"/name", "/engine", "/version", "/commit", "/compiler"}) run.at(text, Type::text);
  run.at("/seed", Type::whole);
  run.at("/device", Type::object);
  run.at("/work_seconds", Type::number);
  for (const auto& [pointer, type] : {std::pair{"/passes", Type::whole},
                                      {"/photons", Type::whole},
                                      {"/phase_seconds", Type::numbers},
                                      {"/energy", Type::numbers},
                                      {"/errors", Type::numbers},
                                      {"/wall_seconds", Type::number},
                                      {"/measuring_seconds", Type::number},
                                      {"/error_column", Type::text}})
    if (run.has(pointer)) run.at(pointer, type);
  if (run.has("/reference")) run.at("/reference/origin", Type::text);
  if (run.has("/display"))
    for (const auto& [pointer, type] : {std::pair{"/display/gamut", Type::text},
                                        {"/display/tone", Type::text},
                                        {"/display/white_balance", Type::list}})
      run.at(pointer, type);
  return run.json();
}

/// The choice of this word, or the one before where a later version has further ones.
template <class E>
void choose(E& value, const std::string& word) {
  for (const auto& choice : preset::choices<E>)
    if (choice.name == word) value = choice.value;
}

/// Plain where the run is of a version that did not say it.
image::Display read_display(const Json& run) {
  image::Display display;
  if (!run.contains("display")) return display;
  choose(display.gamut, run["display"]["gamut"]);
  choose(display.tone, run["display"]["tone"]);
  const Json& matrix = run["display"]["white_balance"];
  for (std::size_t i = 0; i < std::min(matrix.size(), display.white_balance.size()); ++i)
    display.white_balance[i] = matrix[i].is_number() ? matrix[i].get<float>() : 0;
  return display;
}

std::map<std::string, std::string> read_settings(const fs::path& folder) {
  std::map<std::string, std::string> settings;
  const Json flat = RunDocument(folder / "preset.json").json().flatten();
  for (const auto& [pointer, value] : flat.items()) { // "/scene/lights/0/power_w"
    std::string key = pointer.substr(std::min<std::size_t>(1, pointer.size()));
    std::replace(key.begin(), key.end(), '/', '.');
    settings[key] = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return settings;
}

Json read_plan(const fs::path& folder) {
  const RunDocument plan(folder / "plan.json");
  plan.at("/engine", Type::text);
  const auto each = [&](const std::string& list, std::initializer_list<std::pair<const char*, Type>> members) {
    for (std::size_t i = 0; i < plan.at(list, Type::list).size(); ++i)
      for (const auto& [member, type] : members) plan.at(fmt::format("{}/{}/{}", list, i, member), type);
  };
  each("/passes", {{"name", Type::text}, {"runs", Type::flag}, {"reason", Type::text}});
  each("/buffers", {{"name", Type::text}, {"bytes", Type::whole}});
  return plan.json();
}

/// A curve that the engine added (job::Curve): names of columns, then rows of numbers; what is not finite is null.
Json read_curve(const fs::path& file) {
  Json curve{{"name", file.stem().string()}, {"columns", Json::array()}, {"rows", Json::array()}};
  std::istringstream lines(read_file(file));
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string place = fmt::format("{}:{}", file.string(), ++number);
    Json row = Json::array();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      const auto value = number_in<double>(cell);
      if (number > 1 && !value) throw bad_input(place, "a cell is no number", "expected a table of numbers");
      row.push_back(number == 1 ? Json(cell) : std::isfinite(*value) ? Json(*value) : Json());
    }
    if (number > 1 && row.size() != curve["columns"].size())
      throw bad_input(place, fmt::format("the row has {} cells", row.size()),
                      fmt::format("expected {}", curve["columns"].size()));
    if (number == 1)
      curve["columns"] = row;
    else
      curve["rows"].push_back(row);
  }
  return curve;
}

Json read_curves(const fs::path& folder) {
  Json curves = Json::array();
  for (const fs::path& file : files_ending(folder, ".csv"))
    if (file.filename() != "history.csv") curves.push_back(read_curve(file));
  return curves;
}

/// A run's folder before or while it runs: begin_run has written these two, nothing has written run.json.
bool is_begun_run(const fs::path& folder) { return is_there(folder / "plan.json") && is_there(folder / "preset.json"); }

/// The runs that a sweep's file names, as far as they are there: an earlier sweep may have left others.
std::vector<fs::path> in_order(const fs::path& sweep, std::vector<fs::path> runs) {
  if (!is_there(sweep / sweep_file)) return runs;
  const RunDocument order(sweep / sweep_file);
  std::vector<fs::path> ordered;
  for (std::size_t i = 0; i < order.at("/runs", Type::list).size(); ++i)
    if (const fs::path run = sweep / order.at(fmt::format("/runs/{}", i), Type::text).get<std::string>();
        std::ranges::count(runs, run) > 0)
      ordered.push_back(run);
  return ordered.empty() ? runs : ordered;
}

/// The run in a folder, or the runs in its folders, also those that have not ended: read_run refuses them.
std::vector<fs::path> runs_in(const fs::path& folder) {
  const auto is_run = [](const fs::path& path) { return is_there(path / "run.json") || is_begun_run(path); };
  std::error_code error;
  if (!fs::exists(folder, error)) throw bad_input(folder.string(), "there is no such folder");
  if (!fs::is_directory(folder, error)) throw bad_input(folder.string(), "is a file", "expected the folder of a run");
  if (is_run(folder)) return {folder};
  std::vector<fs::path> runs;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (std::error_code ignored; entry->is_directory(ignored) && is_run(entry->path())) runs.push_back(entry->path());
  if (error) throw bad_input(folder.string(), "cannot be read: " + error.message());
  if (runs.empty())
    throw bad_input(folder.string(), "holds no run",
                    "expected a folder with run.json, or one of a sweep with such folders inside",
                    "make one with `nephroid run`");
  std::sort(runs.begin(), runs.end());
  return in_order(folder, std::move(runs));
}

RunFolder read_run(const fs::path& folder) {
  if (!is_there(folder / "run.json") && is_begun_run(folder))
    throw bad_input(folder.string(), "this run is not finished: it has no run.json", "expected a finished run",
                    "wait for it, or go on with `nephroid run --resume`");
  RunFolder run{folder, read_run_json(folder), read_plan(folder), read_settings(folder), read_curves(folder), {}, {}};
  run.display = read_display(run.run);
  if (is_there(folder / "history.csv")) run.history = measure::read_run_history(folder);
  return run;
}

/// A sweep's runs are called "NAME,key=value".
std::string sweep_of(const RunFolder& run) { return run.name().substr(0, run.name().find(',')); }

bool have_one_sweep(std::span<const RunFolder> runs) {
  return std::all_of(runs.begin(), runs.end(),
                     [&](const RunFolder& run) { return sweep_of(run) == sweep_of(runs.front()); });
}

/// Names that tell the runs apart: the preset's, with the folder where needed; of a sweep's runs the part that differs.
std::vector<std::string> labels_of(std::span<const RunFolder> runs) {
  std::vector<std::string> names, swept, with_folder, with_path;
  for (const RunFolder& run : runs) {
    const std::string name = run.name();
    swept.push_back(name.substr(std::min(sweep_of(run).size() + 1, name.size())));
    names.push_back(name);
    with_folder.push_back(fmt::format("{} ({})", name, fs::weakly_canonical(run.folder).filename().string()));
    with_path.push_back(fmt::format("{} ({})", name, run.folder.string()));
  }
  const auto all_differ = [](const auto& labels) {
    return std::set(labels.begin(), labels.end()).size() == labels.size();
  };
  if (have_one_sweep(runs) && std::find(swept.begin(), swept.end(), "") == swept.end() && all_differ(swept))
    return swept;
  return all_differ(names) ? names : all_differ(with_folder) ? with_folder : with_path;
}

std::string title_of(std::span<const RunFolder> runs) {
  if (runs.size() == 1) return runs.front().name();
  return fmt::format(fmt::runtime(have_one_sweep(runs) ? "{1}: {0} runs" : "{0} runs compared"), runs.size(),
                     sweep_of(runs.front()));
}

Json colours() {
  constexpr int stops = 32;
  Json all = Json::array();
  for (int i = 0; i <= stops; ++i) all.push_back(measure::map_colour(i / double{stops}));
  return all;
}

/// JSON for inside a script element, which any "</script" or "<!--" in a string would end: '<' is only ever in strings.
std::string script_safe(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

const std::string& page_file(std::string_view name) {
  const auto& files = page_files();
  return std::find_if(files.begin(), files.end(), [&](const PageFile& file) { return file.name == name; })->text;
}

} // namespace

std::set<fs::path> files_ending(const fs::path& folder, const std::string& extension) {
  std::set<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == extension) files.insert(entry->path());
  return files;
}

std::vector<RunFolder> read_runs(std::span<const fs::path> folders) {
  std::vector<fs::path> found;
  std::set<fs::path> seen;
  for (const fs::path& folder : folders)
    for (fs::path& run : runs_in(folder)) {
      if (!seen.insert(fs::weakly_canonical(run)).second)
        throw bad_input(run.string(), "this run is named twice", "expected every run once");
      found.push_back(std::move(run));
    }
  if (found.size() > max_runs)
    throw bad_input(folders.front().string(), fmt::format("{} runs are too many for one page", found.size()),
                    fmt::format("expected at most {}", max_runs), "name the folders of some of them");
  std::vector<RunFolder> runs;
  for (const fs::path& folder : found) runs.push_back(read_run(folder));
  return runs;
}

Json report_data(std::span<const fs::path> run_folders) {
  std::vector<RunFolder> runs = read_runs(run_folders);
  Pictures pictures = read_pictures(runs);
  Json data{{"title", title_of(runs)},
            {"runs", Json::array()},
            {"metrics", metrics_json(runs, pictures.reference_of_run)},
            {"pictures", std::move(pictures.groups)},
            {"notes", std::move(pictures.notes)},
            {"colours", colours()}};
  const std::vector<std::string> labels = labels_of(runs);
  for (std::size_t i = 0; i < runs.size(); ++i)
    data["runs"].push_back({{"label", labels[i]},
                            {"folder", runs[i].folder.string()},
                            {"measurements", runs[i].history ? Json(runs[i].history->rows.size()) : Json()},
                            {"settings", std::move(runs[i].settings)},
                            {"curves", std::move(runs[i].curves)},
                            {"run", std::move(runs[i].run)},
                            {"plan", std::move(runs[i].plan)}});
  return data;
}

std::string report_html(std::span<const fs::path> run_folders) {
  const std::string data = script_safe(json_text(report_data(run_folders)));
  std::string_view rest = page_file("report.html");
  std::string html;
  for (std::size_t begin = 0; (begin = rest.find("{{")) != std::string_view::npos;) {
    const std::size_t end = rest.find("}}", begin);
    const std::string_view name = rest.substr(begin + 2, end - begin - 2);
    html.append(rest.substr(0, begin)).append(name == "data" ? data : page_file(name));
    rest.remove_prefix(end + 2);
  }
  return html.append(rest);
}

} // namespace nephroid::report
