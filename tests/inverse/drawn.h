// SPDX-License-Identifier: Apache-2.0
// Drawings as light a cell.
#pragma once
#include "inverse/pictures/target.h"

namespace nephroid::inverse {

inline Target drawn(const Picture& picture, const Layout& layout) {
  std::vector<std::string> notes;
  return make_target(picture, layout, FileFinder(), "p", notes);
}

} // namespace nephroid::inverse
