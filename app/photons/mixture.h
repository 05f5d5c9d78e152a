// SPDX-License-Identifier: Apache-2.0
// The best mixture of a picture with an estimate of it, place by place, as far as two halves of a noisy picture without
// bias can tell.
//
// That picture is p = truth + e. What is to be made better is b = truth + f, and the estimate is b + r. The mixture b +
// w r is off by the square
//
//   E[f^2] + 2 w E[r f] + w^2 E[r^2],
//
// and E[r f] is to be had without the truth (Stein 1981, "Estimation of the mean of a multivariate normal
// distribution"; with an estimate that knows nothing of the noise the best weight is that of James and Stein): f = (b -
// p) + e, and of the halves p + d and p - d, of which r has a draw q of its noise, E[r e] = E[q d]: the noise of one
// half is not in the other. Sums are taken around each pixel. Where few photons fell they are noisy themselves, so the
// estimate counts only for what it gains beyond one standard deviation of that. The halves draw it, too: r has the draw
// q, b - p that of their difference.
#pragma once
#include <span>
#include <vector>

namespace nephroid::photons {

/// Both [pixel][3].
struct Estimate {
  std::span<const float> rgb;
  std::span<const float> error_draw; ///< of what it has of the picture's noise; empty: nothing
};

/// Below which light counts as if it were this, where errors count over light: a hundredth of the mean of all pixels
/// that are not black. So what is for the better does not depend on exposure. light: [pixel].
double least_light(std::span<const double> light);

/// All linear sRGB, [pixel][3]. rgb, error_draw: b and a draw of its noise (job::Picture::error_draw); they become
/// those of the mixture. picture, picture_draw: p and d. light: [pixel], what the squares of errors are measured by.
/// Weights are 0..1.
void mix(std::span<const float> picture, std::span<const float> picture_draw, const Estimate& estimate,
         std::span<const double> light, int width, int height, std::vector<float>& rgb, std::vector<float>& error_draw);

} // namespace nephroid::photons
