// SPDX-License-Identifier: Apache-2.0
// The best mixture of a picture with estimates of it, place by place, as far as two halves of a noisy picture without bias can tell.
//
// That picture is p = truth + e. What is to be made better is b = truth + f, and an estimate is b + r_k. The mixture b + sum of w_k r_k is
// off by the square
//
//   E[f^2] + 2 sum of w_k E[r_k f] + sum of w_k w_l E[r_k r_l],
//
// and its first two terms are to be had without the truth (Stein 1981, "Estimation of the mean of a multivariate normal distribution"; with
// one estimate that knows nothing of the noise the best weight is that of James and Stein): f = (b - p) + e, and of the halves p + d and
// p - d, with which estimates are off by r_ka and r_kb, q_k = (r_ka - r_kb) / 2 gives E[r_k e] = E[q_k d]: the noise of one is not in
// the other. Sums are taken around each pixel. Where few photons fell they are noisy themselves, so an estimate counts only for what it
// gains beyond one standard deviation of that.
#pragma once
#include <span>
#include <vector>

namespace nephroid::photons {

/// Linear sRGB, [pixel][3].
struct Estimate {
  std::vector<float> change; ///< r: from what is to be made better to this
  std::vector<float> draw;   ///< q: the same of the draw of its error (job::Picture::error_draw)
};

/// rgb, error_draw: b and a draw of its noise; they become those of the mixture. picture, picture_draw: p and d. Weights are 0..1, together
/// at most 1. light: [pixel], what the squares of errors are measured by. estimates: at most two.
void mix(std::span<const float> picture, std::span<const float> picture_draw, std::span<const Estimate> estimates,
         std::span<const double> light, int width, int height, std::vector<float>& rgb, std::vector<float>& error_draw);

} // namespace nephroid::photons
