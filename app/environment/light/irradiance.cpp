// SPDX-License-Identifier: Apache-2.0
#include "environment/light/irradiance.h"

namespace nephroid::environment {

IrradianceMoments irradiance_moments(const CubeMap& cube)
{
  IrradianceMoments moments;
  for (int face = 0; face < face_count; ++face)
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) {
        const glm::dvec3 from = glm::normalize(position({face, middle(x, cube.size), middle(y, cube.size)})),
                         f = cube.flux_of(cube.texel(face, x, y));
        moments.flux += f;
        for (int c = 0; c < 3; ++c) {
          const auto i = static_cast<std::size_t>(c);
          moments.first[i] += f[c] * from;
          moments.second[i] += f[c] * glm::outerProduct(from, from);
        }
      }
  return moments;
}

IrradiancePolynomial irradiance_polynomial(const IrradianceMoments& moments, double rotate_deg)
{
  const glm::dmat3 turn(turned({1, 0, 0}, rotate_deg), turned({0, 1, 0}, rotate_deg), turned({0, 0, 1}, rotate_deg));
  IrradiancePolynomial polynomial{};
  polynomial[0] = 3.0 / 32 * moments.flux;
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const glm::dvec3 v = 0.5 * (turn * moments.first[i]);
    const glm::dmat3 m = 15.0 / 32 * (turn * moments.second[i] * glm::transpose(turn));
    const std::array<double, 9> factors{v.x, v.y, v.z, m[0][0], m[1][1], m[2][2], 2 * m[0][1], 2 * m[1][2], 2 * m[2][0]};
    for (std::size_t k = 0; k < factors.size(); ++k) polynomial[k + 1][c] = factors[k];
  }
  return polynomial;
}

} // namespace nephroid::environment
