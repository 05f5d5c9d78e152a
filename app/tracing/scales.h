// SPDX-License-Identifier: Apache-2.0
// How many quanta of a film's or counter's fixed point a unit has. A usual value lies in the middle of 63 bits, so values may be far
// brighter or fainter. All scales are powers of two, so that they round nothing.
#pragma once
#include "scene/scene.h"

#include <cstdint>

namespace nephroid::tracing {

/// 1 for what is not positive or not finite.
double power_of_two_below(double value);

/// About the box about all triangles.
scene::Sphere scene_bounds(const scene::Scene& scene);

/// Of a film of splats, quanta per unit of XYZ radiance. A photon with a mean share of `watts` has 2^16 on a surface as far away as the
/// scene's middle. The limit of one photon is 2^42 (kernels/tracing/film.h), which it has 8000 times nearer. photons: of one pass.
double splat_scale(const scene::Scene& scene, unsigned photons, double watts);

/// Of energy counters, quanta per watt: 2^40 for the power of one pass; 2^20 passes fit into 63 bits.
double energy_scale(double watts);
/// The mean of such a counter over so many passes, the part of the one in hand included; 0 before the first.
double mean_watts(std::int64_t quanta, double quanta_per_watt, double passes);

} // namespace nephroid::tracing
