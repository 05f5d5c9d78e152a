// SPDX-License-Identifier: Apache-2.0
// "What was compared": the runs, what they cost, where their presets differ, how far off they ended.
#include "measure/report_charts.h"
#include "measure/report_metrics.h"
#include "measure/report_page.h"
#include "measure/report_text.h"

#include <algorithm>
#include <map>
#include <set>

namespace nephroid::measure {
namespace {

constexpr std::size_t longest_value = 60; ///< of a setting; a table of wavelengths is longer

std::string device_name(const RunSummary& run)
{
  for (const auto& [key, value] : run.device)
    if (key == "name") return value;
  return "";
}

std::string measuring_cell(const RunSummary& run)
{
  if (!run.measuring_seconds) return "–";
  const double all = run.work_seconds + *run.measuring_seconds;
  return fmt::format("{} ({:.1f} %)", readable_seconds(*run.measuring_seconds), all > 0 ? 100 * *run.measuring_seconds / all : 0.0);
}

bool have_one_device(const std::vector<RunSummary>& runs)
{
  return std::all_of(runs.begin(), runs.end(), [&](const RunSummary& run) { return run.device == runs.front().device; });
}

std::string runs_table(const Report& report)
{
  const bool one_device = have_one_device(report.runs);
  std::string html = fmt::format("<div class=\"table\"><table><thead><tr><th>Run</th>{}<th class=\"number\">Passes</th>"
                                 "<th class=\"number\">Photons</th><th class=\"number\">Work</th><th class=\"number\">Measuring</th>"
                                 "<th class=\"number\">Wall clock</th><th>Folder</th></tr></thead><tbody>\n",
                                 one_device ? "" : "<th>Device</th>");
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    const RunSummary& run = report.runs[i];
    append(html,
           "<tr><th class=\"name\">{}</th>{}<td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
           "<td class=\"number\">{}</td><td class=\"number\">{}</td><td><code>{}</code></td></tr>\n",
           run_name(report, i), one_device ? "" : "<td>" + escaped(device_name(run)) + "</td>", run.passes,
           readable_count(static_cast<double>(run.photons)), readable_seconds(run.work_seconds), measuring_cell(run),
           run.wall_seconds ? readable_seconds(*run.wall_seconds) : "–", escaped(run.folder.string()));
  }
  html += "</tbody></table></div>\n<p class=\"note\">Work is the time of rendering alone, without start-up and without measuring; errors "
          "are drawn over it. The share is that of measuring in the two together.";
  if (one_device) append(html, " Device: {}.", escaped(device_name(report.runs.front())));
  return html + "</p>\n";
}

std::string value_cell(const RunSummary& run, const std::string& key)
{
  const auto setting = run.settings.find(key);
  if (setting == run.settings.end()) return "<span class=\"out\">–</span>";
  return fmt::format("<code>{}</code>", escaped(shortened(setting->second, longest_value)));
}

/// The keys that not every run has, or not with one value. Names and descriptions are for people.
std::vector<std::string> differing_keys(const std::vector<RunSummary>& runs)
{
  std::map<std::string, std::set<std::string>> values;
  std::map<std::string, std::size_t> counts;
  for (const RunSummary& run : runs)
    for (const auto& [key, value] : run.settings) {
      values[key].insert(value);
      ++counts[key];
    }
  std::vector<std::string> keys;
  for (const auto& [key, different] : values)
    if (key != "name" && key != "description" && (different.size() > 1 || counts[key] < runs.size())) keys.push_back(key);
  return keys;
}

std::string settings_table(const Report& report)
{
  if (report.runs.size() < 2) return "";
  const std::vector<std::string> keys = differing_keys(report.runs);
  std::string html = "<h3>Settings that differ</h3>\n";
  if (keys.empty()) return html + "<p>None: the presets of all runs are the same.</p>\n";
  append(html, "<div class=\"table tall\"><table><thead><tr><th>Setting</th>{}</tr></thead><tbody>\n", run_headings(report));
  for (const std::string& key : keys) {
    append(html, "<tr><th><code>{}</code></th>", escaped(key));
    for (const RunSummary& run : report.runs) append(html, "<td>{}</td>", value_cell(run, key));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// By column: those of run.json, else of the history's last row.
std::map<std::string, double> final_errors(const RunSummary& run)
{
  std::map<std::string, double> errors = run.errors;
  if (errors.empty() && run.history && !run.history->rows.empty())
    for (std::size_t i = 0; i < run.history->columns.size(); ++i)
      if (const double value = run.history->rows.back().errors[i]; value == value) errors[run.history->columns[i]] = value;
  return errors;
}

std::string error_cell(const RunSummary& run, const std::map<std::string, double>& errors, const std::string& column)
{
  const auto error = errors.find(column);
  if (error == errors.end()) return "<td class=\"out\">–</td>";
  std::string cell = three_figures(error->second);
  if (run.reference) {
    const auto floor = run.reference->noise_floor.find(column);
    if (floor != run.reference->noise_floor.end()) append(cell, "<br><small class=\"soft\">floor {}</small>", three_figures(floor->second));
  }
  return "<td class=\"value\">" + cell + "</td>";
}

std::string metric_cell(const std::string& metric, bool is_estimate)
{
  const MetricText text = metric_text(metric);
  return fmt::format("<th class=\"name\">{} <small class=\"soft\">{}</small>{}</th>", escaped(text.label), text.unit,
                     is_estimate ? " <span class=\"tag\">estimate</span>" : "");
}

std::string final_errors_table(const Report& report)
{
  std::vector<std::map<std::string, double>> errors;
  std::set<std::string> present;
  for (const RunSummary& run : report.runs) {
    errors.push_back(final_errors(run));
    for (const auto& [column, value] : errors.back()) present.insert(column);
  }
  if (present.empty()) return "";
  std::string html = fmt::format(
      "<h3>Errors at the end</h3>\n<div class=\"table\"><table><thead><tr><th>Metric</th>{}</tr></thead><tbody>\n", run_headings(report));
  for (const bool is_estimate : {false, true})
    for (const MetricCurves& curves : report.metrics) {
      const std::string column = column_name({curves.metric, is_estimate});
      if (!present.contains(column)) continue;
      append(html, "<tr>{}", metric_cell(curves.metric, is_estimate));
      for (std::size_t i = 0; i < report.runs.size(); ++i) html += error_cell(report.runs[i], errors[i], column);
      html += "</tr>\n";
    }
  return html +
         "</tbody></table></div>\n<p class=\"note\">Floor: what the reference itself is off by. An estimate is a run's own, made from "
         "two independent halves of its samples.</p>\n";
}

} // namespace

std::vector<std::string> labels_of(const std::vector<RunSummary>& runs)
{
  const auto all_differ = [](const std::vector<std::string>& labels) {
    return std::set<std::string>(labels.begin(), labels.end()).size() == labels.size();
  };
  std::vector<std::string> names, swept, with_folder, with_path;
  std::set<std::string> sweeps;
  for (const RunSummary& run : runs) {
    const std::size_t comma = std::min(run.name.find(','), run.name.size()); // a sweep's runs are "NAME,key=value"
    sweeps.insert(run.name.substr(0, comma));
    swept.push_back(run.name.substr(std::min(comma + 1, run.name.size())));
    names.push_back(run.name);
    with_folder.push_back(fmt::format("{} ({})", run.name, std::filesystem::weakly_canonical(run.folder).filename().string()));
    with_path.push_back(fmt::format("{} ({})", run.name, run.folder.string()));
  }
  const bool is_one_sweep = sweeps.size() == 1 && std::none_of(swept.begin(), swept.end(), [](const auto& part) { return part.empty(); });
  if (is_one_sweep && all_differ(swept)) return swept;
  return all_differ(names) ? names : all_differ(with_folder) ? with_folder : with_path;
}

std::string run_name(const Report& report, std::size_t run)
{
  std::string name;
  for (const char c : escaped(report.labels[run])) name += c == ',' ? std::string(",<wbr>") : std::string(1, c); // a line may end there
  return fmt::format("<span class=\"dot\" style=\"--run:{}\"></span>{}&nbsp;{}", run_colour(run), run + 1, name);
}

std::string run_headings(const Report& report)
{
  std::string html;
  for (std::size_t i = 0; i < report.runs.size(); ++i) append(html, "<th class=\"name\">{}</th>", run_name(report, i));
  return html;
}

std::string overview_section(const Report& report)
{
  return "<section id=\"compared\"><h2>What was compared</h2>\n" + runs_table(report) + settings_table(report) +
         final_errors_table(report) + "</section>\n";
}

} // namespace nephroid::measure
