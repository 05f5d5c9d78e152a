// SPDX-License-Identifier: Apache-2.0
// White light of a wavelength at a time, for paths that have one.
#pragma once
#include "kernels/tracing/shared_types.h"

#include <vector>

namespace nephroid::environment {

/// [401]: what a wavelength of white light is in linear sRGB; all together are (1, 1, 1). An environment's colours stand for spectra of the
/// three primaries (optics/colour.h), so white is the sum of these.
std::vector<shared::float4> white_light();

} // namespace nephroid::environment
