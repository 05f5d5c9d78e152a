// SPDX-License-Identifier: Apache-2.0
#include "photons/mixture.h"

#include "base/parallel.h"
#include "base/summed_area.h"

#include <algorithm>
#include <cmath>

namespace nephroid::photons {
namespace {

/// The radius around a pixel, in pixels, of the mean of its light.
constexpr int light_radius = 7;

/// The radius of the part of a picture whose mean light is the frame's own. 49 x 49 pixels have little noise together.
constexpr int part_radius = 24;

/// Weights follow the noise: where more photons fell by chance there is more of it, and more is taken from the frame
/// before. So bright peaks would go and dark holes stay. Gives each part of the mixture the frame's own light again, as
/// a factor of what was mixed.
void keep_light(std::span<const float> own, std::span<const float> own_draw, int width, int height,
                std::vector<float>& rgb, std::vector<float>& draw) {
  constexpr double most = 0.1; // what a single bright peak may add to the light around it
  const std::vector<float> mixed = rgb;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto at = [c](std::size_t pixel) { return 3 * pixel + c; };
    const auto carrier = [&](std::size_t i) {
      return mixed[at(i)] == own[at(i)] ? 0.0 : std::max(double{mixed[at(i)]}, 0.0);
    };
    const SummedArea lacks(width, height, [&](std::size_t i) { return double{own[at(i)]} - mixed[at(i)]; });
    const SummedArea lacks_of_draw(width, height, [&](std::size_t i) { return double{own_draw[at(i)]} - draw[at(i)]; });
    const SummedArea carriers(width, height, carrier);
    const auto factor = [&](const SummedArea& lack, std::size_t i) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      const double sum = carriers.sum(x, y, part_radius);
      return sum > 0 ? std::clamp(lack.sum(x, y, part_radius) / sum, -most, most) : 0.0;
    };
    // The mean of the factors around has no edges where parts end.
    const SummedArea factors(width, height, [&](std::size_t i) { return factor(lacks, i); });
    const SummedArea factors_of_draw(width, height, [&](std::size_t i) { return factor(lacks_of_draw, i); });
    for_items(mixed.size() / 3, [&](std::size_t i) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      rgb[at(i)] += static_cast<float>(carrier(i) * factors.mean(x, y, part_radius));
      draw[at(i)] += static_cast<float>(carrier(i) * factors_of_draw.mean(x, y, part_radius));
    });
  }
}

/// How much of a difference noise explains, 0..1 by pixel, as a draw of that noise tells: noise of few photons has
/// peaks that no deviation knows of, but its draw has them, too.
class Changes {
public:
  Changes(std::span<const float> difference, std::span<const float> draw, int width, int height)
      : width_(width), height_(height), usual_(difference.size() / 3, 1.0f) {
    for (const int radius : {0, 1, 3}) look(difference, draw, radius);
  }
  float usual(std::size_t pixel) const { return usual_[pixel]; }

private:
  /// Compares the mean of the pixels within the radius with the largest one of the draw around.
  void look(std::span<const float> difference, std::span<const float> draw, int radius) {
    const std::vector<float> squares = squares_of_means(difference, radius),
                             usual = largest_around(squares_of_means(draw, radius));
    constexpr float margin = 2; // squared: else the peaks of the noise itself would pass for changes, and stay
    for (std::size_t i = 0; i < usual_.size(); ++i)
      if (squares[i] > margin * usual[i]) usual_[i] = std::min(usual_[i], margin * usual[i] / squares[i]);
  }

  std::vector<float> squares_of_means(std::span<const float> values, int radius) const {
    std::vector<float> squares(usual_.size());
    for (std::size_t c = 0; c < 3; ++c) {
      const SummedArea sums(width_, height_, [&](std::size_t i) { return values[3 * i + c]; });
      for_items(squares.size(), [&](std::size_t i) {
        squares[i] += static_cast<float>(
            std::pow(sums.mean(static_cast<int>(i) % width_, static_cast<int>(i) / width_, radius), 2));
      });
    }
    return squares;
  }

  /// The largest value of the square about each pixel, along rows and then along columns.
  std::vector<float> largest_around(std::vector<float> values) const {
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    const auto along = [](const std::vector<float>& from, std::size_t count, std::size_t step, std::size_t lines,
                          std::size_t line_step) {
      constexpr std::size_t radius = error_radius;
      std::vector<float> largest(from.size());
      for_blocks(lines, [&](std::size_t line) {
        const std::size_t begin = line * line_step;
        for (std::size_t i = 0; i < count; ++i) {
          float& most = largest[begin + i * step];
          for (std::size_t j = i - std::min(i, radius); j < std::min(i + radius + 1, count); ++j)
            most = std::max(most, from[begin + j * step]);
        }
      });
      return largest;
    };
    return along(along(values, width, 1, height, width), height, width, width, 1);
  }

  int width_, height_;
  std::vector<float> usual_;
};

} // namespace

double least_light(std::span<const double> light) {
  double sum = 0, count = 0;
  for (const double pixel_light : light)
    if (pixel_light > 0) sum += pixel_light, ++count;
  return count > 0 ? 0.01 * sum / count : 1;
}

void mix(std::span<const float> picture, std::span<const float> picture_draw, const Estimate& estimate,
         std::span<const double> light, int width, int height, std::vector<float>& rgb, std::vector<float>& error_draw,
         int radius) {
  const auto draw_of = [&](std::size_t c) { return estimate.error_draw.empty() ? 0.0 : estimate.error_draw[c]; };
  const double dark = least_light(light);
  const SummedArea lights(width, height, [&](std::size_t i) { return light[i]; });
  // Sums term(c, r) of the three channels c of a pixel, divided by the light there.
  const auto relative_to_light = [&](std::size_t i, const auto& term) {
    double sum = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) sum += term(c, static_cast<double>(estimate.rgb[c]) - rgb[c]);
    return sum / (dark + lights.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, light_radius));
  };
  const SummedArea slopes(width, height, [&](std::size_t i) {
    return relative_to_light(i, [&](std::size_t c, double r) {
      return r * (static_cast<double>(rgb[c]) - picture[c]) + (draw_of(c) - error_draw[c]) * picture_draw[c];
    });
  });
  // A draw of the noise in r (b - p).
  const SummedArea scatters(width, height, [&](std::size_t i) {
    return std::pow(relative_to_light(i,
                                      [&](std::size_t c, double r) {
                                        return r * (static_cast<double>(error_draw[c]) - picture_draw[c]) +
                                               (draw_of(c) - error_draw[c]) *
                                                   (static_cast<double>(rgb[c]) - picture[c]);
                                      }),
                    2);
  });
  const SummedArea squares(
      width, height, [&](std::size_t i) { return relative_to_light(i, [](std::size_t, double r) { return r * r; }); });
  for_items(light.size(), [&](std::size_t i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const double scatter = std::sqrt(std::max(scatters.sum(x, y, radius), 0.0));
    const double gain = -slopes.sum(x, y, radius) - scatter, square = squares.sum(x, y, radius);
    if (gain <= 0 || square <= 0) return;
    const auto weight = static_cast<float>(std::min(gain / square, 1.0));
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      rgb[c] += weight * (estimate.rgb[c] - rgb[c]);
      error_draw[c] += weight * (static_cast<float>(draw_of(c)) - error_draw[c]);
    }
  });
}

std::vector<float> mix_before(const Estimate& before, int width, int height, std::vector<float>& rgb,
                              std::vector<float>& error_draw) {
  const std::vector<float> own = rgb, own_draw = error_draw;
  std::vector<float> difference(rgb.size()), draw(rgb.size());
  for (std::size_t c = 0; c < rgb.size(); ++c)
    if (!std::isnan(before.rgb[c])) {
      difference[c] = before.rgb[c] - own[c];
      draw[c] = before.error_draw[c] - own_draw[c];
    }
  std::vector<double> light(rgb.size() / 3);
  for (std::size_t c = 0; c < rgb.size(); ++c) light[c / 3] += std::max(double{own[c]}, 0.0) / 3;
  const Changes changes(difference, draw, width, height);
  std::vector<float> estimate(rgb.size()), estimate_draw(rgb.size());
  for (std::size_t c = 0; c < rgb.size(); ++c) {
    estimate[c] = own[c] + changes.usual(c / 3) * difference[c];
    estimate_draw[c] = own_draw[c] + changes.usual(c / 3) * draw[c];
  }
  mix(own, own_draw, {estimate, estimate_draw}, light, width, height, rgb, error_draw);
  keep_light(own, own_draw, width, height, rgb, error_draw);

  // What the mixture has moved beyond the noise of that is light of the frame before.
  const SummedArea beyond(width, height, [&](std::size_t i) {
    double sum = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      sum += std::pow(static_cast<double>(rgb[c]) - own[c], 2) -
             std::pow(static_cast<double>(error_draw[c]) - own_draw[c], 2);
    return sum / 3;
  });
  std::vector<float> with_bias = error_draw;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double bias_square =
        std::max(beyond.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, error_radius), 0.0);
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) { // no more than a pixel was moved
      const double bias = std::min(bias_square, std::pow(static_cast<double>(rgb[c]) - own[c], 2));
      with_bias[c] = static_cast<float>(std::copysign(std::sqrt(std::pow(error_draw[c], 2) + bias), error_draw[c]));
    }
  }
  return with_bias;
}

} // namespace nephroid::photons
