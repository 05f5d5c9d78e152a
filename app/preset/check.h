// SPDX-License-Identifier: Apache-2.0
// What one field cannot say alone: checks across fields that need no files. Private to preset/.
#pragma once
#include "base/place.h"
#include "preset/preset.h"

#include <functional>
#include <string>

namespace nephroid::preset {

/// Throws bad_input at where(pointer) of the first contradiction.
void check(const Preset& preset, const std::function<Place(const std::string& pointer)>& where);

} // namespace nephroid::preset
