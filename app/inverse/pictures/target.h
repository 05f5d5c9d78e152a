// SPDX-License-Identifier: Apache-2.0
// The pictures that are wanted, as light a cell: drawings, words, QR codes and files.
#pragma once
#include "base/files.h"
#include "inverse/layout.h"

namespace nephroid::inverse {

/// A file's brightness in each cell, 0..1: the luminance of linear sRGB, inverted where that is asked for, before the
/// ground; over its maximum on the receiver, with the picture's tone; then the mean of the pixels that a cell covers;
/// then levels and vignette. Cells beside the file are dark. Appends to `notes` what the file says and is not obeyed.
/// Throws bad_input, naming the file, where it cannot be read, has a value that is no light, or is one grey all over.
Target photograph(const std::filesystem::path& file, const Picture& picture, const Layout& layout,
                  std::vector<std::string>& notes);

/// The brightness, 0 or 1, of each cell for a QR code (ISO/IEC 18004) in whole cells, row 0 at the top. Light modules
/// and the quiet zone of 4 modules around them are lit, what is beside it dark. The code has the lowest version that
/// holds the text, and the strongest correction that this version has room for; a module has as many cells as fit.
/// Throws bad_input at `where` for text that no code holds, and for too few cells, saying how many would do.
std::vector<double> qr_cells(const std::string& text, const glm::ivec2& cells, const Location& where);

/// In a drawing, each cell has the part of it that is covered; a file keeps its aspect. `where` is the picture's
/// FILE#/json/pointer. Appends to `notes`, and throws bad_input, as the two above, and there for a drawing that leaves
/// every cell dark.
Target make_target(const Picture& picture, const Layout& layout, const FileFinder& finder, const Location& where,
                   std::vector<std::string>& notes);

std::vector<Target> make_targets(const preset::Preset& preset, const Layout& layout, std::vector<std::string>& notes);

} // namespace nephroid::inverse
