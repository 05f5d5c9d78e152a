// SPDX-License-Identifier: Apache-2.0
// Choosing among a few hundred things by one random number of a device.
#pragma once
#include <vector>

namespace nephroid::tracing {

/// Running sums of weights as whole numbers of 2^-24, from the first weight's own to 1. A random number of the device is such a number
/// too, so the difference of two sums is exactly the chance. Whatever has a weight has a chance. Where all weights are 0, all chances are
/// the same.
std::vector<float> exact_cdf(const std::vector<double>& weights);

/// The same with a 0 in front: one number more than there are weights.
std::vector<float> exact_cdf_from_zero(const std::vector<double>& weights);

/// What light is worth, where paths are dealt to lights, clusters or wavelengths and nothing has been measured.
/// seen: what the eye makes of it, (X + Y + Z) / 3. power: a twentieth of it counts too, so that what the eye hardly sees is still seen.
constexpr double worth(double seen, double power) { return seen + 0.05 * power; }

} // namespace nephroid::tracing
