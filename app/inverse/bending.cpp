// SPDX-License-Identifier: Apache-2.0
#include "inverse/bending.h"

#include "optics/fresnel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {

glm::dvec3 direction_of(const glm::dvec2& slope) { return glm::normalize(glm::dvec3(slope, -1)); }

std::optional<glm::dvec3> facet_normal(const glm::dvec3& in, const glm::dvec3& out, double n)
{
  glm::dvec3 normal = n * in - out;
  if (n < 1) normal = -normal; // out of the object is the way that light goes
  const double length = glm::length(normal);
  if (!(length > 0 && glm::dot(normal, in) > 0 && glm::dot(normal, out) > 0)) return std::nullopt;
  return normal / length;
}

double slope_limit(double n)
{
  const double cosine = std::min(n, 1 / n);
  return std::sqrt(1 - cosine * cosine) / cosine;
}

double slope_behind(double tilt_radians, double n)
{
  const double sine = n * std::sin(tilt_radians);
  return sine < 1 ? std::tan(std::abs(std::asin(sine) - tilt_radians)) : std::numeric_limits<double>::infinity();
}

glm::dvec2 facet_gradient(const glm::dvec2& slope, double n) { return -slope / (n * std::sqrt(1 + glm::dot(slope, slope)) - 1); }

glm::dvec2 facet_slope(const glm::dvec2& gradient, double n)
{
  const double steepness = glm::length(gradient);
  if (steepness == 0) return {0, 0};
  const double slope = std::min(slope_behind(std::atan(steepness), n), slope_limit(n));
  return gradient / steepness * (n > 1 ? -slope : slope);
}

double transmitted(const glm::dvec2& slope, double n)
{
  const std::optional<glm::dvec3> normal = facet_normal({0, 0, -1}, direction_of(slope), n);
  return normal ? 1 - optics::fresnel_reflectance(-normal->z, n, 1) : 0;
}

} // namespace nephroid::inverse
