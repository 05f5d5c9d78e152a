// SPDX-License-Identifier: Apache-2.0
// Where the picture lies in its panel: fit, zoom about the cursor, drag. Pure arithmetic in screen pixels.
#pragma once
#include "ui/state/commands.h"

namespace nephroid::ui {

using Point = std::array<double, 2>;

/// screen = origin + scale * picture, in pixels; picture (0, 0) is the top left corner of the top left pixel.
struct Placement {
  double scale = 1;
  Point origin{0, 0};

  Point to_picture(const Point& screen) const {
    return {(screen[0] - origin[0]) / scale, (screen[1] - origin[1]) / scale};
  }
  Point to_screen(const Point& picture) const {
    return {origin[0] + scale * picture[0], origin[1] + scale * picture[1]};
  }
};

/// A part of a panel on the screen.
struct Canvas {
  Point corner{0, 0}, size{0, 0};
};

/// Sizes are in pixels, at least 1.
Placement place(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture);
/// The picture's point under `screen` stays there. The scale stays in 1/64..256.
ViewSettings zoomed(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture,
                    const Point& screen, double factor);
ViewSettings dragged(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture,
                     const Point& screen_delta);
/// The pixel under a point of the screen; nothing outside of the picture.
std::optional<std::array<int, 2>> pixel_at(const Placement& placement, const std::array<int, 2>& picture,
                                           const Point& screen);
/// The pixels between two points of the screen, both included; nothing where none is in the picture.
std::optional<PixelRegion> region_between(const Placement& placement, const std::array<int, 2>& picture, const Point& a,
                                          const Point& b);

} // namespace nephroid::ui
