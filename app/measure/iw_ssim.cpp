// SPDX-License-Identifier: Apache-2.0
#include "measure/iw_ssim.h"

#include "base/parallel.h"
#include "measure/information_weights.h"
#include "measure/lab.h"
#include "measure/laplacian_pyramid.h"
#include "measure/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace nephroid::measure {
namespace {

constexpr int scale_count = 5;
constexpr std::array<double, scale_count> scale_weights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333}; ///< Wang et al. 2003; sum 1.0001
constexpr std::size_t window = 11, margin = window / 2;
constexpr double luminance_constant = (0.01 * 255) * (0.01 * 255), contrast_constant = (0.03 * 255) * (0.03 * 255);
constexpr std::size_t block_rows = 32;

/// Gaussian of standard deviation 1.5, sum 1.
std::array<double, window> gaussian()
{
  std::array<double, window> taps{};
  for (std::size_t i = 0; i < window; ++i) {
    const double x = static_cast<double>(i) - margin;
    taps[i] = std::exp(-x * x / (2 * 1.5 * 1.5));
  }
  const double sum = std::accumulate(taps.begin(), taps.end(), 0.0);
  for (double& tap : taps) tap /= sum;
  return taps;
}

Plane luma(const Pixels& picture)
{
  Plane plane(static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
  for_ranges(plane.values.size(), std::size_t{1} << 14, [&](std::size_t, Range range) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
      const float* const rgb = &picture.rgb[3 * p];
      plane.values[p] = 255 * (0.299 * encode_clipped(rgb[0]) + 0.587 * encode_clipped(rgb[1]) + 0.114 * encode_clipped(rgb[2]));
    }
  });
  return plane;
}

/// Gaussian means over the window of a, b, a^2, b^2 and a b.
enum Moment { mean_a, mean_b, mean_aa, mean_bb, mean_ab, moment_count };
using Moments = std::array<Plane, moment_count>;

/// The moments along one row; valid windows only.
void row_moments(Moments& moments, std::size_t to, const double* a, const double* b, const std::array<double, window>& taps)
{
  for (std::size_t x = 0; x < moments[0].width; ++x) {
    std::array<double, moment_count> sums{};
    for (std::size_t i = 0; i < window; ++i) {
      const double wa = taps[i] * a[x + i], wb = taps[i] * b[x + i];
      sums[mean_a] += wa;
      sums[mean_b] += wb;
      sums[mean_aa] += wa * a[x + i];
      sums[mean_bb] += wb * b[x + i];
      sums[mean_ab] += wa * b[x + i];
    }
    for (std::size_t m = 0; m < moment_count; ++m) moments[m].row(to)[x] = sums[m];
  }
}

double similarity(const std::array<double, moment_count>& m, bool with_luminance)
{
  const double aa = m[mean_a] * m[mean_a], bb = m[mean_b] * m[mean_b], ab = m[mean_a] * m[mean_b];
  const double variances = std::max(0.0, m[mean_aa] - aa) + std::max(0.0, m[mean_bb] - bb);
  const double structure = (2 * (m[mean_ab] - ab) + contrast_constant) / (variances + contrast_constant);
  return with_luminance ? structure * (2 * ab + luminance_constant) / (aa + bb + luminance_constant) : structure;
}

/// SSIM's contrast and structure, with luminance if asked for, of every window that lies wholly inside.
Plane similarities(const Plane& a, const Plane& b, bool with_luminance)
{
  const std::array<double, window> taps = gaussian();
  Plane result(a.width - 2 * margin, a.height - 2 * margin);
  for_ranges(result.height, block_rows, [&](std::size_t, Range rows) {
    const std::size_t count = rows.end - rows.begin;
    Moments moments;
    moments.fill(Plane(result.width, count + 2 * margin));
    for (std::size_t y = 0; y < count + 2 * margin; ++y) row_moments(moments, y, a.row(rows.begin + y), b.row(rows.begin + y), taps);
    for (std::size_t y = 0; y < count; ++y)
      for (std::size_t x = 0; x < result.width; ++x) {
        std::array<double, moment_count> sums{};
        for (std::size_t i = 0; i < window; ++i)
          for (std::size_t m = 0; m < moment_count; ++m) sums[m] += taps[i] * moments[m].row(y + i)[x];
        result.row(rows.begin + y)[x] = similarity(sums, with_luminance);
      }
  });
  return result;
}

/// Whether the window about inner pixel (x, y) of a scale counts. Level pixel i lies on pixel 2^scale i of the picture.
struct ScaleMask {
  Mask mask;
  std::size_t width;
  int scale;

  bool operator()(std::size_t x, std::size_t y) const { return counts(mask, ((y + margin) << scale) * width + ((x + margin) << scale)); }
};

/// The mean of the similarities that count, weighted where there are weights (of all but the outermost ring of the level's pixels).
std::optional<double> pooled(const Plane& similarity, const Plane* weights, const ScaleMask& mask)
{
  double sum = 0, weight_sum = 0, plain_sum = 0;
  std::size_t windows = 0;
  for (std::size_t y = 0; y < similarity.height; ++y)
    for (std::size_t x = 0; x < similarity.width; ++x) {
      if (!mask(x, y)) continue;
      const double weight = weights ? weights->row(y + margin - 1)[x + margin - 1] : 1;
      sum += weight * similarity.row(y)[x];
      weight_sum += weight;
      plain_sum += similarity.row(y)[x];
      ++windows;
    }
  if (windows == 0) return std::nullopt;
  return weight_sum > 0 ? sum / weight_sum : plain_sum / static_cast<double>(windows);
}

} // namespace

std::vector<std::optional<double>> iw_ssim_each(const Pixels& picture, const Pixels& reference, std::span<const Mask> masks)
{
  if (std::min(picture.width, picture.height) < iw_ssim_smallest_side) return std::vector<std::optional<double>>(masks.size());
  const std::vector<Plane> a = laplacian_pyramid(luma(picture), scale_count), b = laplacian_pyramid(luma(reference), scale_count);
  const double weight_sum = std::accumulate(scale_weights.begin(), scale_weights.end(), 0.0);
  std::vector<std::optional<double>> results(masks.size(), 1.0);
  for (std::size_t s = 0; s < scale_count; ++s) {
    const bool coarsest = s + 1 == scale_count, has_parent = s + 2 < scale_count;
    const Plane parent = has_parent ? enlarged_parent(b[s + 1], b[s].width, b[s].height) : Plane();
    const Plane weights = coarsest ? Plane() : information_weights(b[s], a[s], parent);
    const Plane similar = similarities(b[s], a[s], coarsest);
    for (std::size_t m = 0; m < masks.size(); ++m) {
      const ScaleMask mask{masks[m], static_cast<std::size_t>(picture.width), static_cast<int>(s)};
      const std::optional<double> mean = pooled(similar, coarsest ? nullptr : &weights, mask);
      if (!mean) results[m].reset();
      if (results[m]) *results[m] *= std::pow(std::max(0.0, *mean), scale_weights[s] / weight_sum);
    }
  }
  return results;
}

std::optional<double> iw_ssim(const Pixels& picture, const Pixels& reference, Mask mask)
{
  return iw_ssim_each(picture, reference, std::span<const Mask>(&mask, 1)).front();
}

} // namespace nephroid::measure
