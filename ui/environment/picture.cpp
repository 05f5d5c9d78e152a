// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::ui {
namespace {

using environment::CubePoint;

constexpr double pi = std::numbers::pi;
constexpr int no_face = -1;
/// Which face lies where in the cross; numbers of environment::face_names.
constexpr std::array<std::array<int, 4>, 3> cross{
    {{no_face, 2, no_face, no_face}, {1, 5, 0, 4}, {no_face, 3, no_face, no_face}}};

/// Faces are described as seen from outside. From inside those of the sides are mirrored across, +y and -y, which hang
/// on -z, down.
CubePoint mirrored(const CubePoint& point) {
  const bool side = point.face < 2 || point.face > 3;
  return {point.face, side ? -point.s : point.s, side ? point.t : -point.t};
}

/// A part of each of three channels in place of what is there.
void blend(unsigned char* rgb, const Colour& colour, double part) {
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<unsigned char>(std::lround((1 - part) * rgb[c] + part * colour[c]));
}

constexpr Colour line{70, 235, 70};
constexpr double line_part = 0.7;

} // namespace

int MapPictureSize::height() const { return std::max(1, static_cast<int>(std::lround(width / aspect(layout)))); }

std::optional<CubePoint> cube_point(MapLayout layout, const glm::dvec2& at) {
  if (!(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1)) return std::nullopt;
  if (layout == MapLayout::latitude_longitude) {
    const double zenith = pi * at.y, azimuth = 2 * pi * at.x - pi;
    return environment::met_point(
        {std::sin(zenith) * std::sin(azimuth), std::cos(zenith), -std::sin(zenith) * std::cos(azimuth)});
  }
  const double x = 4 * at.x, y = 3 * at.y;
  const int face = cross.at(static_cast<std::size_t>(y)).at(static_cast<std::size_t>(x));
  if (face == no_face) return std::nullopt;
  return mirrored({face, 2 * (x - std::floor(x)) - 1, 2 * (y - std::floor(y)) - 1});
}

glm::dvec2 place_of(MapLayout layout, const glm::dvec3& direction) {
  if (layout == MapLayout::latitude_longitude) {
    const double up = direction.y / glm::length(direction);
    return {std::atan2(direction.x, -direction.z) / (2 * pi) + 0.5, std::acos(std::clamp(up, -1.0, 1.0)) / pi};
  }
  const CubePoint point = mirrored(environment::met_point(direction));
  std::size_t row = 0, column = 0;
  for (std::size_t y = 0; y < cross.size(); ++y)
    for (std::size_t x = 0; x < cross[y].size(); ++x)
      if (cross[y][x] == point.face) row = y, column = x;
  return {(static_cast<double>(column) + (point.s + 1) / 2) / 4, (static_cast<double>(row) + (point.t + 1) / 2) / 3};
}

std::vector<Colour> colours_under(const MapPictureSize& size, const environment::SegmentPicture& map) {
  constexpr int parts = 3; // along a side of a pixel, so that a small lamp is not missed between two middles
  const auto texel = [](double u, int count) { return std::min(static_cast<int>(u * count), count - 1); };
  std::vector<Colour> colours;
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width; ++x) {
      std::array<int, 3> sum{};
      for (int part = 0; part < parts * parts; ++part) {
        const int part_x = part % parts, part_y = part / parts;
        glm::dvec2 at{(x + (part_x + 0.5) / parts) / size.width, (y + (part_y + 0.5) / parts) / size.height()};
        if (size.layout == MapLayout::cube) {
          const auto point = cube_point(size.layout, at);
          if (!point) continue;
          at = place_of(MapLayout::latitude_longitude, environment::position(*point));
        }
        const auto row = static_cast<std::size_t>(texel(at.y, map.height)),
                   column = static_cast<std::size_t>(texel(at.x, map.width));
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += map.rgba[4 * (row * static_cast<std::size_t>(map.width) + column) + c];
      }
      Colour& mean = colours.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<unsigned char>(sum[c] / (parts * parts));
    }
  return colours;
}

std::vector<int> regions_of_texels(const environment::Segmentation& segmentation) {
  const environment::CubeMap cube{segmentation.cube_size, {}};
  std::vector<int> regions(cube.texel(environment::face_count, 0, 0));
  int number = 0;
  for (const auto* list : {&segmentation.lights, &segmentation.dropped})
    for (const environment::Region& region : *list) {
      for (int y = region.rect.y0; y < region.rect.y1; ++y)
        std::fill_n(regions.begin() + static_cast<std::ptrdiff_t>(cube.texel(region.face, region.rect.x0, y)),
                    region.rect.width(), number);
      ++number;
    }
  return regions;
}

std::vector<int> texels_under(const MapPictureSize& size, int cube_size) {
  const environment::CubeMap cube{cube_size, {}};
  std::vector<int> texels;
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width; ++x) {
      const auto at = cube_point(size.layout, {(x + 0.5) / size.width, (y + 0.5) / size.height()});
      texels.push_back(at ? static_cast<int>(cube.texel(at->face, environment::texel_of(at->s, cube_size),
                                                        environment::texel_of(at->t, cube_size)))
                          : -1);
    }
  return texels;
}

std::vector<unsigned char> drawn(const MapPictureSize& size, const std::vector<Colour>& colours,
                                 const std::vector<int>& texels, const std::vector<int>& regions) {
  std::vector<unsigned char> rgba(4 * texels.size(), 0);
  const auto pixel = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
  };
  const auto ends = [&](int texel, int neighbour) {
    return neighbour >= 0 && regions[static_cast<std::size_t>(texel)] != regions[static_cast<std::size_t>(neighbour)];
  };
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width; ++x) {
      const std::size_t at = pixel(x, y);
      const int texel = texels[at];
      if (texel < 0) continue;
      std::copy(colours[at].begin(), colours[at].end(), &rgba[4 * at]);
      rgba[4 * at + 3] = 255;
      if (regions.empty()) continue;
      // The right edge of latitude and longitude goes on at the left; that of the cross does too, where +z and -x meet.
      const int right = texels[pixel((x + 1) % size.width, y)],
                below = y + 1 < size.height() ? texels[pixel(x, y + 1)] : -1;
      if (ends(texel, right) || ends(texel, below)) blend(&rgba[4 * at], line, line_part);
    }
  return rgba;
}

} // namespace nephroid::ui
