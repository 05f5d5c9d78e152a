// SPDX-License-Identifier: Apache-2.0
// A round lens: its relief cut along the ellipse within the object's size, and the side and the front that close it.
#pragma once
#include "inverse/facets/solid.h"

namespace nephroid::inverse {

/// `solid` has only the relief, over the whole rectangle. Triangles with no corner within the ellipse are left out, the
/// others cut. Corners close to the ellipse are moved onto it first, so that no triangle becomes much thinner than it
/// was.
void cut_round(const Layout& layout, const Surface& surface, Solid& solid);

} // namespace nephroid::inverse
