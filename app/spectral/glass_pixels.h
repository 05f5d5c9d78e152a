// SPDX-License-Identifier: Apache-2.0
// Where the picture may show glass or a mirror: what those pixels show takes as many samples as a run can give, for each path from the eye
// there has one wavelength and one branch of each reflection.
#pragma once
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace nephroid::spectral {

/// The pixels, row after row, whose square the outline of a triangle or ellipsoid of glass or of a mirror may touch, whatever stands before
/// it; all of them for a camera inside glass. Every path that meets glass or a mirror first is of one of these.
std::vector<std::uint32_t> glass_pixels(const scene::Scene& scene);

} // namespace nephroid::spectral
