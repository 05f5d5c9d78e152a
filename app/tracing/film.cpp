// SPDX-License-Identifier: Apache-2.0
#include "tracing/film.h"

#include "optics/colour.h"

#include <cmath>

namespace nephroid::tracing {
namespace {

/// Linear sRGB of weight_a * a + weight_b * b, where a and b are XYZ sums.
optics::Colour blend(const std::int64_t* a, double weight_a, const std::int64_t* b, double weight_b) {
  optics::Colour xyz{};
  for (std::size_t c = 0; c < 3; ++c)
    xyz[c] = static_cast<double>(a[c]) * weight_a + static_cast<double>(b[c]) * weight_b;
  return optics::xyz_to_linear_srgb(xyz);
}

/// A film with more than two replicates.
void add_replicates(const Film& film, std::size_t pixels, job::Layer& layer) {
  const std::size_t replicates = film.sums.size() / (3 * pixels);
  layer.replicates.resize(film.sums.size());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const auto [even, odd] = film.samples(pixel);
    const double scale = even + odd > 0 ? static_cast<double>(replicates) / ((even + odd) * film.quanta_per_unit) : 0;
    for (std::size_t replicate = 0; replicate < replicates; ++replicate)
      for (std::size_t i = 3 * (replicate * pixels + pixel), c = 0; c < 3; ++c)
        layer.replicates[i + c] += static_cast<double>(film.sums[i + c]) * scale;
  }
}

} // namespace

job::Layer& layer_of(job::Picture& picture, const std::string& name) {
  for (job::Layer& layer : picture.layers)
    if (layer.name == name) return layer;
  const std::size_t size = 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  return picture.layers.emplace_back(job::Layer{name, std::vector<float>(size, 0.0f)});
}

void add_layer(const std::string& name, const Film& film, job::Picture& picture) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  job::Layer& layer = layer_of(picture, name);
  if (film.sums.size() > 6 * pixels) return add_replicates(film, pixels, layer);
  std::vector<float>& error_draw = picture.error_draw;
  const bool halves = film.sums.size() == 6 * pixels;
  const std::int64_t* first = film.sums.data();
  const std::int64_t* second = halves ? first + 3 * pixels : first; // with one image, its weight below is 0
  if (!halves) error_draw.clear();
  std::array<double, 2> samples{-1, -1}; // the pixel before's: most pixels have as many
  double mean = 0, mean_a = 0, mean_b = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    if (const std::array<double, 2> counts = film.samples(pixel); counts != samples) {
      const auto [a, b] = samples = counts;
      mean = a + b > 0 ? 1 / ((a + b) * film.quanta_per_unit) : 0;
      // (A / a - B / b) sqrt(a b) / (a + b), with the sums A and B
      mean_a = mean * std::sqrt(b / a), mean_b = mean * std::sqrt(a / b);
      if (a <= 0 || b <= 0) error_draw.clear();
    }
    const std::size_t i = 3 * pixel;
    const optics::Colour value = blend(first + i, mean, second + i, halves ? mean : 0);
    for (std::size_t c = 0; c < 3; ++c) layer.rgb[i + c] += static_cast<float>(value[c]);
    if (error_draw.empty()) continue;
    const optics::Colour error = blend(first + i, mean_a, second + i, -mean_b);
    for (std::size_t c = 0; c < 3; ++c) error_draw[i + c] += static_cast<float>(error[c]);
  }
}

std::array<double, 2> halves_of(std::int64_t passes, double part) {
  const std::int64_t odd = passes / 2, even = passes - odd; // the first pass is number 0
  std::array<double, 2> counts{static_cast<double>(even), static_cast<double>(odd)};
  counts[static_cast<std::size_t>(passes % 2)] += part;
  return counts;
}

} // namespace nephroid::tracing
