// SPDX-License-Identifier: Apache-2.0
// Caustics on receivers, put together set after set in the ways that the thesis compares (table 3.3): kernels/environment/one_by_one.cl.
#pragma once
#include "compute/compute.h"
#include "environment/light/distant_lights.h"
#include "environment/settings.h"
#include "kernels/environment/render_types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::environment {

struct CastTexels;

/// What is looked up, all of it on the device.
struct TurnedSpheres {
  const compute::Buffer<std::uint16_t>& stored;
  const compute::Buffer<float>& radii;
  const compute::Buffer<shared::DeviceEightSets>& sets; ///< none of lights' own directions
  shared::DeviceSpheres spheres;
  shared::float4 object_x, object_y, object_z; ///< the object's axes in the scene
};

class OneByOne {
public:
  /// stored: spheres of all baked directions in their stored form, direction after direction. Throws failed where the device has not enough
  /// memory.
  OneByOne(Technique technique, const std::vector<std::uint16_t>& stored, std::size_t directions, std::size_t channels,
           const compute::Context& context);

  /// On the device, beside TurnedSpheres. texels: in their stored form, of all spheres of one direction.
  static std::uint64_t bytes(Technique technique, std::size_t texels, std::size_t directions, std::size_t channels);

  /// sets: as turned.sets has them.
  void set_lights(const TurnedSpheres& turned, const std::vector<TurnedSet>& sets);
  /// turned: as set_lights had it.
  void cast(const TurnedSpheres& turned, const CastTexels& texels);

private:
  struct Launch {
    int first_set = 0;
    std::vector<int> directions; ///< of its sets
  };
  /// As many as it takes for all sets. own: further arguments.
  void run(compute::Kernel& kernel, std::uint32_t items, const TurnedSpheres& turned, const std::vector<compute::Argument>& own);

  Technique technique_;
  compute::Context context_;
  std::vector<compute::Buffer<std::uint16_t>> of_direction_; ///< [direction], or all in TurnedSpheres::stored
  compute::Buffer<float> compiled_;                          ///< [sphere][texel of the stored form][3]
  std::vector<Launch> launches_;
  compute::Kernel cast_, compile_, cast_compiled_;
};

} // namespace nephroid::environment
