// SPDX-License-Identifier: Apache-2.0
// Colour against published figures: CIE 015, IEC 61966-2-1, CIELAB.
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "tests/support/test.h"

namespace nephroid::colour_test {

using namespace nephroid::optics;

void expect_near(const Colour& got, const Colour& wanted, double tolerance)
{
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], tolerance) << i;
}

// CIE 1931 2-degree: ybar peaks with 1 at 555 nm; rows 450, 555 and 600 nm of the printed table.
TEST(Colour, ColourMatchingFunctionsAreTheCieTable)
{
  const ColourMatching& cie = cie_1931();
  EXPECT_NEAR(cie.y[555 - first_nm], 1.0, 1e-12);
  EXPECT_NEAR(cie.x[450 - first_nm], 0.3362, 1e-12);
  EXPECT_NEAR(cie.z[450 - first_nm], 1.77211, 1e-12);
  EXPECT_NEAR(cie.x[600 - first_nm], 1.0622, 1e-12);
  EXPECT_NEAR(cie.y[600 - first_nm], 0.631, 1e-12);
}

// The functions have equal areas, 106.86 nm over 380..780 nm.
TEST(Colour, EqualEnergyIsNeutral)
{
  const Colour xyz = to_xyz(constant_spectrum(1));
  expect_near(xyz, {106.86, 106.86, 106.86}, 0.03);
}

TEST(Colour, PrimariesOfSrgbHaveTheirChromaticities)
{
  const double wanted[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
  for (std::size_t i = 0; i < 3; ++i) {
    Colour rgb{};
    rgb[i] = 1;
    const Colour xyz = linear_srgb_to_xyz(rgb);
    const double sum = xyz[0] + xyz[1] + xyz[2];
    EXPECT_NEAR(xyz[0] / sum, wanted[i][0], 1e-4) << i;
    EXPECT_NEAR(xyz[1] / sum, wanted[i][1], 1e-4) << i;
  }
  expect_near(linear_srgb_to_xyz({1, 1, 1}), {0.9505, 1.0, 1.0890}, 1e-12);
}

TEST(Colour, SrgbThereAndBackIsTheIdentityOutsideTheGamutToo)
{
  for (const Colour& xyz : {Colour{0.2, 0.3, 0.4}, Colour{1, 0, 0}, Colour{-0.1, 2, 30}})
    expect_near(linear_srgb_to_xyz(xyz_to_linear_srgb(xyz)), xyz, 1e-13);
  // The inverse that IEC 61966-2-1 prints, to its four digits.
  expect_near(xyz_to_linear_srgb({1, 0, 0}), {3.2406, -0.9689, 0.0557}, 1e-4);
  EXPECT_LT(xyz_to_linear_srgb({0.05, 0.3, 0.3})[0], 0); // a spectral cyan: not clipped
}

TEST(Colour, SrgbEncoding)
{
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_NEAR(srgb_encode(1), 1, 1e-15);
  EXPECT_NEAR(srgb_encode(0.002), 0.02584, 1e-15);
  EXPECT_NEAR(srgb_encode(0.214041140482), 0.5, 1e-9);
  EXPECT_NEAR(srgb_encode(-0.214041140482), -0.5, 1e-9);
}

TEST(Colour, LightnessOfKnownLuminances)
{
  EXPECT_NEAR(lightness(1), 100, 1e-12);
  EXPECT_NEAR(lightness(0.184186518), 50, 1e-6); // ((50 + 16) / 116)^3
  EXPECT_NEAR(lightness(0.001), 0.9033, 1e-4);   // 903.3 Y below .008856
  EXPECT_NEAR(lightness(0), 0, 1e-12);
}

} // namespace nephroid::colour_test
