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

// At normal incidence R = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2); without k a metal is glass that nothing passes.
TEST(Conductor, HasItsClosedForms) {
  for (const double n : {0.2, 1.0, 2.5})
    for (const double k : {0.5, 3.0, 7.0})
      EXPECT_NEAR(conductor_reflectance(1, 1, {n, k}), ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k),
                  1e-14);
  for (double degrees = 0; degrees < 90; degrees += 7.5)
    EXPECT_NEAR(conductor_reflectance(std::cos(degrees * radian), 1, {1.5, 0}),
                fresnel_reflectance(std::cos(degrees * radian), 1, 1.5), 1e-14);
  EXPECT_NEAR(conductor_reflectance(0.3, 1.5, {0.3, 4.5}), conductor_reflectance(0.3, 1, {0.2, 3}), 1e-14);
}

// A layer of a quarter of its wavelength turns light round: with n_layer^2 = n_t nothing is reflected. Half a
// wavelength does nothing, and so does no layer, before and beyond the critical angle of the layer.
TEST(Coating, QuarterAndHalfOfAWavelength) {
  EXPECT_NEAR(coated_reflectance(1, 1, std::sqrt(1.5), 1.5, 0.25 / std::sqrt(1.5)), 0, 1e-15);
  const double quarter = coated_reflectance(1, 1, 1.38, 1.52, 0.25 / 1.38), n2 = 1.38 * 1.38;
  EXPECT_NEAR(quarter, std::pow((1.52 - n2) / (1.52 + n2), 2), 1e-15);
  EXPECT_NEAR(coated_reflectance(1, 1, 1.38, 1.52, 0.5 / 1.38), fresnel_reflectance(1, 1, 1.52), 1e-15);
  for (const double cosine : {1.0, 0.7, 0.2})
    for (const double layer : {1.0, 1.38, 2.4}) {
      EXPECT_NEAR(coated_reflectance(cosine, 1.6, layer, 1.9, 0), fresnel_reflectance(cosine, 1.6, 1.9), 1e-14);
      EXPECT_NEAR(coated_reflectance(cosine, 1.9, layer, 1.9, 0), 0, 1e-14);
    }
}

// A gap of air in glass reflects all light beyond its critical angle, unless it is narrow: then light tunnels.
TEST(Coating, LightTunnelsThroughANarrowGap) {
  const double cosine = std::cos(60 * radian);
  double before = 0;
  for (const double gap : {0.05, 0.1, 0.3, 1.0}) {
    const double reflectance = coated_reflectance(cosine, 1.5, 1, 1.5, gap);
    EXPECT_GT(reflectance, before) << gap;
    before = reflectance;
  }
  EXPECT_GT(before, 0.9999);
  EXPECT_LT(coated_reflectance(cosine, 1.5, 1, 1.5, 0.05), 0.2);
}

} // namespace nephroid::fresnel_test
