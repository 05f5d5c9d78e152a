// SPDX-License-Identifier: Apache-2.0
// Targets: spheres that together enclose every caustic object, as tightly as a few spheres can.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::tracing {

inline constexpr std::size_t max_targets = MAX_TARGETS;

/// At most max_targets spheres that hold all dielectric and mirror objects. An object is cut into pieces as long as
/// that makes the spheres' shadow smaller: with one sphere, two of three photons miss a bunny.
std::vector<scene::Sphere> caustic_targets(const scene::Scene& scene);

/// One sphere about the whole scene and every light, so that a light sends its photons wherever it shines.
scene::Sphere everything(const scene::Scene& scene);

/// The area of the shadow that the spheres cast together: the mean over directions, in square units, to about 2 %.
double mean_shadow(const std::vector<scene::Sphere>& spheres);

} // namespace nephroid::tracing
