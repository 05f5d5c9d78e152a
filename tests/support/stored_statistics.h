// SPDX-License-Identifier: Apache-2.0
// A rendering's mean and variance, stored, and the test that a fresh rendering has that mean and that variance: every
// block of pixels of six sizes, from one pixel to the whole picture, is compared with what the stored variances allow.
#pragma once
#include "image/image.h"
#include "tests/support/statistics.h"

namespace nephroid::test {

/// Pictures are square, of this many pixels a side, in XYZ: those values are never negative and no photon weighs much
/// more than another.
inline constexpr int stored_size = 48;
/// Edges of the blocks, in pixels; each divides the picture.
inline constexpr std::array<int, 6> block_edges{1, 2, 4, 8, 16, 48};

using XyzPicture = std::vector<double>; ///< 3 a pixel, row 0 at the top

/// Means over the blocks of one edge, 3 a block, row by row.
inline std::vector<double> block_means(const XyzPicture& picture, int edge) {
  const int blocks = stored_size / edge;
  std::vector<double> means(3 * static_cast<std::size_t>(blocks * blocks), 0.0);
  for (int y = 0; y < stored_size; ++y)
    for (int x = 0; x < stored_size; ++x)
      for (int c = 0; c < 3; ++c)
        means[static_cast<std::size_t>(3 * (y / edge * blocks + x / edge) + c)] +=
            picture[static_cast<std::size_t>(3 * (y * stored_size + x) + c)] / (edge * edge);
  return means;
}

struct StoredStatistics {
  struct Level {
    std::vector<double> mean, variance; ///< one render's, 3 a block
  };
  std::array<Level, block_edges.size()> levels;
  int renders = 0;
  std::array<double, 3> largest{}; ///< what one photon or one path of a render adds to a pixel, at most
  double mean_z2 = 1,
         standard_deviation_z2 = 0; ///< of clipped_mean_z2 over renders that had no part in the mean and variance
};

/// Mean of min(z^2, 9) over the values whose noise is below a fifth of them, so that z is nearly normal and a rare
/// outlier cannot rule it. z2(i): of value i of a picture. A bias that is everywhere and too small for a single pixel
/// raises it, as does a larger variance.
template <class Z2>
double clipped_mean_z2(const StoredStatistics::Level& pixels, Z2 z2) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < pixels.mean.size(); ++i) {
    if (!(pixels.variance[i] > 0) || pixels.mean[i] * pixels.mean[i] < 25 * pixels.variance[i]) continue;
    sum += std::min(z2(i), 9.0);
    ++count;
  }
  return count > 0 ? sum / count : 1;
}

/// Mean and variance of independent renders. largest: see StoredStatistics.
inline StoredStatistics make_statistics(const std::vector<XyzPicture>& renders, const std::array<double, 3>& largest) {
  StoredStatistics stored;
  const double n = static_cast<double>(renders.size());
  stored.renders = static_cast<int>(renders.size());
  stored.largest = largest;
  for (std::size_t l = 0; l < block_edges.size(); ++l) {
    StoredStatistics::Level& level = stored.levels[l];
    std::vector<std::vector<double>> blocks;
    for (const XyzPicture& picture : renders) blocks.push_back(block_means(picture, block_edges[l]));
    level.mean.assign(blocks[0].size(), 0.0);
    level.variance.assign(blocks[0].size(), 0.0);
    for (const std::vector<double>& block : blocks)
      for (std::size_t i = 0; i < block.size(); ++i) level.mean[i] += block[i] / n;
    for (const std::vector<double>& block : blocks)
      for (std::size_t i = 0; i < block.size(); ++i)
        level.variance[i] += (block[i] - level.mean[i]) * (block[i] - level.mean[i]) / (n - 1);
  }
  // Each render against the mean and variance of the others, which follow from those of all by taking it out again.
  const StoredStatistics::Level& pixels = stored.levels[0];
  double sum = 0, sum2 = 0;
  for (const XyzPicture& picture : renders) {
    const double z2 = clipped_mean_z2(pixels, [&](std::size_t i) {
      const double deviation = (picture[i] - pixels.mean[i]) * n / (n - 1);
      const double variance = ((n - 1) * pixels.variance[i] - deviation * deviation * (n - 1) / n) / (n - 2);
      return variance > 0 ? deviation * deviation / (variance * n / (n - 1)) : 9;
    });
    sum += z2;
    sum2 += z2 * z2;
  }
  stored.mean_z2 = sum / n;
  stored.standard_deviation_z2 = std::sqrt(std::max(sum2 / n - stored.mean_z2 * stored.mean_z2, 0.0) * n / (n - 1));
  return stored;
}

namespace stored_image {

inline const std::vector<std::string> channels{"mean.X", "mean.Y", "mean.Z", "variance.X", "variance.Y", "variance.Z"};

/// The levels stand below one another, each at the left edge.
inline int height() {
  int rows = 0;
  for (const int edge : block_edges) rows += stored_size / edge;
  return rows;
}

/// Calls visit(level, value of that level, first of the six channels' values) for every block.
template <class Image, class Visit>
void for_each_block(Image& image, Visit visit) {
  int top = 0;
  for (std::size_t l = 0; l < block_edges.size(); ++l) {
    const int blocks = stored_size / block_edges[l];
    for (int y = 0; y < blocks; ++y)
      for (int x = 0; x < blocks; ++x)
        visit(l, static_cast<std::size_t>(3 * (y * blocks + x)),
              &image.data[static_cast<std::size_t>(6 * ((top + y) * stored_size + x))]);
    top += blocks;
  }
}

} // namespace stored_image

inline void write_statistics(const fs::path& file, const StoredStatistics& stored) {
  image::Image image{.width = stored_size, .height = stored_image::height(), .channels = stored_image::channels};
  image.data.assign(static_cast<std::size_t>(6 * image.width * image.height), 0.0f);
  stored_image::for_each_block(image, [&](std::size_t level, std::size_t i, float* values) {
    for (std::size_t c = 0; c < 3; ++c) {
      values[c] = static_cast<float>(stored.levels[level].mean[i + c]);
      values[3 + c] = static_cast<float>(stored.levels[level].variance[i + c]);
    }
  });
  image.attributes = {{"renders", std::to_string(stored.renders)},
                      {"largest", fmt::format("{} {} {}", stored.largest[0], stored.largest[1], stored.largest[2])},
                      {"z2", fmt::format("{} {}", stored.mean_z2, stored.standard_deviation_z2)}};
  image::write_exr(file, image);
}

inline StoredStatistics read_statistics(const fs::path& file) {
  image::Image image = image::read_image(file);
  if (image.width != stored_size || image.height != stored_image::height() || image.channels != stored_image::channels)
    throw std::runtime_error(file.string() + " does not hold stored statistics");
  StoredStatistics stored;
  for (std::size_t l = 0; l < block_edges.size(); ++l) {
    const auto blocks = static_cast<std::size_t>(stored_size / block_edges[l]);
    stored.levels[l].mean.resize(3 * blocks * blocks);
    stored.levels[l].variance.resize(3 * blocks * blocks);
  }
  stored_image::for_each_block(image, [&](std::size_t level, std::size_t i, const float* values) {
    for (std::size_t c = 0; c < 3; ++c) {
      stored.levels[level].mean[i + c] = static_cast<double>(values[c]);
      stored.levels[level].variance[i + c] = static_cast<double>(values[3 + c]);
    }
  });
  stored.renders = std::stoi(image.attributes.at("renders"));
  std::istringstream(image.attributes.at("largest")) >> stored.largest[0] >> stored.largest[1] >> stored.largest[2];
  std::istringstream(image.attributes.at("z2")) >> stored.mean_z2 >> stored.standard_deviation_z2;
  return stored;
}

/// What a fresh render's comparison gave.
struct Comparison {
  double block_p = 1;      ///< the p-value of the worst block of any size and channel, corrected after Sidak
  std::string worst;       ///< where that is, in words
  double z2 = 1, z2_p = 1; ///< clipped_mean_z2 and its p-value
  std::vector<float> z;    ///< z of every pixel and channel, 0 where nothing varies
};

inline Comparison compare(const XyzPicture& picture, const StoredStatistics& stored) {
  const double n = stored.renders;
  Comparison result;
  double smallest_p = 1;
  for (std::size_t l = 0; l < block_edges.size(); ++l) {
    const StoredStatistics::Level& level = stored.levels[l];
    const int edge = block_edges[l], blocks = stored_size / edge;
    const std::vector<double> means = block_means(picture, edge);
    double smallest = 1;
    std::string where;
    for (std::size_t i = 0; i < means.size(); ++i) {
      // An event of 1 / n a render is easily in no stored render, but in this one: as if two more had been seen.
      const double largest = stored.largest[i % 3] / (edge * edge);
      const double variance = level.variance[i] * (1 + 1 / n) + 2 / n * largest * largest;
      const double deviation = means[i] - level.mean[i];
      const double p = std::isfinite(deviation) ? bernstein(deviation, variance, largest, n - 1) : 0;
      if (p >= smallest) continue;
      smallest = p;
      const auto block = static_cast<int>(i / 3);
      where =
          fmt::format("{} of the {} x {} pixels at column {}, row {}: {:.6g}, stored {:.6g}, standard deviation {:.3g}",
                      "XYZ"[i % 3], edge, edge, block % blocks * edge, block / blocks * edge, means[i], level.mean[i],
                      std::sqrt(variance));
    }
    const double size_p = sidak(smallest, static_cast<double>(means.size()));
    if (size_p >= smallest_p) continue;
    smallest_p = size_p;
    result.worst = where;
  }
  result.block_p = sidak(smallest_p, block_edges.size());
  const StoredStatistics::Level& pixels = stored.levels[0];
  for (std::size_t i = 0; i < picture.size(); ++i)
    result.z.push_back(pixels.variance[i] > 0 ? static_cast<float>((picture[i] - pixels.mean[i]) /
                                                                   std::sqrt(pixels.variance[i] * (1 + 1 / n)))
                                              : 0.0f);
  result.z2 = clipped_mean_z2(pixels, [&](std::size_t i) { return static_cast<double>(result.z[i] * result.z[i]); });
  const double variance_z2 = stored.standard_deviation_z2 * stored.standard_deviation_z2;
  if (variance_z2 > 0) result.z2_p = bernstein(result.z2 - stored.mean_z2, variance_z2 * (1 + 1 / n), 0, n - 1);
  return result;
}

} // namespace nephroid::test
