// SPDX-License-Identifier: Apache-2.0
// Dispersion from files of the refractiveindex.info database and, with one glass, from catalogues of Zemax.
#pragma once
#include "optics/dispersion.h"

#include <filesystem>
#include <string>

namespace nephroid::optics {

/// Any YAML file of the refractiveindex.info database; a file .agf with one glass. Throws bad_input naming FILE:LINE
/// where it can.
DispersionCurve load_dispersion(const std::filesystem::path& file);
/// The same from text; source names it in messages and its stem becomes the curve's name.
DispersionCurve parse_dispersion(const std::string& yaml, const std::filesystem::path& source);

} // namespace nephroid::optics
