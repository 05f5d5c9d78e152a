// SPDX-License-Identifier: Apache-2.0
// Mixes a picture with an estimate so that each place has the smallest error, as two halves of a noisy picture tell it.
//
// The unbiased picture is p = truth + e, the picture to be improved b = truth + f, and the estimate b + r. The square
// of the error of the mixture b + w r is
//
//   E[f^2] + 2 w E[r f] + w^2 E[r^2],
//
// E[r f] can be had without the truth (Stein 1981, "Estimation of the mean of a multivariate normal distribution"; for
// an estimate whose noise is independent the best weight is that of James and Stein). f = (b - p) + e. The halves are p
// + d and p - d, and r has a draw q of its noise. The noise of one half is not in the other, so E[r e] = E[q d]. Sums
// are taken around each pixel. They are noisy where few photons fell, so the estimate counts only for its gain beyond
// one standard deviation of them, which the halves tell too: r has the draw q, b - p the difference of its own.
#pragma once
#include <span>
#include <vector>

namespace nephroid::photons {

/// An estimate of a picture; both members are [pixel][3].
struct Estimate {
  std::span<const float> rgb;
  std::span<const float> error_draw; ///< draw of its share of the picture's noise; empty: it has none
};

/// A lower bound for light where errors are divided by light: a hundredth of the mean of all pixels that are not black.
double least_light(std::span<const double> light);

/// The radius around a pixel, in pixels, of the means of its errors.
constexpr int error_radius = 8;

/// Mixes the picture b in rgb, with a draw of its noise in error_draw (job::Picture::error_draw), with the estimate;
/// both become those of the mixture. All are linear sRGB, [pixel][3]. picture and picture_draw are p and d.
/// light[pixel] is the light that the squares of errors are divided by. Weights are 0..1. radius: as error_radius.
void mix(std::span<const float> picture, std::span<const float> picture_draw, const Estimate& estimate,
         std::span<const double> light, int width, int height, std::vector<float>& rgb, std::vector<float>& error_draw,
         int radius = error_radius);

/// Mixes a picture with that of an animation's frame before, whose draw is of other random numbers; rgb and error_draw
/// become those of the mixture. The places of `before` where it is NaN count for nothing. A difference beyond the
/// largest that its noise has around there, of a pixel or of a few pixels, is a change of the scene: there the estimate
/// gives way by the inverse square, so that neither light nor shadow stays behind that stands out from the frame's own
/// noise. Returns a draw of the mixture's error with the light in it that is not this frame's; error_draw is of the
/// noise alone, for the next frame.
std::vector<float> mix_before(const Estimate& before, int width, int height, std::vector<float>& rgb,
                              std::vector<float>& error_draw);

} // namespace nephroid::photons
