// SPDX-License-Identifier: Apache-2.0
// The smooth part of an environment's irradiance: closed forms of maps of the first three degrees, all light of made maps, turned maps.
#include "environment/light/irradiance.h"
#include "tests/support/test.h"

#include "environment/segment/quality.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tests/environment/maps.h"

namespace nephroid::irradiance_test {

using namespace nephroid::environment;

constexpr int some = 64; ///< normals, even on the sphere

/// As kernels/environment/shade.cl, for a unit normal.
glm::dvec3 irradiance(const IrradiancePolynomial& p, const glm::dvec3& n)
{
  return p[0] + n.x * p[1] + n.y * p[2] + n.z * p[3] + n.x * n.x * p[4] + n.y * n.y * p[5] + n.z * n.z * p[6] + n.x * n.y * p[7] +
         n.y * n.z * p[8] + n.z * n.x * p[9];
}

TEST(Irradiance, OfAnEvenMapIsPiTimesItsRadiance)
{
  scene::Environment map = test::uniform_map(64, 32, {0.2, 1, 3});
  map.radiance = 7;
  const IrradiancePolynomial polynomial = irradiance_polynomial(irradiance_moments(make_cube_map(map)), 0);
  double largest = 0;
  for (int i = 0; i < some; ++i) {
    const glm::dvec3 part =
        irradiance(polynomial, scene::even_direction(i, some)) / (7 * pi * glm::dvec3(map.rgb[0], map.rgb[1], map.rgb[2]));
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(part[c] - 1));
  }
  fmt::print("an even map: {:.2g} off at most\n", largest);
  EXPECT_LT(largest, 2e-5); // its texels are shared out to the cube's in single steps of a grid
}

/// A cube whose texels have radiance of(direction of their middle).
template <class Of>
CubeMap made_cube(int size, const Of& of)
{
  CubeMap cube{size, {}};
  for (int face = 0; face < face_count; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const glm::dvec3 rgb = of(glm::normalize(position({face, middle(x, size), middle(y, size)})));
        for (int c = 0; c < 3; ++c) cube.flux.push_back(rgb[c] * solid_angle({x, y, x + 1, y + 1}, size));
      }
  return cube;
}

// Ramamoorthi and Hanrahan 2001: the irradiance has pi of the mean, 2 pi / 3 of the first degree and pi / 4 of the second.
TEST(Irradiance, OfTheFirstThreeDegrees)
{
  const glm::dvec3 a(0.3, -0.5, 0.2);
  const glm::dmat3 symmetric(glm::dvec3(0.4, 0.1, -0.2), glm::dvec3(0.1, -0.3, 0.25), glm::dvec3(-0.2, 0.25, -0.1)); // its trace is 0
  const CubeMap cube = made_cube(128, [&](const glm::dvec3& n) {
    return glm::dvec3(1 + glm::dot(a, n), 1 + glm::dot(n, symmetric * n), 2 + glm::dot(a, n) - glm::dot(n, symmetric * n));
  });
  const IrradiancePolynomial polynomial = irradiance_polynomial(irradiance_moments(cube), 0);
  double largest = 0;
  for (int i = 0; i < some; ++i) {
    const glm::dvec3 n = scene::even_direction(i, some);
    const double first = 2 * pi / 3 * glm::dot(a, n), second = pi / 4 * glm::dot(n, symmetric * n);
    const glm::dvec3 off = irradiance(polynomial, n) - glm::dvec3(pi + first, pi + second, 2 * pi + first - second);
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(off[c]));
  }
  fmt::print("first three degrees: {:.2g} W/m^2 off at most, of 3\n", largest);
  EXPECT_LT(largest, 1e-4); // texels of 1/64 count as their middles
}

// What higher degrees bring is left out: about 1 % on the whole of a natural map, more where one small lamp has all light.
TEST(Irradiance, OfMadeMaps)
{
  for (const test::NamedMap& named : test::synthetic_maps(128)) {
    const CubeMap cube = make_cube_map(named.map);
    const std::vector<glm::dvec3> truth = irradiances(cube, some);
    const IrradiancePolynomial polynomial = irradiance_polynomial(irradiance_moments(cube), 0);
    double mean = 0;
    std::vector<double> off;
    for (int i = 0; i < some; ++i) {
      const glm::dvec3 expected = truth[static_cast<std::size_t>(i)];
      mean += expected.y / some;
      off.push_back(std::abs(irradiance(polynomial, scene::even_direction(i, some)).y - expected.y));
    }
    std::ranges::sort(off);
    fmt::print("{}: of the mean irradiance {:.2f} % off in the median, {:.2f} % at most\n", named.name, 100 * off[some / 2] / mean,
               100 * off.back() / mean);
    // max(t, 0) less its first three degrees is 3/32 at t = 0, where a lamp is that has all light, and its irradiance is 1/4 in the mean.
    EXPECT_LT(off.back(), 0.38 * mean);
    EXPECT_LT(off[some / 2], 0.2 * mean);
  }
}

TEST(Irradiance, OfATurnedMapIsThatOfTurnedNormals)
{
  const CubeMap cube = make_cube_map(test::synthetic_maps(64)[1].map);
  const IrradiancePolynomial as_it_lies = irradiance_polynomial(irradiance_moments(cube), 0);
  for (const double rotate_deg : {-300.0, 35.0, 90.0, 180.0}) {
    const IrradiancePolynomial by_turn = irradiance_polynomial(irradiance_moments(cube), rotate_deg);
    for (int i = 0; i < some; ++i) {
      const glm::dvec3 n = scene::even_direction(i, some), expected = irradiance(as_it_lies, n);
      EXPECT_LT(glm::distance(irradiance(by_turn, turned(n, rotate_deg)), expected), 1e-10 * glm::length(expected)) << rotate_deg;
    }
  }
}

// A lamp at +x, turned by a quarter to the left as seen from above, is at -z: rotate_deg as scene::Environment has it.
TEST(Irradiance, TurnsToTheLeft)
{
  const CubeMap cube = made_cube(16, [](const glm::dvec3& n) { return glm::dvec3(n.x > 0.9); });
  const IrradiancePolynomial polynomial = irradiance_polynomial(irradiance_moments(cube), 90);
  EXPECT_GT(irradiance(polynomial, {0, 0, -1}).y, 10 * std::abs(irradiance(polynomial, {0, 0, 1}).y));
  EXPECT_GT(irradiance(polynomial, {0, 0, -1}).y, 2 * irradiance(polynomial, {1, 0, 0}).y);
}

} // namespace nephroid::irradiance_test
