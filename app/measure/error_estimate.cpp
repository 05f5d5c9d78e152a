// SPDX-License-Identifier: Apache-2.0
// The error that CIELAB is measured on, channel by channel, with the picture m, the draw d, and means over a square about a pixel (bars):
//
//   n = mean of d^2                      the noise's variance
//   v = mean of (m - m_bar)^2            the picture's own and the noise's together
//   p = m_bar^2 / n                      about how many photons a pixel has: mean^2 / variance of a Poisson distribution
//   w = 1 - min(n / v, 1) / (1 + p^2)
//   e = sqrt(w) d + (1 - w) (m - m_bar)
//
// With many photons a pixel, w is 1 and e is the draw. With less than about one, w is Wiener's share of the picture in what is seen, and e
// takes in what m differs from its surroundings by; its variance is then w n + (1 - w)^2 v = w n + (1 - w) n = n, because d is
// uncorrelated with m. The surroundings of a pixel with many photons must not count: beside a bright edge they would call black wrong.
#include "measure/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephroid::measure {
namespace {

constexpr int reach = 3; ///< of the square, in pixels to each side: 49 pixels are enough for a mean, and few enough for detail

/// Sums of one channel over any rectangle: entry (x, y) is the sum of all pixels left of x and above y.
class SummedArea {
public:
  template <class Value>
  SummedArea(int width, int height, Value value) : width_(width), height_(height)
  {
    const std::size_t stride = static_cast<std::size_t>(width) + 1;
    sums_.assign(stride * (static_cast<std::size_t>(height) + 1), 0.0);
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
      double row = 0;
      for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
        row += value(y * static_cast<std::size_t>(width) + x);
        sums_[(y + 1) * stride + x + 1] = sums_[y * stride + x + 1] + row;
      }
    }
  }

  /// Of the square about a pixel, as much of it as is in the picture.
  double mean(int x, int y) const
  {
    const int left = std::max(x - reach, 0), right = std::min(x + reach + 1, width_);
    const int top = std::max(y - reach, 0), bottom = std::min(y + reach + 1, height_);
    const double sum = at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
    return sum / (static_cast<double>(right - left) * (bottom - top));
  }

private:
  double at(int x, int y) const
  {
    return sums_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(width_) + 1) + static_cast<std::size_t>(x)];
  }
  int width_, height_;
  std::vector<double> sums_;
};

/// The picture without e: a draw of the truth as CIELAB needs it.
std::vector<float> likely_truth(const job::Picture& picture)
{
  std::vector<float> truth(picture.rgb.size());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto m = [&](std::size_t pixel) { return static_cast<double>(picture.rgb[3 * pixel + channel]); };
    const auto d = [&](std::size_t pixel) { return static_cast<double>(picture.error_draw[3 * pixel + channel]); };
    const SummedArea sum(picture.width, picture.height, m);
    const SummedArea squares(picture.width, picture.height, [&](std::size_t pixel) { return m(pixel) * m(pixel); });
    const SummedArea noise(picture.width, picture.height, [&](std::size_t pixel) { return d(pixel) * d(pixel); });
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
        const double mean = sum.mean(x, y), variance = squares.mean(x, y) - mean * mean, n = noise.mean(x, y);
        const double p = n > 0 ? mean * mean / n : 0;
        const double w = n > 0 ? 1 - std::min(n / variance, 1.0) / (1 + p * p) : 1;
        const double e = std::sqrt(w) * d(pixel) + (1 - w) * (m(pixel) - mean);
        truth[3 * pixel + channel] = static_cast<float>(m(pixel) - e);
      }
  }
  return truth;
}

Metrics quick(const job::Picture& picture, const std::vector<float>& other)
{
  return compare({picture.width, picture.height, other, "the run"}, {picture.width, picture.height, picture.rgb, "the run"}, {},
                 Effort::quick);
}

} // namespace

Metrics estimate_error(const job::Picture& picture)
{
  std::vector<float> drawn(picture.rgb.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = picture.rgb[i] + picture.error_draw[i];
  Metrics metrics = quick(picture, drawn);
  const Metrics lab = quick(picture, likely_truth(picture));
  metrics.lab_mean = lab.lab_mean;
  metrics.lab_rms = lab.lab_rms;
  metrics.lab_max = lab.lab_max;
  return metrics;
}

} // namespace nephroid::measure
