// SPDX-License-Identifier: Apache-2.0
// The panel "Spectra": the spectra of the lights, the eye's luminosity, reflectances, u(lambda) of (4.15) and the
// iterations of each cluster, on the wavelength axis that the panel "Dispersion" has too. The rows of a light's
// spectrum are edited here.
#pragma once
#include "ui/spectral/spectra/curves.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

/// Which curves are shown.
struct SpectraSwitches {
  bool light = true, luminosity = true, u = true, iterations = true;
  std::set<std::string> hidden; ///< materials whose reflectance is not
};

/// IM_COL32 of each curve; a reflectance has its own.
namespace spectra_colour {
inline constexpr std::uint32_t light = IM_COL32(255, 206, 112, 255), luminosity = IM_COL32(132, 204, 146, 255);
inline constexpr std::uint32_t u = IM_COL32(206, 158, 255, 255); ///< most walls are white
inline constexpr std::uint32_t iterations = colour::accent;
inline constexpr std::uint32_t rim = IM_COL32(132, 132, 132, 255); ///< about a dark colour, to be seen on the plot
bool is_dark(std::uint32_t colour);
std::uint32_t of(const std::array<double, 3>& srgb);
} // namespace spectra_colour

struct SpectraPlotContents {
  const Spectra* spectra = nullptr;
  const SpectraSwitches* switches = nullptr;
  const preset::LightSpectrum* edited = nullptr; ///< the edited light's, rows sorted; null where there is none
  std::size_t light = 0;                         ///< its index
  std::optional<std::size_t> selected;           ///< the row of it that is marked
};

/// Curves between 0 and 1 and, below, the iterations of each cluster, over one wavelength axis. The rows of the light
/// that is edited are points that can be dragged.
class SpectraPlot {
public:
  /// In the window's free width; height in pixels.
  RowGesture draw(const SpectraPlotContents& contents, WavelengthAxis& axis, float height);

  /// For tests: where a value of the upper plot was drawn last, on the screen.
  std::array<double, 2> place(double nm, double value) const { return area_.to_screen({nm, value}); }
  /// What 1 stands for in the light's own units.
  double unit() const { return unit_; }

private:
  RowGesture draw_curves(const SpectraPlotContents& contents, WavelengthAxis& axis, float height);
  void draw_iterations(const SpectraPlotContents& contents, WavelengthAxis& axis, float height);
  void draw_pointer(const SpectraPlotContents& contents, std::optional<int>& pointed);

  RowHandles handles_;         ///< the edited light's
  double unit_ = 1;            ///< stays while a row is held, or the others would move against it
  std::optional<int> pointed_; ///< the wavelength (index) under the mouse, in either plot
  PlotArea area_;              ///< the upper plot
};

class SpectraPanel : public Panel {
public:
  static constexpr const char* title = "Spectra";
  /// axis outlives the panel.
  explicit SpectraPanel(WavelengthAxis& axis) : axis_(axis) {}
  void draw(const Context& context) override;

  const SpectraMaker& maker() const { return maker_; }
  const SpectraPlot& plot() const { return plot_; }

private:
  void choose_light(const preset::Preset& preset);
  void draw_light(const Context& context);
  void draw_light_choice(const preset::Preset& preset);
  void draw_spectrum_controls(const Context& context);
  void draw_switches();
  void draw_plot(const Context& context, float height);
  void draw_numbers() const;
  void draw_surroundings() const;

  void follow_rows(const Context& context, const RowGesture& gesture);

  WavelengthAxis& axis_;
  SpectraMaker maker_;
  SpectraPlot plot_;
  SpectraSwitches switches_;
  Gestures gestures_{title};
  RowEditor editor_{gestures_};
  std::string source_;             ///< the preset of light_
  std::size_t light_ = 0;          ///< the one that is edited
  preset::LightSpectrum spectrum_; ///< its spectrum, rows sorted
};

} // namespace nephroid::ui
