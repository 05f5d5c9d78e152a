// SPDX-License-Identifier: Apache-2.0
#include "ui/view/placement.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

Placement exact_place(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture) {
  const double width = picture[0], height = picture[1];
  const Point centre = view_settings.fit ? Point{width / 2, height / 2} : view_settings.centre;
  Placement placement;
  placement.scale = view_settings.fit ? std::max(1e-3, std::min(canvas.size[0] / width, canvas.size[1] / height))
                                      : view_settings.zoom;
  for (int axis = 0; axis < 2; ++axis)
    placement.origin[axis] = canvas.corner[axis] + canvas.size[axis] / 2 - placement.scale * centre[axis];
  return placement;
}

/// The same place on the screen, as zoom and centre instead of fit.
ViewSettings explicit_settings(const ViewSettings& view_settings, const Canvas& canvas,
                               const std::array<int, 2>& picture) {
  if (!view_settings.fit) return view_settings;
  ViewSettings said = view_settings;
  said.fit = false;
  said.zoom = exact_place(view_settings, canvas, picture).scale;
  said.centre = {picture[0] / 2.0, picture[1] / 2.0};
  return said;
}

} // namespace

Placement place(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture) {
  Placement placement = exact_place(view_settings, canvas, picture);
  // The origin is in whole pixels of the screen, so that at 100 % the texture is not interpolated.
  for (double& coordinate : placement.origin) coordinate = std::round(coordinate);
  return placement;
}

ViewSettings zoomed(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture,
                    const Point& screen, double factor) {
  ViewSettings next = explicit_settings(view_settings, canvas, picture);
  const Point still = exact_place(next, canvas, picture).to_picture(screen);
  next.zoom = std::clamp(next.zoom * factor, 1.0 / 64, 256.0);
  for (int axis = 0; axis < 2; ++axis)
    next.centre[axis] = still[axis] - (screen[axis] - canvas.corner[axis] - canvas.size[axis] / 2) / next.zoom;
  return next;
}

ViewSettings dragged(const ViewSettings& view_settings, const Canvas& canvas, const std::array<int, 2>& picture,
                     const Point& screen_delta) {
  ViewSettings next = explicit_settings(view_settings, canvas, picture);
  for (int axis = 0; axis < 2; ++axis) next.centre[axis] -= screen_delta[axis] / next.zoom;
  return next;
}

std::optional<std::array<int, 2>> pixel_at(const Placement& placement, const std::array<int, 2>& picture,
                                           const Point& screen) {
  const Point at = placement.to_picture(screen);
  const std::array<int, 2> pixel{static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1]))};
  if (pixel[0] < 0 || pixel[1] < 0 || pixel[0] >= picture[0] || pixel[1] >= picture[1]) return std::nullopt;
  return pixel;
}

std::optional<PixelRegion> region_between(const Placement& placement, const std::array<int, 2>& picture, const Point& a,
                                          const Point& b) {
  const Point p = placement.to_picture(a), q = placement.to_picture(b);
  PixelRegion region;
  for (std::size_t i = 0; i < 2; ++i) {
    const double low = std::floor(std::min(p[i], q[i])), high = std::floor(std::max(p[i], q[i])) + 1;
    region.from[i] = static_cast<int>(std::clamp<double>(low, 0, picture[i]));
    region.to[i] = static_cast<int>(std::clamp<double>(high, 0, picture[i]));
    if (region.from[i] >= region.to[i]) return std::nullopt;
  }
  return region;
}

} // namespace nephroid::ui
