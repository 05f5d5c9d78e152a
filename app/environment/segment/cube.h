// SPDX-License-Identifier: Apache-2.0
// A cube seen from its centre: six square faces, the point of them that a direction meets, and solid angles on them.
// And the environment on these faces, which keep its light exactly.
#pragma once
#include "scene/environment.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::environment {

inline constexpr int face_count = 6;
/// A face is named by the axis through its middle. The numbers of faces are places in this list.
inline constexpr std::array<const char*, face_count> face_names{"+x", "-x", "+y", "-y", "+z", "-z"};

/// A point of the cube of half side 1: s to the right and t downwards in its face, which lies as in OpenGL's maps.
struct CubePoint {
  int face = 0;
  double s = 0, t = 0;
};

/// The point's position, which is not of unit length.
glm::dvec3 position(const CubePoint& point);
/// The point that a direction from the centre meets. direction: any length but 0.
inline CubePoint met_point(const glm::dvec3& direction) {
  const double x = direction.x, y = direction.y, z = direction.z;
  const double across = std::abs(x), up = std::abs(y), along = std::abs(z);
  if (up >= across && up >= along) return y > 0 ? CubePoint{2, x / up, z / up} : CubePoint{3, x / up, -z / up};
  if (across >= along) return x > 0 ? CubePoint{0, -z / across, -y / across} : CubePoint{1, z / across, -y / across};
  return z > 0 ? CubePoint{4, x / along, -y / along} : CubePoint{5, -x / along, -y / along};
}

/// Texels x0..x1 and y0..y1 of a face, half open; x counts along s, y along t.
struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const Rect&) const = default;
};

/// s or t of the border before texel i, 0..size, of a face of size x size texels.
inline double border(int i, int size) { return 2.0 * i / size - 1; }
/// s or t of the middle of texel i.
inline double middle(int i, int size) { return (2.0 * i + 1) / size - 1; }
/// The texel, 0..size-1, that s or t lies in.
inline int texel_of(double s, int size) {
  const int i = static_cast<int>((s + 1) / 2 * size);
  return i < size ? i : size - 1;
}

/// The exact solid angle, in sr.
double solid_angle(const Rect& rect, int size);

struct CubeMap {
  int size = 0;             ///< texels along a side of a face
  std::vector<double> flux; ///< [face][row][column][3]: radiance times solid angle, linear sRGB, W/m^2 of Y
  bool even = false;        ///< whether the map has one colour all around

  std::size_t texel(int face, int x, int y) const {
    return (static_cast<std::size_t>(face) * static_cast<std::size_t>(size) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size) +
           static_cast<std::size_t>(x);
  }
  glm::dvec3 flux_of(std::size_t texel) const { return {flux[3 * texel], flux[3 * texel + 1], flux[3 * texel + 2]}; }
};

/// The size at which a face's middle texel is as wide as the map's at its equator; even, from 128 to 512.
int cube_size(const scene::Environment& map);

/// The cube has all light of the map, times its `radiance`. It is not turned by rotate_deg.
CubeMap make_cube_map(const scene::Environment& map);

/// Y of linear sRGB (IEC 61966-2-1).
inline double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

/// The scene's direction for one in the cube: the map is turned about +y, counterclockwise as seen from above.
glm::dvec3 turned(const glm::dvec3& direction, double rotate_deg);

} // namespace nephroid::environment
