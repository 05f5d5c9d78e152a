// SPDX-License-Identifier: Apache-2.0
// What no field of a preset can say alone.
#pragma once
#include "base/place.h"
#include "preset/preset.h"

#include <functional>
#include <string>

namespace nephroid::preset {

/// Throws bad_input at where(pointer) of the first contradiction.
void check(const Preset& preset, const std::function<Place(const std::string& pointer)>& where);

} // namespace nephroid::preset
