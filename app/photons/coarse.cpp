// SPDX-License-Identifier: Apache-2.0
#include "photons/coarse.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nephroid::photons {
namespace {

constexpr std::size_t rows_of_a_task = 16;

/// Between which two blocks a pixel's middle lies, along one side, and how near it is to the second, 0..1.
struct Between {
  std::size_t first, second;
  float nearness;
};

std::vector<Between> places_between(int pixels, int blocks, int edge)
{
  std::vector<Between> places;
  for (int i = 0; i < pixels; ++i) {
    const double at = std::clamp((i + 0.5) / edge - 0.5, 0.0, blocks - 1.0), below = std::floor(at);
    const auto first = static_cast<std::size_t>(below);
    places.push_back({first, std::min(first + 1, static_cast<std::size_t>(blocks - 1)), static_cast<float>(at - below)});
  }
  return places;
}

} // namespace

int edge_of_first_picture(int width, int height)
{
  constexpr double most_pixels = 128 * 128 * 1.25;
  int edge = 1;
  while (static_cast<double>(width) * height / edge / edge > most_pixels) edge *= 2;
  return edge;
}

tracing::Film film_of_blocks(const Blocks& blocks, const tracing::Film& film)
{
  const auto across = static_cast<std::size_t>(blocks.across()), down = static_cast<std::size_t>(blocks.down()),
             width = static_cast<std::size_t>(blocks.width), height = static_cast<std::size_t>(blocks.height),
             edge = static_cast<std::size_t>(blocks.edge);
  const std::size_t images = film.sums.size() / (3 * width * height);
  std::vector<std::int64_t> sums(images * 3 * across * down);
  std::vector<std::array<double, 2>> samples(across * down);
  for_ranges(images * down, rows_of_a_task, [&](std::size_t, Range rows) {
    for (std::size_t row = rows.begin; row < rows.end; ++row)
      for (std::size_t y = row % down * edge; y < std::min((row % down + 1) * edge, height); ++y)
        for (std::size_t x = 0; x < width; ++x)
          for (std::size_t c = 0; c < 3; ++c)
            sums[3 * (row * across + x / edge) + c] += film.sums[3 * ((row / down * height + y) * width + x) + c];
  });
  for (std::size_t pixel = 0; pixel < width * height; ++pixel) {
    const std::array<double, 2> of_pixel = film.samples(pixel);
    std::array<double, 2>& of_block = samples[pixel / width / edge * across + pixel % width / edge];
    for (std::size_t half = 0; half < 2; ++half) of_block[half] += of_pixel[half];
  }
  return {std::move(sums), film.quanta_per_unit, [samples = std::move(samples)](std::size_t block) { return samples[block]; }};
}

std::vector<float> between_blocks(const Blocks& blocks, std::span<const float> rgb)
{
  const auto across = static_cast<std::size_t>(blocks.across()), width = static_cast<std::size_t>(blocks.width);
  const std::vector<Between> columns = places_between(blocks.width, blocks.across(), blocks.edge),
                             rows = places_between(blocks.height, blocks.down(), blocks.edge);
  std::vector<float> picture(3 * columns.size() * rows.size());
  for_ranges(rows.size(), rows_of_a_task, [&](std::size_t, Range range) {
    for (std::size_t y = range.begin; y < range.end; ++y)
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const auto along = [&](std::size_t row) {
            const float a = rgb[3 * (row * across + columns[x].first) + c], b = rgb[3 * (row * across + columns[x].second) + c];
            return a + columns[x].nearness * (b - a);
          };
          const float upper = along(rows[y].first), lower = along(rows[y].second);
          picture[3 * (y * width + x) + c] = upper + rows[y].nearness * (lower - upper);
        }
  });
  return picture;
}

} // namespace nephroid::photons
