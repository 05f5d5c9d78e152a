// SPDX-License-Identifier: Apache-2.0
// IW-SSIM: structural similarity over five scales, each place weighted by the information a person takes from it. Wang
// and Li: Information Content Weighting for Perceptual Image Quality Assessment, IEEE Trans. Image Processing, 2011.
#pragma once
#include "measure/metrics.h"

namespace nephroid::measure {

/// Below so many pixels a side the coarsest of the five scales is smaller than SSIM's window of 11.
inline constexpr int iw_ssim_smallest_side = 161;

/// For each mask 0..1, 1 for equal pictures, of the luma (.299 .587 .114) of the sRGB-encoded, clipped pictures. Not
/// symmetric. None where a side is below iw_ssim_smallest_side or where no window of a scale is in the mask. The
/// pictures have the same size and finite values. What the authors leave open: similarities below 0 count as 0; a
/// reference that is flat (or whose covariance is singular) has no strength where it does not vary; where all weights
/// of a scale are 0 its windows count alike. With a mask, windows count whose centre is in it; covariances are of the
/// whole picture.
std::vector<std::optional<double>> iw_ssim_each(const Pixels& picture, const Pixels& reference,
                                                std::span<const Mask> masks);

} // namespace nephroid::measure
