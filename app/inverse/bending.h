// SPDX-License-Identifier: Apache-2.0
// Refraction at a facet, from inside the object to what is around it (thesis section 5.4.1). A slope is how far light moves along x and y
// while it goes one length along -z.
#pragma once
#include <glm/glm.hpp>

#include <optional>

namespace nephroid::inverse {

/// The direction with a slope; unit.
glm::dvec3 direction_of(const glm::dvec2& slope);

/// The unit normal, out of the object, of a surface that turns `in` (inside) into `out` (outside); both unit. By Snell's law
/// n in - out has no part along the surface: n sin theta_1 = sin theta_2. Empty: no surface does, because they are further apart than
/// slope_limit says, or alike.
std::optional<glm::dvec3> facet_normal(const glm::dvec3& in, const glm::dvec3& out, double n);

/// The largest slope that light along -z can be given: the outgoing light, or the light inside, then runs along the surface.
/// The deviation delta has cos delta = min(n, 1 / n).
double slope_limit(double n);

/// The largest slope that the engine uses: near the limit little light leaves, in a thin bundle.
inline constexpr double usable_part = 0.95;
inline double usable_slope(double n) { return usable_part * slope_limit(n); }

/// The slope of light along -z behind a facet that is tilted so far against the front; infinite where the light is reflected totally.
double slope_behind(double tilt_radians, double n);

/// dz/dx and dz/dy of the facet that gives light along -z this slope, which is below the limit. Where z rises by (g . p) over p, that is
/// g = -slope / (n sqrt(1 + slope^2) - 1).
glm::dvec2 facet_gradient(const glm::dvec2& slope, double n);

/// The other way round: the slope that light along -z gets behind such a facet; the limit where it is totally reflected.
glm::dvec2 facet_slope(const glm::dvec2& gradient, double n);

/// How much of the light inside leaves through such a facet: 1 minus Fresnel's reflectance.
double transmitted(const glm::dvec2& slope, double n);

} // namespace nephroid::inverse
