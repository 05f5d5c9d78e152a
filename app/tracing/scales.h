// SPDX-License-Identifier: Apache-2.0
// How many quanta of a film's or counter's fixed point a unit has. A usual value lies in the middle of 63 bits, so
// values may be far brighter or fainter. All scales are powers of two, so that they round nothing. Beside them,
// choosing among a few hundred things by one random number of a device.
#pragma once
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::tracing {

/// 1 for what is not positive or not finite.
double power_of_two_below(double value);

/// About the box about all triangles.
scene::Sphere scene_bounds(const scene::Scene& scene);
/// Its lowest and highest corner; without points both are 0.
std::array<glm::vec3, 2> box_about(const std::vector<glm::vec3>& points);

/// Of a film of splats, quanta per unit of XYZ radiance. A photon with a mean share of `watts` has 2^16 on a surface as
/// far away as the scene's middle. The limit of one photon is 2^42 (kernels/tracing/film.h), which it has 8000 times
/// nearer. photons: of one pass.
double splat_scale(const scene::Scene& scene, unsigned photons, double watts);

/// Of energy counters, quanta per watt: 2^40 for the power of one pass; 2^20 passes fit into 63 bits.
double energy_scale(double watts);
/// The mean of such a counter over so many passes, the part of the one in hand included; 0 before the first.
double mean_watts(std::int64_t quanta, double quanta_per_watt, double passes);

/// Running sums of weights as whole numbers of 2^-24, from the first weight's own to 1. A random number of the device
/// is such a number too, so the difference of two sums is exactly the chance. Whatever has a weight has a chance. Where
/// all weights are 0, all chances are the same.
std::vector<float> exact_cdf(const std::vector<double>& weights);

/// The same with a 0 in front: one number more than there are weights.
std::vector<float> exact_cdf_from_zero(const std::vector<double>& weights);

/// What light is worth, where paths are allocated to lights, clusters or wavelengths and nothing has been measured.
/// seen: what the eye makes of it, (X + Y + Z) / 3. power: a twentieth of it counts too, so that what the eye hardly
/// sees is still seen.
constexpr double worth(double seen, double power) { return seen + 0.05 * power; }

} // namespace nephroid::tracing
