// SPDX-License-Identifier: Apache-2.0
#include "ui/state/difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

namespace nephroid::ui {
namespace {

bool same_values(const DifferenceRequest& a, const DifferenceRequest& b)
{
  return a.picture.owner == b.picture.owner && a.other.owner == b.other.owner && a.metric == b.metric;
}

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

} // namespace

void want_difference(NewestDifference& difference, TaskQueue& tasks, const DifferenceRequest& request,
                     NewestDifference::Clock::time_point now)
{
  const auto& newest = difference.newest();
  const bool same_form =
      newest && newest->of.other.owner == request.other.owner && newest->of.metric == request.metric && newest->of.scale == request.scale;
  const bool same_picture = newest && newest->of.picture.owner == request.picture.owner;
  difference.want(
      tasks, "difference of pictures",
      !same_form     ? Request::other
      : same_picture ? Request::same
                     : Request::other_picture,
      [request, values = newest && same_values(newest->of, request) ? newest->values : nullptr] { return coloured_map(request, values); },
      now);
}

} // namespace nephroid::ui
