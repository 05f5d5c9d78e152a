// SPDX-License-Identifier: Apache-2.0
// Where a picture of the scene shows a meter's cells.
#pragma once
#include "scene/bvh.h"
#include "scene/meter.h"

#include <vector>

namespace nephroid::meters {

/// The cell that each pixel of the scene's camera shows through its middle, rows from the top; -1: none. What stands
/// before the meter hides it, also glass; of an object's surface the measured side is seen, of a plane in the air both.
/// On every core. Empty for a camera that is a receiver.
std::vector<int> cells_in_picture(const scene::Scene& scene, const scene::Bvh& bvh, const scene::MeterSurface& meter);

} // namespace nephroid::meters
