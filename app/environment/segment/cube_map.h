// SPDX-License-Identifier: Apache-2.0
// The environment as six faces that keep its light exactly.
#pragma once
#include "environment/segment/cube.h"
#include "scene/environment.h"

#include <cstddef>
#include <vector>

namespace nephroid::environment {

struct CubeMap {
  int size = 0;             ///< texels along a side of a face
  std::vector<double> flux; ///< 3 a texel, face after face and row after row: radiance times solid angle, linear sRGB, W/m^2 of Y
  bool even = false;        ///< whether the map has one colour all around

  std::size_t texel(int face, int x, int y) const
  {
    return (static_cast<std::size_t>(face) * static_cast<std::size_t>(size) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size) +
           static_cast<std::size_t>(x);
  }
  glm::dvec3 flux_of(std::size_t texel) const { return {flux[3 * texel], flux[3 * texel + 1], flux[3 * texel + 2]}; }
};

/// A texel in the middle of a face is about as wide as the map's at its equator: a quarter of the map's width, but 128 to 512, and even.
int cube_size(const scene::Environment& map);

/// All light of the map, times its `radiance`. It is not turned by rotate_deg: what is made of the cube stays the same while the map turns.
CubeMap make_cube_map(const scene::Environment& map);

/// Y of linear sRGB (IEC 61966-2-1).
inline double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

/// A direction in the cube as it is in the scene, where the map is turned about +y, counterclockwise as seen from above.
glm::dvec3 turned(const glm::dvec3& direction, double rotate_deg);

} // namespace nephroid::environment
