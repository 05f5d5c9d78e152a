// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/picture.h"

#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::environment {
namespace {

constexpr int width = 1024, height = 512;
constexpr double disc_radius = 4, rim = 1.5; // pixels
constexpr std::array<unsigned char, 3> green{0, 255, 0}, black{0, 0, 0};

struct PixelRange {
  int begin, end;
};

/// The texels under pixel i of `pixels`, at least one.
PixelRange texels_under(int i, int pixels, int texels) {
  const auto to = [&](int pixel) { return static_cast<int>(static_cast<long long>(pixel) * texels / pixels); };
  return {to(i), std::max(to(i) + 1, to(i + 1))};
}

/// The mean of the texels under each pixel.
std::vector<glm::dvec3> scaled_map(const scene::Environment& map) {
  std::vector<glm::dvec3> pixels;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const PixelRange rows = texels_under(row, height, map.height), columns = texels_under(column, width, map.width);
      glm::dvec3 sum{0};
      for (int y = rows.begin; y < rows.end; ++y)
        for (int x = columns.begin; x < columns.end; ++x) {
          const float* const rgb =
              map.rgb.data() + std::size_t{3} * (static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                                                 static_cast<std::size_t>(x));
          sum += glm::dvec3(rgb[0], rgb[1], rgb[2]);
        }
      pixels.push_back(sum / (double(rows.end - rows.begin) * (columns.end - columns.begin)));
    }
  return pixels;
}

/// Reinhard et al. 2002, "Photographic tone reproduction", (1) to (3): the geometric mean becomes .18.
void make_small_range(std::vector<glm::dvec3>& pixels) {
  double logarithms = 0, lit = 0;
  for (const glm::dvec3& rgb : pixels) {
    const double mean = (rgb.x + rgb.y + rgb.z) / 3;
    if (!(mean > 0)) continue;
    logarithms += std::log(mean);
    ++lit;
  }
  const double scale = lit > 0 ? 0.18 / std::exp(logarithms / lit) : 1;
  for (glm::dvec3& rgb : pixels) rgb = scale * rgb / (1.0 + scale * rgb);
}

class Painter {
public:
  explicit Painter(SegmentPicture picture) : picture_(std::move(picture)) {}

  void borders(const Segmentation& segmentation) {
    const std::vector<int> regions = regions_of_pixels(segmentation);
    const auto region = [&](int x, int y) { return regions[pixel(x, y)]; };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool ends_right = region(x, y) != region((x + 1) % width, y),
                   ends_below = y + 1 < height && region(x, y) != region(x, y + 1);
        if (ends_right || ends_below) paint(x, y, green);
      }
  }

  void disc(const glm::dvec3& direction) {
    const double column = (std::atan2(direction.x, -direction.z) / (2 * std::numbers::pi) + 0.5) * width;
    const double row = std::acos(std::clamp(direction.y, -1.0, 1.0)) / std::numbers::pi * height;
    const int reach = static_cast<int>(disc_radius + rim) + 1, x0 = static_cast<int>(column),
              y0 = static_cast<int>(row);
    for (int y = std::max(0, y0 - reach); y <= std::min(height - 1, y0 + reach); ++y)
      for (int x = x0 - reach; x <= x0 + reach; ++x) {
        const double distance = std::hypot(x + 0.5 - column, y + 0.5 - row);
        if (distance < disc_radius + rim) paint((x + width) % width, y, distance < disc_radius ? green : black);
      }
  }

  SegmentPicture result() { return std::move(picture_); }

private:
  static std::size_t pixel(int x, int y) { return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x); }
  void paint(int x, int y, const std::array<unsigned char, 3>& colour) {
    std::copy(colour.begin(), colour.end(), picture_.rgba.begin() + static_cast<std::ptrdiff_t>(4 * pixel(x, y)));
  }

  /// The number of the region that each pixel's middle lies in.
  static std::vector<int> regions_of_pixels(const Segmentation& segmentation) {
    const int size = segmentation.cube_size;
    const CubeMap cube{size, {}};
    std::vector<int> texel_regions(cube.texel(face_count, 0, 0)), pixel_regions;
    int number = 0;
    for (const std::vector<Region>* regions : {&segmentation.lights, &segmentation.dropped})
      for (const Region& region : *regions) {
        for (int y = region.rect.y0; y < region.rect.y1; ++y)
          for (int x = region.rect.x0; x < region.rect.x1; ++x) texel_regions[cube.texel(region.face, x, y)] = number;
        ++number;
      }
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const double zenith = std::numbers::pi * (row + 0.5) / height,
                     azimuth = 2 * std::numbers::pi * (column + 0.5) / width - std::numbers::pi;
        const CubePoint at =
            met_point({std::sin(zenith) * std::sin(azimuth), std::cos(zenith), -std::sin(zenith) * std::cos(azimuth)});
        pixel_regions.push_back(texel_regions[cube.texel(at.face, texel_of(at.s, size), texel_of(at.t, size))]);
      }
    return pixel_regions;
  }

  SegmentPicture picture_;
};

} // namespace

SegmentPicture shown_map(const scene::Environment& map) {
  std::vector<glm::dvec3> pixels = scaled_map(map);
  make_small_range(pixels);
  SegmentPicture picture{width, height, {}};
  for (const glm::dvec3& rgb : pixels) {
    for (int c = 0; c < 3; ++c) picture.rgba.push_back(image::shown(static_cast<float>(rgb[c])));
    picture.rgba.push_back(255);
  }
  return picture;
}

SegmentPicture segment_picture(const scene::Environment& map, const Segmentation& segmentation) {
  Painter painter(shown_map(map));
  painter.borders(segmentation);
  for (const Region& light : segmentation.lights) painter.disc(light.direction);
  return painter.result();
}

} // namespace nephroid::environment
