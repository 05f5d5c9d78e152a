// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/wavelength_axis.h"

#include "optics/wavelength.h"

#include <implot.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// What the axis can be moved and zoomed to: where dispersion data of glass lies.
constexpr double lowest_nm = 100, highest_nm = 5000, narrowest_nm = 2;

} // namespace

void WavelengthAxis::set_up(bool compact)
{
  const ImPlotAxisFlags flags = compact ? ImPlotAxisFlags_NoLabel | ImPlotAxisFlags_NoTickLabels : ImPlotAxisFlags_None;
  ImPlot::SetupAxis(ImAxis_X1, "wavelength (nm)", flags);
  ImPlot::SetupAxisLimitsConstraints(ImAxis_X1, lowest_nm, highest_nm);
  ImPlot::SetupAxisZoomConstraints(ImAxis_X1, narrowest_nm, highest_nm - lowest_nm);
  ImPlot::SetupAxisLinks(ImAxis_X1, &low_nm_, &high_nm_);
}

void WavelengthAxis::show_all(double low_nm, double high_nm)
{
  low_nm_ = std::max(lowest_nm, std::min<double>(optics::first_nm, low_nm) - margin_nm);
  high_nm_ = std::min(highest_nm, std::max<double>(optics::last_nm, high_nm) + margin_nm);
}

void WavelengthAxis::show_all() { show_all(optics::first_nm, optics::last_nm); }

} // namespace nephroid::ui
