// SPDX-License-Identifier: Apache-2.0
// The panel "Spectra": the spectra of the lights, the eye's luminosity, reflectances, u(lambda) of (4.15) and the iterations
// of each cluster, on the wavelength axis that the panel "Dispersion" has too. The rows of a light's spectrum
// are edited here.
#pragma once
#include "ui/spectral/spectra/curves.h"
#include "ui/spectral/spectra/plot.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

class SpectraPanel : public Panel {
public:
  static constexpr const char* title = "Spectra";
  /// axis outlives the panel.
  explicit SpectraPanel(WavelengthAxis& axis) : axis_(axis) {}
  void draw(const Context& context) override;

  /// For tests: what was drawn last, and the middle of a widget on the screen; nothing where there is no such widget.
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
  std::string source_;             ///< the preset that light_ is of
  std::size_t light_ = 0;          ///< the one that is edited
  preset::LightSpectrum spectrum_; ///< of it, rows sorted
};

} // namespace nephroid::ui
