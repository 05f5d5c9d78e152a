// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/own_directions.h"

#include <algorithm>

namespace nephroid::environment {

// One direction stands alone where else four are put together, and its caustics are sharp.
std::uint32_t OwnDirections::photons_each(const BakeTask& task)
{
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(8 * std::uint64_t{task.photons}, 1U << 30));
}

OwnDirections::OwnDirections(const BakeTask& task, const compute::Context& context) : context_(context), task_(task)
{
  task_.radii = task_.own_radii;
  bake_ = task_.empty_bake();
  bake_.directions.clear();
  task_.photons = photons_each(task);
}

void OwnDirections::want(const std::vector<glm::dvec3>& directions)
{
  Bake wanted = task_.empty_bake();
  wanted.directions.clear();
  std::vector<glm::dvec3> missing;
  for (const glm::dvec3& direction : directions) {
    const auto at = static_cast<std::size_t>(std::ranges::find(bake_.directions, direction) - bake_.directions.begin());
    if (at >= bake_.baked.size()) {
      missing.push_back(direction);
      continue;
    }
    wanted.directions.push_back(direction);
    wanted.baked.push_back(bake_.baked[at]);
    const auto keep = [&](const std::vector<std::uint16_t>& from, std::size_t items, std::vector<std::uint16_t>& to) {
      to.insert(to.end(), from.data() + at * items, from.data() + (at + 1) * items);
    };
    keep(bake_.halves, bake_.direction_items(), wanted.halves);
    keep(bake_.ways, bake_.direction_texels(), wanted.ways);
  }
  wanted.directions.insert(wanted.directions.end(), missing.begin(), missing.end());
  if (baker_ && (missing.empty() || missing.front() != task_.directions.front())) {
    sent_ += baker_->photons();
    baker_.reset();
  }
  bake_ = std::move(wanted);
}

// Each has a baker of its own, so its photons are the same whatever is baked beside it.
void OwnDirections::step()
{
  if (!baker_) {
    task_.directions = {bake_.directions[bake_.baked.size()]};
    baker_.emplace(task_, context_);
  }
  baker_->step();
  if (!baker_->finished()) return;
  sent_ += baker_->photons();
  const Bake one = baker_->take();
  baker_.reset(); // its device memory is for others
  bake_.baked.push_back(one.baked.front());
  bake_.halves.insert(bake_.halves.end(), one.halves.begin(), one.halves.end());
  bake_.ways.insert(bake_.ways.end(), one.ways.begin(), one.ways.end());
}

} // namespace nephroid::environment
