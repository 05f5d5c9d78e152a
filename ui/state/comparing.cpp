// SPDX-License-Identifier: Apache-2.0
#include "ui/state/comparing.h"

#include "ui/state/run_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace nephroid::ui {
namespace {

/// The values in the map's colours, by a table: there are far more pixels than colours that a display tells apart.
std::vector<unsigned char> coloured(const std::vector<float>& values, double scale, bool is_signed)
{
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

/// known: the values, where they are known from a map with another scale.
std::shared_ptr<const ShownDifference> coloured_map(const DifferenceRequest& request, std::shared_ptr<const std::vector<float>> known)
{
  auto map = std::make_shared<ShownDifference>();
  map->of = request;
  try {
    if (!known)
      known = std::make_shared<std::vector<float>>(measure::difference_map(request.picture.pixels, request.other.pixels, request.metric));
    map->scale = request.scale > 0 ? request.scale : measure::colour_scale(*known);
    map->rgba = coloured(*known, map->scale, measure::is_signed(request.metric));
    map->values = std::move(known);
  } catch (const std::exception& error) {
    map->error = error.what();
  }
  return map;
}

/// Null where there is no layer of this name.
const job::Layer* find_layer(const std::vector<job::Layer>& layers, const std::string& name)
{
  const auto found = std::ranges::find(layers, name, &job::Layer::name);
  return found == layers.end() ? nullptr : &*found;
}

/// Why a picture (its name as a sentence begins) has no such layer; empty where it has it, or where none is asked for.
std::string why_no_layer(const std::string& picture, const std::vector<job::Layer>& layers, const std::string& name)
{
  if (name.empty() || find_layer(layers, name)) return {};
  if (layers.empty()) return fmt::format("{} has no layers, and \"{}\" is chosen", picture, name);
  std::vector<std::string> names;
  for (const job::Layer& layer : layers) names.push_back(layer.name);
  return fmt::format("{} has no layer \"{}\", only {}", picture, name, fmt::join(names, ", "));
}

/// All of a picture or one of its layers; the layer is there. Other pixels have another owner.
template <class Picture>
HeldPicture held(const std::shared_ptr<const Picture>& of, const std::string& layer, const std::string& name)
{
  const job::Layer* found = layer.empty() ? nullptr : find_layer(of->layers, layer);
  const std::vector<float>& rgb = found ? found->rgb : of->rgb;
  return {std::shared_ptr<const void>(of, &rgb), {of->width, of->height, rgb, name}};
}

} // namespace

void Comparing::carry_out(const command::ShowDifference& c)
{
  comparison_.difference = c.on;
  comparison_.metric = c.metric;
  comparison_.scale = c.scale > 0 && std::isfinite(c.scale) ? c.scale : 0;
  if (!c.on) difference_.forget(tasks_);
}

void Comparing::carry_out(const command::PinRun&)
{
  if (run_.snapshot()) pin(run_now(run_));
}

void Comparing::carry_out(const command::Unpin& c)
{
  pinned_.remove(c.pin);
  if (comparison_.pin == c.pin) comparison_.pin = 0;
}

std::string Comparing::why_no_picture() const
{
  if (!run_.snapshot()) return "there is no picture yet";
  return why_no_layer("the run's picture", run_.snapshot()->picture->layers, comparison_.layer);
}

HeldPicture Comparing::picture() const
{
  if (!why_no_picture().empty()) return {};
  return held(run_.snapshot()->picture, comparison_.layer, "the run");
}

std::string Comparing::why_not() const
{
  if (const std::string why = why_no_picture(); !why.empty()) return why;
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
  if (width == picture.width && height == picture.height)
    return why_no_layer(pin ? '"' + pin->name + '"' : "the reference", pin ? pin->picture->layers : reference->layers, comparison_.layer);
  return fmt::format("{} is {} x {}, the picture {} x {}", pin ? '"' + pin->name + '"' : "the reference", width, height, picture.width,
                     picture.height);
}

HeldPicture Comparing::other_picture() const
{
  if (!why_not().empty()) return {};
  if (const PinnedRun* pin = pinned_.find(comparison_.pin)) return held(pin->picture, comparison_.layer, pin->name);
  return held(run_.reference(), comparison_.layer, run_.reference()->origin);
}

void Comparing::update(TaskQueue::Clock::time_point now)
{
  if (!comparison_.difference) return;
  const DifferenceRequest request{picture(), other_picture(), comparison_.metric, comparison_.scale};
  if (!request.other.owner) return;
  const auto& newest = difference_.newest();
  const bool same_other = newest && newest->of.other.owner == request.other.owner && newest->of.metric == request.metric;
  const bool same_picture = newest && newest->of.picture.owner == request.picture.owner;
  const bool same_form = same_other && newest->of.scale == request.scale;
  difference_.want(
      tasks_, "difference of pictures",
      !same_form     ? Request::other
      : same_picture ? Request::same
                     : Request::other_picture,
      [request, values = same_other && same_picture ? newest->values : nullptr] { return coloured_map(request, values); }, now);
}

} // namespace nephroid::ui
