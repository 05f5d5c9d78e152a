// SPDX-License-Identifier: Apache-2.0
#include "optics/wavelength.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nephroid::optics {
namespace {

constexpr std::size_t below_count = 20, inside_count = 100;

/// Of cell i, or of the last one's end.
double solar_edge(std::size_t i) {
  constexpr double low = 280, visible_low = first_nm - 0.5, visible_high = last_nm + 0.5, high = 4000;
  if (i <= below_count) return low + (visible_low - low) * static_cast<double>(i) / below_count;
  i -= below_count;
  if (i <= inside_count)
    return visible_low + (visible_high - visible_low) * static_cast<double>(i) / double{inside_count};
  i -= inside_count;
  constexpr double beyond_count = wavelength_count - below_count - inside_count;
  return visible_high * std::pow(high / visible_high, static_cast<double>(i) / beyond_count);
}

Cells solar_cells() {
  Cells made{};
  for (std::size_t i = 0; i < wavelength_count; ++i) {
    const double from = solar_edge(i), to = solar_edge(i + 1);
    made.nm[i] = (from + to) / 2;
    made.width_nm[i] = to - from;
  }
  return made;
}

Cells visible_cells() {
  Cells made{};
  for (std::size_t i = 0; i < wavelength_count; ++i) made.nm[i] = wavelength_nm(static_cast<int>(i));
  made.width_nm.fill(1);
  return made;
}

} // namespace

const Cells& cells(SpectralRange range) {
  static const Cells visible = visible_cells(), solar = solar_cells();
  return range == SpectralRange::visible ? visible : solar;
}

const char* text_of(SpectralRange range) {
  return range == SpectralRange::visible ? "380 to 780 nm" : "280 to 4000 nm";
}

Spectrum rebinned(const Spectrum& visible, SpectralRange range) {
  if (range == SpectralRange::visible) return visible;
  const Cells& to = cells(range);
  Spectrum made{};
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double low = to.nm[i] - to.width_nm[i] / 2, high = to.nm[i] + to.width_nm[i] / 2;
    const int first = std::max(static_cast<int>(std::floor(low + 0.5)), first_nm),
              last = std::min(static_cast<int>(std::floor(high + 0.5)), last_nm);
    for (int nm = first; nm <= last; ++nm)
      made[i] += visible[static_cast<std::size_t>(nm - first_nm)] *
                 std::max(0.0, std::min(high, nm + 0.5) - std::max(low, nm - 0.5));
  }
  return made;
}

} // namespace nephroid::optics
