// SPDX-License-Identifier: Apache-2.0
// Tables by which a device chooses among things with one random number.
#pragma once
#include <vector>

namespace nephroid {

/// Running sums of weights in whole multiples of 2^-24, from the first weight to 1. A random number of the device is
/// such a multiple too, so the difference of two sums is exactly the chance. Every positive weight has a chance.
std::vector<float> exact_cdf(const std::vector<double>& weights);

/// exact_cdf with a 0 in front: one number more than there are weights.
std::vector<float> exact_cdf_from_zero(const std::vector<double>& weights);

} // namespace nephroid
