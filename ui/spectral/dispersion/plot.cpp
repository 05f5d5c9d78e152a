// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/dispersion/panel.h"

#include "base/counted.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace nephroid::ui {
namespace {

constexpr ImU32 beyond = IM_COL32(0, 0, 0, 70); ///< over wavelengths that are not rendered
constexpr double least_span_of_n = 1e-4;
constexpr double ranks_margin = 6;

/// What is drawn at one place of the x axis: a wavelength where it stands, or in its rank.
struct Columns {
  std::array<double, optics::wavelength_count> x{}, n{};
  std::array<int, optics::wavelength_count> wavelength{}; ///< indices 0..400
};

Columns columns_of(const DispersionModel& model, bool sorted) {
  Columns columns;
  std::size_t at = 0;
  const auto add = [&](int wavelength) {
    columns.x[at] = sorted ? static_cast<double>(at) : optics::wavelength_nm(wavelength);
    columns.n[at] = model.curve().n[static_cast<std::size_t>(wavelength)];
    columns.wavelength[at++] = wavelength;
  };
  if (sorted) {
    for (const photons::Cluster& cluster : model.chosen().clustering.clusters)
      for (const int wavelength : cluster.wavelengths) add(wavelength);
  } else
    for (int wavelength = 0; wavelength < optics::wavelength_count; ++wavelength) add(wavelength);
  return columns;
}

/// The ends of what is shown of n between two ends of the x axis, with a margin.
std::array<double, 2> ends_of_n(const DispersionContents& contents, const std::vector<double>& x,
                                const std::vector<double>& n, const std::array<double, 2>& x_ends) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](double at, double value) {
    if (at < x_ends[0] || at > x_ends[1] || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (std::size_t i = 0; i < x.size(); ++i) take(x[i], n[i]);
  if (!contents.sorted)
    for (const ControlPoint& point : contents.points) take(point[0], point[1]);
  if (!(low <= high)) return {1, 2};
  const double margin = std::max(0.1 * (high - low), least_span_of_n);
  return {low - 1.5 * margin, high + margin}; // more room below, where the bands are
}

ImPlotSpec curve_spec(ImU32 colour, float width) {
  ImPlotSpec spec = line_spec(colour, width);
  spec.Flags |= int{ImPlotItemFlags_NoLegend} | ImPlotLineFlags_SkipNaN;
  return spec;
}

void plot_line(const char* label, const std::vector<double>& x, const std::vector<double>& y, ImU32 colour,
               std::size_t first, std::size_t count) {
  const std::string under = std::string(label) + " outline";
  ImPlot::PlotLine(under.c_str(), x.data() + first, y.data() + first, static_cast<int>(count),
                   curve_spec(colour::outline, 4));
  ImPlot::PlotLine(label, x.data() + first, y.data() + first, static_cast<int>(count), curve_spec(colour, 2));
}

/// The line in full colour where there is data and a quiet one where it is extrapolated or held.
void plot_curve(const char* label, const GlassCurve& curve, const std::vector<double>& y, ImU32 colour) {
  const auto& x = curve.line_nm;
  plot_line(label, x, y, colour::quiet_on_dark, 0, x.size());
  const auto first = std::lower_bound(x.begin(), x.end(), curve.data_nm[0]),
             last = std::upper_bound(first, x.end(), curve.data_nm[1]);
  const std::string inside = std::string(label) + " data";
  if (last - first > 1)
    plot_line(inside.c_str(), x, y, colour, static_cast<std::size_t>(first - x.begin()),
              static_cast<std::size_t>(last - first));
}

/// Below the curve in each cluster's colour, and an opaque strip at the foot. Where the mouse is at a wavelength (not
/// -1), the other clusters are pale.
void draw_bands(const DispersionModel& model, const Columns& columns, int under_mouse) {
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  const float foot = ImPlot::GetPlotPos().y + ImPlot::GetPlotSize().y, strip = std::round(foot - 10 * scale());
  const std::size_t highlighted = under_mouse < 0 ? 0 : model.cluster_of()[static_cast<std::size_t>(under_mouse)];
  ImPlot::PushPlotClipRect();
  for (std::size_t i = 0; i < columns.x.size(); ++i) {
    const std::size_t cluster = model.cluster_of()[static_cast<std::size_t>(columns.wavelength[i])];
    const ImU32 colour = cluster_colour(cluster);
    const float alpha = under_mouse < 0 ? 0.5f : highlighted == cluster ? 0.85f : 0.15f;
    // Whole pixels: neighbours neither overlap nor leave a gap.
    const ImVec2 at = ImPlot::PlotToPixels(columns.x[i] - 0.5, columns.n[i]);
    const float left = std::round(at.x), right = std::round(ImPlot::PlotToPixels(columns.x[i] + 0.5, columns.n[i]).x);
    list.AddRectFilled({left, at.y}, {right, strip}, with_alpha(colour, alpha));
    list.AddRectFilled({left, strip}, {right, foot}, with_alpha(colour, std::min(1.0f, alpha + 0.5f)));
  }
  ImPlot::PopPlotClipRect();
}

/// Darkens where nothing is rendered.
void shade_beyond() {
  const ImVec2 corner = ImPlot::GetPlotPos(), size = ImPlot::GetPlotSize();
  const float left = ImPlot::PlotToPixels(optics::first_nm - 0.5, 0).x,
              right = ImPlot::PlotToPixels(optics::last_nm + 0.5, 0).x;
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  if (left > corner.x) list.AddRectFilled(corner, {std::min(left, corner.x + size.x), corner.y + size.y}, beyond);
  if (right < corner.x + size.x)
    list.AddRectFilled({std::max(right, corner.x), corner.y}, {corner.x + size.x, corner.y + size.y}, beyond);
}

/// "400..412, 430..431 nm" of a cluster; the first few where it is in many pieces.
std::string stretches(const DispersionModel& model, std::size_t cluster) {
  constexpr int shown = 4;
  std::string text;
  int count = 0;
  for (std::size_t i = 0, next = 0; i < optics::wavelength_count; i = next) {
    const auto& of = model.cluster_of();
    for (next = i + 1; next < of.size() && of[next] == of[i];) ++next;
    if (of[i] != cluster || ++count > shown) continue;
    const int first = optics::wavelength_nm(static_cast<int>(i)),
              last = optics::wavelength_nm(static_cast<int>(next) - 1);
    text +=
        (text.empty() ? "" : ", ") + (first == last ? fmt::format("{}", first) : fmt::format("{}..{}", first, last));
  }
  if (count > shown) text += fmt::format(" and {} more", count - shown);
  return text + " nm";
}

void draw_values(const DispersionModel& model, int wavelength) {
  if (!ImGui::BeginTooltip()) return;
  const auto index = static_cast<std::size_t>(wavelength);
  const GlassCurve& curve = model.curve();
  std::string values = fmt::format("{} nm: n = {:.6g}", optics::wavelength_nm(wavelength), curve.n[index]);
  if (curve.has_k) values += fmt::format(", k = {:.3g}", curve.k[index]);
  ImGui::TextUnformatted(values.c_str());
  const std::size_t c = model.cluster_of()[index];
  const photons::Clustering& clustering = model.chosen().clustering;
  const photons::Cluster& cluster = clustering.clusters[c];
  draw_text(cluster_colour(c), fmt::format("cluster {} of {}: {}, mean n {:.6g}", c + 1, clustering.clusters.size(),
                                           counted(cluster.wavelengths.size(), "wavelength"), cluster.n_mean));
  ImGui::TextDisabled("%s", stretches(model, c).c_str());
  ImGui::EndTooltip();
}

/// The wavelength's index; -1 where there is none or a button is held: then the person looks at something else.
int wavelength_under_mouse(const Columns& columns) {
  const double column = ImPlot::IsPlotHovered() && !ImGui::IsAnyMouseDown()
                            ? std::round(ImPlot::GetPlotMousePos().x) - columns.x.front()
                            : -1;
  return column >= 0 && column < optics::wavelength_count ? columns.wavelength[static_cast<std::size_t>(column)] : -1;
}

std::string point_text(const ControlPoint& point) { return fmt::format("{:.6g} nm, n = {:.6g}", point[0], point[1]); }

/// k is not negative; the axis goes on below 0 to keep its line off the bands' strip.
int write_k(double value, char* text, int size, void*) {
  return std::snprintf(text, static_cast<std::size_t>(size), "%s",
                       value < 0 ? "" : fmt::format("{:.2g}", value).c_str());
}

/// The axis of k, at the right.
void set_up_k(const DispersionContents& contents) {
  const std::vector<double>& k = contents.model->curve().line_k;
  double most = 1e-12;
  for (const double value : k)
    if (std::isfinite(value)) most = std::max(most, value);
  set_up_fixed_axis(ImAxis_Y2, contents.absorbs ? "extinction coefficient k" : "extinction coefficient k (not used)",
                    -0.15 * most, 1.1 * most, ImPlotAxisFlags_AuxDefault | ImPlotAxisFlags_NoMenus);
  ImPlot::SetupAxisFormat(ImAxis_Y2, write_k);
}

} // namespace

std::uint32_t cluster_colour(std::size_t cluster) {
  // Steps of the golden ratio round the circle of hues keep any few successive ones far apart; the brightness tells
  // those that come near to each other again, after 8 and 13 steps.
  constexpr double golden = 0.6180339887498949;
  const double hue = std::fmod(0.58 + golden * static_cast<double>(cluster), 1.0);
  constexpr float brightness[] = {0.95f, 0.68f, 0.82f}, saturation[] = {0.62f, 0.75f, 0.45f};
  float r = 0, g = 0, b = 0;
  ImGui::ColorConvertHSVtoRGB(static_cast<float>(hue), saturation[cluster % 3], brightness[cluster % 3], r, g, b);
  return ImGui::ColorConvertFloat4ToU32({r, g, b, 1});
}

RowGesture DispersionPlot::draw(const DispersionContents& contents, WavelengthAxis& axis, float height) {
  const DispersionModel& model = *contents.model;
  const GlassCurve& curve = model.curve();
  const bool clustered = model.error().empty(), sorted = contents.sorted && clustered;
  const bool has_k = curve.has_k && !sorted && !curve.line_k.empty();
  const std::optional<Columns> columns = clustered ? std::optional(columns_of(model, sorted)) : std::nullopt;
  std::vector<double> x = curve.line_nm, n = curve.line_n;
  if (sorted) {
    x.assign(columns->x.begin(), columns->x.end());
    n.assign(columns->n.begin(), columns->n.end());
  }

  if (!begin_plot(sorted ? "##sorted" : "##dispersion", height, ImPlotFlags_NoLegend)) return {};
  std::array<double, 2> x_ends{axis.low_nm(), axis.high_nm()};
  if (sorted) {
    x_ends = {-ranks_margin, optics::wavelength_count - 1 + ranks_margin};
    set_up_fixed_axis(ImAxis_X1, "rank by falling n", x_ends[0], x_ends[1], ImPlotAxisFlags_Lock);
  } else
    axis.set_up();
  const std::array<double, 2> n_ends =
      handles_.held() ? area_.y : ends_of_n(contents, x, n, x_ends); // a held axis does not run away
  set_up_fixed_axis(ImAxis_Y1, "index of refraction n", n_ends[0], n_ends[1], ImPlotAxisFlags_NoMenus);
  if (has_k) set_up_k(contents);
  ImPlot::SetupFinish();
  area_ = PlotArea::in_hand();

  if (!sorted) shade_beyond();
  const int under_mouse = columns ? wavelength_under_mouse(*columns) : -1;
  if (columns) draw_bands(model, *columns, under_mouse);
  if (has_k) {
    ImPlot::SetAxes(ImAxis_X1, ImAxis_Y2);
    plot_curve("k", curve, curve.line_k, contents.absorbs ? colour::note_on_dark : colour::quiet_on_dark);
    ImPlot::SetAxes(ImAxis_X1, ImAxis_Y1);
  }
  RowGesture gesture;
  if (sorted)
    plot_line("n", x, n, colour::on_dark, 0, x.size());
  else
    plot_curve("n", curve, curve.line_n, colour::on_dark);
  if (sorted || contents.points.empty())
    handles_.leave();
  else
    gesture = handles_.draw(contents.points, contents.selected, {colour::on_dark, colour::note_on_dark, point_text});
  if (under_mouse >= 0 && !handles_.over_row()) draw_values(model, under_mouse);
  const bool hovered = ImPlot::IsPlotHovered();
  ImPlot::EndPlot();
  if (hovered && !sorted && contents.points.empty() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    axis.show_all();
  return gesture;
}

ControlPoint DispersionPlot::grid() const {
  const double wanted = (area_.y[1] - area_.y[0]) / 40, decimal = std::pow(10, std::floor(std::log10(wanted)));
  const double steps = wanted / decimal; // 1 .. 10
  return {1, decimal * (steps <= 1 ? 1 : steps <= 2 ? 2 : steps <= 5 ? 5 : 10)};
}

} // namespace nephroid::ui
