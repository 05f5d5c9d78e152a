// SPDX-License-Identifier: Apache-2.0
// z > 0 is the diamond |u| + |v| < 1 of the square from -1 to 1; z < 0 is folded out into its corners. In a quadrant |u| + |v| = r, where
// r^2 = 1 - |z| is the share of the half sphere that is nearer to the pole, and |v| / r is the azimuth in quarter turns.
#include "environment/bake/sphere_map.h"

#include <algorithm>
#include <cmath>

namespace nephroid::environment {
namespace {

glm::dvec2 with_signs(const glm::dvec2& size, const glm::dvec2& signs)
{
  return {std::copysign(size.x, signs.x), std::copysign(size.y, signs.y)};
}

} // namespace

std::size_t SphereMap::texel(const glm::dvec3& direction) const
{
  const glm::dvec3 d = glm::abs(direction) / glm::length(direction);
  const double r = std::sqrt((d.x * d.x + d.y * d.y) / (1 + d.z));
  const double v = r * std::atan2(d.y, d.x) * (2 / std::numbers::pi), u = r - v;
  const glm::dvec2 folded = direction.z < 0 ? glm::dvec2(1 - v, 1 - u) : glm::dvec2(u, v);
  const glm::dvec2 place = (0.5 + 0.5 * with_signs(folded, glm::dvec2(direction))) * static_cast<double>(side);
  const int column = std::clamp(static_cast<int>(place.x), 0, side - 1), row = std::clamp(static_cast<int>(place.y), 0, side - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) + static_cast<std::size_t>(column);
}

glm::dvec3 SphereMap::direction(std::size_t texel) const
{
  const auto n = static_cast<std::size_t>(side);
  const glm::dvec2 place = (glm::dvec2(texel % n, texel / n) + 0.5) * (2.0 / side) - 1.0, size = glm::abs(place);
  const double height = 1 - size.x - size.y, r = 1 - std::abs(height); // above 0: the upper half
  const double azimuth = r > 0 ? ((size.y - size.x) / r + 1) * std::numbers::pi / 4 : 0;
  const double sine = r * std::sqrt(2 - r * r);
  return {with_signs({std::cos(azimuth) * sine, std::sin(azimuth) * sine}, place), std::copysign(1 - r * r, height)};
}

} // namespace nephroid::environment
