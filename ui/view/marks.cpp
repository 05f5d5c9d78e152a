// SPDX-License-Identifier: Apache-2.0
#include "ui/view/marks.h"

#include "ui/widgets/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

/// About pixels from `from` to before `to`; seen on any colour.
void frame(const Placement& placement, const std::array<int, 2>& from, const std::array<int, 2>& to, ImU32 colour, double least)
{
  Point low = placement.to_screen({static_cast<double>(from[0]), static_cast<double>(from[1])});
  Point high = placement.to_screen({static_cast<double>(to[0]), static_cast<double>(to[1])});
  for (std::size_t i = 0; i < 2; ++i)
    if (const double missing = least - (high[i] - low[i]); missing > 0) low[i] -= missing / 2, high[i] += missing / 2;
  const auto rect = [&](float margin, ImU32 c) {
    ImGui::GetWindowDrawList()->AddRect({static_cast<float>(low[0]) - margin, static_cast<float>(low[1]) - margin},
                                        {static_cast<float>(high[0]) + margin, static_cast<float>(high[1]) + margin}, c);
  };
  rect(2, colour::outline);
  rect(1, colour);
  rect(0, colour::outline);
}

} // namespace

std::optional<PixelRegion> region_between(const Placement& placement, const std::array<int, 2>& picture, const Point& a, const Point& b)
{
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

void draw_marks(const Context& context, const Placement& placement, const std::array<int, 2>& picture)
{
  if (const auto& region = context.chosen.region) {
    const std::array to{std::min(region->to[0], picture[0]), std::min(region->to[1], picture[1])};
    if (region->from[0] < to[0] && region->from[1] < to[1]) frame(placement, region->from, to, colour::accent, 0);
  }
  if (const auto& pixel = context.chosen.pixel; pixel && (*pixel)[0] < picture[0] && (*pixel)[1] < picture[1])
    frame(placement, *pixel, {(*pixel)[0] + 1, (*pixel)[1] + 1}, colour::on_dark, 5);
}

} // namespace nephroid::ui
