// SPDX-License-Identifier: Apache-2.0
// Refraction at a facet, from inside the object to what is around it (thesis section 5.4.1). A slope is how far light
// moves along x and y while it goes one length along -z. Sines are x and y of light's unit direction before the flat
// front; by Snell's law they are also those of n times its unit direction behind it.
//
// A mirror is an object of the index -1 (Welford 1974, Aberrations of the Symmetrical Optical System), without a front:
// Snell's law becomes that of reflection. Its light comes from below, along +z; it is written down folded at z = 0, as
// if it came from above. So n times the unit direction "inside" is the true direction of the light, and slopes inside
// are those of its true way.
#pragma once
#include <glm/glm.hpp>

#include <limits>
#include <optional>

namespace nephroid::inverse {

glm::dvec3 direction_of(const glm::dvec2& slope);

/// The unit normal, out of the object, of a surface that turns one unit vector, inside, into another: by Snell's law
/// n in - out has no part along the surface. Empty where the two are further apart than slope_limit allows, or alike.
std::optional<glm::dvec3> facet_normal(const glm::dvec3& in, const glm::dvec3& out, double n);

/// The largest slope that light along -z can be given; light in- or outside then runs along the surface. Infinite for a
/// mirror.
double slope_limit(double n);

/// The part of slope_limit() that the engine uses: near the limit little light leaves, in a thin bundle.
inline constexpr double usable_part = 0.95;
inline double usable_slope(double n) { return usable_part * slope_limit(n); }

/// The slope of light along -z behind a facet with this tilt against the front; infinite: it is reflected totally.
double slope_behind(double tilt_radians, double n);

/// n times the unit direction of light inside the object; |sines| < min(1, |n|).
glm::dvec3 light_inside(const glm::dvec2& sines, double n);

glm::dvec2 slope_inside(const glm::dvec2& sines, double n);

inline constexpr double any_steepness = std::numeric_limits<double>::infinity();

inline constexpr double mirror_index = -1;
/// The gradient of the steepest facet of a mirror, which turns light along -z by 53 degrees: a slope of 4/3.
inline constexpr double steepest_mirror = 0.5;

/// The last good value between a good one and one that is not, after this many halvings.
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

/// Where light goes from which a facet turns it by at most usable_slope(n): on as inside the object, or back from a
/// flat mirror.
glm::dvec3 unturned(const glm::dvec2& sines, double n);

/// Whether light inside deviates to this slope by at most usable_slope(n), with a facet of at most this gradient.
bool reachable(const glm::dvec2& slope, double n, const glm::dvec2& sines = {}, double steepest = any_steepness);
/// The slope itself where it is reachable; else the last reachable one on the way to it from flat_slope().
glm::dvec2 nearest_reachable(const glm::dvec2& slope, double n, const glm::dvec2& sines = {},
                             double steepest = any_steepness);

/// dz/dx and dz/dy of the facet that gives light this slope, which must be reachable. Its normal is along light_inside
/// - direction_of(slope). For light straight on the gradient is -slope / (n sqrt(1 + slope^2) - 1).
glm::dvec2 facet_gradient(const glm::dvec2& slope, double n, const glm::dvec2& sines = {});

/// The inverse of facet_gradient(). Where light is totally reflected, the slope is that of light along the facet.
glm::dvec2 facet_slope(const glm::dvec2& gradient, double n, const glm::dvec2& sines = {});

/// The part of the light inside that leaves through such a facet: 1 minus Fresnel's reflectance. 1 for a mirror.
double transmitted(const glm::dvec2& slope, double n, const glm::dvec2& sines = {});

/// The derivatives of the slope behind a facet, by the sines and by the index.
struct SlopeChange {
  glm::dmat2 by_sines{1};
  glm::dvec2 by_index{0};
};
SlopeChange slope_change(const glm::dvec2& slope, double n, const glm::dvec2& sines = {});

} // namespace nephroid::inverse
