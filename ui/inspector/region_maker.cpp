// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/region_maker.h"

#include <utility>

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
  if (made_.valid()) {
    if (made_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Made made = made_.get();
    rest_until_ = now + 2 * made.took;
    if (!std::exchange(forgotten_, false)) newest_ = std::move(made.statistics);
  }
  if (newest_ && same_but_picture(newest_->of, request)) {
    if (newest_->of.picture.owner == request.picture.owner || now < rest_until_) return;
  }
  made_ = std::async(std::launch::async, [request] {
    const Clock::time_point begin = Clock::now();
    Made made{std::make_shared<RegionStatistics>(region_statistics(request))};
    made.took = Clock::now() - begin;
    return made;
  });
}

void RegionMaker::forget()
{
  newest_.reset();
  forgotten_ = made_.valid();
}

} // namespace nephroid::ui
