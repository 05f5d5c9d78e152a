// SPDX-License-Identifier: Apache-2.0
#include "ui/error/panel.h"

#include "measure/run_curves.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr float dash = 6, gap = 4; ///< pixels at scale 1

/// A polyline in dashes of equal length on the screen: ImPlot has none. Inside of a plot.
void plot_dashed(const char* label, const measure::Curve& curve, ImPlotSpec spec) {
  std::vector<double> x, y; // pairs: begin and end of every dash
  float walked = 0;         // along the line, in pixels
  const float period = (dash + gap) * scale(), on = dash * scale();
  const auto add = [&](const ImVec2& pixel) {
    const ImPlotPoint point = ImPlot::PixelsToPlot(pixel);
    x.push_back(point.x);
    y.push_back(point.y);
  };
  ImVec2 from = curve.seconds.empty() ? ImVec2() : ImPlot::PlotToPixels(curve.seconds[0], curve.errors[0]);
  for (std::size_t i = 1; i < curve.seconds.size(); ++i) {
    const ImVec2 to = ImPlot::PlotToPixels(curve.seconds[i], curve.errors[i]);
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    // Zoomed in far, a line may be a million dashes long: then it is drawn whole.
    if (!(length < 1e4f)) {
      add(from);
      add(to);
    } else
      for (float at = 0; at < length;) {
        const float phase = std::fmod(walked + at, period), left = (phase < on ? on : period) - phase;
        const float next = std::min(length, at + std::max(left, 0.1f));
        if (phase < on) {
          add(from + (to - from) * at / length);
          add(from + (to - from) * next / length);
        }
        at = next;
      }
    walked = std::fmod(walked + std::min(length, 1e4f), period);
    from = to;
  }
  spec.Flags |= ImPlotLineFlags_Segments;
  ImPlot::PlotLine(label, x.data(), y.data(), static_cast<int>(x.size()), spec);
}

/// "run, slope -0.50###1e": what follows ### keeps the item the same while the slope changes.
std::string label_of(const std::string& name, const ErrorLine& line, std::size_t run, const char* kind) {
  const std::string slope = line.fit ? fmt::format(", slope {:.2f}", line.fit->exponent) : std::string();
  return fmt::format("{}{}###{}{}", name, slope, run, kind);
}

void plot_line(const std::string& label, const ErrorLine& line, const PlottedRun& run, bool dashed) {
  if (line.drawn.seconds.empty()) return;
  ImPlotSpec spec = line_spec(run.colour, dashed ? 0.75f * run.weight : run.weight);
  if (line.drawn.seconds.size() == 1) { // no line yet
    spec.Marker = ImPlotMarker_Circle;
    spec.MarkerSize = 3 * scale();
  }
  if (dashed && line.drawn.seconds.size() > 1)
    plot_dashed(label.c_str(), line.drawn, spec);
  else
    ImPlot::PlotLine(label.c_str(), line.drawn.seconds.data(), line.drawn.errors.data(),
                     static_cast<int>(line.drawn.seconds.size()), spec);
}

void plot_level(const std::string& label, double error, std::uint32_t colour, bool dashed) {
  const ImPlotRange x = ImPlot::GetPlotLimits().X;
  const measure::Curve level{{x.Min, x.Max}, {error, error}};
  if (dashed)
    plot_dashed(label.c_str(), level, line_spec(colour, 1));
  else
    ImPlot::PlotLine(label.c_str(), level.seconds.data(), level.errors.data(), 2, line_spec(colour, 1));
}

/// The value of every line at the row nearest to the cursor's time.
void draw_values(const PlotContents& contents) {
  const double seconds = ImPlot::GetPlotMousePos().x;
  if (!ImGui::BeginTooltip()) return;
  ImGui::TextDisabled("%s", fmt::format("{} at {:.3g} s of work", contents.metric, seconds).c_str());
  for (const PlottedRun& run : contents.runs) {
    const auto error = nearest_point(run.lines->error.curve, seconds),
               estimate = nearest_point(run.lines->estimate.curve, seconds);
    if (!error && !estimate) continue;
    std::string text = run.name + ":";
    if (error) text += fmt::format("  {:.4g} ({:.3g} s)", error->error, error->seconds);
    if (estimate) text += fmt::format("  estimate {:.4g}", estimate->error);
    if (estimate && !error) text += fmt::format(" ({:.3g} s)", estimate->seconds);
    draw_text(run.colour, text);
  }
  ImGui::EndTooltip();
  const ImVec2 top = ImPlot::GetPlotPos();
  const float x = ImGui::GetIO().MousePos.x;
  ImPlot::GetPlotDrawList()->AddLine({x, top.y}, {x, top.y + ImPlot::GetPlotSize().y}, colour::frame, scale());
}

/// "mean CIELAB distance", with its unit where it says more than its name.
std::string axis_label(const std::string& metric) {
  const measure::MetricText text = measure::metric_text(metric);
  return text.unit.empty() ? text.label : fmt::format("{} ({})", text.label, text.unit);
}

void set_up_axes(const PlotContents& contents, const PlotRange& range, bool follows) {
  const bool is_log =
      std::all_of(contents.runs.begin(), contents.runs.end(), [](const PlottedRun& run) { return run.lines->falls; });
  ImPlot::SetupAxes("seconds of work", contents.metric.empty() ? nullptr : axis_label(contents.metric).c_str());
  ImPlot::SetupAxisScale(ImAxis_X1, ImPlotScale_Log10);
  ImPlot::SetupAxisScale(ImAxis_Y1, is_log ? ImPlotScale_Log10 : ImPlotScale_Linear);
  set_up_ticks(ImAxis_X1, axis_ticks(range.seconds));
  if (is_log) set_up_ticks(ImAxis_Y1, axis_ticks(range.errors));
  if (follows) {
    ImPlot::SetupAxisLimits(ImAxis_X1, range.seconds[0], range.seconds[1], ImPlotCond_Always);
    ImPlot::SetupAxisLimits(ImAxis_Y1, range.errors[0], range.errors[1], ImPlotCond_Always);
  }
  ImPlot::SetupLegend(ImPlotLocation_SouthWest, ImPlotLegendFlags_Reverse);
  ImPlot::SetupFinish();
}

void plot_runs(const PlotContents& contents) {
  std::optional<double> noise_floor;
  for (std::size_t i = 0; i < contents.runs.size(); ++i) {
    const PlottedRun& run = contents.runs[i];
    if (run.lines->noise_floor) noise_floor = run.lines->noise_floor; // that of the run in front stays
    // The legend's swatches are squares: words say which line is dashed.
    const bool both = !run.lines->error.drawn.seconds.empty();
    plot_line(label_of(run.name, run.lines->error, i, "e"), run.lines->error, run, false);
    plot_line(label_of(run.name + (both ? ", estimate (dashed)" : " (estimate, dashed)"), run.lines->estimate, i, "s"),
              run.lines->estimate, run, true);
  }
  if (noise_floor)
    plot_level(fmt::format("noise floor of the reference {:.3g}###floor", *noise_floor), *noise_floor,
               colour::quiet_on_dark, true);
  if (contents.target)
    plot_level(fmt::format("target {:.3g}###target", *contents.target), *contents.target, colour::note_on_dark, false);
}

} // namespace

void ErrorPlot::draw(const PlotContents& contents, float height) {
  std::vector<const RunLines*> lines;
  std::vector<double> levels;
  for (const PlottedRun& run : contents.runs) {
    lines.push_back(run.lines);
    if (run.lines->noise_floor) levels.push_back(*run.lines->noise_floor);
  }
  if (contents.target) levels.push_back(*contents.target);
  if (!begin_plot("##error against time", height)) return;
  // While nobody holds the axes they are as wide as what there is; else as they were drawn last, which the ticks go by.
  set_up_axes(contents, follows_ ? plot_range(lines, levels) : shown(), follows_);
  plot_runs(contents);
  area_ = PlotArea::in_hand();
  const bool hovered = ImPlot::IsPlotHovered();
  if (hovered && !contents.runs.empty()) draw_values(contents);
  ImPlot::EndPlot();
  // The axes are held while they follow; the gesture that lets them go takes effect with the next frame.
  if (hovered) follows_ = follows_after_mouse(follows_);
}

} // namespace nephroid::ui
