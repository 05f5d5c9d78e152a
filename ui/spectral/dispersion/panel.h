// SPDX-License-Identifier: Apache-2.0
// The panel "Dispersion": a dielectric's n(lambda) with control points to drag, its wavelength clusters, how many each method needs and
// how far they may bend light wrong. Everything follows the mouse.
#pragma once
#include "ui/spectral/dispersion/model.h"
#include "ui/spectral/dispersion/plot.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

class DispersionPanel : public Panel {
public:
  static constexpr const char* title = "Dispersion";
  /// axis outlives the panel.
  explicit DispersionPanel(WavelengthAxis& axis) : axis_(axis) {}
  void draw(const Context& context) override;

  /// For tests: what was drawn last.
  const DispersionModel& model() const { return model_; }
  const DispersionPlot& plot() const { return plot_; }

private:
  void follow(const Context& context);
  void draw_toolbar(const Context& context, const std::vector<std::string>& names);
  void draw_points_row(const Context& context);
  void draw_plot(const Context& context);
  void draw_methods(const Context& context) const;
  void draw_bias(const Context& context) const;

  void make_editable(const Context& context);
  void follow_rows(const Context& context, const RowGesture& gesture);
  void edit_points(const Context& context, const RowsEdit& edit) const;

  WavelengthAxis& axis_;
  Gestures gestures_{title};
  RowEditor editor_{gestures_};
  DispersionModel model_;
  DispersionPlot plot_;
  std::string shown_;                ///< the material,
  preset::Dispersion dispersion_;    ///< and its
  std::vector<ControlPoint> points_; ///< of this frame, by rising wavelength
  bool sorted_ = false, snap_ = false;
  preset::Dispersion fitted_; ///< what "Make editable" made,
  std::string fitted_text_;   ///< and what it said about it
  float below_plot_ = 0;      ///< height of what was drawn there last
};

} // namespace nephroid::ui
