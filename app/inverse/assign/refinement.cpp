// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/refinement.h"

#include "base/parallel.h"
#include "inverse/assign/cost.h"
#include "inverse/bending.h"

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

/// Lengths tried along a line.
constexpr int most_tries = 6;
/// The first step moves facets by so many cells of the last receiver, as a root mean square.
constexpr double first_step = 0.05;
/// A line's step is good where the sum falls by this part of what the gradient promises.
constexpr double promise = 0.1;

double dot(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
  return sum;
}

} // namespace

Refinement::Refinement(const Layout& layout, const std::vector<Target>& targets, std::vector<double> weights,
                       const std::vector<double>& heights)
    : layout_(layout), targets_(targets), weights_(std::move(weights)), heights_(heights),
      gradient_(layout.facet_count()), before_(layout.facet_count()), direction_(layout.facet_count()) {}

/// The new direction, and how the sum changes along it.
double Refinement::turn() {
  const double before = dot(before_, before_), now = dot(gradient_, gradient_);
  const double keep = before > 0 ? std::max(0.0, (now - dot(gradient_, before_)) / before) : 0;
  for (std::size_t i = 0; i < direction_.size(); ++i) direction_[i] = keep * direction_[i] - gradient_[i];
  if (const double change = dot(gradient_, direction_); change < 0) return change;
  for (std::size_t i = 0; i < direction_.size(); ++i) direction_[i] = -gradient_[i];
  return -now;
}

void Refinement::advance(DeviceFacets& facets) {
  ++done_;
  gradient_ = facets.gradient();
  const std::vector<glm::dvec2> slopes = facets.slopes();
  const double change = turn(), from = weighted_squares(targets_, weights_, facets.light(), slopes.size());
  if (step_ == 0) {
    const double length = std::sqrt(-change / static_cast<double>(slopes.size()));
    step_ = length > 0 ? first_step * layout_.cell().x / layout_.distances.back() / length : 0;
  }
  before_ = gradient_;
  std::vector<glm::dvec2> moved(slopes.size());
  for (int i = 0; i < most_tries; ++i) {
    for_ranges(slopes.size(), 4096, [&](std::size_t, Range range) {
      for (std::size_t k = range.begin; k < range.end; ++k)
        moved[k] =
            nearest_reachable(slopes[k] + step_ * direction_[k], layout_.n, layout_.sines_on(k), layout_.steepest);
    });
    facets.put(moved, heights_);
    // The parabola through both sums with the slope at the first: its lowest point is the next length.
    const double to = weighted_squares(targets_, weights_, facets.light(), slopes.size()),
                 bend = (to - from - step_ * change) / (step_ * step_),
                 lowest = bend > 0 ? -change / (2 * bend) : 4 * step_;
    if (to < from + promise * step_ * change) {
      step_ = std::clamp(lowest, step_ / 4, 4 * step_);
      return;
    }
    step_ = std::clamp(lowest, step_ / 10, step_ / 2);
  }
  facets.put(slopes, heights_);
  stuck_ = true;
}

void Refinement::serialize(Archive& archive) {
  archive.items(before_);
  archive.items(direction_);
  archive.value(step_);
  archive.value(done_);
  archive.value(stuck_);
}

} // namespace nephroid::inverse
