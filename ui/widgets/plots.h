// SPDX-License-Identifier: Apache-2.0
// What plots of several panels share: ImPlot's context, with its sizes at the display's scale, and the wavelength axis.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct ImPlotContext;
struct ImPlotSpec;

namespace nephroid::ui {

/// A line of this colour (IM_COL32) and width in pixels at scale 1, which does not decide what axes show.
ImPlotSpec line_spec(std::uint32_t colour, float width);

/// ImPlot::BeginPlot in the window's free width, without title, menus and the mouse's place. more: further ImPlotFlags.
bool begin_plot(const char* id, float height, int more = 0);
/// An axis (ImAxis) of these ends, whatever the mouse does. flags: ImPlotAxisFlags.
void set_up_fixed_axis(int axis, const char* label, double low, double high, int flags);
/// Ticks with numbers: those that ImPlot puts on a log axis have none within a decade. axis: an ImAxis.
void set_up_ticks(int axis, const std::vector<double>& ticks);

/// Where a plot lies on the screen, and what its axes show.
struct PlotArea {
  std::array<double, 4> screen{}; ///< x, y, width, height
  std::array<double, 2> x{0, 1}, y{0, 1};

  /// Of the plot in hand, after SetupFinish.
  static PlotArea in_hand();
  /// Where a point is, on linear axes.
  std::array<double, 2> to_screen(const std::array<double, 2>& point) const {
    return {screen[0] + screen[2] * (point[0] - x[0]) / (x[1] - x[0]),
            screen[1] + screen[3] * (y[1] - point[1]) / (y[1] - y[0])};
  }
};

/// Whether axes that follow what they show go on with that, when the mouse is on their plot: the wheel and a drag let
/// them go, a double click takes them back.
bool follows_after_mouse(bool follows);

/// A name in quotes, as CSV has it (RFC 4180).
std::string in_csv(const std::string& name);

class PlotContext {
public:
  /// A Dear ImGui context must be there, and stay longer than this.
  PlotContext();
  ~PlotContext();
  PlotContext(const PlotContext&) = delete;
  PlotContext& operator=(const PlotContext&) = delete;
  /// Once a frame, before panels draw.
  void follow_scale();

private:
  ImPlotContext* context_ = nullptr;
  float scale_ = 0;
};

/// Who zooms or moves it in one plot moves it in all.
class WavelengthAxis {
public:
  static constexpr double margin_nm = 10; ///< of the whole range, beyond the 401 wavelengths at both ends

  /// The x axis of a plot, with its label and its limits: after ImPlot::BeginPlot, before SetupFinish and the first
  /// plotted item. compact: without label and tick labels, for a plot above one that has them.
  void set_up(bool compact = false);
  /// The whole range again, with a margin: the 401 wavelengths, and what lies from low_nm to high_nm beyond them.
  void show_all(double low_nm = 380, double high_nm = 780);
  /// The ends that are shown.
  double low_nm() const { return low_nm_; }
  double high_nm() const { return high_nm_; }

private:
  double low_nm_ = 380 - margin_nm, high_nm_ = 780 + margin_nm;
};

} // namespace nephroid::ui
