// SPDX-License-Identifier: Apache-2.0
// Units of meters, and values with a unit.
#pragma once
#include "preset/preset.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::preset {

/// Lumens of a watt at 555 nm (CIE 015): lux are this times the Y of an irradiance.
inline constexpr double lumens_per_watt = 683.002;

/// What an eye makes of light, or its power.
constexpr bool is_luminous(Meter::Unit unit) {
  return unit == Meter::Unit::lux || unit == Meter::Unit::kilolux || unit == Meter::Unit::candela;
}

/// Of light in a direction; else of light on an area.
constexpr bool is_intensity(Meter::Unit unit) {
  return unit == Meter::Unit::candela || unit == Meter::Unit::watts_per_steradian;
}

/// The unit of its numbers: a goniometer's watts and lumens are for a steradian.
constexpr Meter::Unit unit_of(const Meter& meter) {
  if (meter.type != Meter::Type::goniometer) return meter.unit;
  return is_luminous(meter.unit) ? Meter::Unit::candela : Meter::Unit::watts_per_steradian;
}

/// W/m^2, lx, W/sr or cd in one of a unit.
constexpr double size_of(Meter::Unit unit) {
  return unit == Meter::Unit::watts || unit == Meter::Unit::lux || is_intensity(unit) ? 1 : 1000; // a sun: 1,000
}

/// "W/m^2", ...
std::vector<std::string_view> meter_units();

struct Quantity {
  double value = 0;
  Meter::Unit unit = Meter::Unit::watts;
};

/// A value as Meter::threshold has it: "2500 W/m^2". W/m2 and W/m² are other spellings. Nothing where there is no unit,
/// or none of meter_units().
std::optional<Quantity> quantity_in(std::string_view text);

/// A meter's threshold in this unit. Nothing where it has none, or one of the other quantity.
std::optional<double> threshold_in(const Meter& meter, Meter::Unit unit);

/// The name of a meter as a part of a file's: letters, digits, '-', '_' and '.' alone.
std::string file_stem(const Meter& meter);

} // namespace nephroid::preset
