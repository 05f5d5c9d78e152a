// SPDX-License-Identifier: Apache-2.0
// From folders to data, and the data into the page, which holds its style, its script and the chart library itself.
#include "report/report.h"

#include "base/json_output.h"
#include "measure/difference.h"
#include "report/comparison.h"
#include "report/overview.h"
#include "report/pictures.h"

#include <algorithm>

namespace nephroid::report {
namespace {

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
  std::vector<RunFolder> runs;
  for (const std::filesystem::path& folder : find_runs(run_folders)) runs.push_back(read_run(folder));
  Pictures pictures = read_pictures(runs);
  Json data{{"title", title_of(runs)},
            {"runs", Json::array()},
            {"settings", differing_settings(runs)},
            {"errors", final_errors(runs)},
            {"metrics", metrics_json(runs, pictures.reference_of_run)},
            {"pictures", std::move(pictures.groups)},
            {"colours", colours()},
            {"notes", std::move(pictures.notes)}};
  const std::vector<std::string> labels = labels_of(runs);
  for (std::size_t i = 0; i < runs.size(); ++i)
    data["runs"].push_back({{"label", labels[i]},
                            {"folder", runs[i].folder.string()},
                            {"measurements", runs[i].history ? Json(runs[i].history->rows.size()) : Json()},
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
