// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace nephroid::environment {
namespace {

constexpr std::array<int, 3> counts{26, 98, 386};

} // namespace

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

} // namespace nephroid::environment
