// SPDX-License-Identifier: Apache-2.0
// How much a person learns from each place of a pyramid's level: the weights of IW-SSIM.
// Wang and Li: Information Content Weighting for Perceptual Image Quality Assessment, IEEE Trans. Image Processing 20 (5), 2011.
#pragma once
#include "measure/laplacian_pyramid.h"

namespace nephroid::measure {

/// A weight a pixel of the level, its outermost ring of pixels left out, in bits: 2 less wide and high than the level. Reference and
/// picture: the same level of both pyramids; parent: of the reference, as large as the level, or empty where it is not to be used.
Plane information_weights(const Plane& reference, const Plane& picture, const Plane& parent);

} // namespace nephroid::measure
