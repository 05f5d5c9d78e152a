// SPDX-License-Identifier: Apache-2.0
// What a meter shows: numbers of its cells, each with a 95 % interval. The intervals come of the run's eight
// independent parts by Student's t. They hold for what the run computes: paths that it cuts off are told by themselves
// (photons::MeterRun::lost_share).
#pragma once
#include "photons/meter.h"
#include "preset/meters.h"
#include "scene/meter.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::meters {

/// A number and where it is in 95 of 100 runs of other seeds.
struct Interval {
  double value = 0, low = 0, high = 0;
  /// Half of its width.
  double half() const { return (high - low) / 2; }
};

/// The mean of independent values of one distribution. rounding: that much of it is added each way. Light is not below
/// 0, and so no end is that lies below the mean.
Interval interval_of(std::span<const double> replicates, double rounding);

/// Irradiance in W/m^2 and illuminance in lux; of a goniometer intensities in W/sr and cd.
enum class Quantity { irradiance, illuminance };
inline constexpr std::array quantities{Quantity::irradiance, Quantity::illuminance};

/// Of one quantity, over all cells of a meter.
struct Numbers {
  Interval mean;        ///< by area, of a goniometer by solid angle
  Interval total;       ///< W or lm: the mean times the area
  Interval peak, least; ///< of cells
  Interval uniformity;  ///< least over mean
  std::size_t peak_cell = 0;
};

struct LayerReading {
  std::string name;                           ///< "all", or the layer's
  std::array<Numbers, 2> of;                  ///< [Quantity]
  std::array<std::vector<Interval>, 2> cells; ///< [Quantity][cell]
  const Numbers& numbers(Quantity quantity) const { return of[static_cast<std::size_t>(quantity)]; }
};

struct Reading {
  std::vector<LayerReading> layers;    ///< all together first
  double extent = 0;                   ///< of all cells, m^2; of a goniometer steradians
  std::optional<Interval> share_above; ///< of the area, above the meter's threshold
  const LayerReading& all() const { return layers.front(); }
};

/// layers: photons::MeterRun::layers.
Reading read(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
             std::vector<photons::MeterLayer> layers);

/// The larger relative half width of the intervals of mean and peak, of the quantity of the meter's unit. Infinite
/// where no light was found.
double relative_half_width(const preset::Meter& meter, const Reading& reading);

/// The quantity that a unit is of.
constexpr Quantity quantity_of(preset::Meter::Unit unit) {
  return preset::is_luminous(unit) ? Quantity::illuminance : Quantity::irradiance;
}

} // namespace nephroid::meters
