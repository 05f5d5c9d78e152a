// SPDX-License-Identifier: Apache-2.0
#include "ui/state/comparing.h"

#include "ui/state/run_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace nephroid::ui {
namespace {

/// Colours the values by a table, because there are far more pixels than colours that a display tells apart.
std::vector<unsigned char> coloured(const std::vector<float>& values, double scale, bool is_signed) {
  constexpr int steps = 1024;
  std::vector<std::array<unsigned char, 3>> table;
  for (int i = 0; i <= steps; ++i) table.push_back(measure::map_colour(static_cast<double>(i) / steps, is_signed));
  std::vector<unsigned char> rgba(4 * values.size(), 255);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double position = is_signed ? 0.5 + 0.5 * values[i] / scale : values[i] / scale;
    const auto& colour = table[static_cast<std::size_t>(std::lround(steps * std::clamp(position, 0.0, 1.0)))];
    std::copy(colour.begin(), colour.end(), &rgba[4 * i]);
  }
  return rgba;
}

/// known: values from a map with another scale; null: they must be computed.
std::shared_ptr<const ShownDifference> coloured_map(const DifferenceRequest& request,
                                                    std::shared_ptr<const std::vector<float>> known) {
  auto map = std::make_shared<ShownDifference>();
  map->of = request;
  try {
    if (!known)
      known = std::make_shared<std::vector<float>>(
          measure::difference_map(request.picture.pixels, request.other.pixels, request.metric));
    map->scale = request.scale > 0 ? request.scale : measure::colour_scale(*known);
    map->rgba = coloured(*known, map->scale, measure::is_signed(request.metric));
    map->values = std::move(known);
  } catch (const std::exception& error) {
    map->error = error.what();
  }
  return map;
}

/// The layer with this name; null where there is none.
const job::Layer* find_layer(const std::vector<job::Layer>& layers, const std::string& name) {
  const auto found = std::ranges::find(layers, name, &job::Layer::name);
  return found == layers.end() ? nullptr : &*found;
}

std::shared_ptr<const ShownMetrics> measured(const HeldPicture& picture, const HeldPicture& other,
                                             measure::MetricSet which) {
  auto metrics = std::make_shared<ShownMetrics>();
  metrics->picture = picture;
  metrics->other = other;
  try {
    metrics->metrics = measure::compare(picture.pixels, other.pixels, {}, which);
  } catch (const std::exception& error) {
    metrics->error = error.what();
  }
  return metrics;
}

} // namespace

void Comparing::carry_out(const command::ShowDifference& c) {
  comparison_.difference = c.on;
  comparison_.metric = c.metric;
  comparison_.scale = c.scale > 0 && std::isfinite(c.scale) ? c.scale : 0;
  if (!c.on) difference_.forget(tasks_);
}

void Comparing::carry_out(const command::PinRun&) {
  if (run_.snapshot()) pin(run_now(run_));
}

void Comparing::carry_out(const command::PinFile& c) {
  services_.follow_ups.push_back(command::Ask{});
  tasks_.start(
      pins_, {"reading " + c.path.string(), TaskKind::request}, [path = c.path] { return read_pin(path); },
      [this, like = c.like, show = c.show](PinnedRun run) {
        if (like) {
          run.name = like->name;
          run.colour = like->colour;
          run.shown = like->shown;
        }
        const bool shows_picture = show && !run.is_run();
        if (shows_picture)
          services_.messages.note(
              fmt::format("opened {}, {} x {} ({})", run.name, run.picture->width, run.picture->height, run.read_as));
        const std::uint64_t id = pin(std::move(run));
        if (shows_picture) comparison_.shown = id;
      });
}

void Comparing::carry_out(const command::Unpin& c) {
  pinned_.remove(c.pin);
  if (comparison_.pin == c.pin) comparison_.pin = 0;
  if (comparison_.shown == c.pin) comparison_.shown = 0;
}

void Comparing::carry_out(const command::CompareWith& c) {
  comparison_.pin = c.pin == Comparison::run_in_hand || pinned_.find(c.pin) ? c.pin : 0;
}

template <class Picture>
Comparing::Side Comparing::side_of(const Picture& picture, const std::string& name, const std::string& subject) {
  return {picture, picture->width, picture->height, &picture->rgb, &picture->layers, name, subject};
}

Comparing::Side Comparing::pinned_side(const PinnedRun& pin) {
  const std::string quoted = '"' + pin.name + '"';
  if (!pin.picture) return {.why_not = quoted + " has no picture: only its history was read"};
  return side_of(pin.picture, pin.name, quoted);
}

/// The picture of the snapshot, which must exist. Designs are compared by the light that they cast.
std::shared_ptr<const job::Picture> Comparing::run_picture() const {
  const job::Snapshot& snapshot = *run_.snapshot();
  return shows_run_alone() && snapshot.in_view ? snapshot.in_view : snapshot.picture;
}

Comparing::Side Comparing::run_side() const {
  if (!run_.snapshot()) return {.why_not = "there is no picture yet"};
  return side_of(run_picture(), "the run", "the run's picture");
}

Comparing::Side Comparing::side() const {
  const PinnedRun* pin = pinned_.find(comparison_.shown);
  return pin ? pinned_side(*pin) : run_side();
}

Comparing::Side Comparing::other_side() const {
  if (comparison_.pin == Comparison::run_in_hand) return run_side();
  if (const PinnedRun* pin = pinned_.find(comparison_.pin)) return pinned_side(*pin);
  if (const auto& reference = run_.reference()) return side_of(reference, reference->origin, "the reference");
  if (run_.plan() || !run_.has_reference())
    return {.why_not = "the preset has no reference and no picture is chosen to compare with"};
  return {.why_not = "the reference is not there yet"};
}

/// The picture or the chosen layer of it, where there is one. Other pixels have another owner.
HeldPicture Comparing::held(const Side& side) const {
  if (!why_no_layer(side).empty()) return {};
  const job::Layer* found = find_layer(*side.layers, comparison_.layer);
  const std::vector<float>& rgb = found ? found->rgb : *side.rgb;
  return {std::shared_ptr<const void>(side.owner, &rgb), {side.width, side.height, rgb, side.name}};
}

/// Why there is no picture, or not the chosen layer of it; empty where there is.
std::string Comparing::why_no_layer(const Side& side) const {
  const std::string& layer = comparison_.layer;
  if (!side.why_not.empty() || layer.empty() || find_layer(*side.layers, layer)) return side.why_not;
  if (side.layers->empty()) return fmt::format("{} has no layers, and \"{}\" is chosen", side.subject, layer);
  std::vector<std::string> names;
  for (const job::Layer& there : *side.layers) names.push_back(there.name);
  return fmt::format("{} has no layer \"{}\", only {}", side.subject, layer, fmt::join(names, ", "));
}

std::shared_ptr<const job::Picture> Comparing::source() const {
  if (const PinnedRun* pin = pinned_.find(comparison_.shown)) return pin->picture;
  return run_.snapshot() ? run_picture() : nullptr;
}

std::string Comparing::name() const {
  const PinnedRun* pin = pinned_.find(comparison_.shown);
  return pin ? '"' + pin->name + '"' : "this run";
}

std::string Comparing::other_name() const {
  if (comparison_.pin == Comparison::run_in_hand) return "this run";
  const PinnedRun* pin = pinned_.find(comparison_.pin);
  return pin ? '"' + pin->name + '"' : "Reference";
}

std::string Comparing::why_no_picture() const { return why_no_layer(side()); }
std::string Comparing::why_none_beside() const { return why_no_layer(other_side()); }

HeldPicture Comparing::picture() const { return held(side()); }
HeldPicture Comparing::picture_beside() const { return held(other_side()); }
HeldPicture Comparing::other_picture() const { return why_not().empty() ? picture_beside() : HeldPicture{}; }

std::string Comparing::why_not() const {
  if (const std::string why = why_no_picture(); !why.empty()) return why;
  const Side one = side(), other = other_side();
  if (other.why_not.empty() && (one.width != other.width || one.height != other.height))
    return fmt::format("{} is {} x {}, {} {} x {}", other.subject, other.width, other.height,
                       comparison_.shown == 0 ? "the picture" : one.subject, one.width, one.height);
  return why_none_beside();
}

bool Comparing::are_compared(const HeldPicture& picture, const HeldPicture& other) const {
  const auto is = [](const HeldPicture& of, const HeldPicture& now, bool of_run) {
    return of.owner == now.owner || (of_run && now.owner && of.pixels.width == now.pixels.width &&
                                     of.pixels.height == now.pixels.height && of.pixels.name == now.pixels.name);
  };
  const HeldPicture now = other_picture();
  return now.owner && is(picture, this->picture(), comparison_.shown == 0) &&
         is(other, now, comparison_.pin == Comparison::run_in_hand);
}

std::shared_ptr<const ShownMetrics> Comparing::fitting(const NewestResult<ShownMetrics>& metrics) const {
  const auto& newest = metrics.newest();
  return newest && comparison_.measures() && are_compared(newest->picture, newest->other) ? newest : nullptr;
}

void Comparing::update(TaskQueue::Clock::time_point now) {
  if (comparison_.difference) update_map(now);
  if (comparison_.measures()) update_metrics(now);
}

void Comparing::update_metrics(TaskQueue::Clock::time_point now) {
  constexpr std::chrono::seconds stays{1};
  const HeldPicture picture = this->picture(), other = other_picture();
  if (!other.owner) return;
  const bool another = picture.owner != measured_, against_another = other.owner != measured_against_;
  if (another || against_another) measured_since_ = now;
  if ((another && comparison_.shown != 0) || (against_another && comparison_.pin != Comparison::run_in_hand)) {
    metrics_.forget(tasks_); // a person chose this: it need not wait for what is being made
    all_metrics_.forget(tasks_);
  }
  measured_ = picture.owner, measured_against_ = other.owner;
  const auto want = [&](NewestResult<ShownMetrics>& metrics, measure::MetricSet which) {
    const auto& newest = metrics.newest();
    const bool same_other = newest && newest->other.owner == other.owner,
               same_picture = newest && newest->picture.owner == picture.owner;
    metrics.want(
        tasks_, "metrics of pictures", same_other, same_picture,
        [picture, other, which] { return measured(picture, other, which); }, now);
  };
  want(metrics_, measure::MetricSet::quick);
  if (now - measured_since_ >= stays) want(all_metrics_, measure::MetricSet::full);
}

void Comparing::update_map(TaskQueue::Clock::time_point now) {
  const DifferenceRequest request{picture(), other_picture(), comparison_.metric, comparison_.scale};
  if (!request.other.owner) return;
  const auto& newest = difference_.newest();
  const bool same_other =
      newest && newest->of.other.owner == request.other.owner && newest->of.metric == request.metric;
  const bool same_picture = newest && newest->of.picture.owner == request.picture.owner;
  const bool same_form = same_other && newest->of.scale == request.scale;
  const auto known = same_other && same_picture ? newest->values : nullptr;
  difference_.want(
      tasks_, "difference of pictures", same_form, same_picture,
      [request, known] { return coloured_map(request, known); }, now);
}

} // namespace nephroid::ui
