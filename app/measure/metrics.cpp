// SPDX-License-Identifier: Apache-2.0
#include "measure/metrics.h"

#include "base/error.h"
#include "base/parallel.h"
#include "measure/flip.h"
#include "measure/iw_ssim.h"
#include "measure/lab.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace nephroid::measure {
namespace {

/// Pixels a block: its sums fit the cache, and a small picture is one block and starts no thread.
constexpr std::size_t block_pixels = 8192;

/// Sums over the pixels that count.
struct Sums {
  double lab = 0, lab_squared = 0, lab_max = 0;
  double squared = 0, relative = 0, reference_squared = 0, encoded_squared = 0; ///< over channels as well
  std::size_t pixels = 0;

  Sums& operator+=(const Sums& other) {
    lab += other.lab;
    lab_squared += other.lab_squared;
    lab_max = std::max(lab_max, other.lab_max);
    squared += other.squared;
    relative += other.relative;
    reference_squared += other.reference_squared;
    encoded_squared += other.encoded_squared;
    pixels += other.pixels;
    return *this;
  }
};

/// Adds one pixel: linear a and b, and what is known of b.
void add_pixel(Sums& sums, const float* a, const float* b, const double* b_lab, const double* b_encoded) {
  constexpr double dark = 0.01; // rel_mse: where the reference is darker, the error counts as if it were this (squared)
  const std::array<double, 3> a_lab = lab_of(a);
  double lab_squared = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double difference = double{a[c]} - b[c], reference_squared = double{b[c]} * b[c];
    sums.squared += difference * difference;
    sums.relative += difference * difference / (reference_squared + dark);
    sums.reference_squared += reference_squared;
    const double encoded = encode_clipped(a[c]) - b_encoded[c];
    sums.encoded_squared += encoded * encoded;
    lab_squared += (a_lab[c] - b_lab[c]) * (a_lab[c] - b_lab[c]);
  }
  const double distance = std::sqrt(lab_squared);
  sums.lab += distance;
  sums.lab_squared += lab_squared;
  sums.lab_max = std::max(sums.lab_max, distance);
  ++sums.pixels;
}

Metrics metrics_of(const Sums& sums) {
  const auto pixels = static_cast<double>(sums.pixels), values = 3 * pixels;
  Metrics metrics;
  metrics.lab_mean = sums.lab / pixels;
  metrics.lab_rms = std::sqrt(sums.lab_squared / pixels);
  metrics.lab_max = sums.lab_max;
  metrics.mse = sums.squared / values;
  metrics.rel_mse = sums.relative / values;
  metrics.rel_l2 = sums.squared == 0             ? 0
                   : sums.reference_squared == 0 ? std::numeric_limits<double>::infinity()
                                                 : std::sqrt(sums.squared / sums.reference_squared);
  if (sums.encoded_squared > 0) metrics.psnr_db = 10 * std::log10(values / sums.encoded_squared);
  metrics.pixels = sums.pixels;
  return metrics;
}

double mean(std::span<const float> map, Mask mask) {
  double sum = 0;
  std::size_t pixels = 0;
  for (std::size_t p = 0; p < map.size(); ++p)
    if (counts(mask, p)) {
      sum += map[p];
      ++pixels;
    }
  return sum / static_cast<double>(pixels);
}

/// The first value that is NaN or infinite, or rgb.size().
std::size_t first_not_finite(std::span<const float> rgb) {
  std::atomic<std::size_t> first = rgb.size();
  for_ranges(rgb.size(), std::size_t{1} << 16, [&](std::size_t, Range range) {
    // A product with 0 is 0 or NaN: a sum of them tells whether all are finite, several at a time.
    float zeros = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) zeros += rgb[i] * 0.0f;
    if (zeros == 0) return;
    const auto* const found =
        std::find_if_not(rgb.data() + range.begin, rgb.data() + range.end, [](float v) { return std::isfinite(v); });
    const auto index = static_cast<std::size_t>(found - rgb.data());
    for (std::size_t known = first; index < known && !first.compare_exchange_weak(known, index);) {
    }
  });
  return first;
}

std::string value_name(float value) { return std::isnan(value) ? "NaN" : value > 0 ? "infinity" : "-infinity"; }

template <auto member>
Metric metric(std::string_view name, Metric::Kind kind, std::string_view meaning, MetricText text) {
  const auto of = [](const Metrics& metrics) { return std::optional<double>(metrics.*member).value_or(std::nan("")); };
  return {name, meaning, std::move(text), kind, of};
}

} // namespace

void check_pixels(const Pixels& picture) {
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != 3 * pixels)
    throw failed(picture.name,
                 fmt::format("a picture of {} x {} has {} values", picture.width, picture.height, picture.rgb.size()));
  const std::size_t at = first_not_finite(picture.rgb);
  if (at == picture.rgb.size()) return;
  const std::size_t column = at / 3 % static_cast<std::size_t>(picture.width),
                    row = at / 3 / static_cast<std::size_t>(picture.width);
  throw bad_input(picture.name,
                  fmt::format("pixel ({}, {}) has {} in {}", column, row, value_name(picture.rgb[at]), "RGB"[at % 3]),
                  "expected finite values everywhere");
}

void check_same_size(const Pixels& picture, int width, int height, const std::string& reference_name) {
  if (picture.width == width && picture.height == height) return;
  throw bad_input(picture.name, fmt::format("is {} x {} pixels", picture.width, picture.height),
                  fmt::format("expected {} x {}, the size of {}", width, height, reference_name));
}

void check_mask(Mask mask, int width, int height, const std::string& name) {
  if (mask.empty()) return;
  if (mask.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw bad_input(name, fmt::format("has {} pixels", mask.size()),
                    fmt::format("expected {} x {}, as the pictures", width, height));
  if (std::all_of(mask.begin(), mask.end(), [](unsigned char m) { return m == 0; }))
    throw bad_input(name, "is all black: no pixel counts", "expected a mask with pixels that are not 0");
}

QuickComparison::QuickComparison(const Pixels& reference, Mask mask)
    : width_(reference.width), height_(reference.height), name_(reference.name), mask_(mask.begin(), mask.end()) {
  check_pixels(reference);
  check_mask(mask, width_, height_);
  rgb_.assign(reference.rgb.begin(), reference.rgb.end());
  lab_.resize(rgb_.size());
  encoded_.resize(rgb_.size());
  for_ranges(rgb_.size() / 3, block_pixels, [this](std::size_t, Range range) {
    for (std::size_t i = 3 * range.begin; i < 3 * range.end; i += 3) {
      const std::array<double, 3> lab = lab_of(&rgb_[i]);
      std::copy(lab.begin(), lab.end(), &lab_[i]);
      for (std::size_t c = i; c < i + 3; ++c) encoded_[c] = encode_clipped(rgb_[c]);
    }
  });
}

Metrics QuickComparison::against(const Pixels& picture) const {
  check_same_size(picture, width_, height_, name_);
  check_pixels(picture);
  const std::size_t pixels = rgb_.size() / 3;
  std::vector<Sums> blocks((pixels + block_pixels - 1) / block_pixels);
  for_ranges(pixels, block_pixels, [&](std::size_t block, Range range) {
    Sums sums;
    for (std::size_t p = range.begin; p < range.end; ++p)
      if (counts(mask_, p)) add_pixel(sums, &picture.rgb[3 * p], &rgb_[3 * p], &lab_[3 * p], &encoded_[3 * p]);
    blocks[block] = sums;
  });
  return metrics_of(
      std::accumulate(blocks.begin(), blocks.end(), Sums{}, [](Sums a, const Sums& b) { return a += b; }));
}

std::vector<Metrics> compare_each(const Pixels& picture, const Pixels& reference, std::span<const Mask> masks,
                                  MetricSet which) {
  std::vector<Metrics> results;
  for (const Mask mask : masks) results.push_back(QuickComparison(reference, mask).against(picture));
  if (which == MetricSet::quick) return results;
  const std::vector<std::optional<double>> similarities = iw_ssim_each(picture, reference, masks);
  const std::vector<float> flip = flip_map(picture, reference), hdr_flip = hdr_flip_map(picture, reference);
  for (std::size_t m = 0; m < masks.size(); ++m) {
    results[m].iw_ssim = similarities[m];
    results[m].flip = mean(flip, masks[m]);
    results[m].hdr_flip = mean(hdr_flip, masks[m]);
  }
  return results;
}

Metrics compare(const Pixels& picture, const Pixels& reference, Mask mask, MetricSet which) {
  return compare_each(picture, reference, std::span<const Mask>(&mask, 1), which).front();
}

const std::vector<Metric>& all_metrics() {
  using enum Metric::Kind;
  // Distances fall with the root of the samples, mean squares with their number. FLIP bends small differences upwards.
  static const std::vector<Metric> metrics{
      metric<&Metrics::lab_mean>("lab_mean", estimated,
                                 "distance in CIELAB, mean of the pixels (0 is equal, about 2.3 just noticeable)",
                                 {"mean CIELAB distance", "CIELAB units", -0.5}),
      metric<&Metrics::lab_rms>("lab_rms", estimated, "distance in CIELAB, root mean square",
                                {"root mean square CIELAB distance", "CIELAB units", -0.5}),
      metric<&Metrics::lab_max>("lab_max", other, "distance in CIELAB, largest",
                                {"largest CIELAB distance", "CIELAB units", -0.5}),
      metric<&Metrics::mse>("mse", estimated, "(a - b)^2, mean", {"mean square error", "white²", -1.0}),
      metric<&Metrics::rel_mse>("rel_mse", other, "(a - b)^2 / (b^2 + 0.01), mean",
                                {"relative mean square error", "", -1.0}),
      metric<&Metrics::rel_l2>("rel_l2", estimated, "|a - b| / |b|", {"relative L2 error", "", -0.5}),
      metric<&Metrics::psnr_db>("psnr_db", other, "decibels of the displayed pictures; more is better",
                                {"peak signal-to-noise ratio", "dB", std::nullopt, false, true}),
      metric<&Metrics::iw_ssim>("iw_ssim", perceptual, "structural similarity, 1 is equal; needs 161 pixels a side",
                                {"IW-SSIM", "", std::nullopt, false, true}),
      metric<&Metrics::flip>("flip", perceptual, "what a viewer sees flipping between the displayed pictures, 0..1",
                             {"FLIP", "", std::nullopt}),
      metric<&Metrics::hdr_flip>("hdr_flip", perceptual, "the same at every exposure, 0..1",
                                 {"HDR-FLIP", "", std::nullopt})};
  return metrics;
}

std::vector<std::pair<std::string, double>> named(const Metrics& metrics) {
  std::vector<std::pair<std::string, double>> values;
  for (const Metric& metric : all_metrics()) values.emplace_back(metric.name, metric.of(metrics));
  return values;
}

} // namespace nephroid::measure
