// SPDX-License-Identifier: Apache-2.0
// Glass from a catalogue of Zemax (.agf).
#pragma once
#include "optics/dispersion.h"

#include <filesystem>
#include <string>

namespace nephroid::optics {

/// The only glass of the text: n by its formula, k by its internal transmittance. source names it in messages. Throws
/// bad_input where there is none or there are several, at a line that is broken, and where the formula does not give
/// the n_d that the text has.
DispersionCurve parse_zemax_glass(const std::string& text, const std::filesystem::path& source);

} // namespace nephroid::optics
