// SPDX-License-Identifier: Apache-2.0
// A baked object under lights, on a device: E r^2 of all lights at points around it (kernels/environment/cast.cl).
#pragma once
#include "compute/compute.h"
#include "environment/bake/bake.h"
#include "environment/light/distant_lights.h"
#include "kernels/environment/render_types.h"
#include "tracing/slices.h"

#include <cstdint>
#include <vector>

namespace nephroid::environment {

/// Texels of a cube of receivers to be lit: first .. first + count - 1 of a list.
struct CastTexels {
  const compute::Buffer<std::uint32_t>* list; ///< numbers of texels
  std::uint32_t first, count;
  const compute::Buffer<float>* distances;        ///< [texel of the cube]
  const compute::Buffer<shared::float4>* normals; ///< [texel of the cube], unit, on the object's side
  const compute::Buffer<float>* caustics; ///< [texel of the cube][3], written: E r^2, linear sRGB, W/m^2 of Y times
                                          ///< squared units
  int size;                               ///< texels along an edge of the cube's faces
};

class Caustics {
public:
  /// bake outlives it. Throws failed where the device has not enough memory.
  Caustics(const Bake& bake, const compute::Context& context);

  /// Memory of what compile_air() makes.
  static std::uint64_t air_bytes(const Bake& bake, int side);

  /// rotation: from the bake's coordinates to the scene's.
  void set_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation);

  void cast(const CastTexels& texels);

  /// The time that all calls of set_lights and cast have taken.
  double seconds() const { return seconds_; }

  /// Adds up the light in the air of all sets into one set of spheres (Algorithm 3.5) with maps of side x side texels.
  void compile_air(int side);

  /// What compile_air() made, for kernels that look it up (compiled_air in kernels/environment/spheres.h).
  struct Air {
    compute::Buffer<float> light; ///< 6 a texel
    shared::DeviceSpheres spheres{};
    shared::DeviceAxes object{};
  };
  const Air& air() const { return air_; }
  const compute::Buffer<float>& radii() const { return radii_; }
  int side() const { return spheres_.side; } ///< the side of the bake's maps

private:
  /// The arguments for a kernel that looks up the spheres of all sets.
  std::vector<compute::Argument> arguments() const;

  compute::Context context_;
  int directions_;              ///< how many a shape of the bake has
  std::vector<double> weights_; ///< the bake's
  shared::DeviceSpheres spheres_{};
  compute::Buffer<std::uint8_t> texels_;
  compute::Buffer<std::uint16_t> blocks_;
  compute::Buffer<shared::float4> way_of_; ///< [number of Bake::way_map]
  compute::Buffer<float> radii_;
  Air air_;
  compute::Buffer<shared::DeviceEightSets> sets_;
  int used_eights_ = 0; ///< how many items of sets_ are in use
  double seconds_ = 0;
  compute::Kernel cast_, compile_air_;
};

} // namespace nephroid::environment
