// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/cuts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace nephroid::environment {
namespace {

/// Rounding in sums of positive numbers, relative to them.
constexpr double rounding = 1e-12;

/// The best cut of one direction.
struct Candidate {
  int at = 0; ///< lines before the cut; 0: there is none
  double cost = 0;
  Moments before, after;
};

double cost_of(const Moments& before, const Moments& after, SegmentMethod method)
{
  return method == SegmentMethod::thesis ? std::abs(before.m0 - after.m0) : before.variance() + after.variance();
}

/// lines: the sums of rows or of columns. Both sides of a cut are sums of lines: a difference of larger sums would be rounding where
/// there is hardly any light.
Candidate best_between(const std::vector<Moments>& lines, SegmentMethod method)
{
  const std::size_t count = lines.size();
  if (count < 2) return {};
  std::vector<Moments> after(count); // [i]: of lines i and on
  after.back() = lines.back();
  for (std::size_t i = count - 1; i-- > 0;) (after[i] = after[i + 1]) += lines[i];
  std::vector<double> costs(count);
  Moments before;
  for (std::size_t i = 1; i < count; ++i) {
    before += lines[i - 1];
    costs[i] = cost_of(before, after[i], method);
  }
  const double least = *std::min_element(costs.begin() + 1, costs.end()), enough = least + rounding * after.front().m0;
  std::size_t at = 0;
  const auto from_middle = [&](std::size_t i) { return std::abs(2 * static_cast<long>(i) - static_cast<long>(count)); };
  for (std::size_t i = 1; i < count; ++i)
    if (costs[i] <= enough && (at == 0 || from_middle(i) < from_middle(at))) at = i;
  Candidate best{static_cast<int>(at), costs[at], {}, after[at]};
  for (std::size_t i = 0; i < at; ++i) best.before += lines[i];
  return best;
}

double squared_deviation(int width, int height)
{
  const double aspect = static_cast<double>(std::max(width, height)) / std::min(width, height);
  return (aspect - 1) * (aspect - 1);
}

/// Dev (3.2) of two rectangles `side` wide, that have `at` and the rest of `length`.
double deviation(int side, int length, int at) { return squared_deviation(side, at) + squared_deviation(side, length - at); }

bool is_cut_across(const Rect& rect, const Candidate& across, const Candidate& along, SegmentMethod method, double weight)
{
  if (across.at == 0 || along.at == 0) return along.at == 0;
  if (method == SegmentMethod::thesis)
    return deviation(rect.width(), rect.height(), across.at) <= deviation(rect.height(), rect.width(), along.at);
  if (std::abs(across.cost - along.cost) <= rounding * weight) return rect.height() >= rect.width();
  return across.cost < along.cost;
}

} // namespace

double Moments::variance() const
{
  if (!(m0 > 0)) return 0;
  const double value = m0 - glm::dot(m1, m1) / m0;
  return value > rounding * m0 ? value : 0;
}

WeighedCube::WeighedCube(const CubeMap& cube, SegmentWeights weights)
    : size_(cube.size), side_(static_cast<std::size_t>(cube.size)), weights_(face_count * side_ * side_), outwards_(side_ * side_)
{
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      const double s = middle(x, size_), t = middle(y, size_);
      outwards_[cube.texel(0, x, y)] = 1 / std::sqrt(1 + s * s + t * t);
      const double share = weights == SegmentWeights::texel ? 1 / solid_angle({x, y, x + 1, y + 1}, size_) : 1;
      for (int face = 0; face < face_count; ++face) {
        const std::size_t texel = cube.texel(face, x, y);
        weights_[texel] = share * luminance(cube.flux_of(texel));
      }
    }
}

Moments WeighedCube::sum(int face, const Rect& rect) const
{
  Moments all;
  for (int y = rect.y0; y < rect.y1; ++y) {
    Moments row;
    for (int x = rect.x0; x < rect.x1; ++x) row += of(face, x, y);
    all += row;
  }
  return all;
}

std::optional<Cut> best_cut(const WeighedCube& cube, int face, const Rect& rect, SegmentMethod method)
{
  std::vector<Moments> rows(static_cast<std::size_t>(rect.height())), columns(static_cast<std::size_t>(rect.width()));
  double weight = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    Moments& row = rows[static_cast<std::size_t>(y - rect.y0)];
    for (int x = rect.x0; x < rect.x1; ++x) {
      const Moments texel = cube.of(face, x, y);
      row += texel;
      columns[static_cast<std::size_t>(x - rect.x0)] += texel;
    }
    weight += row.m0;
  }
  const Candidate across = best_between(rows, method), along = best_between(columns, method);
  if (across.at == 0 && along.at == 0) return std::nullopt;
  if (is_cut_across(rect, across, along, method, weight)) {
    const int y = rect.y0 + across.at;
    return Cut{{rect.x0, rect.y0, rect.x1, y}, {rect.x0, y, rect.x1, rect.y1}, across.before, across.after};
  }
  const int x = rect.x0 + along.at;
  return Cut{{rect.x0, rect.y0, x, rect.y1}, {x, rect.y0, rect.x1, rect.y1}, along.before, along.after};
}

} // namespace nephroid::environment
