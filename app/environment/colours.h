// SPDX-License-Identifier: Apache-2.0
// Tables of colours that kernels look up.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "tracing/wavelength_tables.h"

#include <vector>

namespace nephroid::environment {

/// [401]: each wavelength of white light in linear sRGB; their sum is (1, 1, 1). An environment's colours stand for
/// spectra of the three primaries (optics/colour.h), so white is the sum of these.
std::vector<shared::float4> white_light();

/// [row of the lights' tables][reflector]: what a reflector sends back of a light, linear sRGB.
std::vector<shared::float4> lit_colours(const tracing::WavelengthTables& tables);

/// [reflector][primary]: what a reflector sends back of a primary's spectrum, linear sRGB.
std::vector<shared::float4> reflected_primaries(const tracing::WavelengthTables& tables);

/// [channel][401]: the running sums of each wavelength's chance, which is its share of white light in the channel,
/// where positive. So what glass does not bend has no noise of colours.
std::vector<float> channel_cdf();

} // namespace nephroid::environment
