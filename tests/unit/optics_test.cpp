// SPDX-License-Identifier: Apache-2.0
// Colour against CIE 015, IEC 61966-2-1 and CIELAB; light spectra and reflectances against published figures; the
// spectra of the sRGB primaries: the right colour, and nothing smoother has it.
#include "optics/colour.h"
#include "optics/primary_reflectances.h"
#include "optics/spectrum.h"
#include "tests/support/test.h"

namespace nephroid::optics_test {

using namespace nephroid::optics;
using Rows = std::vector<std::array<double, 2>>;
using Second = std::array<double, wavelength_count - 2>;

void expect_near(const Colour& got, const Colour& wanted, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], tolerance) << i;
}

// CIE 1931 2-degree: ybar peaks with 1 at 555 nm; rows 450, 555 and 600 nm of the printed table.
TEST(Colour, ColourMatchingFunctionsAreTheCieTable) {
  const ColourMatching& cie = cie_1931();
  EXPECT_NEAR(cie.y[555 - first_nm], 1.0, 1e-12);
  EXPECT_NEAR(cie.x[450 - first_nm], 0.3362, 1e-12);
  EXPECT_NEAR(cie.z[450 - first_nm], 1.77211, 1e-12);
  EXPECT_NEAR(cie.x[600 - first_nm], 1.0622, 1e-12);
  EXPECT_NEAR(cie.y[600 - first_nm], 0.631, 1e-12);
}

// The functions have equal areas, 106.86 nm over 380..780 nm.
TEST(Colour, EqualEnergyIsNeutral) {
  const Colour xyz = to_xyz(constant_spectrum(1));
  expect_near(xyz, {106.86, 106.86, 106.86}, 0.03);
}

TEST(Colour, PrimariesOfSrgbHaveTheirChromaticities) {
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

TEST(Colour, LightOfAnyColourHasASpectrumThatIsNowhereNegative) {
  for (const Colour& rgb : {Colour{1, 0, 0}, Colour{0, 1, 0}, Colour{0, 0, 1}, Colour{1, 0, 1}, Colour{0, 1, 1},
                            Colour{1, 1, 0}, Colour{0.05, 0, 1}, Colour{1, 0.02, 0}, Colour{0.3, 0.3, 1}}) {
    const Spectrum light = light_of_colour(rgb);
    EXPECT_GE(*std::min_element(light.begin(), light.end()), 0);
    const Colour found = xyz_to_linear_srgb(to_xyz(light));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], rgb[c], 1e-4) << rgb[0] << ' ' << rgb[1] << ' ' << rgb[2];
  }
}

TEST(Colour, SrgbThereAndBackIsTheIdentityOutsideTheGamutToo) {
  for (const Colour& xyz : {Colour{0.2, 0.3, 0.4}, Colour{1, 0, 0}, Colour{-0.1, 2, 30}})
    expect_near(linear_srgb_to_xyz(xyz_to_linear_srgb(xyz)), xyz, 1e-13);
  // The inverse that IEC 61966-2-1 prints, to its four digits.
  expect_near(xyz_to_linear_srgb({1, 0, 0}), {3.2406, -0.9689, 0.0557}, 1e-4);
  EXPECT_LT(xyz_to_linear_srgb({0.05, 0.3, 0.3})[0], 0); // a spectral cyan: not clipped
}

TEST(Colour, SrgbEncoding) {
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_NEAR(srgb_encode(1), 1, 1e-15);
  EXPECT_NEAR(srgb_encode(0.002), 0.02584, 1e-15);
  EXPECT_NEAR(srgb_encode(0.214041140482), 0.5, 1e-9);
  EXPECT_NEAR(srgb_encode(-0.214041140482), -0.5, 1e-9);
}

TEST(Colour, LightnessOfKnownLuminances) {
  EXPECT_NEAR(lightness(1), 100, 1e-12);
  EXPECT_NEAR(lightness(0.184186518), 50, 1e-6); // ((50 + 16) / 116)^3
  EXPECT_NEAR(lightness(0.001), 0.9033, 1e-4);   // 903.3 Y below .008856
  EXPECT_NEAR(lightness(0), 0, 1e-12);
}

double sum(const Spectrum& s) { return std::accumulate(s.begin(), s.end(), 0.0); }
double at(const Spectrum& s, int nm) { return s[static_cast<std::size_t>(nm - first_nm)]; }

struct WhitePoint {
  const char* name;
  double x, y;
};

class Illuminant : public testing::TestWithParam<WhitePoint> {};

// CIE 015 table of chromaticities (2-degree). Linear interpolation of the 5 nm tables moves the lines of the
// fluorescent lamps by a few units of the fourth digit.
TEST_P(Illuminant, HasItsWhitePoint) {
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

TEST(Spectrum, EveryIlluminantIsNamedAndAnUnknownOneIsRefused) {
  EXPECT_EQ(illuminant_names().size(), 16u);
  for (const std::string& name : illuminant_names()) EXPECT_NEAR(sum(illuminant(name)), 1, 1e-14) << name;
  const std::string line = refusal_of([] { illuminant("D66"); });
  EXPECT_THAT(line, AllOf(HasSubstr("no illuminant is called \"D66\""), HasSubstr("A, D50, D65")));
}

TEST(Spectrum, TablesAreInterpolatedLinearly) {
  // D65 at 560 nm is 100 by definition; 560 and 565 nm are rows, and the nanometres between lie on the line.
  const Spectrum d65 = illuminant("D65");
  EXPECT_NEAR(at(d65, 562) / at(d65, 560), 1 + 2.0 / 5 * (at(d65, 565) / at(d65, 560) - 1), 1e-12);
}

// The peak of Planck's law per wavelength is at 2897.772 um K / T (Wien), and the ratio of two wavelengths is known.
TEST(Spectrum, BlackBodyFollowsPlanck) {
  const Spectrum light = blackbody(5000);
  EXPECT_NEAR(sum(light), 1, 1e-14);
  const auto peak = std::max_element(light.begin(), light.end()) - light.begin();
  EXPECT_NEAR(first_nm + static_cast<double>(peak), 2897771.955 / 5000, 1);
  const auto planck = [](double nm, double kelvin) {
    return std::pow(nm, -5) / std::expm1(1.438776877e7 / (nm * kelvin));
  };
  for (double kelvin : {1000.0, 2856.0, 5000.0, 20000.0}) {
    const Spectrum s = blackbody(kelvin);
    for (int nm : {380, 450, 640, 780})
      EXPECT_NEAR(at(s, nm) / at(s, 560), planck(nm, kelvin) / planck(560, kelvin), 1e-8 * at(s, nm) / at(s, 560));
  }
  // Illuminant A is a black body of 2848 K under the old c2 = .014350 m K: 2855.5 K today.
  const Spectrum a = illuminant("A"), black = blackbody(2855.496);
  for (int nm = first_nm; nm <= last_nm; nm += 5) EXPECT_NEAR(at(a, nm) / at(black, nm), 1, 2e-4) << nm;
}

TEST(Spectrum, BlackBodyStaysFiniteAtExtremes) {
  for (double kelvin : {1e-3, 1.0, 1e9, 1e300}) EXPECT_NEAR(sum(blackbody(kelvin)), 1, 1e-12) << kelvin;
  EXPECT_THAT(refusal_of([] { blackbody(0); }), HasSubstr("a black body of 0 K"));
  EXPECT_THAT(refusal_of([] { blackbody(-1); }), HasSubstr("above 0 K"));
  EXPECT_THAT(refusal_of([] { blackbody(std::nan("")); }), HasSubstr("above 0 K"));
}

TEST(Spectrum, LightTableIsZeroOutsideAndSumsToOne) {
  const Spectrum light = light_table(Rows{{560, 2}, {550, 0}, {570, 0}}); // a triangle, rows in any order
  EXPECT_NEAR(sum(light), 1, 1e-14);
  EXPECT_NEAR(at(light, 560), 0.1, 1e-14); // height 2 over an area of 20
  EXPECT_NEAR(at(light, 555), 0.05, 1e-14);
  EXPECT_EQ(at(light, 549), 0);
  EXPECT_EQ(at(light, 571), 0);
}

TEST(Spectrum, WhatLiesBetweenWholeNanometresKeepsItsAreaAndItsPlace) {
  const Spectrum line = spectrum_of_table(Rows{{632.75, 0}, {632.8, 1000}, {632.85, 0}}); // a laser's
  EXPECT_NEAR(at(line, 632), 50 * 0.2, 1e-6);
  EXPECT_NEAR(at(line, 633), 50 * 0.8, 1e-6);
  EXPECT_NEAR(sum(line), 50, 1e-6);
  EXPECT_NEAR(at(light_table(Rows{{632.75, 0}, {632.8, 1}, {632.85, 0}}), 633), 0.8, 1e-6);
  EXPECT_NEAR(sum(spectrum_of_table(Rows{{499, 0}, {500.5, 1}, {502, 0}})), 1.5, 1e-6);
  EXPECT_NEAR(sum(spectrum_of_table(Rows{{547, 0}, {550.5, 1}, {554, 0}})), 3.5, 1e-6);
  const Spectrum flat = spectrum_of_table(Rows{{400.5, 2}, {450.25, 2}, {500.5, 2}}); // cut at its ends
  for (const int nm : {401, 402, 450, 500}) EXPECT_NEAR(at(flat, nm), 2, 1e-9) << nm;
  for (const int nm : {400, 501}) EXPECT_EQ(at(flat, nm), 0) << nm;
  const Spectrum whole_range = spectrum_of_table(Rows{{380, 1}, {580.5, 1}, {780, 1}});
  EXPECT_NEAR(at(whole_range, 380), 1, 1e-9);
  EXPECT_NEAR(at(whole_range, 780), 1, 1e-9);
  const Spectrum whole = spectrum_of_table(Rows{{500, 1}, {501, 3}, {510, 0}}); // as it is
  EXPECT_EQ(at(whole, 500), 1);
  EXPECT_EQ(at(whole, 501), 3);
}

TEST(Spectrum, LinesGoToTheirTwoNearestWavelengths) {
  const Spectrum light = light_lines(Rows{{546.074, 3}, {780, 1}, {365.0, 5}}); // 365 nm lies outside and gives nothing
  EXPECT_NEAR(at(light, 546), 0.75 * 0.926, 1e-12);
  EXPECT_NEAR(at(light, 547), 0.75 * 0.074, 1e-12);
  EXPECT_NEAR(at(light, 780), 0.25, 1e-12);
  EXPECT_NEAR(sum(light), 1, 1e-14);
}

TEST(Spectrum, BadLightsAreRefused) {
  EXPECT_THAT(refusal_of([] { light_table(Rows{}); }), HasSubstr("the table is empty"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{900, 1}, {1000, 1}}); }), HasSubstr("no power in 380..780 nm"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, 0}, {600, 0}}); }), HasSubstr("no power"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, 1}, {600, -1}}); }), HasSubstr("at 600 nm is -1"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, 1}, {500, 2}}); }), HasSubstr("500 nm is given twice"));
  EXPECT_THAT(refusal_of([] { light_table(Rows{{500, std::nan("")}}); }), HasSubstr("not finite"));
  EXPECT_THAT(refusal_of([] { light_lines(Rows{}); }), HasSubstr("no power"));
  EXPECT_THAT(refusal_of([] { light_lines(Rows{{200, 1}}); }), HasSubstr("no power in 380..780 nm"));
  EXPECT_THAT(refusal_of([] { light_lines(Rows{{500, INFINITY}}); }), HasSubstr("not finite"));
}

// Under its design light C the patches have published xyY; under D65 Y of the greys is close to their nominal 9.5 .. 2
// values.
TEST(Spectrum, ColorCheckerGreysFallFromWhiteToBlack) {
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
  EXPECT_THAT(refusal_of([] { colorchecker_patch("blue skye"); }), HasSubstr("did you mean \"blue sky\"?"));
}

TEST(Spectrum, ReflectancesHoldTheirEndsAndStayInRange) {
  const Spectrum r = reflectance_table(Rows{{500, 0.2}, {600, 0.4}});
  EXPECT_EQ(at(r, 380), 0.2);
  EXPECT_NEAR(at(r, 550), 0.3, 1e-15);
  EXPECT_EQ(at(r, 780), 0.4);
  EXPECT_THAT(refusal_of([] { reflectance_table(Rows{{500, 1.2}}); }), HasSubstr("0 to 1"));
  EXPECT_THAT(refusal_of([] { reflectance_table(Rows{{500, std::nan("")}}); }), HasSubstr("0 to 1"));
  EXPECT_EQ(constant_spectrum(0.5)[200], 0.5);
}

Second second_differences(const Spectrum& s) {
  Second d{};
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = s[i] - 2 * s[i + 1] + s[i + 2];
  return d;
}

double inner(const auto& a, const auto& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// What is left of a spectrum without its part along the colour-matching functions (Gram-Schmidt): it is black to the
/// eye.
Spectrum without_colour(Spectrum s) {
  const ColourMatching& eye = cie_1931();
  std::vector<Spectrum> basis;
  for (const Spectrum* function : {&eye.x, &eye.y, &eye.z}) {
    Spectrum b = *function;
    for (int twice = 0; twice < 2; ++twice) // once more for what rounding left
      for (const Spectrum& other : basis) {
        const double part = inner(b, other);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] -= part * other[i];
      }
    const double length = std::sqrt(inner(b, b));
    for (double& value : b) value /= length;
    basis.push_back(b);
  }
  for (const Spectrum& b : basis) {
    const double part = inner(s, b);
    for (std::size_t i = 0; i < s.size(); ++i) s[i] -= part * b[i];
  }
  return s;
}

TEST(PrimarySpectra, HaveTheColoursOfThePrimaries) {
  for (std::size_t primary = 0; primary < 3; ++primary) {
    const Colour rgb = xyz_to_linear_srgb(to_xyz(primary_spectra()[primary]));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], c == primary ? 1 : 0, 1e-12) << primary;
  }
}

// To a colour and back, for colours inside the gamut, outside of it and far brighter than white.
TEST(PrimarySpectra, AreThereAndBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-2, 100);
  for (int i = 0; i < 100; ++i) {
    const Colour rgb{value(random), value(random), value(random)};
    Spectrum s{};
    for (std::size_t w = 0; w < s.size(); ++w)
      for (std::size_t p = 0; p < 3; ++p) s[w] += rgb[p] * primary_spectra()[p][w];
    const Colour back = xyz_to_linear_srgb(to_xyz(s));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-6);
  }
}

// A convex function is smallest where it does not change to first order in any direction that keeps the colour: |D (s +
// e v)|^2 has the slope 2 (D s).(D v) in e. Directions: each wavelength by itself, and random ones.
TEST(PrimarySpectra, NothingSmootherHasTheirColour) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<Spectrum> directions;
  for (std::size_t w = 0; w < wavelength_count; w += 7) directions.emplace_back()[w] = 1;
  for (int i = 0; i < 50; ++i)
    for (double& value : directions.emplace_back()) value = normal(random);
  for (const Spectrum& s : primary_spectra()) {
    const Second curvature = second_differences(s);
    EXPECT_GT(inner(curvature, curvature), 0);
    for (const Spectrum& direction : directions) {
      const Second change = second_differences(without_colour(direction));
      const double slope = inner(curvature, change) / std::sqrt(inner(curvature, curvature) * inner(change, change));
      EXPECT_LT(std::abs(slope), 1e-7);
    }
  }
}

// Grey light has power at every wavelength, so nothing that absorbs can make it negative, and it falls off towards red
// as daylight does.
TEST(PrimarySpectra, GreyHasPowerEverywhere) {
  double sum_of_y = 0;
  for (const double y : cie_1931().y) sum_of_y += y;
  for (std::size_t w = 0; w < wavelength_count; ++w) {
    double grey = 0; // in units of the even spectrum with Y = 1
    for (const Spectrum& s : primary_spectra()) grey += s[w] * sum_of_y;
    EXPECT_GT(grey, 0.3) << w;
    EXPECT_LT(grey, 1.2) << w;
  }
}

// Of every colour in 0..1 they make a reflectance in 0..1 that has the colour under daylight.
TEST(PrimaryReflectances, HaveTheirColoursAndAddUpToWhite) {
  const std::array<Spectrum, 3>& primaries = primary_reflectances();
  const Spectrum d65 = illuminant("D65");
  const Colour white = xyz_to_linear_srgb(to_xyz(d65));
  for (std::size_t primary = 0; primary < 3; ++primary) {
    Spectrum left = d65;
    for (std::size_t w = 0; w < left.size(); ++w) left[w] *= primaries[primary][w];
    const Colour rgb = xyz_to_linear_srgb(to_xyz(left));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c] / white[c], primary == c ? 1 : 0, 1e-9) << primary << c;
  }
  for (std::size_t w = 0; w < d65.size(); ++w) {
    double sum = 0;
    for (const Spectrum& primary : primaries) {
      EXPECT_GE(primary[w], 0);
      sum += primary[w];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

} // namespace nephroid::optics_test
