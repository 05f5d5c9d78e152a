// SPDX-License-Identifier: Apache-2.0
// The pixel and the rectangle that the panel Inspector is about, drawn over the picture; and pixels under the mouse.
#pragma once
#include "ui/state/context.h"
#include "ui/view/placement.h"

namespace nephroid::ui {

/// The pixels between two points of the screen, both included; nothing where none is in the picture.
std::optional<PixelRegion> region_between(const Placement& placement, const std::array<int, 2>& picture, const Point& a, const Point& b);
void draw_marks(const Context& context, const Placement& placement, const std::array<int, 2>& picture);

} // namespace nephroid::ui
