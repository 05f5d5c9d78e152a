// SPDX-License-Identifier: Apache-2.0
#include "inverse/thesis/trial.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/uniform.h"

#include <algorithm>

namespace nephroid::inverse {
namespace {

/// Facets of one advance(), and of one thread's turn.
constexpr std::size_t piece = 512, turn = 16;

} // namespace

std::vector<glm::dvec2> flat_slopes(const Layout& layout)
{
  std::vector<glm::dvec2> slopes(layout.facet_count());
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = flat_slope(layout.sines_on(i));
  return slopes;
}

Trial::Trial(const Layout& layout, const std::vector<Aim>& aims, const Thesis& settings, std::uint64_t seed)
    : layout_(layout), settings_(settings), seed_(seed), sampler_(layout, aims, settings),
      counts_(aims.size(), std::vector<std::uint32_t>(layout.cell_count())), slopes_(flat_slopes(layout))
{
}

void Trial::advance()
{
  const std::size_t count = std::min(piece, layout_.facet_count() - next_), receivers = counts_.size();
  std::vector<Draws> found(count);
  for_ranges(count, turn, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      std::mt19937_64 random = numbers_of(seed_, next_ + i);
      found[i] = sampler_.draw(next_ + i, settings_.draws, random);
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    if (found[i].slopes.empty())
      ++dark_;
    else
      slopes_[next_ + i] = found[i].slopes.front();
    for (std::size_t k = 0; k < found[i].cells.size(); ++k)
      if (const int cell = found[i].cells[k]; cell >= 0) ++counts_[k % receivers][static_cast<std::size_t>(cell)];
  }
  next_ += count;
}

Drawn Trial::drawn() const
{
  Drawn drawn{{}, slopes_, dark_};
  for (const auto& counts : counts_) {
    drawn.light.emplace_back(counts.begin(), counts.end());
    for (double& light : drawn.light.back()) light /= settings_.draws;
  }
  return drawn;
}

void Trial::state(State& state)
{
  state.value(next_);
  for (auto& counts : counts_) state.items(counts);
  state.items(slopes_);
  state.value(dark_);
}

} // namespace nephroid::inverse
