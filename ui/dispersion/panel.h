// SPDX-License-Identifier: Apache-2.0
// The panel "Dispersion": a dielectric's n(lambda) with control points to drag, its wavelength clusters, how many each method needs and
// how far they may bend light wrong. Everything follows the mouse.
#pragma once
#include "ui/dispersion/model.h"
#include "ui/dispersion/plot.h"
#include "ui/spectra/curves.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/row_editor.h"
#include "ui/widgets/widgets.h"

#include <string>
#include <vector>

namespace nephroid::ui {

class WavelengthAxis;

class DispersionPanel : public Panel {
public:
  static constexpr const char* title = "Dispersion";
  /// axis outlives the panel.
  explicit DispersionPanel(WavelengthAxis& axis) : axis_(axis) {}
  const char* name() const override { return title; }
  void draw(const Workbench& workbench, Commands& commands) override;

  /// For tests: what was drawn last, and where (the middle on the screen) a widget of this name was.
  const DispersionModel& model() const { return model_; }
  const DispersionPlot& plot() const { return plot_; }
  /// 401 N over the iterations of all clusters, where the effort gives clusters different ones.
  std::optional<double> saving_by_effort() const { return saving_by_effort_; }
  std::array<double, 2> widget(const std::string& name) const { return places_.of(name).value(); }

private:
  /// What one frame's parts read: the preset, the material, and where edits go.
  struct Frame {
    const Workbench& workbench;
    const preset::Preset& preset;
    const preset::Material& material;
    Commands& commands;
  };

  void follow(const Workbench& workbench);
  void draw_toolbar(const Frame& frame, const std::vector<std::string>& names);
  void draw_source(const Frame& frame) const;
  void draw_points_row(const Frame& frame);
  void draw_plot(const Frame& frame);
  ControlPoint place(const ControlPoint& mouse) const;
  void draw_methods(const Frame& frame) const;
  void draw_bias(const Frame& frame);
  void draw_effort(const Frame& frame);

  void make_editable(const Frame& frame);
  /// The control points as they shall be; nothing where there is no edit.
  void edit_points(const Frame& frame, const std::optional<RowsEdit>& edit) const;
  WavelengthAxis& axis_;
  Gestures gestures_{title};
  RowEditor editor_{gestures_};
  DispersionModel model_;
  DispersionPlot plot_;
  SpectraMaker work_; ///< iterations a cluster, where the effort gives each its own
  std::optional<double> saving_by_effort_;
  std::string shown_;                ///< the material
  std::vector<ControlPoint> points_; ///< of this frame, by rising wavelength
  bool sorted_ = false, snap_ = false;
  preset::Dispersion fitted_; ///< what "Make editable" made,
  std::string fitted_text_;   ///< and what it said about it
  float below_plot_ = 0;      ///< height of what was drawn there last
  WidgetPlaces places_;
};

} // namespace nephroid::ui
