// SPDX-License-Identifier: Apache-2.0
// Light spectra and reflectances against published figures: white points of CIE 015, Planck's law, the ColorChecker.
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "tests/support/errors.h"

namespace nephroid::spectrum_test {

using namespace nephroid::optics;
using Rows = std::vector<std::array<double, 2>>;

double sum(const Spectrum& s) { return std::accumulate(s.begin(), s.end(), 0.0); }
double at(const Spectrum& s, int nm) { return s[static_cast<std::size_t>(nm - first_nm)]; }

struct WhitePoint {
  const char* name;
  double x, y;
};

class Illuminant : public testing::TestWithParam<WhitePoint> {};

// CIE 015 table of chromaticities (2-degree). Linear interpolation of the 5 nm tables moves the lines of the fluorescent lamps
// by a few units of the fourth digit.
TEST_P(Illuminant, HasItsWhitePoint)
{
  const Spectrum light = illuminant(GetParam().name);
  EXPECT_NEAR(sum(light), 1, 1e-14);
  const Colour xyz = to_xyz(light);
  const double total = xyz[0] + xyz[1] + xyz[2];
  EXPECT_NEAR(xyz[0] / total, GetParam().x, 6e-4);
  EXPECT_NEAR(xyz[1] / total, GetParam().y, 6e-4);
}

INSTANTIATE_TEST_SUITE_P(Cie, Illuminant,
                         testing::Values(WhitePoint{"A", 0.44757, 0.40745}, WhitePoint{"D50", 0.34567, 0.35850},
                                         WhitePoint{"D65", 0.31272, 0.32903}, WhitePoint{"E", 1.0 / 3, 1.0 / 3},
                                         WhitePoint{"F1", 0.3131, 0.3371}, WhitePoint{"F2", 0.3721, 0.3751},
                                         WhitePoint{"F3", 0.4091, 0.3941}, WhitePoint{"F4", 0.4402, 0.4031},
                                         WhitePoint{"F5", 0.3138, 0.3452}, WhitePoint{"F6", 0.3779, 0.3882},
                                         WhitePoint{"F7", 0.3129, 0.3292}, WhitePoint{"F8", 0.3458, 0.3586},
                                         WhitePoint{"F9", 0.3741, 0.3727}, WhitePoint{"F10", 0.3458, 0.3588},
                                         WhitePoint{"F11", 0.3805, 0.3769}, WhitePoint{"F12", 0.4370, 0.4042}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Spectrum, EveryIlluminantIsNamedAndAnUnknownOneIsRefused)
{
  EXPECT_EQ(illuminant_names().size(), 16u);
  for (const std::string& name : illuminant_names()) EXPECT_NEAR(sum(illuminant(name)), 1, 1e-14) << name;
  const std::string line = refusal_of([] { illuminant("D66"); });
  EXPECT_THAT(line, testing::AllOf(testing::HasSubstr("no illuminant is called \"D66\""), testing::HasSubstr("A, D50, D65")));
}

TEST(Spectrum, TablesAreInterpolatedLinearly)
{
  // D65 at 560 nm is 100 by definition; 560 and 565 nm are rows, and the nanometres between lie on the line.
  const Spectrum d65 = illuminant("D65");
  EXPECT_NEAR(at(d65, 562) / at(d65, 560), 1 + 2.0 / 5 * (at(d65, 565) / at(d65, 560) - 1), 1e-12);
}

// The peak of Planck's law per wavelength is at 2897.772 um K / T (Wien), and the ratio of two wavelengths is known.
TEST(Spectrum, BlackBodyFollowsPlanck)
{
  const Spectrum light = blackbody(5000);
  EXPECT_NEAR(sum(light), 1, 1e-14);
  const auto peak = std::max_element(light.begin(), light.end()) - light.begin();
  EXPECT_NEAR(first_nm + static_cast<double>(peak), 2897771.955 / 5000, 1);
  const auto planck = [](double nm, double kelvin) { return std::pow(nm, -5) / std::expm1(1.438776877e7 / (nm * kelvin)); };
  for (double kelvin : {1000.0, 2856.0, 5000.0, 20000.0}) {
    const Spectrum s = blackbody(kelvin);
    for (int nm : {380, 450, 640, 780})
      EXPECT_NEAR(at(s, nm) / at(s, 560), planck(nm, kelvin) / planck(560, kelvin), 1e-8 * at(s, nm) / at(s, 560));
  }
  // Illuminant A is a black body of 2848 K under the old c2 = .014350 m K: 2855.5 K today.
  const Spectrum a = illuminant("A"), black = blackbody(2855.496);
  for (int nm = first_nm; nm <= last_nm; nm += 5) EXPECT_NEAR(at(a, nm) / at(black, nm), 1, 2e-4) << nm;
}

TEST(Spectrum, BlackBodyStaysFiniteAtExtremes)
{
  for (double kelvin : {1e-3, 1.0, 1e9, 1e300}) EXPECT_NEAR(sum(blackbody(kelvin)), 1, 1e-12) << kelvin;
  EXPECT_THAT(refusal_of([] { blackbody(0); }), testing::HasSubstr("a black body of 0 K"));
  EXPECT_THAT(refusal_of([] { blackbody(-1); }), testing::HasSubstr("above 0 K"));
  EXPECT_THAT(refusal_of([] { blackbody(std::nan("")); }), testing::HasSubstr("above 0 K"));
}

TEST(Spectrum, LightTableIsZeroOutsideAndSumsToOne)
{
  const Spectrum light = light_table(Rows{{560, 2}, {550, 0}, {570, 0}}); // a triangle, rows in any order
  EXPECT_NEAR(sum(light), 1, 1e-14);
  EXPECT_NEAR(at(light, 560), 0.1, 1e-14); // height 2 over an area of 20
  EXPECT_NEAR(at(light, 555), 0.05, 1e-14);
  EXPECT_EQ(at(light, 549), 0);
  EXPECT_EQ(at(light, 571), 0);
}

TEST(Spectrum, LinesGoToTheirTwoNearestWavelengths)
{
  const Spectrum light = light_lines(Rows{{546.074, 3}, {780, 1}, {365.0, 5}}); // 365 nm lies outside and gives nothing
  EXPECT_NEAR(at(light, 546), 0.75 * 0.926, 1e-12);
  EXPECT_NEAR(at(light, 547), 0.75 * 0.074, 1e-12);
  EXPECT_NEAR(at(light, 780), 0.25, 1e-12);
  EXPECT_NEAR(sum(light), 1, 1e-14);
}

TEST(Spectrum, BadLightsAreRefused)
{
  EXPECT_THAT(refusal_of([] { light_table(Rows{}); }), testing::HasSubstr("the table is empty"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{900, 1}, {1000, 1}}); }), testing::HasSubstr("no power in 380..780 nm"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, 0}, {600, 0}}); }), testing::HasSubstr("no power"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, 1}, {600, -1}}); }), testing::HasSubstr("at 600 nm is -1"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, 1}, {500, 2}}); }), testing::HasSubstr("500 nm is given twice"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, std::nan("")}}); }), testing::HasSubstr("not finite"));
  EXPECT_THAT(refusal_of([] { light_lines(Rows{}); }), testing::HasSubstr("no power"));
  EXPECT_THAT(refusal_of([] { light_lines(Rows{{200, 1}}); }), testing::HasSubstr("no power in 380..780 nm"));
  EXPECT_THAT(refusal_of([] { light_lines(Rows{{500, INFINITY}}); }), testing::HasSubstr("not finite"));
}

// Under its design light C the patches have published xyY; under D65 Y of the greys is close to their nominal 9.5 .. 2 values.
TEST(Spectrum, ColorCheckerGreysFallFromWhiteToBlack)
{
  ASSERT_EQ(colorchecker_names().size(), 24u);
  const Spectrum d65 = illuminant("D65");
  const double white = to_xyz(d65)[1];
  const double nominal[] = {0.90, 0.591, 0.362, 0.198, 0.090, 0.031};
  for (std::size_t i = 0; i < 6; ++i) {
    Spectrum seen = colorchecker_patch(colorchecker_names()[18 + i]);
    for (std::size_t w = 0; w < seen.size(); ++w) seen[w] *= d65[w];
    EXPECT_NEAR(to_xyz(seen)[1] / white, nominal[i], 0.015) << colorchecker_names()[18 + i];
  }
  EXPECT_NEAR(at(colorchecker_patch("dark skin"), 380), 0.048, 1e-12);
  EXPECT_NEAR(at(colorchecker_patch("dark skin"), 381), 0.048 + (0.051 - 0.048) / 5, 1e-12);
  EXPECT_NEAR(at(colorchecker_patch("blue sky"), 382), 0.113 + 2 * (0.138 - 0.113) / 5, 1e-12);
  EXPECT_THAT(refusal_of([] { colorchecker_patch("blue skye"); }), testing::HasSubstr("did you mean \"blue sky\"?"));
}

TEST(Spectrum, ReflectancesHoldTheirEndsAndStayInRange)
{
  const Spectrum r = reflectance_table(Rows{{500, 0.2}, {600, 0.4}});
  EXPECT_EQ(at(r, 380), 0.2);
  EXPECT_NEAR(at(r, 550), 0.3, 1e-15);
  EXPECT_EQ(at(r, 780), 0.4);
  EXPECT_THAT(refusal_of([] { reflectance_table(Rows{{500, 1.2}}); }), testing::HasSubstr("0 to 1"));
  EXPECT_THAT(refusal_of([] { reflectance_table(Rows{{500, std::nan("")}}); }), testing::HasSubstr("0 to 1"));
  EXPECT_EQ(constant_spectrum(0.5)[200], 0.5);
}

} // namespace nephroid::spectrum_test
