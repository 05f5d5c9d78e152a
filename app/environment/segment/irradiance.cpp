// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/irradiance.h"

#include "base/parallel.h"
#include "scene/ray.h"

#include <algorithm>
#include <cmath>

namespace nephroid::environment {
namespace {

/// The sum over a block of texels of flux times unit direction, for each channel.
using AxisMoments = glm::dmat3;

constexpr int blocks_along = 128; // along a face: a block is as small as a texel of the smallest cube

/// A block keeps the sum over its directions, so a plane gets the exact light of every block that it does not cut.
std::vector<AxisMoments> blocks_of(const CubeMap& cube) {
  const int side = (cube.size + blocks_along - 1) / blocks_along;
  std::vector<AxisMoments> blocks;
  for (int face = 0; face < face_count; ++face)
    for (int top = 0; top < cube.size; top += side)
      for (int left = 0; left < cube.size; left += side) {
        AxisMoments sum(0);
        for (int y = top; y < std::min(top + side, cube.size); ++y)
          for (int x = left; x < std::min(left + side, cube.size); ++x) {
            const glm::dvec3 direction = glm::normalize(position({face, middle(x, cube.size), middle(y, cube.size)}));
            sum += glm::outerProduct(direction, cube.flux_of(cube.texel(face, x, y)));
          }
        if (sum != AxisMoments(0)) blocks.push_back(sum);
      }
  return blocks;
}

/// E(n) = sum of max(0, n . moment).
glm::dvec3 irradiance(const std::vector<AxisMoments>& blocks, const glm::dvec3& normal) {
  glm::dvec3 sum{0};
  for (const AxisMoments& block : blocks) sum += glm::max(normal * block, glm::dvec3(0));
  return sum;
}

} // namespace

std::vector<glm::dvec3> irradiances(const CubeMap& cube, int normals) {
  const std::vector<AxisMoments> blocks = blocks_of(cube);
  std::vector<glm::dvec3> result(static_cast<std::size_t>(normals));
  for_blocks(result.size(), [&](std::size_t i) {
    result[i] = irradiance(blocks, scene::even_direction(static_cast<int>(i), normals));
  });
  return result;
}

double irradiance_error(const std::vector<glm::dvec3>& truth, const Segmentation& segmentation) {
  std::vector<AxisMoments> lights;
  for (const Region& region : segmentation.lights) lights.push_back(glm::outerProduct(region.direction, region.flux));
  double differences = 0, squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const glm::dvec3 normal = scene::even_direction(static_cast<int>(i), static_cast<int>(truth.size()));
    const glm::dvec3 difference = irradiance(lights, normal) - truth[i];
    differences += glm::dot(difference, difference);
    squares += glm::dot(truth[i], truth[i]);
  }
  return squares > 0 ? std::sqrt(differences / squares) : 0;
}

} // namespace nephroid::environment
