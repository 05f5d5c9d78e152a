// SPDX-License-Identifier: Apache-2.0
// From folders to a page: reads the runs, has their curves drawn, joins the sections.
#include "measure/report.h"

#include "measure/report_charts.h"
#include "measure/report_metrics.h"
#include "measure/report_page.h"
#include "measure/report_text.h"

#include <algorithm>
#include <set>

namespace nephroid::measure {
namespace {

constexpr std::size_t longest_label = 36; ///< of a legend, whose two columns share the chart's width

std::string legend(const Report& report, const MetricCurves& curves, std::size_t run)
{
  const auto slope = curves.slope(run);
  return fmt::format("{} {}{}{}", run + 1, shortened(report.labels[run], longest_label),
                     curves.runs[run].is_judged_by_estimate() ? " (estimate)" : "",
                     slope && metric_text(curves.metric).falls ? ", slope " + signed_text(slope->exponent, 2) : "");
}

/// The judged curve of every run, and the estimates of those that have a reference as well.
Chart chart_of(const Report& report, const MetricCurves& curves)
{
  const MetricText text = metric_text(curves.metric);
  Chart chart;
  chart.title = text.label + " against seconds of work";
  chart.y_axis = text.label + (text.unit.empty() ? "" : " (" + text.unit + ")");
  chart.logarithmic = text.falls;
  if (text.falls) chart.guide_exponent = text.law;
  std::set<double> floors;
  for (std::size_t i = 0; i < curves.runs.size(); ++i) {
    const RunCurves& run = curves.runs[i];
    if (run.judged().errors.empty()) continue;
    chart.lines.push_back({legend(report, curves, i), i, run.is_judged_by_estimate(), run.judged()});
    if (!run.is_judged_by_estimate() && !run.estimate.errors.empty()) chart.lines.push_back({"", i, true, run.estimate});
    if (run.noise_floor > 0) floors.insert(run.noise_floor);
  }
  chart.noise_floors.assign(floors.begin(), floors.end());
  return chart;
}

Report read_report(std::span<const std::filesystem::path> run_folders)
{
  Report report;
  for (const std::filesystem::path& folder : find_runs(run_folders)) report.runs.push_back(read_run(folder));
  for (std::string& label : report.labels = labels_of(report.runs)) label = utf8(label);
  report.metrics = curves_of(report.runs);
  report.pictures = read_pictures(report.runs);
  std::vector<Chart> charts;
  for (const MetricCurves& curves : report.metrics) charts.push_back(chart_of(report, curves));
  report.charts = draw_charts(charts);
  return report;
}

const std::string& page_file(std::string_view name)
{
  const auto& files = page_files();
  return std::find_if(files.begin(), files.end(), [&](const PageFile& file) { return file.name == name; })->text;
}

std::string title_of(const Report& report)
{
  if (report.runs.size() == 1) return escaped(report.labels.front());
  std::set<std::string> names;
  for (const RunSummary& run : report.runs) names.insert(run.name.substr(0, run.name.find(',')));
  return names.size() == 1 ? fmt::format("{}: {} runs", escaped(*names.begin()), report.runs.size())
                           : fmt::format("{} runs compared", report.runs.size());
}

/// What the policy allows is what the page holds itself: a browser would refuse anything from elsewhere.
std::string head(const std::string& title)
{
  return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
                     "script-src 'unsafe-inline'\">\n<title>{} - Nephroid</title>\n<style>\n{}</style>\n</head>\n",
                     title, page_file("report.css"));
}

} // namespace

std::string report_html(std::span<const std::filesystem::path> run_folders)
{
  const Report report = read_report(run_folders);
  const std::string title = title_of(report);
  return head(title) + fmt::format("<body>\n<header><h1>{}</h1>\n<p class=\"soft\">Nephroid: error against run time</p>\n", title) +
         "<nav><a href=\"#compared\">What was compared</a><a href=\"#errors\">Error against time</a><a href=\"#pictures\">Pictures</a>"
         "<a href=\"#plans\">Plans</a><a href=\"#machines\">Machines</a></nav></header>\n<main>\n" +
         overview_section(report) + errors_section(report) + pictures_section(report) + plans_section(report) + machines_section(report) +
         "</main>\n<script>\n" + page_file("report.js") + "</script>\n</body>\n</html>\n";
}

} // namespace nephroid::measure
