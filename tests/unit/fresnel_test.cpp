// SPDX-License-Identifier: Apache-2.0
// Snell and Fresnel against closed forms.
#include "optics/fresnel.h"
#include "tests/support/test.h"

namespace nephroid::fresnel_test {

using namespace nephroid::optics;

constexpr double radian = std::numbers::pi / 180;

TEST(Fresnel, NormalIncidenceReflectsTheSquareOfTheQuotient) {
  for (double n : {1.0, 1.33, 1.5168, 1.92286, 2.417, 4.0}) {
    const double r = (n - 1) / (n + 1);
    EXPECT_NEAR(fresnel_reflectance(1, 1, n), r * r, 1e-15) << n;
    EXPECT_NEAR(fresnel_reflectance(1, n, 1), r * r, 1e-15) << n;
  }
}

TEST(Fresnel, SnellsLawHolds) {
  for (double degrees = 0; degrees < 90; degrees += 7.5) {
    const std::optional<double> cos_t = refracted_cosine(std::cos(degrees * radian), 1, 1.5);
    ASSERT_TRUE(cos_t);
    EXPECT_NEAR(1.5 * std::sqrt(1 - *cos_t * *cos_t), std::sin(degrees * radian), 1e-14) << degrees;
  }
}

// At Brewster's angle the two rays are at right angles, light polarised in the plane of incidence is not reflected at
// all, and what is left is half of r_s^2 with r_s = (1 - m^2) / (1 + m^2), m = n_t / n_i.
TEST(Fresnel, BrewstersAngleLeavesOnePolarisation) {
  for (double m : {1.2, 1.5, 1.92286, 1 / 1.5}) {
    const double angle = std::atan(m);
    const double r_s = (1 - m * m) / (1 + m * m);
    EXPECT_NEAR(fresnel_reflectance(std::cos(angle), 1, m), r_s * r_s / 2, 1e-14) << m;
    const std::optional<double> cos_t = refracted_cosine(std::cos(angle), 1, m);
    ASSERT_TRUE(cos_t);
    EXPECT_NEAR(angle + std::acos(*cos_t), std::numbers::pi / 2, 1e-7) << m;
  }
}

TEST(Fresnel, TotalReflectionBeginsAtTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5) / radian;
  EXPECT_LT(fresnel_reflectance(std::cos((critical - 1e-4) * radian), 1.5, 1), 1);
  EXPECT_EQ(fresnel_reflectance(std::cos((critical + 1e-4) * radian), 1.5, 1), 1);
  EXPECT_FALSE(refracted_cosine(std::cos((critical + 1e-4) * radian), 1.5, 1));
}

// The same share is reflected from either side along the same pair of rays: light can go back the way it came.
TEST(Fresnel, ReflectanceIsTheSameBothWays) {
  for (double n : {1.1, 1.33, 1.9, 2.4})
    for (double degrees = 0; degrees < 90; degrees += 3) {
      const double cos_i = std::cos(degrees * radian);
      const std::optional<double> cos_t = refracted_cosine(cos_i, 1, n);
      ASSERT_TRUE(cos_t);
      EXPECT_NEAR(fresnel_reflectance(cos_i, 1, n), fresnel_reflectance(*cos_t, n, 1), 1e-12) << n << " " << degrees;
    }
}

TEST(Fresnel, StaysBetweenNothingAndEverything) {
  EXPECT_EQ(fresnel_reflectance(0, 1, 1.5), 1);
  EXPECT_EQ(fresnel_reflectance(0, 1.5, 1.5), 0);
  for (double ratio : {1e-6, 0.5, 1.0, 2.0, 1e6})
    for (double cosine = 0; cosine <= 1; cosine += 0.01) {
      const double r = fresnel_reflectance(cosine, 1, ratio);
      EXPECT_GE(r, 0) << ratio << " " << cosine;
      EXPECT_LE(r, 1) << ratio << " " << cosine;
    }
}

} // namespace nephroid::fresnel_test
