// SPDX-License-Identifier: Apache-2.0
// The wavelength axis that plots of several panels share: who zooms or moves one moves all.
#pragma once

namespace nephroid::ui {

class WavelengthAxis {
public:
  static constexpr double margin_nm = 10; ///< of the whole range, beyond the 401 wavelengths at both ends

  /// The x axis of a plot, with its label and its limits: after ImPlot::BeginPlot, before SetupFinish and the first plotted item.
  /// compact: without label and tick labels, for a plot above one that has them.
  void set_up(bool compact = false);
  /// The whole range again, with a margin: the 401 wavelengths, and what lies from low_nm to high_nm beyond them.
  void show_all(double low_nm, double high_nm);
  void show_all();
  /// The ends that are shown.
  double low_nm() const { return low_nm_; }
  double high_nm() const { return high_nm_; }

private:
  double low_nm_ = 380 - margin_nm, high_nm_ = 780 + margin_nm;
};

} // namespace nephroid::ui
