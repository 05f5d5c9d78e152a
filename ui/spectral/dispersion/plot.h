// SPDX-License-Identifier: Apache-2.0
// The plot of the panel "Dispersion": n over wavelength or in sorted order, the clusters as coloured bands below it, k on an axis of its
// own, control points that can be dragged.
#pragma once
#include "ui/spectral/dispersion/model.h"
#include "ui/widgets/plots.h"
#include "ui/widgets/rows.h"

namespace nephroid::ui {

struct DispersionContents {
  const DispersionModel* model = nullptr; ///< outlives the call
  std::vector<ControlPoint> points;       ///< by rising wavelength; empty: nothing to drag
  std::optional<std::size_t> selected;    ///< one of them
  bool sorted = false;                    ///< the x axis is the rank by falling n instead of the wavelength
  bool absorbs = true;                    ///< whether k is used
};

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

} // namespace nephroid::ui
