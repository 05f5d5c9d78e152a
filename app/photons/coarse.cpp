// SPDX-License-Identifier: Apache-2.0
#include "photons/coarse.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace nephroid::photons {
namespace {

constexpr std::size_t rows_of_a_task = 16;

/// The two blocks that a pixel's middle lies between along one side, and how near it is to the second, 0..1.
struct Between {
  std::size_t first, second;
  float nearness;
};

std::vector<Between> places_between(int pixels, int blocks, int edge) {
  std::vector<Between> places;
  for (int i = 0; i < pixels; ++i) {
    const double at = std::clamp((i + 0.5) / edge - 0.5, 0.0, blocks - 1.0), below = std::floor(at);
    const auto first = static_cast<std::size_t>(below);
    places.push_back(
        {first, std::min(first + 1, static_cast<std::size_t>(blocks - 1)), static_cast<float>(at - below)});
  }
  return places;
}

} // namespace

std::vector<int> preview_edges(int width, int height) {
  constexpr double most_blocks = 64 * 64 * 1.25; // most blocks of the second picture
  int edge = 1;
  while (static_cast<double>(width) * height / edge / edge > most_blocks) edge *= 2;
  if (edge == 1) return {};
  std::vector<int> edges{2 * edge, edge, edge / 2};
  std::erase_if(edges, [](int blocks) { return blocks <= 1; });
  return edges;
}

std::vector<float> mean_of_blocks(const Blocks& blocks, std::span<const float> rgb) {
  if (blocks.edge == 1) return {rgb.begin(), rgb.end()};
  const auto across = static_cast<std::size_t>(blocks.across()), down = static_cast<std::size_t>(blocks.down()),
             width = static_cast<std::size_t>(blocks.width), height = static_cast<std::size_t>(blocks.height),
             edge = static_cast<std::size_t>(blocks.edge);
  std::vector<float> means(3 * across * down);
  for_ranges(down, 1, [&](std::size_t, Range rows) {
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
      const std::size_t top = row * edge, bottom = std::min(top + edge, height);
      for (std::size_t y = top; y < bottom; ++y)
        for (std::size_t x = 0; x < width; ++x)
          for (std::size_t c = 0; c < 3; ++c) means[3 * (row * across + x / edge) + c] += rgb[3 * (y * width + x) + c];
      for (std::size_t column = 0; column < across; ++column) {
        const std::size_t columns = std::min((column + 1) * edge, width) - column * edge;
        for (std::size_t c = 0; c < 3; ++c)
          means[3 * (row * across + column) + c] /= static_cast<float>(columns * (bottom - top));
      }
    }
  });
  return means;
}

std::vector<float> draw_by_places(const Blocks& blocks, std::span<const float> rgb) {
  std::vector<float> against(rgb.begin(), rgb.end());
  const auto width = static_cast<std::size_t>(blocks.width);
  for (std::size_t i = 0; i < against.size(); ++i)
    if ((i / 3 % width + i / 3 / width) % 2 == 1) against[i] = -against[i];
  return mean_of_blocks(blocks, against);
}

std::vector<float> between_blocks(const Blocks& blocks, std::span<const float> rgb) {
  if (blocks.edge == 1) return {rgb.begin(), rgb.end()};
  const auto across = static_cast<std::size_t>(blocks.across()), width = static_cast<std::size_t>(blocks.width);
  const std::vector<Between> columns = places_between(blocks.width, blocks.across(), blocks.edge),
                             rows = places_between(blocks.height, blocks.down(), blocks.edge);
  std::vector<float> picture(3 * columns.size() * rows.size());
  for_ranges(rows.size(), rows_of_a_task, [&](std::size_t, Range range) {
    for (std::size_t y = range.begin; y < range.end; ++y)
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const auto along = [&](std::size_t row) {
            const float a = rgb[3 * (row * across + columns[x].first) + c],
                        b = rgb[3 * (row * across + columns[x].second) + c];
            return a + columns[x].nearness * (b - a);
          };
          const float upper = along(rows[y].first), lower = along(rows[y].second);
          picture[3 * (y * width + x) + c] = upper + rows[y].nearness * (lower - upper);
        }
  });
  return picture;
}

} // namespace nephroid::photons
