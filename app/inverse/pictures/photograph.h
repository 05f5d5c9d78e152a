// SPDX-License-Identifier: Apache-2.0
// Picture files as light a cell.
#pragma once
#include "inverse/layout.h"

#include <filesystem>

namespace nephroid::inverse {

/// A file's brightness in each cell, 0..1. First comes the luminance of linear sRGB over its maximum, with the
/// picture's tone; then the mean over the pixels that a cell covers, with their parts; then levels and vignette. Cells
/// that the file does not reach are dark. Throws bad_input, naming the file, where it cannot be read, has a value that
/// is no light, or is one grey all over.
Target photograph(const std::filesystem::path& file, const Picture& picture, const Layout& layout);

} // namespace nephroid::inverse
