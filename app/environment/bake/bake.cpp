// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/bake.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace nephroid::environment {
namespace {

// z > 0 is the diamond |u| + |v| < 1 of the square from -1 to 1; z < 0 is folded out into its corners. In a quadrant |u| + |v| = r, where
// r^2 = 1 - |z| is the share of the half sphere that is nearer to the pole, and |v| / r is the azimuth in quarter turns.
glm::dvec2 with_signs(const glm::dvec2& size, const glm::dvec2& signs)
{
  return {std::copysign(size.x, signs.x), std::copysign(size.y, signs.y)};
}

constexpr std::array<int, 3> counts{26, 98, 386};

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

std::span<const int> direction_counts() { return counts; }

std::vector<glm::ivec3> cube_points(int count)
{
  const int m = count == counts[0] ? 1 : count == counts[1] ? 2 : 4;
  std::vector<glm::ivec3> points;
  for (int x = -m; x <= m; ++x)
    for (int y = -m; y <= m; ++y)
      for (int z = -m; z <= m; ++z)
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == m) points.emplace_back(x, y, z);
  return points;
}

std::vector<glm::dvec3> light_directions(int count)
{
  std::vector<glm::dvec3> directions;
  for (const glm::ivec3& point : cube_points(count)) directions.push_back(-glm::normalize(glm::dvec3(point)));
  return directions;
}

std::uint16_t to_half(double value) { return glm::packHalf1x16(static_cast<float>(value)); }

glm::dvec3 Bake::at(std::size_t direction, std::size_t sphere, std::size_t texel) const
{
  const std::size_t first = direction * direction_items() + sphere * sphere_items() + texel * static_cast<std::size_t>(channels);
  const auto channel = [&](std::size_t c) { return unit * static_cast<double>(glm::unpackHalf1x16(halves[first + c])); };
  return channels == 3 ? glm::dvec3(channel(0), channel(1), channel(2)) : glm::dvec3(channel(0));
}

} // namespace nephroid::environment
