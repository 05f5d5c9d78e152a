// SPDX-License-Identifier: Apache-2.0
// The error that CIELAB and rel_mse are measured on, for each of X, Y and Z, which light can only add to, with the
// picture m, the draw d, and means over a square about a pixel (bars):
//
//   n = mean of d^2                      the noise's variance
//   v = mean of (m - m_bar)^2            the picture's own and the noise's together
//   p = m_bar^2 / n                      about how many photons a pixel has: a Poisson's mean^2 / variance
//   w = 1 - min(n / v, 1) / (1 + p^2)
//   e = sqrt(w) d + (1 - w) (m - m_bar)
//
// With many photons a pixel, w is 1 and e is the draw. With less than about one, w is Wiener's share of the picture in
// what is seen, and e takes in what m differs from its surroundings by; its variance is then w n + (1 - w)^2 v = w n +
// (1 - w) n = n, because d is uncorrelated with m. The surroundings of a pixel with many photons must not count: beside
// a bright edge they would call black wrong. What would make the truth negative is left out: CIELAB is steep there.
#include "measure/error_estimate.h"

#include "base/summed_area.h"
#include "optics/colour.h"

#include <algorithm>
#include <cmath>

namespace nephroid::measure {
namespace {

/// The square's pixels to each side: 49 are enough for a mean, and few enough for detail.
constexpr int reach = 3;

std::vector<double> to_xyz(const std::vector<float>& rgb) {
  std::vector<double> xyz;
  xyz.reserve(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    for (const double value : optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]})) xyz.push_back(value);
  return xyz;
}

/// Takes e from one of X, Y, Z of the picture m; d is the draw.
void subtract_error(std::vector<double>& m, const std::vector<double>& d, std::size_t channel, int width, int height) {
  const auto of = [&](const std::vector<double>& values) {
    return [&](std::size_t pixel) { return values[3 * pixel + channel]; };
  };
  const auto square = [&](const std::vector<double>& values) {
    return [&](std::size_t pixel) { return values[3 * pixel + channel] * values[3 * pixel + channel]; };
  };
  const SummedArea sum(width, height, of(m)), squares(width, height, square(m)), noise(width, height, square(d));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) + channel;
      const double mean = sum.mean(x, y, reach), variance = squares.mean(x, y, reach) - mean * mean,
                   n = noise.mean(x, y, reach);
      const double p = n > 0 ? mean * mean / n : 0;
      const double w = n > 0 ? 1 - std::min(n / variance, 1.0) / (1 + p * p) : 1;
      m[i] = std::max(m[i] - std::sqrt(w) * d[i] - (1 - w) * (m[i] - mean), 0.0);
    }
}

/// The picture without e: a draw of the truth.
std::vector<float> likely_truth(const job::Picture& picture) {
  std::vector<double> xyz = to_xyz(picture.rgb);
  const std::vector<double> draw = to_xyz(picture.error_draw);
  for (std::size_t channel = 0; channel < 3; ++channel)
    subtract_error(xyz, draw, channel, picture.width, picture.height);
  std::vector<float> truth;
  truth.reserve(xyz.size());
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    for (const double value : optics::xyz_to_linear_srgb({xyz[i], xyz[i + 1], xyz[i + 2]}))
      truth.push_back(static_cast<float>(value));
  return truth;
}

} // namespace

Metrics estimate_error(const job::Picture& picture, Mask mask) {
  const Pixels pixels{picture.width, picture.height, picture.rgb, "the run"};
  std::vector<float> drawn(picture.rgb.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = picture.rgb[i] + picture.error_draw[i];
  const Metrics draw_metrics =
      compare({picture.width, picture.height, drawn, "the run"}, pixels, mask, MetricSet::quick);
  const std::vector<float> truth = likely_truth(picture);
  Metrics metrics = compare(pixels, {picture.width, picture.height, truth, "the run"}, mask, MetricSet::quick);
  metrics.mse = draw_metrics.mse;
  metrics.rel_l2 = draw_metrics.rel_l2;
  metrics.psnr_db = draw_metrics.psnr_db;
  return metrics;
}

} // namespace nephroid::measure
