// SPDX-License-Identifier: Apache-2.0
// The workbench's part in holding runs against each other: pinned runs, the other picture, maps of differences.
#include "ui/state/workbench.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>

namespace nephroid::ui {

void Workbench::carry_out(const command::Flip& c) { comparison_.flip = c.on; }

void Workbench::carry_out(const command::CompareWith& c) { comparison_.pin = pinned_.find(c.pin) ? c.pin : 0; }

void Workbench::carry_out(const command::ShowDifference& c)
{
  comparison_.difference = c.on;
  comparison_.metric = c.metric;
  comparison_.scale = c.scale > 0 && std::isfinite(c.scale) ? c.scale : 0;
  if (!c.on) difference_.forget();
}

void Workbench::carry_out(const command::PinRun&)
{
  if (!snapshot_) return;
  PinnedRun run;
  run.name = snapshot_name_;
  run.history = snapshot_->history ? snapshot_->history : std::make_shared<job::History>();
  run.picture = snapshot_->picture;
  pinned_.add(std::move(run));
}

void Workbench::carry_out(const command::PinFile& c)
{
  question_ = Question::none;
  background_.push_back(std::async(std::launch::async, [path = c.path] {
    Finished done;
    try {
      done.pin = read_pin(path);
    } catch (const Error& error) {
      done.message.line = error.line();
      done.message.kind = error.kind();
    } catch (const std::exception& error) {
      done.message.line = error.what();
    }
    return done;
  }));
}

void Workbench::carry_out(const command::ChangePin& c) { pinned_.change(c.pin, c.name, c.colour, c.shown); }

void Workbench::carry_out(const command::Unpin& c)
{
  pinned_.remove(c.pin);
  if (comparison_.pin == c.pin) comparison_.pin = 0;
}

void Workbench::carry_out(const command::ChooseMetric& c) { error_metric_ = c.metric; }

std::string Workbench::why_not_comparable() const
{
  if (!snapshot_) return "there is no picture yet";
  const PinnedRun* pin = pinned_.find(comparison_.pin);
  if (comparison_.pin == 0 && !reference_) {
    if (plan_ || !history_->current().reference) return "the preset has no reference and no run is chosen to compare with";
    return "the reference is not there yet";
  }
  if (pin && !pin->picture) return fmt::format("\"{}\" has no picture: only its history was read", pin->name);
  const auto [width, height] =
      pin ? std::array{pin->picture->width, pin->picture->height} : std::array{reference_->width, reference_->height};
  const job::Picture& picture = *snapshot_->picture;
  if (width == picture.width && height == picture.height) return {};
  return fmt::format("{} is {} x {}, the picture {} x {}", pin ? '"' + pin->name + '"' : "the reference", width, height, picture.width,
                     picture.height);
}

HeldPicture Workbench::other_picture() const
{
  if (!why_not_comparable().empty()) return {};
  if (const PinnedRun* pin = pinned_.find(comparison_.pin))
    return {pin->picture, {pin->picture->width, pin->picture->height, pin->picture->rgb, pin->name}};
  return {reference_, reference_->pixels()};
}

void Workbench::make_difference(Clock::time_point now)
{
  if (!comparison_.difference) return;
  const HeldPicture other = other_picture();
  if (!other.owner) return;
  const job::Picture& picture = *snapshot_->picture;
  const HeldPicture shown{snapshot_->picture, {picture.width, picture.height, picture.rgb, "the run"}};
  difference_.want({shown, other, comparison_.metric, comparison_.scale}, now);
}

} // namespace nephroid::ui
