// SPDX-License-Identifier: Apache-2.0
// What several panels' plots share: ImPlot's context, with sizes at the display's scale, and the wavelength axis.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct ImPlotContext;
struct ImPlotSpec;

namespace nephroid::ui {

/// A line of this colour (IM_COL32) and width in pixels at scale 1, which axes do not fit.
ImPlotSpec line_spec(std::uint32_t colour, float width);

/// ImPlot::BeginPlot in the window's free width, without title, menus and mouse position. more: further ImPlotFlags.
bool begin_plot(const char* id, float height, int more = 0);
/// An axis (ImAxis) with these ends, which the mouse cannot change. flags: ImPlotAxisFlags.
void set_up_fixed_axis(int axis, const char* label, double low, double high, int flags);
/// Ticks with numbers, because ImPlot has none within a decade of a log axis. axis: an ImAxis.
void set_up_ticks(int axis, const std::vector<double>& ticks);

/// Where a plot lies on the screen, and the ends of its axes.
struct PlotArea {
  std::array<double, 4> screen{}; ///< x, y, width, height
  std::array<double, 2> x{0, 1}, y{0, 1};

  /// The current plot's area; called after SetupFinish.
  static PlotArea in_hand();
  /// The screen position of a point, on linear axes.
  std::array<double, 2> to_screen(const std::array<double, 2>& point) const {
    return {screen[0] + screen[2] * (point[0] - x[0]) / (x[1] - x[0]),
            screen[1] + screen[3] * (y[1] - point[1]) / (y[1] - y[0])};
  }
};

/// Whether axes still fit the data after what the mouse does on the current plot: the wheel and a drag release them, a
/// double click fits them again.
bool follows_after_mouse(bool follows);

/// A quoted name for CSV (RFC 4180).
std::string in_csv(const std::string& name);

class PlotContext {
public:
  /// A Dear ImGui context must exist, and outlive this object.
  PlotContext();
  ~PlotContext();
  PlotContext(const PlotContext&) = delete;
  PlotContext& operator=(const PlotContext&) = delete;
  /// Called once a frame, before panels draw.
  void follow_scale();

private:
  ImPlotContext* context_ = nullptr;
  float scale_ = 0;
};

/// The axis that several plots share: zooming or moving it in one does so in all.
class WavelengthAxis {
public:
  static constexpr double margin_nm = 10; ///< the margin of the whole range at both ends

  /// Sets up the x axis of a plot, with its label and limits: after ImPlot::BeginPlot, before SetupFinish and the first
  /// plotted item. compact: without label and tick labels, for a plot above one that has them.
  void set_up(bool compact = false);
  /// Shows the whole range again, with a margin: the 401 wavelengths, and low_nm to high_nm.
  void show_all(double low_nm = 380, double high_nm = 780);
  double low_nm() const { return low_nm_; }
  double high_nm() const { return high_nm_; }

private:
  double low_nm_ = 380 - margin_nm, high_nm_ = 780 + margin_nm;
};

} // namespace nephroid::ui
