// SPDX-License-Identifier: Apache-2.0
// The vector form of a facet's normal against the thesis' quadratic, Snell's law and the limit of what a facet can bend.
#include "inverse/bending.h"
#include "tests/support/test.h"

namespace nephroid::bending_test {

glm::dvec3 random_direction(std::mt19937_64& random)
{
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// (5.6) in the plane of both directions, with R = (1, 0) and M = -in: a quadratic of the tangent of the normal's angle. Its roots are the
// two normals that (5.5), Snell's law squared, allows; ours must be one of them.
TEST(Bending, TheVectorFormSolvesTheThesisQuadratic)
{
  std::mt19937_64 random(1);
  int solved = 0;
  for (int i = 0; i < 2000; ++i) {
    const double n = std::uniform_real_distribution<double>(1.1, 2.5)(random);
    const glm::dvec3 in = random_direction(random), out = random_direction(random);
    const auto normal = inverse::facet_normal(in, out, n);
    if (!normal) continue;
    ++solved;
    const double mx = -glm::dot(in, out), my = std::sqrt(1 - mx * mx), eta2 = n * n;
    const double a1 = (eta2 * mx * mx - 1) / (eta2 - 1), a2 = 2 * eta2 * mx * my / (eta2 - 1), a3 = eta2 * my * my / (eta2 - 1);
    const glm::dvec3 across = glm::normalize(-in - mx * out); // M's part across R: the second axis
    const double x = glm::dot(*normal, out), y = glm::dot(*normal, across);
    EXPECT_NEAR(a1 * x * x + a2 * x * y + a3 * y * y, 1, 1e-9);                         // (5.5)
    EXPECT_NEAR((2 * a3 - 2) * y * y + 2 * a2 * x * y + (2 * a1 - 2) * x * x, 0, 1e-9); // (5.6) times cos^2
  }
  EXPECT_GT(solved, 200);
}

// The quadratic is 0 = 0 for light that goes straight on; the vector form is not.
TEST(Bending, UndeviatedLightHasAFlatFacet)
{
  const glm::dvec3 down{0, 0, -1};
  for (const double n : {1.0001, 1.5, 0.7}) EXPECT_NEAR(glm::length(*inverse::facet_normal(down, down, n) - down), 0, 1e-12) << n;
}

TEST(Bending, AFacetsNormalRefractsToItsSlope)
{
  for (const double n : {0.7, 1.33, 1.5, 2.4})
    for (const double part : {0.01, 0.5, 0.99}) {
      const glm::dvec2 slope = part * inverse::slope_limit(n) * glm::dvec2(0.6, -0.8);
      const glm::dvec3 normal = *inverse::facet_normal({0, 0, -1}, inverse::direction_of(slope), n);
      const glm::dvec3 refracted = glm::refract(glm::dvec3(0, 0, -1), -normal, n); // GLSL's own
      EXPECT_NEAR(glm::length(refracted - inverse::direction_of(slope)), 0, 1e-9) << n << " " << part;
      // The gradient lies in the facet: (1, 0, dz/dx) is across the normal.
      const glm::dvec2 g = inverse::facet_gradient(slope, n);
      EXPECT_NEAR(glm::dot(normal, glm::dvec3(1, 0, g.x)), 0, 1e-12);
      EXPECT_NEAR(glm::dot(normal, glm::dvec3(0, 1, g.y)), 0, 1e-12);
    }
}

// n = 1.5: cos delta = 2 / 3, tan delta = sqrt(5) / 2.
TEST(Bending, SlopesEndWhereLightRunsAlongTheFacet)
{
  EXPECT_NEAR(inverse::slope_limit(1.5), std::sqrt(5.0) / 2, 1e-12);
  for (const double n : {0.7, 1.5, 2.4}) {
    const glm::dvec2 limit{inverse::slope_limit(n), 0};
    EXPECT_TRUE(inverse::facet_normal({0, 0, -1}, inverse::direction_of(0.999 * limit), n)) << n;
    EXPECT_FALSE(inverse::facet_normal({0, 0, -1}, inverse::direction_of(1.001 * limit), n)) << n;
    EXPECT_LT(inverse::transmitted(0.9999 * limit, n), 0.2) << n;
  }
  EXPECT_NEAR(inverse::transmitted({0, 0}, 1.5), 0.96, 1e-12); // ((n - 1) / (n + 1))^2 is reflected
}

} // namespace nephroid::bending_test
