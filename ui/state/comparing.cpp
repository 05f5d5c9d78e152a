// SPDX-License-Identifier: Apache-2.0
#include "ui/state/comparing.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace nephroid::ui {

void Comparing::carry_out(const command::ShowDifference& c)
{
  comparison_.difference = c.on;
  comparison_.metric = c.metric;
  comparison_.scale = c.scale > 0 && std::isfinite(c.scale) ? c.scale : 0;
  if (!c.on) difference_.forget();
}

void Comparing::carry_out(const command::PinRun&)
{
  if (!run_.snapshot()) return;
  PinnedRun run;
  run.name = run_.snapshot_name();
  run.history = run_.error_history() ? run_.error_history() : std::make_shared<job::History>();
  run.picture = run_.snapshot()->picture;
  pin(std::move(run));
}

void Comparing::carry_out(const command::Unpin& c)
{
  pinned_.remove(c.pin);
  if (comparison_.pin == c.pin) comparison_.pin = 0;
}

std::string Comparing::why_not() const
{
  if (!run_.snapshot()) return "there is no picture yet";
  const PinnedRun* pin = pinned_.find(comparison_.pin);
  const measure::Reference* reference = run_.reference().get();
  if (!pin && !reference) {
    if (run_.plan() || !run_.has_reference()) return "the preset has no reference and no run is chosen to compare with";
    return "the reference is not there yet";
  }
  if (pin && !pin->picture) return fmt::format("\"{}\" has no picture: only its history was read", pin->name);
  const auto [width, height] =
      pin ? std::array{pin->picture->width, pin->picture->height} : std::array{reference->width, reference->height};
  const job::Picture& picture = *run_.snapshot()->picture;
  if (width == picture.width && height == picture.height) return {};
  return fmt::format("{} is {} x {}, the picture {} x {}", pin ? '"' + pin->name + '"' : "the reference", width, height, picture.width,
                     picture.height);
}

HeldPicture Comparing::other_picture() const
{
  if (!why_not().empty()) return {};
  if (const PinnedRun* pin = pinned_.find(comparison_.pin))
    return {pin->picture, {pin->picture->width, pin->picture->height, pin->picture->rgb, pin->name}};
  return {run_.reference(), run_.reference()->pixels()};
}

void Comparing::update(DifferenceMaker::Clock::time_point now)
{
  if (!comparison_.difference) return;
  const HeldPicture other = other_picture();
  if (!other.owner) return;
  const std::shared_ptr<const job::Picture>& picture = run_.snapshot()->picture;
  difference_.want({{picture, {picture->width, picture->height, picture->rgb, "the run"}}, other, comparison_.metric, comparison_.scale},
                   now);
}

} // namespace nephroid::ui
