// SPDX-License-Identifier: Apache-2.0
// The panel "Dispersion": a dielectric's n(lambda) with control points to drag, its wavelength clusters, how many each
// method needs and how far they may bend light wrong. Everything follows the mouse.
#pragma once
#include "ui/spectral/dispersion/model.h"
#include "ui/widgets/material_choice.h"
#include "ui/widgets/material_picture.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

struct DispersionContents {
  const DispersionModel* model = nullptr; ///< outlives the call
  std::vector<ControlPoint> points;       ///< by rising wavelength; empty: nothing to drag
  std::optional<std::size_t> selected;    ///< one of the points
  bool sorted = false;                    ///< the x axis is the rank by falling n instead of the wavelength
  bool absorbs = true;                    ///< whether k is used
};

/// n over wavelength or in sorted order, the clusters as coloured bands below it, k on an axis of its own, control
/// points that can be dragged.
class DispersionPlot {
public:
  /// In the window's free width; height in pixels.
  RowGesture draw(const DispersionContents& contents, WavelengthAxis& axis, float height);
  /// A grid that suits the part that is shown: whole nanometres, and n in steps of 1, 2 or 5 of a decimal.
  ControlPoint grid() const;

  /// For tests: where the area was drawn last (x, y, width, height), and where in it a point lies.
  const std::array<double, 4>& area() const { return area_.screen; }
  std::array<double, 2> to_screen(const ControlPoint& point) const { return area_.to_screen(point); }

private:
  RowHandles handles_; ///< the points; while one is dragged the axes stay
  PlotArea area_;      ///< as it was drawn last
};

/// A cluster's colour (IM_COL32, opaque): neighbours differ most.
std::uint32_t cluster_colour(std::size_t cluster);

class DispersionPanel : public Panel {
public:
  static constexpr const char* title = "Dispersion";
  /// axis outlives the panel.
  explicit DispersionPanel(WavelengthAxis& axis) : axis_(axis) {}
  void draw(const Context& context) override;

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
  MaterialChoice glasses_;
  MaterialPictures pictures_;
  std::string shown_;                ///< the material,
  preset::Dispersion dispersion_;    ///< and its
  std::vector<ControlPoint> points_; ///< this frame's, by rising wavelength
  bool sorted_ = false, snap_ = false;
  preset::Dispersion fitted_; ///< what "Make editable" made,
  std::string fitted_text_;   ///< and what it said about it
  float below_plot_ = 0;      ///< the height of what was drawn there last
};

} // namespace nephroid::ui
