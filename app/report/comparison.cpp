// SPDX-License-Identifier: Apache-2.0
// Error curves of runs held against each other.
#include "report/report.h"

#include "measure/run_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::report {
namespace {

using measure::Curve;
using measure::RunCurves;

/// Every run's curves of one metric.
struct MetricCurves {
  std::string metric;
  std::vector<RunCurves> runs;
  bool falls = false;
};

std::vector<MetricCurves> curves_of(std::span<const RunFolder> runs) {
  std::vector<MetricCurves> all;
  std::map<std::string, int> votes; // how many runs are judged by the metric
  for (const RunFolder& run : runs) {
    if (!run.history) continue;
    ++votes[measure::error_column_of(run.history->error_column).metric];
    for (const std::string& metric : measure::metric_names(*run.history))
      if (std::none_of(all.begin(), all.end(), [&](const auto& other) { return other.metric == metric; }))
        all.push_back({metric, {}});
  }
  for (MetricCurves& curves : all) {
    const auto is_error = [&](const RunFolder& run) {
      return run.history && measure::is_error(*run.history, curves.metric);
    };
    curves.falls = std::any_of(runs.begin(), runs.end(), is_error);
    for (const RunFolder& run : runs)
      curves.runs.push_back(run.history ? measure::run_curves(*run.history, curves.metric, curves.falls) : RunCurves{});
  }
  std::erase_if(all, [](const MetricCurves& curves) {
    return std::all_of(curves.runs.begin(), curves.runs.end(),
                       [](const RunCurves& run) { return run.judged().errors.empty(); });
  });
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return std::pair(-votes[a.metric], !a.falls) < std::pair(-votes[b.metric], !b.falls);
  });
  return all;
}

Json line_json(std::size_t run, const RunCurves& curves, bool is_estimate) {
  const Curve& curve = is_estimate ? curves.estimate : curves.error;
  const auto slope = is_estimate == curves.is_judged_by_estimate() ? curves.slope() : std::nullopt;
  Json points = Json::array();
  for (std::size_t i = 0; i < curve.seconds.size(); ++i) points.push_back({curve.seconds[i], curve.errors[i]});
  return {{"run", run},
          {"estimate", is_estimate},
          {"slope", slope ? Json(slope->exponent) : Json()},
          {"floor", is_estimate ? 0 : curves.noise_floor},
          {"points", std::move(points)}};
}

/// Whether the run ended much further from its reference than its own noise and the reference's explain.
bool looks_biased(const RunCurves& run) {
  if (run.error.errors.empty() || run.estimate.errors.empty()) return false;
  const double error = run.error.errors.back(), noise = run.estimate.errors.back(), floor = run.noise_floor;
  return measure::metric_text(run.metric).is_mean_square() ? error > 4 * (noise + floor)
                                                           : error > 2 * std::hypot(noise, floor);
}

/// The round errors that some run came down to, the largest first; powers of ten only where there would be too many.
std::vector<double> levels_of(const MetricCurves& curves) {
  std::set<double> levels;
  for (const RunCurves& run : curves.runs)
    if (const auto reached = measure::errors_reached(run.judged()))
      for (const double level : measure::round_levels(reached->lowest, reached->highest)) levels.insert(level);
  constexpr std::size_t comfortable = 9; // columns of a table
  if (levels.size() > comfortable)
    std::erase_if(levels, [](double level) { return fmt::format("{:e}", level).front() != '1'; });
  return {levels.rbegin(), levels.rend()};
}

Json times_json(const MetricCurves& curves, const std::vector<double>& levels) {
  Json times = Json::array();
  for (std::size_t i = 0; i < curves.runs.size(); ++i) {
    const RunCurves& run = curves.runs[i];
    if (run.judged().errors.empty()) continue;
    Json cells = Json::array();
    for (const double level : levels) {
      const bool earlier = run.judged().errors.front() < level;
      const auto seconds = earlier ? run.judged().seconds.front() : measure::seconds_to_reach(run.judged(), level);
      const bool near_floor = !earlier && level < run.lowest_meaningful();
      cells.push_back(seconds ? Json{{"seconds", *seconds}, {"earlier", earlier}, {"near_floor", near_floor}} : Json());
    }
    times.push_back({{"run", i}, {"estimate", run.is_judged_by_estimate()}, {"cells", std::move(cells)}});
  }
  return times;
}

/// Whether a part of the two presets ("scene.") is the same, but for one key.
bool have_same_settings(const RunFolder& a, const RunFolder& b, const std::string& part,
                        const std::string& but_for = {}) {
  const auto settings_of = [&](const RunFolder& run) {
    auto settings = run.settings;
    std::erase_if(settings,
                  [&](const auto& setting) { return !setting.first.starts_with(part) || setting.first == but_for; });
    return settings;
  };
  return settings_of(a) == settings_of(b);
}

/// Whether both pictures become the same one in the end, but for what an engine's settings leave out.
bool have_one_truth(const RunFolder& a, const RunFolder& b) {
  return std::ranges::all_of(std::array{"scene.", "unit", "white"},
                             [&](const char* part) { return have_same_settings(a, b, part); });
}

/// Why times of two runs are to be read with care; empty where there is no reason.
std::string remarks(const RunFolder& a, const RunFolder& b, bool have_one_reference, bool by_estimate) {
  std::string words;
  const auto add = [&](bool applies, const char* text) {
    if (applies) words += (words.empty() ? "" : ", ") + std::string(text);
  };
  const auto differ = [&](const char* key) { return a.run[key] != b.run[key]; };
  const std::string engine = a.run["engine"]; // its settings are the part of the preset with its name
  add(differ("device"), "different devices");
  add(differ("version") || differ("commit") || differ("compiler"), "different builds of the program");
  add(!by_estimate && !have_one_reference, "different references");
  // Photons a pass change how often the film is looked at and nothing else.
  add(by_estimate && (differ("engine") || !have_same_settings(a, b, engine + ".", engine + ".photons_per_pass")),
      "estimates do not see the bias of different settings: give both a reference");
  return words;
}

/// The lowest round errors that both runs came down to, at most `count`. Where none is round, the middle of what they
/// have in common, to three figures: at its end a flat curve's time says little.
std::vector<double> levels_for_pair(const measure::ErrorRange& both, std::size_t count) {
  std::vector<double> levels = measure::round_levels(both.lowest, both.highest);
  if (levels.empty())
    return {
        std::clamp(std::stod(fmt::format("{:.2e}", std::sqrt(both.lowest * both.highest))), both.lowest, both.highest)};
  if (levels.size() > count) levels.erase(levels.begin(), levels.end() - static_cast<std::ptrdiff_t>(count));
  return levels;
}

/// All pairs of runs that can be compared, and why the others cannot.
class Pairs {
public:
  Pairs(std::span<const RunFolder> runs, const std::vector<std::optional<std::size_t>>& reference_of_run,
        const MetricCurves& curves)
      : runs_(runs), reference_of_run_(reference_of_run), curves_(curves) {
    for (std::size_t a = 0; a < runs.size(); ++a)
      for (std::size_t b = a + 1; b < runs.size(); ++b)
        if (const std::string reason = add(a, b); !reason.empty())
          not_compared_.push_back(fmt::format("{} and {} ({})", a + 1, b + 1, reason));
  }

  void take_into(Json& json) { json["pairs"] = std::move(pairs_), json["not_compared"] = std::move(not_compared_); }

private:
  /// Why there is nothing to compare; empty where something was added, or one of the two has no curve.
  std::string add(std::size_t a, std::size_t b) {
    const RunCurves &of_a = curves_.runs[a], &of_b = curves_.runs[b];
    if (of_a.judged().errors.empty() || of_b.judged().errors.empty()) return {};
    const bool by_estimate = of_a.error.errors.empty() || of_b.error.errors.empty();
    const Curve &curve_a = by_estimate ? of_a.estimate : of_a.error,
                &curve_b = by_estimate ? of_b.estimate : of_b.error;
    if (!have_one_truth(runs_[a], runs_[b]))
      return "different scenes: to be as near to another truth says nothing of the speed";
    if (curve_a.errors.empty() || curve_b.errors.empty())
      return "one is measured against a reference, the other only estimated";
    const double lowest = by_estimate ? 0 : std::max(of_a.lowest_meaningful(), of_b.lowest_meaningful());
    if (const auto both = measure::errors_both_reached(curve_a, curve_b, lowest)) {
      for (const double level : levels_for_pair(*both, runs_.size() <= 6 ? 3 : 1))
        add_level(a, b, curve_a, curve_b, level, by_estimate);
      return {};
    }
    if (measure::errors_both_reached(curve_a, curve_b)) return "nearer to the noise floor than a comparison needs";
    const bool a_is_better = curve_a.errors.front() < measure::errors_reached(curve_b)->lowest;
    return fmt::format("{} was better at its first measurement than {} ever was", (a_is_better ? a : b) + 1,
                       (a_is_better ? b : a) + 1);
  }

  void add_level(std::size_t a, std::size_t b, const Curve& curve_a, const Curve& curve_b, double level,
                 bool by_estimate) {
    const auto equal = measure::at_equal_error(curve_a, curve_b, level);
    if (!equal) return;
    const bool b_is_faster = equal->seconds_b <= equal->seconds_a;
    const double faster = std::min(equal->seconds_a, equal->seconds_b),
                 slower = std::max(equal->seconds_a, equal->seconds_b);
    pairs_.push_back(
        {{"faster", b_is_faster ? b : a},
         {"slower", b_is_faster ? a : b},
         {"error", level},
         {"estimate", by_estimate},
         {"faster_seconds", faster},
         {"slower_seconds", slower},
         {"speed_up", slower / faster},
         {"remark", remarks(runs_[a], runs_[b], reference_of_run_[a] == reference_of_run_[b], by_estimate)}});
  }

  std::span<const RunFolder> runs_;
  const std::vector<std::optional<std::size_t>>& reference_of_run_;
  const MetricCurves& curves_;
  Json pairs_ = Json::array(), not_compared_ = Json::array();
};

} // namespace

Json metrics_json(std::span<const RunFolder> runs, const std::vector<std::optional<std::size_t>>& reference_of_run) {
  Json all = Json::array();
  for (const MetricCurves& curves : curves_of(runs)) {
    const measure::MetricText text = measure::metric_text(curves.metric);
    Json metric{{"metric", curves.metric}, {"label", text.label},
                {"unit", text.unit},       {"law", text.law ? Json(*text.law) : Json()},
                {"falls", curves.falls},   {"larger_is_better", text.larger_is_better},
                {"lines", Json::array()},  {"biased", Json::array()}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
      for (const bool is_estimate : {false, true})
        if (!(is_estimate ? curves.runs[i].estimate : curves.runs[i].error).errors.empty())
          metric["lines"].push_back(line_json(i, curves.runs[i], is_estimate));
      if (curves.falls && looks_biased(curves.runs[i])) metric["biased"].push_back(i);
    }
    if (curves.falls) {
      const std::vector<double> levels = levels_of(curves);
      metric["levels"] = levels;
      metric["times"] = times_json(curves, levels);
      Pairs(runs, reference_of_run, curves).take_into(metric);
    }
    all.push_back(std::move(metric));
  }
  return all;
}

} // namespace nephroid::report
