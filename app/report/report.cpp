// SPDX-License-Identifier: Apache-2.0
// From folders to data, and the data into the page, which holds its style, its script and the chart library itself.
#include "report/report.h"

#include "base/json_output.h"
#include "measure/difference.h"
#include "report/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace nephroid::report {
namespace {

/// A sweep's runs are called "NAME,key=value".
std::string sweep_of(const RunFolder& run) { return run.name().substr(0, run.name().find(',')); }

bool have_one_sweep(std::span<const RunFolder> runs)
{
  return std::all_of(runs.begin(), runs.end(), [&](const RunFolder& run) { return sweep_of(run) == sweep_of(runs.front()); });
}

/// Names that tell the runs apart: the preset's, with the folder where two have one name; of a sweep's runs the part that differs.
std::vector<std::string> labels_of(std::span<const RunFolder> runs)
{
  std::vector<std::string> names, swept, with_folder, with_path;
  for (const RunFolder& run : runs) {
    const std::string name = run.name();
    swept.push_back(name.substr(std::min(sweep_of(run).size() + 1, name.size())));
    names.push_back(name);
    with_folder.push_back(fmt::format("{} ({})", name, std::filesystem::weakly_canonical(run.folder).filename().string()));
    with_path.push_back(fmt::format("{} ({})", name, run.folder.string()));
  }
  const auto all_differ = [](const auto& labels) { return std::set(labels.begin(), labels.end()).size() == labels.size(); };
  if (have_one_sweep(runs) && std::find(swept.begin(), swept.end(), "") == swept.end() && all_differ(swept)) return swept;
  return all_differ(names) ? names : all_differ(with_folder) ? with_folder : with_path;
}

std::string title_of(std::span<const RunFolder> runs)
{
  if (runs.size() == 1) return runs.front().name();
  return fmt::format(fmt::runtime(have_one_sweep(runs) ? "{1}: {0} runs" : "{0} runs compared"), runs.size(), sweep_of(runs.front()));
}

Json colours()
{
  constexpr int stops = 32;
  Json all = Json::array();
  for (int i = 0; i <= stops; ++i) all.push_back(measure::map_colour(i / double{stops}));
  return all;
}

/// JSON for inside a script element, which any "</script" or "<!--" in a string would end: '<' is only ever in strings.
std::string script_safe(const std::string& json)
{
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

const std::string& page_file(std::string_view name)
{
  const auto& files = page_files();
  return std::find_if(files.begin(), files.end(), [&](const PageFile& file) { return file.name == name; })->text;
}

} // namespace

Json report_data(std::span<const std::filesystem::path> run_folders)
{
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

std::string report_html(std::span<const std::filesystem::path> run_folders)
{
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
