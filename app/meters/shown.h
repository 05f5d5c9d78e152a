// SPDX-License-Identifier: Apache-2.0
// What the meters of a run show at one time; nothing of it changes.
#pragma once
#include "meters/reading.h"
#include "optics/wavelength.h"

#include <cstdint>
#include <memory>

namespace nephroid::meters {

/// A reading long gone, in the quantity and unit of the meter.
struct HistoryRow {
  double seconds = 0; ///< of the meter's work until then
  Interval mean, peak;
};

struct Shown {
  preset::Meter meter;
  std::shared_ptr<const scene::MeterSurface> surface; ///< never null
  glm::dvec3 origin{0};                               ///< preset coordinates of the scene's (0, 0, 0)
  double metres_per_unit = 1;
  std::shared_ptr<const Reading> reading; ///< null before the first
  double seconds = 0;                     ///< of work until the reading
  std::uint64_t photons = 0;              ///< sent until then
  double lost_share = 0;                  ///< photons::MeterRun::lost_share
  std::uint64_t refused = 0;              ///< photons::MeterRun::refused
  std::vector<HistoryRow> history;        ///< of all readings
};

struct Readings {
  std::vector<Shown> meters; ///< in the preset's order
  optics::SpectralRange range = optics::SpectralRange::visible;
  std::vector<std::string> notes; ///< what the light is, and what had to be assumed, a line each
};

} // namespace nephroid::meters
