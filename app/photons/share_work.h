// SPDX-License-Identifier: Apache-2.0
// How the work of a pass is divided between photons and paths from the eye.
#pragma once
#include "photons/development.h"

namespace nephroid::photons {

/// Allocates the work of the next passes out by how much each stage lowers the picture's noise: the sum of the variances V_s of what takes the
/// work w_s a pass, V_s w_s being as it is, is smallest where all V_s / w_s are alike. Work is counted, not timed, so that a seed has its
/// bits. The square of a pixel's noise is over that of its light, as in the metric rel_mse.
void share_work(const DeviceWorld& world, const Passes& passes, Development& development);

} // namespace nephroid::photons
