// SPDX-License-Identifier: Apache-2.0
// Does a mesh file hold as much as its header declares? Assimp takes what is missing from a PLY file for zeros, and reserves
// memory for whatever a PLY or GLB header promises, so both are counted before it sees them.
#pragma once
#include "base/place.h"

#include <string>
#include <string_view>

namespace nephroid::scene {

/// Throws bad_input at `where` if bytes open like a PLY or GLB file and end before what their header declares, or if the header
/// makes no sense. Other files pass.
void check_declared_size(std::string_view bytes, const Place& where);

/// Text from a file or its reader as one short line of printable ASCII, without a full stop at its end.
std::string printable(std::string_view text);

} // namespace nephroid::scene
