// SPDX-License-Identifier: Apache-2.0
// Closed forms of engine 2, for `nephroid check` and tests: what spheres about a ball get, by rays in double precision.
#pragma once
#include "check/check.h"
#include "environment/bake/bake.h"
#include "optics/fresnel.h"

#include <functional>
#include <vector>

namespace nephroid::environment {

/// The rays that leave a ball of radius 1, or an object in such a ball, for a ray that meets it at height h.
using RaysOfHeight = std::function<std::vector<optics::BallRay>(double h)>;

/// The rays of a ball of index n, without those reflected inside more than `inner_most` times.
RaysOfHeight ball_rays(double n, int inner_most = 10);

/// E r^2 over size^2 (Bake::at) in each texel of the sphere of radius r, for light along `light`, a unit vector: the
/// power of rings of equal width, each at as many azimuths, goes to the texels where the rays cross the sphere.
std::vector<double> ball_map(const SphereMap& map, const glm::dvec3& light, double r, const RaysOfHeight& rays_of,
                             int rings = 1500, int azimuths = 720);

/// Where a ray that has left the ball crosses the sphere of radius r, in the plane of optics::BallRay.
glm::dvec2 crossing(const optics::BallRay& ray, double r);

/// Runs the kernels that bake.
check::Checks closed_forms();

} // namespace nephroid::environment
