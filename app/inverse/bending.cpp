// SPDX-License-Identifier: Apache-2.0
#include "inverse/bending.h"

#include "optics/fresnel.h"

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {

glm::dvec3 direction_of(const glm::dvec2& slope) { return glm::normalize(glm::dvec3(slope, -1)); }

std::optional<glm::dvec3> facet_normal(const glm::dvec3& in, const glm::dvec3& out, double n) {
  glm::dvec3 normal = n * in - out;
  if (n < 1) normal = -normal; // out of the object is the way that light goes
  const double length = glm::length(normal);
  if (!(length > 0 && glm::dot(normal, in) > 0 && glm::dot(normal, out) > 0)) return std::nullopt;
  return normal / length;
}

double slope_limit(double n) {
  if (n < 0) return std::numeric_limits<double>::infinity();
  const double cosine = std::min(n, 1 / n);
  return std::sqrt(1 - cosine * cosine) / cosine;
}

double slope_behind(double tilt_radians, double n) {
  const double sine = n * std::sin(tilt_radians);
  return sine < 1 ? std::tan(std::abs(std::asin(sine) - tilt_radians)) : std::numeric_limits<double>::infinity();
}

glm::dvec3 light_inside(const glm::dvec2& sines, double n) {
  return {sines, -std::copysign(std::sqrt(n * n - glm::dot(sines, sines)), n)};
}

glm::dvec2 slope_inside(const glm::dvec2& sines, double n) { return sines / -light_inside(sines, n).z; }

glm::dvec2 facet_slope(const glm::dvec2& gradient, double n, const glm::dvec2& sines) {
  const glm::dvec3 in = light_inside(sines, n), normal = glm::normalize(glm::dvec3(gradient, -1));
  const double along = glm::dot(in, normal);
  const glm::dvec3 out = in - (along - std::sqrt(std::max(0.0, 1 - n * n + along * along))) * normal;
  return glm::dvec2(out) / std::max(-out.z, 1e-3);
}

glm::dvec2 flat_slope(const glm::dvec2& sines) { return sines / std::sqrt(1 - glm::dot(sines, sines)); }

glm::dvec3 unturned(const glm::dvec2& sines, double n) {
  return n < 0 ? direction_of(flat_slope(sines)) : light_inside(sines, n) / n;
}

bool reachable(const glm::dvec2& slope, double n, const glm::dvec2& sines, double steepest) {
  const double n2 = n > 1 ? n * n : 1 / (n * n), most2 = usable_part * usable_part * (n2 - 1); // usable_slope squared
  if (n < 0) { // its steepness is its only limit
  } else if (sines == glm::dvec2(0)) {
    if (glm::dot(slope, slope) > most2) return false;
  } else {
    const double cosine = glm::dot(light_inside(sines, n), direction_of(slope)) / n;
    if (cosine <= 0 || cosine * cosine * (1 + most2) < 1) return false;
  }
  if (steepest == any_steepness) return true;
  const glm::dvec2 g = facet_gradient(slope, n, sines);
  return glm::dot(g, g) <= steepest * steepest;
}

glm::dvec2 nearest_reachable(const glm::dvec2& slope, double n, const glm::dvec2& sines, double steepest) {
  if (reachable(slope, n, sines, steepest)) return slope;
  return last_good(flat_slope(sines), slope, 50,
                   [&](const glm::dvec2& middle) { return reachable(middle, n, sines, steepest); });
}

glm::dvec2 facet_gradient(const glm::dvec2& slope, double n, const glm::dvec2& sines) {
  const glm::dvec3 along = light_inside(sines, n) - direction_of(slope);
  return -glm::dvec2(along) / along.z;
}

double transmitted(const glm::dvec2& slope, double n, const glm::dvec2& sines) {
  if (n < 0) return 1;
  const glm::dvec3 in = light_inside(sines, n) / n;
  const std::optional<glm::dvec3> normal = facet_normal(in, direction_of(slope), n);
  return normal ? 1 - optics::fresnel_reflectance(std::min(1.0, glm::dot(*normal, in)), n, 1) : 0;
}

// Snell's law for the unit normal N out of the object: out = k - (k.N - c) N with c^2 = 1 - k^2 + (k.N)^2. So for a
// change dk of k and dn of |k|, c dc = -n dn + (k.N) (dk.N) and dout = dk - (dk.N - dc) N; k_z = -sqrt(n^2 - sines^2).
SlopeChange slope_change(const glm::dvec2& slope, double n, const glm::dvec2& sines) {
  const glm::dvec3 k = light_inside(sines, n), out = direction_of(slope);
  const std::optional<glm::dvec3> normal = facet_normal(k / n, out, n);
  if (!normal) return {};
  const double along = glm::dot(k, *normal), c = glm::dot(out, *normal);
  const auto change = [&](const glm::dvec3& dk, double dn) {
    const double dk_n = glm::dot(dk, *normal), dc = (along * dk_n - n * dn) / c;
    const glm::dvec3 dout = dk - (dk_n - dc) * *normal;
    return -(glm::dvec2(dout) + slope * dout.z) / out.z;
  };
  SlopeChange result;
  result.by_sines[0] = change({1, 0, -sines.x / k.z}, 0);
  result.by_sines[1] = change({0, 1, -sines.y / k.z}, 0);
  result.by_index = change({0, 0, n / k.z}, 1);
  return result;
}

} // namespace nephroid::inverse
