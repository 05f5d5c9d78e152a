// SPDX-License-Identifier: Apache-2.0
// The pictures that are wanted, as light a cell: drawings, words and files.
#pragma once
#include "base/files.h"
#include "inverse/layout.h"
#include "inverse/settings.h"

namespace nephroid::inverse {

/// In a drawing, each cell has the part of it that is covered; a file keeps its aspect. `where` is the picture's
/// FILE#/json/pointer. Throws bad_input there, or naming the file, for a file that cannot be read, has a value that is
/// no light, or is one colour all over; and for a drawing that leaves every cell dark.
Target make_target(const Picture& picture, const Layout& layout, const FileFinder& finder, const Place& where);

/// The targets of all receivers.
std::vector<Target> make_targets(const preset::Preset& preset, const Layout& layout);

} // namespace nephroid::inverse
