// SPDX-License-Identifier: Apache-2.0
// Tables of colours that the view's kernels look up.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "tracing/wavelength_tables.h"

#include <vector>

namespace nephroid::environment {

/// [row of the lights' tables][reflector]: what a reflector sends back of a light, linear sRGB.
std::vector<shared::float4> lit_colours(const tracing::WavelengthTables& tables);

/// [reflector][primary]: what a reflector sends back of a primary's spectrum, linear sRGB.
std::vector<shared::float4> reflected_primaries(const tracing::WavelengthTables& tables);

/// [channel][401]: chances of wavelengths, by how much white light of that wavelength is in the channel where that is positive. So what
/// glass does not bend has no noise of colours.
std::vector<float> channel_cdf();

} // namespace nephroid::environment
