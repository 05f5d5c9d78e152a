// SPDX-License-Identifier: Apache-2.0
// The pictures that are wanted, as light a cell: drawings, words and files.
#pragma once
#include "base/files.h"
#include "inverse/layout.h"
#include "inverse/settings.h"

namespace nephroid::inverse {

/// A file's brightness in each cell, 0..1: the luminance of linear sRGB over its maximum, with the picture's tone, then the cell's mean
/// over the pixels that it covers, with their parts; then levels and vignette. Dark where the file does not reach. Throws bad_input naming
/// the file where it cannot be read, has a value that is no light, or is one grey all over.
Target photograph(const std::filesystem::path& file, const Picture& picture, const Layout& layout);

/// QR codes (ISO/IEC 18004) in whole cells. Brightness 0 or 1 of each cell, row 0 at the top: light modules and the quiet zone of 4 modules
/// around them are lit, what is beside it dark. The code has the lowest version that holds the text, and the strongest correction that this
/// version has room for; a module has as many cells as fit. Throws bad_input at `where` for text that no code holds, and for too few cells,
/// saying how many would do.
std::vector<double> qr_cells(const std::string& text, const glm::ivec2& cells, const Place& where);

/// A drawing is the part of a cell that it covers; a file keeps its aspect. where: the picture's FILE#/json/pointer. Throws bad_input
/// there, or naming the file, for a file that cannot be read, has a value that is no light, or is one colour all over; and for a drawing
/// that leaves every cell dark.
Target make_target(const Picture& picture, const Layout& layout, const FileFinder& finder, const Place& where);

/// Of every receiver.
std::vector<Target> make_targets(const preset::Preset& preset, const Layout& layout);

} // namespace nephroid::inverse
