// SPDX-License-Identifier: Apache-2.0
// The date and the clock of a place (PlaceAndTime).
#pragma once
#include "preset/preset.h"
#include "preset/settings_type.h"

#include <string>
#include <vector>

namespace nephroid::preset {

/// What its clock is ahead of UTC. place: checked. By its time zone that is summer time where the zone has it; of a
/// time that its clock shows twice or never it is that of before the change. Throws failed where the system has no time
/// zones.
double offset_h(const PlaceAndTime& place);

/// The same of every time that the clock shows this hour of this day: none, one, or two in order.
std::vector<double> offsets_h(const PlaceAndTime& place);

/// pointer: the place's. Throws bad_input at where(...) for a date that there is not, a time zone that nobody has, or
/// one with an offset besides.
void check_place(const PlaceAndTime& place, const std::string& pointer, const Where& where);

} // namespace nephroid::preset
