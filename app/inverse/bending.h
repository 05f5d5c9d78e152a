// SPDX-License-Identifier: Apache-2.0
// Refraction at a facet, from inside the object to what is around it (thesis section 5.4.1). A slope is how far light
// moves along x and y while it goes one length along -z. Sines are x and y of light's unit direction before the flat
// front; by Snell's law they are also those of n times its unit direction behind it.
#pragma once
#include <glm/glm.hpp>

#include <limits>
#include <optional>

namespace nephroid::inverse {

/// The direction with a slope; unit.
glm::dvec3 direction_of(const glm::dvec2& slope);

/// The unit normal, out of the object, of a surface that turns `in` (inside) into `out` (outside); both unit. By
/// Snell's law n in - out has no part along the surface: n sin theta_1 = sin theta_2. Empty: no surface does, because
/// they are further apart than slope_limit says, or alike.
std::optional<glm::dvec3> facet_normal(const glm::dvec3& in, const glm::dvec3& out, double n);

/// The largest slope that light along -z can be given: the outgoing light, or the light inside, then runs along the
/// surface. The deviation delta has cos delta = min(n, 1 / n).
double slope_limit(double n);

/// The largest slope that the engine uses: near the limit little light leaves, in a thin bundle.
inline constexpr double usable_part = 0.95;
inline double usable_slope(double n) { return usable_part * slope_limit(n); }

/// The slope of light along -z behind a facet that is tilted so far against the front; infinite where the light is
/// reflected totally.
double slope_behind(double tilt_radians, double n);

/// Light inside the object: n times its unit direction. |sines| < min(1, n).
glm::dvec3 light_inside(const glm::dvec2& sines, double n);

/// Its slope there.
glm::dvec2 slope_inside(const glm::dvec2& sines, double n);

inline constexpr double any_steepness = std::numeric_limits<double>::infinity();

/// Between a value that is good and one that is not, the last good one, after so many halvings.
template <class Value, class IsGood>
Value last_good(Value good, Value bad, int halvings, const IsGood& is_good) {
  for (int i = 0; i < halvings; ++i) {
    const Value middle = (good + bad) / 2.0;
    (is_good(middle) ? good : bad) = middle;
  }
  return good;
}

/// The slope behind a flat facet: light goes on as before the front.
glm::dvec2 flat_slope(const glm::dvec2& sines);

/// Whether the deviation from that light to a slope outside is no more than usable_slope(n), and the facet's gradient
/// than `steepest`.
bool reachable(const glm::dvec2& slope, double n, const glm::dvec2& sines = {}, double steepest = any_steepness);
/// The slope itself where it is reachable; else the last on the way to it from flat_slope() that is.
glm::dvec2 nearest_reachable(const glm::dvec2& slope, double n, const glm::dvec2& sines = {},
                             double steepest = any_steepness);

/// dz/dx and dz/dy of the facet that gives light this slope, which is reachable. Its normal is along k - (slope, -1) /
/// sqrt(1 + slope^2), k being light_inside; for light straight on the gradient is -slope / (n sqrt(1 + slope^2) - 1).
glm::dvec2 facet_gradient(const glm::dvec2& slope, double n, const glm::dvec2& sines = {});

/// The other way round: the slope that light gets behind such a facet; where it is totally reflected, that of light
/// along the facet.
glm::dvec2 facet_slope(const glm::dvec2& gradient, double n, const glm::dvec2& sines = {});

/// How much of the light inside leaves through such a facet: 1 minus Fresnel's reflectance.
double transmitted(const glm::dvec2& slope, double n, const glm::dvec2& sines = {});

/// How the slope behind such a facet changes with the sines, and with the index.
struct SlopeChange {
  glm::dmat2 by_sines{1};
  glm::dvec2 by_index{0};
};
SlopeChange slope_change(const glm::dvec2& slope, double n, const glm::dvec2& sines = {});

} // namespace nephroid::inverse
