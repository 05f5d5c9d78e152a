// SPDX-License-Identifier: Apache-2.0
// "Plans" and "Machines": what each run did and left out and why, on what, and where its time and its light went.
#include "measure/report_page.h"
#include "measure/report_text.h"

namespace nephroid::measure {
namespace {

std::string list_of(const std::vector<std::string>& notes)
{
  if (notes.empty()) return "";
  std::string html = "<ul class=\"note\">\n";
  for (const std::string& note : notes) append(html, "<li>{}</li>\n", escaped(note));
  return html + "</ul>\n";
}

std::string plan_of(const RunSummary& run)
{
  std::string html = "<div class=\"table\"><table><thead><tr><th>Pass</th><th></th><th>Reason</th></tr></thead><tbody>\n";
  for (const plan::Pass& pass : run.plan.passes)
    append(html, "<tr{}><th>{}</th><td>{}</td><td>{}</td></tr>\n", pass.runs ? "" : " class=\"out\"", escaped(pass.name),
           pass.runs ? "runs" : "<span class=\"tag\">left out</span>", escaped(pass.reason));
  std::uint64_t bytes = 0;
  for (const plan::PlannedBuffer& buffer : run.plan.buffers) bytes += buffer.bytes;
  append(html, "</tbody></table></div>\n<p class=\"note\">{} buffers, {} on the device.</p>\n", run.plan.buffers.size(),
         plan::readable_bytes(bytes));
  return html + list_of(run.plan.notes);
}

std::string machine_table(const RunSummary& run)
{
  std::string html = "<div class=\"table\"><table><tbody>\n";
  const auto row = [&](const std::string& what, const std::string& value) {
    append(html, "<tr><th>{}</th><td>{}</td></tr>\n", escaped(what), escaped(value));
  };
  for (const auto& [key, value] : run.device) row(key == "name" ? "device" : key == "compute_units" ? "compute units" : key, value);
  row("program", fmt::format("Nephroid {} ({}), {}", run.version, run.commit, run.compiler));
  row("engine", run.engine);
  row("seed", std::to_string(run.seed));
  return html + "</tbody></table></div>\n";
}

std::string time_table(const RunSummary& run)
{
  std::string html = "<h3>Where the time went</h3>\n<div class=\"table\"><table><thead><tr><th>Phase</th><th class=\"number\">Time</th>"
                     "<th class=\"number\">of the work</th></tr></thead><tbody>\n";
  for (const auto& [phase, seconds] : run.phase_seconds)
    append(html, "<tr><th>{}</th><td class=\"number\">{}</td><td class=\"number\">{:.1f} %</td></tr>\n", escaped(phase),
           readable_seconds(seconds), run.work_seconds > 0 ? 100 * seconds / run.work_seconds : 0.0);
  return html + "</tbody></table></div>\n";
}

std::string light_table(const RunSummary& run)
{
  double emitted = 0;
  for (const auto& [key, watts] : run.energy_w)
    if (key == "emitted") emitted = watts;
  std::string html =
      "<h3>Where the photons' power went</h3>\n<div class=\"table\"><table><thead><tr><th></th><th class=\"number\">Power</th>"
      "<th class=\"number\">of the emitted</th></tr></thead><tbody>\n";
  for (const auto& [key, watts] : run.energy_w)
    append(html, "<tr><th>{}</th><td class=\"number\">{} W</td><td class=\"number\">{}</td></tr>\n", escaped(key), three_figures(watts),
           emitted > 0 ? fmt::format("{:.2f} %", 100 * watts / emitted) : "–");
  return html + "</tbody></table></div>\n";
}

/// The same details for every run, folded away where there are several.
template <class Details>
std::string for_each_run(const Report& report, Details details)
{
  std::string html;
  for (std::size_t i = 0; i < report.runs.size(); ++i)
    append(html, "<details{}><summary>{}</summary><div>\n{}</div></details>\n", report.runs.size() == 1 ? " open" : "", run_name(report, i),
           details(report.runs[i]));
  return html;
}

} // namespace

std::string plans_section(const Report& report)
{
  return "<section id=\"plans\"><h2>Plans</h2>\n" + for_each_run(report, plan_of) + "</section>\n";
}

std::string machines_section(const Report& report)
{
  return "<section id=\"machines\"><h2>Machines</h2>\n" +
         for_each_run(report, [](const RunSummary& run) { return machine_table(run) + time_table(run) + light_table(run); }) +
         "</section>\n";
}

} // namespace nephroid::measure
