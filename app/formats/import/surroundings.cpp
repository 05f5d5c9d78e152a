// SPDX-License-Identifier: Apache-2.0
#include "formats/import/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::formats {
namespace {

using std::numbers::pi;

/// A map in linear sRGB.
struct Map {
  int width = 0, height = 0;
  std::vector<float> rgb{};

  explicit Map(const std::filesystem::path& file) {
    const image::Image picture = image::read_image(file);
    width = picture.width;
    height = picture.height;
    rgb = image::rgb_of(picture, file.string()).values;
  }

  glm::dvec3 texel(int column, int row) const {
    const std::size_t at =
        3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
    return {double(rgb[at]), double(rgb[at + 1]), double(rgb[at + 2])};
  }

  /// place: 0..1, v from the top.
  glm::dvec3 at(const glm::dvec2& place) const {
    return texel(std::clamp(static_cast<int>(place.x * width), 0, width - 1),
                 std::clamp(static_cast<int>(place.y * height), 0, height - 1));
  }
};

/// Where a unit vector is in a square that shares out solid angle evenly: an octahedron's faces, unfolded (Clarberg
/// 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD").
glm::dvec2 place_in_square(const glm::dvec3& direction) {
  const glm::dvec3 d = glm::abs(direction);
  const double r = std::sqrt(std::max(1 - d.z, 0.0)), turn = 2 / pi * std::atan2(d.y, d.x);
  glm::dvec2 place(r * (1 - turn), r * turn);
  if (direction.z < 0) place = 1.0 - glm::dvec2(place.y, place.x);
  return 0.5 * (glm::dvec2(std::copysign(place.x, direction.x), std::copysign(place.y, direction.y)) + 1.0);
}

glm::dvec2 place_in_map(const glm::dvec3& direction, bool is_equal_area) {
  if (is_equal_area) return place_in_square(direction);
  return {std::atan2(-direction.x, direction.z) / (2 * pi) + 0.5, std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi};
}

} // namespace

image::Image map_in_preset(const DescribedSurroundings& surroundings, const glm::dmat3& to_preset) {
  constexpr int widest = 8192, wide = 2048;
  const Map map(surroundings.file);
  const glm::dmat3 from_preset = glm::inverse(to_preset);
  image::Image made;
  made.width = std::clamp(surroundings.is_equal_area ? 2 * map.width : map.width, 2, widest);
  made.height = made.width / 2;
  made.channels = {"R", "G", "B"};
  const int samples = made.width > wide ? 2 : 4; // along each edge of a texel
  for (int row = 0; row < made.height; ++row)
    for (int column = 0; column < made.width; ++column) {
      glm::dvec3 sum(0);
      for (int i = 0; i < samples * samples; ++i) {
        const int across = i % samples, down = i / samples;
        const double azimuth = 2 * pi * ((column + (across + 0.5) / samples) / made.width - 0.5),
                     zenith = pi * (row + (down + 0.5) / samples) / made.height;
        const glm::dvec3 direction(std::sin(zenith) * std::sin(azimuth), std::cos(zenith),
                                   -std::sin(zenith) * std::cos(azimuth));
        sum += map.at(place_in_map(glm::normalize(from_preset * direction), surroundings.is_equal_area));
      }
      for (int c = 0; c < 3; ++c) made.data.push_back(static_cast<float>(sum[c] / (samples * samples)));
    }
  return made;
}

glm::dvec3 mean_of_map(const std::filesystem::path& file, bool is_equal_area) {
  const Map map(file);
  glm::dvec3 sum(0);
  double weights = 0;
  for (int row = 0; row < map.height; ++row) {
    const double weight = is_equal_area ? 1 : std::sin(pi * (row + 0.5) / map.height);
    for (int column = 0; column < map.width; ++column)
      if (const glm::dvec3 rgb = map.texel(column, row); std::isfinite(rgb.x + rgb.y + rgb.z)) sum += weight * rgb;
    weights += weight * map.width;
  }
  return sum / weights;
}

} // namespace nephroid::formats
