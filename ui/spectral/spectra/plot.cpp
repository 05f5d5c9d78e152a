// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/spectra/panel.h"

#include "optics/colour.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {

namespace spectra_colour {
/// A contrast below 2 with the ground, as WCAG defines it: (L + 0.05) / (L of the ground + 0.05), L the relative
/// luminance.
bool is_dark(std::uint32_t colour) {
  const auto luminance = [](std::uint32_t packed) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(packed);
    return 0.2126 * std::pow(c.x, 2.2) + 0.7152 * std::pow(c.y, 2.2) + 0.0722 * std::pow(c.z, 2.2);
  };
  return luminance(colour) + 0.05 < 2 * (luminance(colour::surround) + 0.05);
}

std::uint32_t of(const std::array<double, 3>& srgb) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(std::lround(255 * srgb[i])); };
  return IM_COL32(byte(0), byte(1), byte(2), 255);
}
} // namespace spectra_colour

namespace {

using optics::wavelength_count;
using optics::wavelength_nm;

constexpr double top = 1.1;         ///< the upper axis' end: room to drag the largest point up
constexpr float curves_part = 0.6f; ///< the curves' part of the height where both plots are shown
constexpr ImPlotFlags plot_flags = ImPlotFlags_NoLegend | ImPlotFlags_NoBoxSelect;

ImPlotSpec filled(ImPlotSpec spec) {
  spec.FillColor = spec.LineColor;
  spec.FillAlpha = 0.13f;
  spec.Flags |= ImPlotLineFlags_Shaded;
  return spec;
}

/// divisor: what becomes 1.
void plot_spectrum(const std::string& label, const optics::Spectrum& values, double divisor, const ImPlotSpec& spec) {
  std::array<double, wavelength_count> x, y;
  for (std::size_t w = 0; w < values.size(); ++w) {
    x[w] = wavelength_nm(static_cast<int>(w));
    y[w] = values[w] / divisor;
  }
  ImPlot::PlotLine(label.c_str(), x.data(), y.data(), wavelength_count, spec);
}

/// The light that is edited, by its own rows: exact where the 401 wavelengths would round them, also beyond these.
void plot_rows(const preset::LightSpectrum& light, double unit) {
  std::vector<double> x, y;
  for (const PowerRow& row : light.table) {
    x.push_back(row[0]);
    y.push_back(row[1] / unit);
  }
  if (light.type == preset::LightSpectrum::Type::lines) {
    ImPlot::PlotStems("light", x.data(), y.data(), static_cast<int>(x.size()), 0, line_spec(spectra_colour::light, 2));
    return;
  }
  x.insert(x.begin(), x.front()); // nothing outside
  y.insert(y.begin(), 0);
  x.push_back(x.back());
  y.push_back(0);
  ImPlot::PlotLine("light", x.data(), y.data(), static_cast<int>(x.size()),
                   filled(line_spec(spectra_colour::light, 2)));
}

void plot_lights(const SpectraPlotContents& contents, double unit) {
  for (std::size_t i = 0; i < contents.spectra->lights.size(); ++i) {
    const LightCurve& light = contents.spectra->lights[i];
    if (i == contents.light && contents.edited && has_rows(*contents.edited) && !contents.edited->table.empty())
      plot_rows(*contents.edited, unit);
    else if (light.error.empty() && i == contents.light)
      plot_spectrum("light", light.spectrum, light.largest, filled(line_spec(spectra_colour::light, 2)));
    else if (light.error.empty())
      plot_spectrum(fmt::format("light {}", i + 1), light.spectrum, light.largest,
                    line_spec(with_alpha(spectra_colour::light, 0.43f), 1));
  }
}

void plot_reflectances(const SpectraPlotContents& contents) {
  for (const ReflectanceCurve& curve : contents.spectra->reflectances) {
    if (contents.switches->hidden.contains(curve.material)) continue;
    const std::uint32_t own = spectra_colour::of(curve.srgb);
    if (spectra_colour::is_dark(own))
      plot_spectrum("rim of " + curve.material, curve.reflectance, 1, line_spec(spectra_colour::rim, 4));
    plot_spectrum("reflectance of " + curve.material, curve.reflectance, 1, line_spec(own, 2));
  }
}

constexpr ImPlotAxisFlags value_axis = ImPlotAxisFlags_Lock | ImPlotAxisFlags_NoHighlight;

/// In the plot in hand.
bool double_clicked() { return ImPlot::IsPlotHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left); }

/// The wavelength under the mouse, of the plot in hand.
std::optional<int> pointed_wavelength() {
  if (!ImPlot::IsPlotHovered()) return std::nullopt;
  const long index = std::lround(ImPlot::GetPlotMousePos().x) - optics::first_nm;
  return index < 0 || index >= wavelength_count ? std::nullopt : std::optional(static_cast<int>(index));
}

std::string row_text(const PowerRow& row) { return fmt::format("{:.6g} nm, relative power {:.4g}", row[0], row[1]); }

/// "540 to 561 nm", or "540 nm and 3 more"
std::string extent_of(const std::vector<int>& wavelengths) {
  const int first = wavelength_nm(wavelengths.front()), last = wavelength_nm(wavelengths.back());
  if (first == last) return fmt::format("{} nm", first);
  if (last - first + 1 == std::ssize(wavelengths)) return fmt::format("{} to {} nm", first, last);
  return fmt::format("{} wavelengths between {} and {} nm", wavelengths.size(), first, last);
}

/// Every curve at one wavelength.
void draw_values(const SpectraPlotContents& contents, int index) {
  const Spectra& s = *contents.spectra;
  const SpectraSwitches& shown = *contents.switches;
  const auto w = static_cast<std::size_t>(index);
  if (!ImGui::BeginTooltip()) return;
  ImGui::TextDisabled("%d nm", wavelength_nm(index));
  for (std::size_t i = 0; shown.light && i < s.lights.size(); ++i)
    if (s.lights[i].error.empty())
      draw_text(spectra_colour::light,
                fmt::format("light {}: {:.3g} of its largest", i + 1, s.lights[i].spectrum[w] / s.lights[i].largest));
  if (shown.luminosity)
    draw_text(spectra_colour::luminosity, fmt::format("luminosity: {:.3g}", optics::cie_1931().y[w]));
  for (const ReflectanceCurve& curve : s.reflectances)
    if (!shown.hidden.contains(curve.material))
      draw_text(colour::text, fmt::format("{}: reflects {:.3g}", curve.material, curve.reflectance[w]));
  if (shown.u && s.why_no_u.empty()) draw_text(spectra_colour::u, fmt::format("u: {:.3g}", s.importance.u[w]));
  if (const int c = s.cluster_of[w]; c >= 0) {
    const ClusterWork& cluster = s.clusters[static_cast<std::size_t>(c)];
    draw_text(colour::quiet_text,
              fmt::format("cluster {} of {}, {}: {:.3g} of {} iterations, {}", c + 1, s.clusters.size(),
                          extent_of(cluster.wavelengths), cluster.importance, s.passes, cluster.iterations));
  }
  ImGui::EndTooltip();
}

/// Bars, one for each run of neighbouring wavelengths of a cluster, in the colour of its middle.
void draw_bars(const Spectra& spectra) {
  ImPlot::PushPlotClipRect();
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  for (int first = 0, next = 0; first < wavelength_count; first = next) {
    const int c = spectra.cluster_of[static_cast<std::size_t>(first)];
    for (next = first + 1; next < wavelength_count && spectra.cluster_of[static_cast<std::size_t>(next)] == c;) ++next;
    if (c < 0) continue;
    const auto height = static_cast<double>(spectra.clusters[static_cast<std::size_t>(c)].iterations);
    ImVec2 low = ImPlot::PlotToPixels(wavelength_nm(first) - 0.5, height),
           high = ImPlot::PlotToPixels(wavelength_nm(next) - 0.5, 0);
    if (high.x - low.x > 4 * scale()) high.x -= scale(); // a gap where there is room
    const auto bright = wavelength_colour((first + next - 1) / 2);
    std::array<double, 3> quiet{}; // pure spectral colours would change how the picture's are seen
    for (std::size_t i = 0; i < 3; ++i) quiet[i] = 0.12 + 0.65 * bright[i];
    list.AddRectFilled(low, high, spectra_colour::of(quiet));
  }
  ImPlot::PopPlotClipRect();
}

} // namespace

RowGesture SpectraPlot::draw(const SpectraPlotContents& contents, WavelengthAxis& axis, float height) {
  RowGesture gesture;
  if (!handles_.held()) unit_ = contents.edited ? largest_power(*contents.edited) : 1;
  const bool both = contents.switches->iterations;
  const float upper = both ? curves_part * height : height;
  if (!ImPlot::BeginAlignedPlots("spectra")) return gesture;
  gesture = draw_curves(contents, axis, upper);
  if (both) draw_iterations(contents, axis, height - upper - ImGui::GetStyle().ItemSpacing.y);
  ImPlot::EndAlignedPlots();
  return gesture;
}

RowGesture SpectraPlot::draw_curves(const SpectraPlotContents& contents, WavelengthAxis& axis, float height) {
  RowGesture gesture;
  const SpectraSwitches& shown = *contents.switches;
  if (!begin_plot("##spectra", height, plot_flags)) return gesture;
  axis.set_up(shown.iterations);
  set_up_fixed_axis(ImAxis_Y1, "relative", 0, top, value_axis);
  ImPlot::SetupFinish();
  if (shown.light) plot_lights(contents, unit_);
  if (shown.luminosity)
    plot_spectrum("luminosity", optics::cie_1931().y, 1, line_spec(spectra_colour::luminosity, 1.5f));
  plot_reflectances(contents);
  if (shown.u && contents.spectra->why_no_u.empty())
    plot_spectrum("u", contents.spectra->importance.u, 1, line_spec(spectra_colour::u, 2.5f));
  const bool rows = shown.light && contents.edited && has_rows(*contents.edited);
  if (rows) {
    gesture = handles_.draw(contents.edited->table, contents.selected,
                            {spectra_colour::light, colour::on_dark, row_text, unit_});
    gesture.to[1] = std::clamp(gesture.to[1], 0.0, top * unit_); // up to the top of the plot
  } else
    handles_.leave();
  area_ = PlotArea::in_hand();
  std::optional<int> pointed;
  draw_pointer(contents, pointed);
  const bool all = !rows && double_clicked();
  ImPlot::EndPlot();
  if (all) axis.show_all();
  pointed_ = pointed;
  return gesture;
}

void SpectraPlot::draw_iterations(const SpectraPlotContents& contents, WavelengthAxis& axis, float height) {
  const Spectra& spectra = *contents.spectra;
  if (!begin_plot("##iterations", height, plot_flags)) return;
  axis.set_up();
  set_up_fixed_axis(ImAxis_Y1, "iterations", 0, 1.08 * static_cast<double>(std::max<std::int64_t>(spectra.passes, 1)),
                    value_axis);
  ImPlot::SetupFinish();
  draw_bars(spectra);
  draw_pointer(contents, pointed_);
  const bool all = double_clicked();
  ImPlot::EndPlot();
  if (all) axis.show_all();
}

/// A line at the wavelength under the mouse, in both plots, and the values there.
void SpectraPlot::draw_pointer(const SpectraPlotContents& contents, std::optional<int>& pointed) {
  if (handles_.held()) return;
  const std::optional<int> here = pointed_wavelength();
  if (here) pointed = here;
  if (const std::optional<int> at = here ? here : pointed_) {
    const double nm = wavelength_nm(*at);
    ImPlot::PlotInfLines("pointer", &nm, 1, line_spec(with_alpha(colour::on_dark, 0.43f), 1));
  }
  if (here) draw_values(contents, *here);
}

} // namespace nephroid::ui
