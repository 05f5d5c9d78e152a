// SPDX-License-Identifier: Apache-2.0
// "Error against time": for each metric its chart, the time to reach round errors, and speed-ups at equal error.
#include "measure/report_metrics.h"
#include "measure/report_page.h"
#include "measure/report_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace nephroid::measure {
namespace {

std::string panel_id(std::size_t metric) { return fmt::format("metric-{}", metric); }

/// The buttons that choose a metric, and the rules that show its panel.
std::string selector(const Report& report)
{
  std::string inputs, labels, rules;
  for (std::size_t i = 0; i < report.metrics.size(); ++i) {
    const std::string id = panel_id(i);
    append(inputs, "<input type=\"radio\" name=\"metric\" id=\"{}\"{}>\n", id, i == 0 ? " checked" : "");
    append(labels, "<label for=\"{}\">{}</label>\n", id, escaped(metric_text(report.metrics[i].metric).label));
    append(rules, "#{0}:checked ~ .panels > #{0}-panel {{ display: block; }}\n", id);
    append(
        rules,
        "#{0}:checked ~ .tabs label[for={0}] {{ border-color: var(--accent); color: var(--ink); box-shadow: 0 0 0 1px var(--accent); }}\n",
        id);
    append(rules, "#{0}:focus-visible ~ .tabs label[for={0}] {{ outline: 2px solid var(--accent); outline-offset: 2px; }}\n", id);
  }
  return fmt::format("<style>\n{}</style>\n{}<div class=\"tabs\">\n{}</div>\n", rules, inputs, labels);
}

std::string caption(const Report& report, const MetricCurves& curves)
{
  const MetricText text = metric_text(curves.metric);
  if (!text.falls) return "Larger is better.";
  std::string words;
  bool estimates = false, floors = false, fits = false;
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    estimates = estimates || !curves.runs[i].estimate.errors.empty();
    floors = floors || curves.runs[i].noise_floor > 0;
    fits = fits || curves.slope(i).has_value();
  }
  if (estimates) words += "Dashed: a run's own estimate of its error; solid: its distance to its reference. ";
  if (floors) words += "Horizontal: what the reference itself is off by, below which a distance to it says nothing. ";
  if (fits)
    words += fmt::format("The slopes are least-squares fits in log-log, equal parts of the time axis counting equally{}. ",
                         floors ? fmt::format(", over errors of at least {} times the floor", text.is_mean_square() ? 9 : 3) : "");
  if (text.law) append(words, "Independent samples give {}.", signed_text(*text.law, 1));
  return words;
}

/// The round errors that some run came down to, the largest first; powers of ten only where there would be too many.
std::vector<double> levels_of(const MetricCurves& curves)
{
  std::set<double> levels;
  for (const RunCurves& run : curves.runs)
    if (const auto reached = errors_reached(run.judged()))
      for (const double level : round_levels(reached->lowest, reached->highest)) levels.insert(level);
  constexpr std::size_t comfortable = 9; // columns of a table
  if (levels.size() > comfortable) std::erase_if(levels, [](double level) { return fmt::format("{:e}", level).front() != '1'; });
  return {levels.rbegin(), levels.rend()};
}

std::string time_cell(const MetricCurves& curves, std::size_t run, double level)
{
  const Curve& curve = curves.runs[run].judged();
  if (const auto seconds = seconds_to_reach(curve, level)) {
    const bool meaningful = level >= curves.lowest_meaningful(run);
    return fmt::format("<td class=\"number{}\">{}</td>", meaningful ? "" : " out", readable_seconds(*seconds) + (meaningful ? "" : " *"));
  }
  if (curve.errors.front() < level) return fmt::format("<td class=\"number\">&lt; {}</td>", readable_seconds(curve.seconds.front()));
  return "<td class=\"number out\">–</td>";
}

double to_three_figures(double value) { return std::stod(three_figures(value)); }

/// A round level as it is, another one with three figures.
std::string level_text(double level) { return fmt::format("{:g}", to_three_figures(level)); }

/// " (CIELAB units)", or nothing.
std::string unit_of(const MetricCurves& curves)
{
  const std::string unit = metric_text(curves.metric).unit;
  return unit.empty() ? "" : " (" + unit + ")";
}

std::string times_table(const Report& report, const MetricCurves& curves)
{
  const std::vector<double> levels = levels_of(curves);
  std::string html = "<h3>Time to reach an error</h3>\n";
  if (levels.empty()) return html + "<p>No run passed a round value.</p>\n";
  append(html, "<div class=\"table\"><table><thead><tr><th>Error{}</th>", unit_of(curves));
  for (const double level : levels) append(html, "<th class=\"number\">{:g}</th>", level);
  html += "</tr></thead><tbody>\n";
  bool below_floor = false;
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    const RunCurves& run = curves.runs[i];
    if (run.judged().errors.empty()) continue;
    append(html, "<tr><th>{}{}</th>", run_name(report, i), run.is_judged_by_estimate() ? " <span class=\"tag\">estimate</span>" : "");
    for (const double level : levels) {
      html += time_cell(curves, i, level);
      below_floor = below_floor || (level < curves.lowest_meaningful(i) && seconds_to_reach(run.judged(), level));
    }
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n<p class=\"note\">Work until the error first fell so far, between measurements along a straight line in "
          "log-log; –: never.";
  if (below_floor) html += " *: near the reference's own noise floor.";
  return html + "</p>\n";
}

/// The settings of a part of the preset ("scene.").
std::map<std::string, std::string> settings_of(const RunSummary& run, std::string_view part)
{
  std::map<std::string, std::string> settings = run.settings;
  std::erase_if(settings, [&](const auto& setting) { return !setting.first.starts_with(part); });
  return settings;
}

/// Whether both rendered one picture: an error of a simpler one is no speed-up.
bool show_one_scene(const RunSummary& a, const RunSummary& b) { return settings_of(a, "scene.") == settings_of(b, "scene."); }

/// Whether both runs tend to one picture, but for noise: photons a pass change how often the film is looked at and nothing else.
bool have_one_bias(const RunSummary& a, const RunSummary& b)
{
  auto of_a = settings_of(a, "spectral."), of_b = settings_of(b, "spectral.");
  for (auto* settings : {&of_a, &of_b}) settings->erase("spectral.photons_per_pass");
  return of_a == of_b;
}

/// Why times of two runs are to be read with care; empty where there is no reason.
std::string remarks(const Report& report, std::size_t a, std::size_t b, bool by_estimate)
{
  const RunSummary &run_a = report.runs[a], &run_b = report.runs[b];
  std::string words;
  const auto add = [&](bool applies, const char* text) {
    if (applies) words += (words.empty() ? "" : ", ") + std::string(text);
  };
  add(!show_one_scene(run_a, run_b), "different scenes");
  add(run_a.device != run_b.device, "different devices");
  add(run_a.version != run_b.version || run_a.commit != run_b.commit || run_a.compiler != run_b.compiler,
      "different builds of the program");
  add(!by_estimate && report.pictures.reference_of_run[a] != report.pictures.reference_of_run[b], "different references");
  add(by_estimate && !have_one_bias(run_a, run_b), "estimates do not see the bias of different settings: give both a reference");
  return words;
}

/// The lowest round errors that both runs came down to, at most `count`. Where none is round, the middle of what they have in common, to
/// three figures: at its end a flat curve's time says little.
std::vector<double> levels_for_pair(const ErrorRange& both, std::size_t count)
{
  std::vector<double> levels = round_levels(both.lowest, both.highest);
  if (levels.empty()) return {std::clamp(to_three_figures(std::sqrt(both.lowest * both.highest)), both.lowest, both.highest)};
  if (levels.size() > count) levels.erase(levels.begin(), levels.end() - static_cast<std::ptrdiff_t>(count));
  return levels;
}

/// Of two curves without a common error: which of the two began below all that the other came to.
std::string why_no_error_in_common(const Curve& curve_a, const Curve& curve_b, std::size_t a, std::size_t b)
{
  const bool a_is_better = curve_a.errors.front() < errors_reached(curve_b)->lowest;
  return fmt::format("{} was better at its first measurement than {} ever was", (a_is_better ? a : b) + 1, (a_is_better ? b : a) + 1);
}

/// The rows of all pairs, and why some pairs have none.
struct Pairs {
  std::string rows, not_compared;
  bool with_care = false;
};

void add_pair(Pairs& pairs, const Report& report, const MetricCurves& curves, std::size_t a, std::size_t b)
{
  const RunCurves &of_a = curves.runs[a], &of_b = curves.runs[b];
  if (of_a.judged().errors.empty() || of_b.judged().errors.empty()) return;
  const bool both_have_references = !of_a.error.errors.empty() && !of_b.error.errors.empty();
  const bool both_have_estimates = !of_a.estimate.errors.empty() && !of_b.estimate.errors.empty();
  const auto skip = [&](const std::string& reason) {
    append(pairs.not_compared, "{}{} and {} ({})", pairs.not_compared.empty() ? "" : "; ", a + 1, b + 1, reason);
  };
  if (!both_have_references && !both_have_estimates) return skip("one is measured against a reference, the other only estimated");
  const bool by_estimate = !both_have_references;
  const Curve &curve_a = by_estimate ? of_a.estimate : of_a.error, &curve_b = by_estimate ? of_b.estimate : of_b.error;
  const double lowest = by_estimate ? 0 : std::max(curves.lowest_meaningful(a), curves.lowest_meaningful(b));
  const auto both = errors_both_reached(curve_a, curve_b, lowest);
  if (!both)
    return skip(errors_both_reached(curve_a, curve_b) ? "nearer to the noise floor than a comparison needs"
                                                      : why_no_error_in_common(curve_a, curve_b, a, b));
  const std::string care = remarks(report, a, b, by_estimate);
  pairs.with_care = pairs.with_care || !care.empty();
  const std::size_t levels = report.runs.size() <= 6 ? 3 : 1;
  for (const double level : levels_for_pair(*both, levels)) {
    const auto equal = at_equal_error(curve_a, curve_b, level);
    if (!equal) continue;
    const bool b_is_faster = equal->seconds_b <= equal->seconds_a;
    append(pairs.rows,
           "<tr><td>{}</td><td>{}</td><td class=\"number\">{}{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
           "<td class=\"number\"><strong>{} ×</strong></td><td class=\"warn\">{}</td></tr>\n",
           run_name(report, b_is_faster ? b : a), run_name(report, b_is_faster ? a : b), level_text(level),
           by_estimate ? " <span class=\"tag\">estimate</span>" : "", readable_seconds(b_is_faster ? equal->seconds_b : equal->seconds_a),
           readable_seconds(b_is_faster ? equal->seconds_a : equal->seconds_b),
           three_figures(b_is_faster ? equal->speed_up() : 1 / equal->speed_up()), care);
  }
}

std::string speed_up_table(const Report& report, const MetricCurves& curves)
{
  if (report.runs.size() < 2) return "";
  Pairs pairs;
  for (std::size_t a = 0; a < report.runs.size(); ++a)
    for (std::size_t b = a + 1; b < report.runs.size(); ++b) add_pair(pairs, report, curves, a, b);
  std::string html = "<h3>Speed-up at equal error</h3>\n";
  if (!pairs.rows.empty()) {
    append(html,
           "<div class=\"table tall\"><table><thead><tr><th>Faster</th><th>Slower</th><th class=\"number\">At the error{}</th>"
           "<th class=\"number\">Faster takes</th><th class=\"number\">Slower takes</th><th class=\"number\">Speed-up</th>"
           "<th>{}</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
           unit_of(curves), pairs.with_care ? "To be read with care" : "", pairs.rows);
    html += "<p class=\"note\">Times are those of each run's own file: compare runs of one machine, made in one go.</p>\n";
  }
  if (!pairs.not_compared.empty()) append(html, "<p class=\"note\">Not compared: {}.</p>\n", pairs.not_compared);
  return html;
}

/// Whether the run ended much further from its reference than its own noise and the reference's explain.
bool looks_biased(const MetricCurves& curves, std::size_t run)
{
  const RunCurves& of_run = curves.runs[run];
  if (of_run.error.errors.empty() || of_run.estimate.errors.empty()) return false;
  const double error = of_run.error.errors.back(), noise = of_run.estimate.errors.back(), floor = of_run.noise_floor;
  return metric_text(curves.metric).is_mean_square() ? error > 4 * (noise + floor) : error > 2 * std::hypot(noise, floor);
}

std::string bias_note(const Report& report, const MetricCurves& curves)
{
  std::string names;
  for (std::size_t i = 0; i < report.runs.size(); ++i)
    if (looks_biased(curves, i)) names += (names.empty() ? "" : ", ") + run_name(report, i);
  if (names.empty()) return "";
  return fmt::format(
      "<p class=\"note\"><span class=\"warn\">Biased:</span> {}. At the end the distance to the reference is more than twice what "
      "noise explains: a systematic difference, which more work does not remove.</p>\n",
      names);
}

std::string panel(const Report& report, std::size_t index)
{
  const MetricCurves& curves = report.metrics[index];
  std::string html =
      fmt::format("<div class=\"panel\" id=\"{}-panel\">\n<figure class=\"chart\">\n{}\n<figcaption>{}</figcaption></figure>\n",
                  panel_id(index), report.charts[index], caption(report, curves));
  if (metric_text(curves.metric).falls) html += bias_note(report, curves) + times_table(report, curves) + speed_up_table(report, curves);
  return html + "</div>\n";
}

/// The runs that are not in any chart.
std::string runs_without_errors(const Report& report)
{
  std::string html;
  for (std::size_t i = 0; i < report.runs.size(); ++i) {
    const auto& history = report.runs[i].history;
    if (history && !history->rows.empty()) continue;
    append(html, "<p class=\"note\">{}: {}</p>\n", run_name(report, i),
           history ? "its history.csv has no row: it ended before its first measurement."
                   : "has no history.csv: it did not measure its error.");
  }
  return html;
}

} // namespace

std::string errors_section(const Report& report)
{
  std::string html = "<section id=\"errors\" class=\"metrics\"><h2>Error against time</h2>\n";
  if (report.metrics.empty()) {
    html += "<p>Nothing to draw: no run has an error above 0 in its history.</p>\n";
  } else {
    html += selector(report) + "<div class=\"panels\">\n";
    for (std::size_t i = 0; i < report.metrics.size(); ++i) html += panel(report, i);
    html += "</div>\n";
  }
  return html + runs_without_errors(report) + "</section>\n";
}

} // namespace nephroid::measure
