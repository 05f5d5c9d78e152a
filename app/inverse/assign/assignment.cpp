// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/assignment.h"

#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/facets/heights.h"
#include "inverse/light.h"
#include "inverse/uniform.h"

#include <algorithm>
#include <numeric>

namespace nephroid::inverse {

Assignment::Assignment(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
                       std::uint64_t seed)
    : given_(layout), layout_(layout), targets_(targets), seed_(seed), tones_(targets.size(), 1.0), wanted_(targets),
      weights_(picture_weights(layout, targets)), heights_(layout.facet_count()),
      facets_(context, layout, targets, weights_) {
  std::mt19937_64 random(seed_);
  std::vector<glm::dvec2> slopes(layout.facet_count());
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const std::size_t j =
        layout.distances.size() - 1 - i % (layout.offsets || !layout.light_of.empty() ? layout.distances.size() : 1);
    const glm::dvec2 to = layout.offset(j) + (glm::dvec2(uniform(random), uniform(random)) - 0.5) * layout.receiver;
    slopes[i] = nearest_reachable(slope_towards(layout, i, (to - layout.middle(i)) / layout.distances[j], j), layout.n,
                                  layout.sines_on(i), layout.steepest);
  }
  put(slopes);
  settle();
  residual_ = residual();
  begin_sweep();
}

void Assignment::relight() {
  Illumination light = std::move(layout_.light);
  std::vector<Illumination> own = std::move(layout_.own_lights);
  layout_ = given_;
  layout_.light = std::move(light);
  layout_.own_lights = std::move(own);
  aim();
  put(std::vector(slopes()));
  settle();
  residual_ = residual();
  refinement_.reset();
  converged_ = false;
  next_ = 0;
  begin_sweep();
}

void Assignment::aim() {
  for (std::size_t j = 0; j < wanted_.size(); ++j)
    std::transform(targets_[j].begin(), targets_[j].end(), wanted_[j].begin(),
                   [&](double cell) { return tones_[j] * cell; });
  weights_ = picture_weights(layout_, wanted_);
  facets_.aim(layout_, wanted_, weights_);
}

void Assignment::begin_sweep() {
  std::mt19937_64 random = numbers_of(seed_, static_cast<std::uint64_t>(sweeps_));
  std::vector<std::uint32_t> order(layout_.facet_count());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  facets_.begin_sweep(order, sweeps_, seed_);
}

void Assignment::put(const std::vector<glm::dvec2>& slopes) {
  facets_.put(slopes, heights_);
  forget();
}

/// Free heights stand where walls are lowest, and light falls from there. Facets in one plane see their neighbours as
/// these are now. Each picture is as bright as the light that reaches its receiver.
void Assignment::settle() {
  if (layout_.free_heights || layout_.light.facets) {
    const std::vector<glm::dvec2> now = slopes();
    if (layout_.free_heights) heights_ = heights_of(layout_, now);
    for (std::size_t i = 0; i < layout_.incoming().size(); ++i) {
      Incoming& in = (*layout_.light.facets)[i];
      in.around = facet_gradient(now[i], layout_.n, in.sines);
    }
    share_neighbours();
    facets_.set_incoming(layout_);
    put(now);
  }
  constexpr double least_tone = 0.01; // for a picture that no light has found yet
  for (std::size_t j = 0; j < tones_.size(); ++j) {
    const std::vector<double>& light = all_light()[j];
    tones_[j] = std::max(least_tone,
                         std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(layout_.facet_count()));
  }
  aim();
}

/// Neighbours look the same in every light.
void Assignment::share_neighbours() {
  for (Illumination& light : layout_.own_lights)
    for (std::size_t i = 0; i < light.facets->size(); ++i) (*light.facets)[i].around = layout_.incoming()[i].around;
}

/// The weight of one facet's Cost_N in the sum: both costs are means, one over the facets, one over all cells.
double Assignment::smoothing_weight() const {
  return layout_.smoothing * static_cast<double>(layout_.cell_count() * targets_.size()) /
         static_cast<double>(layout_.facet_count());
}

void Assignment::forget() {
  slopes_.clear();
  light_.clear();
}

const std::vector<glm::dvec2>& Assignment::slopes() const {
  if (slopes_.empty()) slopes_ = facets_.slopes();
  return slopes_;
}

const std::vector<std::vector<double>>& Assignment::all_light() const {
  if (light_.empty()) light_ = facets_.light();
  return light_;
}

void Assignment::refine() {
  refinement_->advance(facets_);
  forget();
  tried_ += layout_.facet_count();
  if (!refinement_->finished()) return;
  ++sweeps_;
  settle();
}

void Assignment::advance() {
  if (refinement_) return refine();
  const std::size_t count = std::min(facets_.batch(), layout_.facet_count() - next_);
  facets_.improve(next_, count, smoothing_weight());
  forget();
  next_ += count;
  tried_ += count;
  if (next_ < layout_.facet_count()) return;
  next_ = 0;
  ++sweeps_;
  settle();
  const double before = std::exchange(residual_, residual());
  constexpr double worth_a_sweep = 0.03; // a sweep that lowers the sum of squares by a smaller part of it is the last
  if (residual_ > (1 - worth_a_sweep) * before) {
    converged_ = layout_.smoothing > 0;
    if (!converged_) refinement_.emplace(layout_, wanted_, weights_, heights_);
  }
  begin_sweep();
}

double Assignment::residual() const {
  const double rough = layout_.smoothing > 0 ? smoothing_weight() * static_cast<double>(layout_.facet_count()) *
                                                   roughness(layout_, slopes())
                                             : 0;
  return weighted_squares(wanted_, weights_, all_light(), layout_.facet_count()) + rough;
}

double Assignment::fraction_done() const {
  return refinement_ ? refinement_->fraction_done()
                     : static_cast<double>(next_) / static_cast<double>(layout_.facet_count());
}

std::vector<Cost> Assignment::costs() const {
  return costs_of(targets_, all_light(), light_sent_to_each(layout_, slopes()));
}

void Assignment::serialize(Archive& archive) {
  archive.value(sweeps_);
  archive.value(next_);
  archive.value(tried_);
  archive.value(residual_);
  archive.items(tones_);
  if (archive.is_read()) aim();
  facets_.serialize(archive);
  if (layout_.free_heights) archive.items(heights_);
  if (layout_.light.facets)
    for (Incoming& in : *layout_.light.facets) {
      archive.value(in.around.x);
      archive.value(in.around.y);
    }
  archive.value(converged_);
  bool refines = refinement_.has_value();
  archive.value(refines);
  if (archive.is_read()) refinement_.reset();
  if (refines && archive.is_read()) refinement_.emplace(layout_, wanted_, weights_, heights_);
  if (refines) refinement_->serialize(archive);
  if (!archive.is_read()) return;
  share_neighbours();
  facets_.set_incoming(layout_);
  forget();
  begin_sweep();
}

} // namespace nephroid::inverse
