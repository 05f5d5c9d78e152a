// SPDX-License-Identifier: Apache-2.0
// Picture files as light a cell.
#pragma once
#include "inverse/layout.h"

#include <filesystem>

namespace nephroid::inverse {

/// A file's brightness in each cell, 0..1: the luminance of linear sRGB over its maximum, with the picture's tone, then
/// the cell's mean over the pixels that it covers, with their parts; then levels and vignette. Dark where the file does
/// not reach. Throws bad_input naming the file where it cannot be read, has a value that is no light, or is one grey
/// all over.
Target photograph(const std::filesystem::path& file, const Picture& picture, const Layout& layout);

} // namespace nephroid::inverse
