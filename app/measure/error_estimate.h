// SPDX-License-Identifier: Apache-2.0
// The error of a picture as far as the picture itself tells.
#pragma once
#include "job/job.h"
#include "measure/metrics.h"

namespace nephroid::measure {

/// The quick metrics of the picture against the truth, as far as the picture itself tells. It needs picture.error_draw.
/// mse and rel_l2 are of the draw itself, which has the error's variance in every pixel. CIELAB and rel_mse are not
/// linear, so there it matters where the truth lies: a pixel that no photon has reached yet has a picture and a draw of
/// 0, and is wrong all the same; and the picture is bright where its noise is, so that it must not be what rel_mse
/// divides by. Where the noise hides the picture, its neighbourhood stands for the truth (error_estimate.cpp).
Metrics estimate_error(const job::Picture& picture, Mask mask = {});

} // namespace nephroid::measure
