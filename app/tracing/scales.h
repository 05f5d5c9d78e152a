// SPDX-License-Identifier: Apache-2.0
// Scales: how many quanta of a film's or counter's fixed point a unit has. A usual value lies in the middle of 63 bits,
// so values may be far brighter or fainter. All scales are powers of two, so that they round nothing.
#pragma once
#include "base/exact_cdf.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::tracing {

/// 1 for a value that is not positive or not finite.
double power_of_two_below(double value);

/// The sphere about the box about all triangles.
scene::Sphere scene_bounds(const scene::Scene& scene);
/// The lowest and the highest corner; without points both are 0.
std::array<glm::vec3, 2> box_about(const std::vector<glm::vec3>& points);

/// The quanta per unit of XYZ radiance in a film of splats. A photon with a mean share of `watts` has 2^16 on a surface
/// as far away as the scene's middle. It reaches the limit, 2^42, 8000 times nearer. photons: those of one pass.
double splat_scale(const scene::Scene& scene, unsigned photons, double watts);

/// The quanta per watt in energy counters. The power of one pass has 2^40, so 2^20 passes fit into 63 bits.
double energy_scale(double watts);
/// The mean of an energy counter over `passes`, which includes the part of the pass in hand; 0 before the first.
double mean_watts(std::int64_t quanta, double quanta_per_watt, double passes);

/// The worth of light, by which paths are divided before anything is measured. seen: what the eye makes of it, (X + Y +
/// Z) / 3. power: a twentieth of it counts too, so that light which the eye hardly sees has paths.
constexpr double worth(double seen, double power) { return seen + 0.05 * power; }

} // namespace nephroid::tracing
