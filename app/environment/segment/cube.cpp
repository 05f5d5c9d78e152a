// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/cube.h"

#include "base/parallel.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <numbers>

namespace nephroid::environment {
namespace {

/// The solid angle from the middle of a face to (s, t), with the sign of s t: the integral of (1 + s^2 + t^2)^(-3/2).
double solid_angle_to(double s, double t) { return std::atan(s * t / std::sqrt(1 + s * s + t * t)); }

constexpr double pi = std::numbers::pi;
constexpr int least_size = 128, most_size = 512;

/// How many parts a texel has along one side. count: texels along that side of the map. parts_around: the least number
/// for the whole side. That has a multiple of `of` parts, so that octants meet between parts.
int parts_of(int count, double parts_around, int of) {
  int parts = std::max(1, static_cast<int>(std::ceil(parts_around / count)));
  while (static_cast<long long>(parts) * count % of != 0) ++parts;
  return parts;
}

/// Gives a map's flux to the cube. A texel's parts are rectangles of longitude and latitude, at most a quarter as wide
/// as the narrowest texel of the cube. Each gives its flux to the texel of the cube that its middle lies in.
class Scatter {
public:
  Scatter(const scene::Environment& map, CubeMap& cube)
      : map_(map), cube_(cube), across_(parts_of(map.width, 8 * pi * cube.size, 4)),
        down_(parts_of(map.height, 4 * pi * cube.size, 2)) {
    const int columns = across_ * map.width;
    for (int i = 0; i < columns; ++i) {
      const double azimuth = 2 * pi * (i + 0.5) / columns - pi;
      sines_.push_back(std::sin(azimuth));
      cosines_.push_back(std::cos(azimuth));
      texels_.push_back(std::size_t{3} * static_cast<std::size_t>(i / across_));
    }
  }

  /// quarter: of the map's width, 0..3. half: of its height. Faces have an even size, so octants share no texel.
  void octant(int quarter, int half) const {
    const int columns = across_ * map_.width / 4, rows = down_ * map_.height / 2;
    for (int row = half * rows; row < (half + 1) * rows; ++row)
      scatter_row(row, quarter * columns, (quarter + 1) * columns);
  }

private:
  void scatter_row(int row, int first, int last) const {
    const int rows = down_ * map_.height;
    const double zenith = pi * (row + 0.5) / rows;
    // cos a - cos b as a product, which loses no digits at the poles.
    const double part_sr = 2 * std::sin(zenith) * std::sin(pi / rows / 2) * 2 * pi / (across_ * map_.width);
    const double up = std::cos(zenith), level = std::sin(zenith), scale = part_sr * map_.radiance;
    const float* const texels =
        map_.rgb.data() + std::size_t{3} * static_cast<std::size_t>(row / down_) * static_cast<std::size_t>(map_.width);
    for (int i = first; i < last; ++i) {
      const auto place = static_cast<std::size_t>(i);
      const float* const rgb = texels + texels_[place];
      const CubePoint to = met_point({level * sines_[place], up, -level * cosines_[place]});
      double* const sum =
          cube_.flux.data() + 3 * cube_.texel(to.face, texel_of(to.s, cube_.size), texel_of(to.t, cube_.size));
      for (int c = 0; c < 3; ++c) sum[c] += scale * double(rgb[c]);
    }
  }

  const scene::Environment& map_;
  CubeMap& cube_;
  int across_, down_;
  std::vector<double> sines_, cosines_; ///< sines and cosines of the parts' azimuths, from -z to the right
  std::vector<std::size_t> texels_;     ///< [part]: the place of its colour in a row of the map
};

} // namespace

glm::dvec3 position(const CubePoint& point) {
  const double s = point.s, t = point.t;
  switch (point.face) {
  case 0: return {1, -t, -s};
  case 1: return {-1, -t, s};
  case 2: return {s, 1, t};
  case 3: return {s, -1, -t};
  case 4: return {s, -t, 1};
  default: return {-s, -t, -1};
  }
}

double solid_angle(const Rect& rect, int size) {
  const double s0 = border(rect.x0, size), s1 = border(rect.x1, size), t0 = border(rect.y0, size),
               t1 = border(rect.y1, size);
  return solid_angle_to(s1, t1) - solid_angle_to(s0, t1) - solid_angle_to(s1, t0) + solid_angle_to(s0, t0);
}

int cube_size(const scene::Environment& map) {
  const int wanted = std::max(map.width, 2 * map.height) / 4;
  return std::clamp(wanted + wanted % 2, least_size, most_size);
}

CubeMap make_cube_map(const scene::Environment& map) {
  CubeMap cube{cube_size(map), {}};
  cube.even = std::equal(map.rgb.begin() + 3, map.rgb.end(), map.rgb.begin()); // each texel equals the one before
  const auto size = static_cast<std::size_t>(cube.size);
  cube.flux.assign(size * size * 3 * face_count, 0.0);
  const Scatter scatter(map, cube);
  for_blocks(8, [&](std::size_t block) { scatter.octant(static_cast<int>(block % 4), static_cast<int>(block / 4)); });
  return cube;
}

glm::dvec3 turned(const glm::dvec3& direction, double rotate_deg) {
  const double angle = glm::radians(std::fmod(rotate_deg, 360.0)), c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x + s * direction.z, direction.y, -s * direction.x + c * direction.z};
}

} // namespace nephroid::environment
