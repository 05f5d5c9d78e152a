// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/region_maker.h"

namespace nephroid::ui {
namespace {

/// The region of what was made is cut to the picture.
bool same_but_picture(const RegionRequest& a, const RegionRequest& b)
{
  const measure::Pixels& of = b.picture.pixels;
  return cut_to(a.region, of.width, of.height) == cut_to(b.region, of.width, of.height) && a.other.owner == b.other.owner &&
         a.other_name == b.other_name && a.white == b.white;
}

} // namespace

void RegionMaker::want(const RegionRequest& request, Clock::time_point now)
{
  if (!maker_.idle(now)) return;
  const auto& newest = maker_.newest();
  if (newest && same_but_picture(newest->of, request) && (newest->of.picture.owner == request.picture.owner || maker_.rests(now))) return;
  maker_.start([request] { return std::make_shared<RegionStatistics>(region_statistics(request)); });
}

} // namespace nephroid::ui
