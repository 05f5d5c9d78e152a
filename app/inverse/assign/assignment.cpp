// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/assignment.h"

#include "base/parallel.h"
#include "inverse/assign/cost.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/facets/solid.h"
#include "inverse/uniform.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nephroid::inverse {

Assignment::Assignment(const Layout& layout, const std::vector<Target>& targets, std::uint64_t seed)
    : given_(layout), layout_(layout), targets_(targets), seed_(seed), weights_(picture_weights(layout, targets)),
      heights_(layout.facet_count()), search_(layout_, weights_, heights_), slopes_(layout.facet_count()),
      light_(targets.size(), std::vector<double>(layout.cell_count()))
{
  std::mt19937_64 random(seed_);
  const double last = layout.distances.back();
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const glm::dvec2 to = (glm::dvec2(uniform(random), uniform(random)) - 0.5) * layout.receiver;
    slopes_[i] = nearest_reachable((to - layout.middle(i)) / last, layout.n, layout.sines_on(i), layout.steepest);
  }
  settle();
  residual_ = residual();
  begin_sweep();
}

void Assignment::relight()
{
  layout_.distances = given_.distances;
  layout_.weights = given_.weights;
  weights_ = picture_weights(layout_, targets_);
  search_.weigh(weights_);
  light_all(layout_, slopes_, heights_, light_);
  residual_ = residual();
  refinement_.reset();
  converged_ = false;
  next_ = 0;
  begin_sweep();
}

void Assignment::begin_sweep()
{
  std::mt19937_64 random = numbers_of(seed_, static_cast<std::uint64_t>(sweeps_));
  order_.resize(slopes_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  for (std::size_t i = order_.size(); i > 1; --i) std::swap(order_[i - 1], order_[random() % i]);
  search_.aim({uniform(random), uniform(random)});
}

/// Facets stand where their walls are lowest for the slopes that they have; their light falls from there. Those in one plane see their
/// neighbours as these are now, in whose shadows they lie.
void Assignment::settle()
{
  if (layout_.free_heights) heights_ = heights_of(layout_, slopes_);
  for (std::size_t i = 0; i < layout_.incoming.size(); ++i)
    layout_.incoming[i].around = facet_gradient(slopes_[i], layout_.n, layout_.incoming[i].sines);
  light_all(layout_, slopes_, heights_, light_);
}

void Assignment::put(std::size_t facet, double sign) { add_light(layout_, facet, slopes_[facet], sign, light_, heights_[facet]); }

/// What one facet's Cost_N, thesis (6.1), weighs in the sum: both costs are means, one over the facets, one over all cells.
double Assignment::smoothing_weight() const
{
  return layout_.smoothing * static_cast<double>(layout_.cell_count() * light_.size()) / static_cast<double>(slopes_.size());
}

glm::dvec3 Assignment::pull_on(std::size_t facet) const
{
  return layout_.smoothing > 0 ? smoothing_weight() * pull(layout_, slopes_, facet) : glm::dvec3(0);
}

/// What the sum would change by with the facet there too.
double Assignment::gain(std::size_t facet, const glm::dvec2& slope) const
{
  const double light = facet_power(layout_, facet, slope), facets = static_cast<double>(slopes_.size());
  double change = layout_.smoothing > 0 ? -glm::dot(normal_of(layout_, facet, slope), pull_on(facet)) : 0;
  for (std::size_t j = 0; j < light_.size(); ++j)
    for_cells(layout_, footprint(layout_, facet, slope, j, heights_[facet]), [&](std::size_t cell, double part) {
      const double a = light * part;
      change += weights_[j] * a * (2 * (light_[j][cell] - facets * targets_[j][cell]) + a);
    });
  return change;
}

std::vector<Lack> Assignment::lacks_without(const std::vector<Lack>& lacks, std::size_t facet) const
{
  std::vector<Lack> all = lacks;
  const glm::dvec2 slope = slopes_[facet];
  const double light = facet_power(layout_, facet, slope);
  for (std::size_t j = 0; j < all.size(); ++j) {
    Lack& lack = all[j];
    const Footprint print = footprint(layout_, facet, slope, j, heights_[facet]);
    for (int k = 0; k < print.rows; ++k)
      for (int i = 0; i < print.columns; ++i)
        lack.values[index_at(print.x0 + i + lack.rim, print.y0 + k + lack.rim, lack.width)] -=
            static_cast<float>(2 * weights_[j] * light * print.cells[index_at(i, k, print.columns)]);
  }
  return all;
}

/// Where a facet would go among the light of the others: to the best of all places, or on from where it is if that is better.
glm::dvec2 Assignment::look(std::size_t facet, const std::vector<Lack>& lacks) const
{
  glm::dvec2 from = slopes_[facet];
  const glm::dvec3 pull = pull_on(facet);
  const std::optional<glm::dvec2> found = search_.best(facet, lacks, pull);
  if (found && search_.score(facet, *found, lacks, pull) < search_.score(facet, from, lacks, pull)) from = *found;
  return search_.refined(facet, from, lacks, pull);
}

void Assignment::refine()
{
  refinement_->advance(slopes_, light_);
  tried_ += slopes_.size();
  if (!refinement_->finished()) return;
  ++sweeps_;
  if (layout_.free_heights || !layout_.incoming.empty()) settle();
}

void Assignment::advance()
{
  if (refinement_) return refine();
  const std::size_t count = std::min(batch, slopes_.size() - next_);
  const std::span<const std::uint32_t> facets(order_.data() + next_, count);
  const std::vector<Lack> now = search_.lacks(targets_, light_);
  std::vector<glm::dvec2> found(count);
  for_blocks(count, [&](std::size_t i) { found[i] = look(facets[i], lacks_without(now, facets[i])); });
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t facet = facets[i];
    put(facet, -1);
    if (gain(facet, found[i]) < gain(facet, slopes_[facet])) slopes_[facet] = found[i];
    put(facet, 1);
  }
  next_ += count;
  tried_ += count;
  if (next_ < slopes_.size()) return;
  next_ = 0;
  ++sweeps_;
  if (layout_.free_heights || !layout_.incoming.empty()) settle();
  const double before = std::exchange(residual_, residual());
  constexpr double worth_a_sweep = 0.01; // a sweep that lowers the sum of squares by a smaller part of it is the last
  if (residual_ > (1 - worth_a_sweep) * before) {
    converged_ = layout_.smoothing > 0;
    if (!converged_) refinement_.emplace(layout_, targets_, weights_, heights_);
  }
  begin_sweep();
}

double Assignment::residual() const
{
  const double rough = layout_.smoothing > 0 ? smoothing_weight() * static_cast<double>(slopes_.size()) * roughness(layout_, slopes_) : 0;
  return weighted_squares(targets_, weights_, light_, slopes_.size()) + rough;
}

double Assignment::part() const
{
  return refinement_ ? refinement_->part() : static_cast<double>(next_) / static_cast<double>(slopes_.size());
}

std::vector<Cost> Assignment::costs() const { return costs_of(targets_, light_, light_sent(layout_, slopes_)); }

void Assignment::state(State& state)
{
  state.value(sweeps_);
  state.value(next_);
  state.value(tried_);
  state.value(residual_);
  state.items(slopes_);
  if (layout_.free_heights) state.items(heights_);
  for (Incoming& in : layout_.incoming) {
    state.value(in.around.x);
    state.value(in.around.y);
  }
  for (auto& light : light_) state.items(light);
  state.value(converged_);
  bool refines = refinement_.has_value();
  state.value(refines);
  if (state.is_read()) refinement_.reset();
  if (refines && state.is_read()) refinement_.emplace(layout_, targets_, weights_, heights_);
  if (refines) refinement_->state(state);
  if (state.is_read()) begin_sweep();
}

} // namespace nephroid::inverse
