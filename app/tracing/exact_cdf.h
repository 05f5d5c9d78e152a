// SPDX-License-Identifier: Apache-2.0
// Choosing among a few hundred things by one random number of a device.
#pragma once
#include <vector>

namespace nephroid::tracing {

/// Running sums of weights as whole numbers of 2^-24, from the first weight's own to 1. A random number of the device is such a number,
/// so the difference of two is the chance itself; none that has a weight has none. Where all weights are 0, all have the same chance.
std::vector<float> exact_cdf(const std::vector<double>& weights);

/// The same after a 0: one more than there are weights.
std::vector<float> exact_cdf_from_zero(const std::vector<double>& weights);

} // namespace nephroid::tracing
