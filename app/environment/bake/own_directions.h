// SPDX-License-Identifier: Apache-2.0
// Spheres of further directions, baked while a scene is shown: where its strongest lights come from (strong_directions in light/).
#pragma once
#include "environment/bake/baker.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::environment {

class OwnDirections {
public:
  /// From each direction. task: of the bake that they are added to.
  static std::uint32_t photons_each(const BakeTask& task);

  /// task: as above.
  OwnDirections(const BakeTask& task, const compute::Context& context);

  /// Of these directions the spheres that are there are kept, and others are dropped. directions: unit, in the bake's coordinates.
  void want(const std::vector<glm::dvec3>& directions);
  bool complete() const { return bake_.baked.size() == bake_.directions.size(); }
  /// While not complete: some photons. Throws failed where the device has not enough memory.
  void step();
  /// Those wanted, as far as they are there.
  const Bake& bake() const { return bake_; }
  /// Sent so far, those of dropped directions too.
  std::uint64_t photons() const { return sent_ + (baker_ ? baker_->photons() : 0); }
  /// To be sent until it is complete.
  std::uint64_t photons_left() const
  {
    return (bake_.directions.size() - bake_.baked.size()) * std::uint64_t{task_.photons} - (baker_ ? baker_->photons() : 0);
  }

private:
  compute::Context context_;
  BakeTask task_; ///< of the one direction in hand
  Bake bake_;
  std::optional<Baker> baker_; ///< of that direction
  std::uint64_t sent_ = 0;     ///< by bakers before it
};

} // namespace nephroid::environment
