// SPDX-License-Identifier: Apache-2.0
// What an object does to parallel light from each of some directions: caustic spheres (thesis 3.1).
//
// Stored is the power through a texel of a sphere over the texel's solid angle, for light of 1 W/m^2: E r^2, where E is the irradiance on
// the sphere itself, so on a surface that faces the middle. Times the cosine between a receiver's normal and the way to the middle it is
// the receiver's irradiance, and then a receiver all around the object gets exactly the power that left the object. (The fluence, which
// does not know the angle at which light crosses a sphere, would give it too much.) Where light does not come from the middle this is an
// approximation, the thesis' own.
#pragma once
#include "environment/bake/sphere_map.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::environment {

/// Where the light of one direction goes. Areas across it, in squares of Bake::size: of the light that meets the object, and of that the
/// part that leaves it, that is absorbed, and that is lost after too many surfaces.
struct BakedDirection {
  double met = 0, sent = 0, absorbed = 0, lost = 0;
};

struct Bake {
  SphereMap map;
  int channels = 1;                   ///< of a texel: 3: linear sRGB under white light; 1: all of that are alike
  double size = 1;                    ///< largest side of the box about the object
  std::vector<double> radii;          ///< of the spheres, ascending
  std::vector<glm::dvec3> directions; ///< all that light is to come from, unit, the way it goes
  std::vector<BakedDirection> baked;  ///< the first of them
  std::vector<std::uint16_t> halves;  ///< [baked direction][sphere][texel][channel]: E r^2 in `unit` of size^2

  /// So that all light in one texel is still a half float.
  static constexpr double unit = 16;

  std::size_t sphere_items() const { return map.texels() * static_cast<std::size_t>(channels); }
  std::size_t direction_items() const { return sphere_items() * radii.size(); }
  /// E r^2 over size^2, linear sRGB.
  glm::dvec3 at(std::size_t direction, std::size_t sphere, std::size_t texel) const;
};

/// The nearest half float.
std::uint16_t to_half(double value);

} // namespace nephroid::environment
