// SPDX-License-Identifier: Apache-2.0
// QR codes as light a cell.
#pragma once
#include "base/place.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace nephroid::inverse {

/// The brightness, 0 or 1, of each cell for a QR code (ISO/IEC 18004) in whole cells, row 0 at the top. Light modules
/// and the quiet zone of 4 modules around them are lit, what is beside it dark. The code has the lowest version that
/// holds the text, and the strongest correction that this version has room for; a module has as many cells as fit.
/// Throws bad_input at `where` for text that no code holds, and for too few cells, saying how many would do.
std::vector<double> qr_cells(const std::string& text, const glm::ivec2& cells, const Place& where);

} // namespace nephroid::inverse
