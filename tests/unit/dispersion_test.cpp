// SPDX-License-Identifier: Apache-2.0
// Dispersion against published figures, hand-computed values of every formula, and the oddities of the
// refractiveindex.info database. Malformed files: each answers with one line that names the file, the line where it
// can, and what is expected.
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "tests/support/test.h"

#include <cmath>
#include <numbers>

namespace nephroid::dispersion_test {

using namespace nephroid::optics;
using Rows = std::vector<std::array<double, 2>>;
using nephroid::Error;
using nephroid::optics::parse_dispersion;

const fs::path materials = fs::path(NEPHROID_SOURCE_DIR) / "presets/materials";
const fs::path more = fs::path(NEPHROID_SOURCE_DIR) / "tests/data/dispersion";

constexpr double line_F = 486.1327, line_d = 587.5618, line_C = 656.2725;

double n_at(const DispersionCurve& curve, double nm, Extrapolation outside = Extrapolation::automatic) {
  return curve.sample(nm, outside).n.value_or(std::nan(""));
}

DispersionCurve from_yaml(const std::string& data) { return parse_dispersion("DATA:\n" + data, "test.yml"); }

struct Glass {
  const char* file;
  double n_d, abbe;
};

// Schott's catalogue (2017): n_d and V_d.
TEST(Dispersion, SchottGlassesHaveTheirCatalogueFigures) {
  for (const Glass& glass : {Glass{"N-BK7", 1.51680, 64.17}, Glass{"N-SF66", 1.92286, 20.88},
                             Glass{"N-SF11", 1.78472, 25.68}, Glass{"SF66", 1.92286, 20.88}}) {
    const DispersionCurve curve = load_dispersion(materials / (std::string(glass.file) + ".yml"));
    EXPECT_EQ(curve.name, glass.file);
    EXPECT_NEAR(n_at(curve, line_d), glass.n_d, 1e-5) << glass.file;
    EXPECT_NEAR((n_at(curve, line_d) - 1) / (n_at(curve, line_F) - n_at(curve, line_C)), glass.abbe, 0.01)
        << glass.file;
  }
}

TEST(Dispersion, OtherMaterialsHaveTheirPublishedFigures) {
  const auto n = [](const char* file, double nm) { return n_at(load_dispersion(materials / file), nm); };
  EXPECT_NEAR(n("fused-silica-Malitson.yml", 587.6), 1.45846, 1e-5);
  // Daimon and Masumura measured against vacuum; tables of water say 1.33299 at 20 C, against air of n = 1.00027.
  EXPECT_NEAR(n("water-20C-Daimon.yml", 589.3) / 1.00027, 1.33299, 2e-5);
  EXPECT_NEAR(n("diamond-Peter.yml", 589.3), 2.417, 1e-3);
  EXPECT_NEAR(n("sapphire-o-Malitson.yml", 589.3), 1.768, 1e-3);
  EXPECT_NEAR(n("PMMA-Szczurowski.yml", 589.3), 1.490, 2e-3);
}

// The database's only files with formulas 7 and 9, and one of 8, against handbook values of the materials (CRC Handbook
// of Chemistry and Physics, Handbook of Optics): silicon 3.42 in the far infrared, silver bromide 2.253 and urea 1.602
// (extraordinary) for yellow light. The tolerance is the spread between authors; the arithmetic is tested below.
TEST(Dispersion, FilesWithTheRareFormulas) {
  EXPECT_NEAR(n_at(load_dispersion(more / "formula7-silicon-Edwards.yml"), 10000), 3.42, 3e-3);
  EXPECT_NEAR(n_at(load_dispersion(more / "formula8-silver-bromide-Schroter.yml"), 587.6), 2.253, 6e-3);
  EXPECT_NEAR(n_at(load_dispersion(more / "formula9-urea-e-Rosker.yml"), 587.6), 1.602, 6e-3);
}

// By hand, with l = 0.5 um (l^2 = 1/4) or l = 2 um (l^2 = 4) so that every term is a short fraction.
TEST(Dispersion, EveryFormulaByHand) {
  const auto n = [](int formula, std::vector<double> c, double um) { return index_by_formula(formula, c, um); };
  EXPECT_NEAR(n(1, {0.25, 3, 1}, 2), std::sqrt(1 + 0.25 + 3 * 4.0 / 3), 1e-15);
  EXPECT_NEAR(n(2, {0.25, 3, 1, 1, 2}, 2), std::sqrt(1 + 0.25 + 3 * 4.0 / 3 + 1 * 4.0 / 2), 1e-15);
  EXPECT_NEAR(n(3, {2, 1, 2, 8, -2}, 2), std::sqrt(2 + 4 + 2.0), 1e-15);
  EXPECT_NEAR(n(4, {1, 3, 2, 2, 1, 6, 0, 1, 2, 0.5, 2, 1, -1}, 2),
              std::sqrt(1 + 3 * 4.0 / (4 - 2) + 6.0 / (4 - 1) + 2 + 0.5), 1e-15);
  EXPECT_NEAR(n(5, {1.5, 0.02, -2, 0.01, 1}, 0.5), 1.5 + 0.08 + 0.005, 1e-15);
  EXPECT_NEAR(n(6, {0.1, 0.5, 6}, 0.5), 1 + 0.1 + 0.5 / (6 - 4), 1e-15);
  const double pole = 1 / (4 - 0.028);
  EXPECT_NEAR(n(7, {3, 0.1, 0.2, 0.01, 0.001, 0.0001}, 2), 3 + 0.1 * pole + 0.2 * pole * pole + 0.04 + 0.016 + 0.0064,
              1e-15);
  const double r = 0.2 + 0.1 * 4 / (4 - 2) - 0.01 * 4;
  EXPECT_NEAR(n(8, {0.2, 0.1, 2, -0.01}, 2), std::sqrt((1 + 2 * r) / (1 - r)), 1e-15);
  EXPECT_NEAR(n(9, {2, 0.5, 3, 0.3, 1.5, 0.05}, 2), std::sqrt(2 + 0.5 / (4 - 3) + 0.3 * 0.5 / (0.25 + 0.05)), 1e-15);
}

TEST(Dispersion, MissingCoefficientsAreZeroAndZeroTermsAreLeftOut) {
  const auto n = [](int formula, std::vector<double> c, double um) { return index_by_formula(formula, c, um); };
  EXPECT_NEAR(n(2, {0.5, 1, 2, 0.75}, 2), std::sqrt(1 + 0.5 + 2 + 0.75), 1e-15); // four: the last pole is at 0
  EXPECT_NEAR(n(7, {3, 0, 0, 0.5, 0}, 2), 5, 1e-15);
  EXPECT_NEAR(n(1, {3}, 0.4), 2, 1e-15);
  // l^2 - 0^0 is 0 at 1 um: 0 / 0 unless the zero factor comes first.
  EXPECT_NEAR(n(4, {4, 0, 0, 0, 0, 0, 0, 0, 0}, 1), 2, 1e-15);
  EXPECT_NEAR(n(4, {4, 0, 0, 0, 0}, 1), 2, 1e-15);
  EXPECT_NEAR(n(8, {0.25, 0, 4}, 2), std::sqrt(1.5 / 0.75), 1e-15);
  EXPECT_NEAR(n(9, {4, 0, 4, 0, 2}, 2), 2, 1e-15);
  EXPECT_TRUE(std::isnan(n(3, {-1}, 0.5)));
}

TEST(Dispersion, AFormulaWithoutAFiniteValueAnswersNothing) {
  const DispersionCurve curve =
      from_yaml("  - type: formula 1\n    wavelength_range: 0.5 1\n    coefficients: 0 1.2 0.45\n");
  EXPECT_TRUE(curve.sample(500).n);
  const IndexSample below = curve.sample(445); // just below the pole at 450 nm: n^2 is far below 0
  EXPECT_FALSE(below.n);
  EXPECT_TRUE(below.extrapolated);
  EXPECT_THAT(refusal_of([&] { sample_n(curve, Extrapolation::automatic); }),
              AllOf(HasSubstr("gives no number at"), HasSubstr("500..1000 nm")));
  EXPECT_NEAR(sample_n(curve, Extrapolation::hold)[0], n_at(curve, 500), 1e-15);
}

TEST(Dispersion, RangeEndsCountAsInside) {
  const DispersionCurve curve =
      from_yaml("  - type: formula 5\n    wavelength_range: 0.4861 0.5893\n    coefficients: 1.5\n");
  for (double nm : {486.1, 589.3, 486.1 * (1 - 5e-7), 589.3 * (1 + 5e-7)})
    EXPECT_FALSE(curve.sample(nm).extrapolated) << nm;
  for (double nm : {486.0, 589.31}) EXPECT_TRUE(curve.sample(nm).extrapolated) << nm;
  EXPECT_NO_THROW(curve.sample(589.3, Extrapolation::refuse));
  EXPECT_THAT(refusal_of([&] { curve.sample(600, Extrapolation::refuse); }),
              HasSubstr("test.yml: test has no n at 600 nm; expected a wavelength in its range 486.1..589.3 nm"));
}

TEST(Dispersion, OutsideHoldsExtrapolatesOrRefuses) {
  const DispersionCurve glass =
      load_dispersion(materials / "N-SF66.yml"); // n by formula and k by table, both from 390 nm
  const double at_390 = n_at(glass, 390);
  EXPECT_GT(n_at(glass, 380), at_390 + 0.001);
  EXPECT_EQ(n_at(glass, 380, Extrapolation::extrapolate), n_at(glass, 380));
  EXPECT_EQ(n_at(glass, 380, Extrapolation::hold), at_390);
  EXPECT_TRUE(glass.sample(380).extrapolated);
  EXPECT_TRUE(glass.sample(380, Extrapolation::hold).extrapolated);
  EXPECT_FALSE(glass.sample(390).extrapolated);
  EXPECT_NEAR(*glass.sample(380).k, 4.8564e-6, 1e-12);
  EXPECT_NEAR(*glass.sample(395).k, (4.8564e-6 + 2.1833e-6) / 2, 1e-12);
  EXPECT_EQ(outside_note(glass, Extrapolation::automatic),
            "N-SF66: n is extrapolated below 390 nm (data: 390..2500 nm)");
  EXPECT_EQ(outside_note(glass, Extrapolation::hold), "N-SF66: n is held below 390 nm (data: 390..2500 nm)");
  EXPECT_EQ(outside_note(load_dispersion(materials / "N-BK7.yml"), Extrapolation::automatic), "");
  EXPECT_THAT(refusal_of([&] { sample_n(glass, Extrapolation::refuse); }), HasSubstr("no n at 380 nm"));
  EXPECT_THAT(refusal_of([&] { sample_k(glass, Extrapolation::refuse); }), HasSubstr("no k at 380 nm"));

  const DispersionCurve table = tabulated(Rows{{500, 1.6}, {600, 1.5}});
  for (Extrapolation outside : {Extrapolation::automatic, Extrapolation::hold, Extrapolation::extrapolate}) {
    EXPECT_EQ(n_at(table, 400, outside), 1.6);
    EXPECT_EQ(n_at(table, 700, outside), 1.5);
  }
  EXPECT_EQ(outside_note(table, Extrapolation::automatic),
            "table: n is held below 500 nm and above 600 nm (data: 500..600 nm)");
}

TEST(Dispersion, DatabaseTablesAreReadAsTheyAre) {
  const DispersionCurve odd =
      from_yaml("  - type: tabulated nk\n    data: |\n        0.70 1.2 -0.01\n        0.50 1.6 0.03\n\n"
                "        0.60 -1.4 0.02\n        0.60 -1.0 0.02\n");
  EXPECT_EQ(odd.range_nm(), (std::array{500.0, 700.0}));
  EXPECT_NEAR(n_at(odd, 600), -1.2, 1e-15); // given twice: the mean; negative n stays
  EXPECT_NEAR(n_at(odd, 550), 0.2, 1e-12);
  EXPECT_NEAR(*odd.sample(700).k, -0.01, 1e-15);
  EXPECT_EQ(sample_k(odd, Extrapolation::automatic)[700 - first_nm], 0); // but light does not gain from it
  EXPECT_THAT(refusal_of([&] { sample_n(odd, Extrapolation::automatic); }), HasSubstr("n above 0"));

  const DispersionCurve single = from_yaml("  - type: tabulated n\n    data: |\n        0.5893 1.33\n");
  EXPECT_EQ(n_at(single, 589.3), 1.33);
  EXPECT_FALSE(single.sample(589.3).extrapolated);
  EXPECT_EQ(n_at(single, 400), 1.33);
  EXPECT_TRUE(single.sample(400).extrapolated);
}

TEST(Dispersion, FilesWithOneOfNAndKOrWithBothApart) {
  const DispersionCurve k_only = from_yaml("  - type: tabulated k\n    data: |\n        0.4 0.1\n        0.6 0.3\n");
  EXPECT_FALSE(k_only.sample(500).n);
  EXPECT_NEAR(*k_only.sample(500).k, 0.2, 1e-15);
  EXPECT_EQ(k_only.range_nm(), (std::array{400.0, 600.0}));
  EXPECT_THAT(refusal_of([&] { sample_n(k_only, Extrapolation::automatic); }),
              HasSubstr("no index of refraction n, only k"));

  const DispersionCurve both =
      from_yaml("  - type: tabulated k\n    data: |\n        0.4 0.1\n  - type: constant\n    value: 1.7\n");
  EXPECT_EQ(n_at(both, 500), 1.7);
  EXPECT_EQ(both.sample(500).k, 0.1);
  EXPECT_FALSE(both.sample(5).extrapolated);

  const DispersionCurve first = from_yaml("  - type: formula 5\n    wavelength_range: 0.4 0.8\n    coefficients: 1.5\n"
                                          "  - type: tabulated nk\n    data: |\n        0.4 1.9 0.1\n");
  EXPECT_EQ(n_at(first, 500), 1.5);
  EXPECT_EQ(first.sample(500).k, 0.1);
}

TEST(Dispersion, AnomalousTablesAreReadWithTheirAbsorption) {
  for (const char* file : {"rhodamine-6G-Seckin.yml", "F8BT-e-Kamptner.yml"}) {
    const DispersionCurve curve = load_dispersion(materials / file);
    const Spectrum n = sample_n(curve, Extrapolation::automatic), k = sample_k(curve, Extrapolation::automatic);
    EXPECT_GT(*std::max_element(k.begin(), k.end()), 0.1) << file;
    EXPECT_FALSE(std::is_sorted(n.begin(), n.end(), std::greater<>())) << file; // n rises somewhere: anomalous
  }
}

// A factor of 0 needs nothing beside it; what a formula has no groups of may end anywhere.
TEST(Dispersion, CoefficientsMayEndWhereNothingIsMissing) {
  for (const char* rest : {"formula 4\n    coefficients: 2.25 0", "formula 3\n    coefficients: 2.25",
                           "formula 7\n    coefficients: 1.5 0", "formula 9\n    coefficients: 2.25 0 0 0"})
    EXPECT_NEAR(n_at(from_yaml(fmt::format("  - type: {}\n    wavelength_range: 0.3 2.5\n", rest)), 500), 1.5, 1e-12)
        << rest;
}

/// A glass of this formula, with more lines.
DispersionCurve zemax(int kind, double n_d, const std::string& coefficients, const std::string& rest = "") {
  return parse_dispersion(fmt::format("CC own\nNM OWN-1 {} 517642 {} 64.17 0 1\nGC own glass\nED 7.1 8.3 2.51 0 0\n"
                                      "CD {}\nLD 0.3 2.5\n{}",
                                      kind, n_d, coefficients, rest),
                          "own.AGF");
}

TEST(Dispersion, ZemaxGlassIsReadByItsFormula) {
  const char* const bk7 = "1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653 0 0 0 0";
  const DispersionCurve curve = zemax(2, 1.5168, bk7, "IT 0.5 0.998 10\nIT 0.4 0.9 10\n");
  EXPECT_EQ(curve.name, "OWN-1");
  EXPECT_NEAR(n_at(curve, line_d), 1.5168, 1e-5);
  EXPECT_NEAR(*abbe_number(curve), 64.17, 0.01);
  EXPECT_EQ(curve.range_nm(), (std::array{300.0, 2500.0}));
  // exp(-4 pi k / 500 nm * 10 mm) is .998.
  EXPECT_NEAR(std::exp(-4 * std::numbers::pi * *curve.sample(500).k / 500e-9 * 0.01), 0.998, 1e-9);
  EXPECT_FALSE(zemax(2, 1.5168, bk7).sample(500).k);
}

// At 2 um, with fractions that are short; n_d 0 is not compared.
TEST(Dispersion, EveryFormulaOfZemaxByHand) {
  const auto squared = [](int kind, const char* c) { return std::pow(n_at(zemax(kind, 0, c), 2000), 2); };
  EXPECT_NEAR(squared(1, "2 0.5 4 16 64 256"), 2 + 2 + 1 + 1 + 1 + 1, 1e-12);
  EXPECT_NEAR(squared(2, "1 2 1 3 0 0"), 1 + 2 + 4, 1e-12);
  const double pole = 1 / (4 - 0.028);
  EXPECT_NEAR(n_at(zemax(3, 0, "1 2 3 0.1 0.01 0.001"), 2000), 1 + 2 * pole + 3 * pole * pole + 0.4 + 0.16 + 0.064,
              1e-12);
  EXPECT_NEAR(squared(4, "0.5 1 1 2 1.5"), 1.5 + 4.0 / 3 + 2 / 1.75, 1e-12);
  EXPECT_NEAR(n_at(zemax(5, 0, "1 1 1"), 2000), 1.5 + std::pow(2, -3.5), 1e-12);
  EXPECT_NEAR(squared(6, "1 2 0 0 0 0 1 3"), 1 + 2 + 4, 1e-12);
  EXPECT_NEAR(squared(7, "3 1 2 0.25"), 3 + 0.5 - 1, 1e-12);
  EXPECT_NEAR(squared(8, "3 1 2 0.25"), 3 + 2 - 1, 1e-12);
  EXPECT_NEAR(squared(9, "3 1 2 1 3"), 3 + 2 + 4, 1e-12);
  EXPECT_NEAR(squared(10, "2 0 0 0 0 0 1024 4096"), 4, 1e-12);
  EXPECT_NEAR(squared(11, "0 0 0 0 0 0 0 0 1 2"), 3, 1e-12);
  EXPECT_NEAR(squared(12, "2 0 0 0 0 0 0.0625 0.015625"), 4, 1e-12);
  EXPECT_NEAR(squared(13, "2 0.25 0.0625 4 16 64 256 1024 4096"), 10, 1e-12);
}

TEST(Dispersion, ZemaxGlassThatIsNotClearIsRefused) {
  const auto refused = [](const std::string& text) { return refusal_of([&] { parse_dispersion(text, "own.agf"); }); };
  EXPECT_EQ(
      refused("NM A 2 0 1.5\nCD 1\nNM B 2 0 1.5\nCD 1\n"),
      "own.agf: has 2 glasses: A, B; expected one; copy the lines of yours, from its NM up to the next NM, into a "
      "file of its own (.agf)");
  EXPECT_THAT(refused("nothing"), HasSubstr("own.agf: has no glass: no line begins with NM"));
  EXPECT_THAT(refused("CC\nNM A 14 0 1.5\nCD 1\nLD 1 2\n"), HasSubstr("own.agf:2: the formula of A is 14"));
  EXPECT_THAT(refused("NM A 2 0 1.5\nCD x\nLD 1 2\n"), HasSubstr("own.agf:2: CD is followed by 0 numbers"));
  EXPECT_THAT(refused("NM A 2 0 1.5\nCD 1 0\n"), HasSubstr("has no line LD"));
  EXPECT_THAT(refused("NM A 2 0 1.5\nCD 3 0\nLD .4 2\n"),
              HasSubstr("own.agf:1: the formula of A gives n_d = 2.00000, and its line NM says 1.5"));
}

TEST(Dispersion, PathsMayHoldAnyCharacters) {
  EXPECT_EQ(parse_dispersion("DATA:\n  - type: constant\n    value: 2\n", "a (b), c/Gauß 1.5 μm.yml").name,
            "Gauß 1.5 μm");
}

TEST(Dispersion, SellmeierAndCauchyOnTheirOwn) {
  const double b[] = {1.03961212, 0.231792344, 1.01046945}, c[] = {0.00600069867, 0.0200179144, 103.560653};
  EXPECT_NEAR(n_at(sellmeier(b, c), line_d), 1.51680, 1e-5);
  EXPECT_EQ(sellmeier(b, c, 300, 2500).range_nm(), (std::array{300.0, 2500.0}));
  const double cauchy_bk7[] = {1.5046, 0.0042, 0.0001};
  EXPECT_NEAR(n_at(cauchy(cauchy_bk7), 500), 1.5046 + 0.0042 * 4 + 0.0001 * 16, 1e-15);
  EXPECT_EQ(n_at(constant_index(1.25), 1e6), 1.25);
  EXPECT_FALSE(constant_index(1.25).sample(1).extrapolated);
}

TEST(Dispersion, ControlPointsAreMetAndNeverOvershot) {
  const Rows points{{380, 1.5}, {450, 1.5}, {460, 2.0}, {470, 2.0}, {600, 1.2}, {610, 1.7}, {780, 1.71}};
  const DispersionCurve curve = control_points(points);
  for (const auto& [nm, n] : points) EXPECT_NEAR(n_at(curve, nm), n, 1e-12) << nm;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto [low, high] = std::minmax(points[i][1], points[i + 1][1]);
    double previous = points[i][1];
    const double direction = points[i + 1][1] >= points[i][1] ? 1 : -1;
    for (double nm = points[i][0]; nm <= points[i + 1][0]; nm += 0.25) {
      const double n = n_at(curve, nm);
      EXPECT_GE(n, low - 1e-12) << nm;
      EXPECT_LE(n, high + 1e-12) << nm;
      EXPECT_GE((n - previous) * direction, -1e-12) << nm; // monotone between two points
      previous = n;
    }
  }
  // On a straight line the cubic is the line, and one point is a constant.
  EXPECT_NEAR(n_at(control_points(Rows{{400, 1.4}, {500, 1.5}, {800, 1.8}}), 650), 1.65, 1e-12);
  EXPECT_EQ(n_at(control_points(Rows{{500, 1.5}}), 600), 1.5);
}

// The slope is continuous at the control points: a straight table would have corners there.
TEST(Dispersion, ControlPointsAreJoinedSmoothly) {
  const DispersionCurve curve = control_points(Rows{{400, 1.9}, {450, 1.7}, {600, 1.6}, {700, 1.58}});
  for (double nm : {450.0, 600.0}) {
    const double step = 1e-3, left = n_at(curve, nm) - n_at(curve, nm - step),
                 right = n_at(curve, nm + step) - n_at(curve, nm);
    EXPECT_NEAR(left / step, right / step, 1e-6) << nm;
  }
}

TEST(Dispersion, BadCurvesAreRefused) {
  // n^2 = 1 + l^2 / (l^2 - 0.36): negative from 424 nm to the resonance at 600 nm, inside the range.
  const std::array<double, 1> strength{1}, resonance{0.36};
  for (const Extrapolation outside : {Extrapolation::automatic, Extrapolation::hold})
    EXPECT_THAT(
        refusal_of([&] { sample_n(sellmeier(strength, resonance), outside); }),
        AllOf(HasSubstr("gives no number at 425 nm: n^2 is negative or infinite there"), Not(HasSubstr("hold"))));
  const double two[] = {1, 2}, one[] = {1}, bad[] = {1, NAN};
  EXPECT_THAT(refusal_of([&] { sellmeier(two, one); }), HasSubstr("2 values of b and 1 of c"));
  EXPECT_THAT(refusal_of([&] { sellmeier({}, {}); }), HasSubstr("no coefficients"));
  EXPECT_THAT(refusal_of([&] { sellmeier(two, bad); }), HasSubstr("not finite"));
  EXPECT_THAT(refusal_of([&] { sellmeier(one, one, 700, 400); }), HasSubstr("0 < low <= high"));
  EXPECT_THAT(refusal_of([&] { cauchy({}); }), HasSubstr("no coefficients"));
  EXPECT_THAT(refusal_of([&] { constant_index(0); }), HasSubstr("a number above 0"));
  EXPECT_THAT(refusal_of([&] { constant_index(INFINITY); }), HasSubstr("a number above 0"));
  EXPECT_THAT(refusal_of([&] { tabulated({}); }), HasSubstr("the table is empty"));
  EXPECT_THAT(refusal_of([&] {
                tabulated(Rows{{500, 1.5}, {500, 1.6}});
              }),
              HasSubstr("500 nm is given twice, with the values 1.5 and 1.6"));
  EXPECT_NO_THROW(tabulated(Rows{{500, 1.5}, {500, 1.5}}));
  EXPECT_THAT(refusal_of([&] { tabulated(Rows{{-500, 1.5}}); }), HasSubstr("a wavelength above 0"));
  EXPECT_THAT(refusal_of([&] { control_points(Rows{{500, NAN}}); }), HasSubstr("not finite"));
  EXPECT_THAT(refusal_of([&] { constant_index(1.5).sample(-1); }), HasSubstr("the wavelength is -1 nm"));
  EXPECT_THAT(refusal_of([&] { constant_index(1.5).sample(NAN); }), HasSubstr("a number above 0"));
}

struct Malformed {
  std::string name, yaml, line;
};
/// Names the case where GoogleTest prints one that failed.
void PrintTo(const Malformed& file, std::ostream* out) { *out << file.name; }

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithOneLine) {
  EXPECT_EQ(refusal_of([] { parse_dispersion(GetParam().yaml, "f.yml"); }), GetParam().line);
}

constexpr const char* no_map =
    "f.yml: this is no refractiveindex.info file; expected a YAML map with a DATA list, or a glass of Zemax (.agf); a "
    "table of n goes into the preset: {\"type\": \"table\", \"table\": [[nm, n], ...]}";
constexpr const char* no_list = "f.yml:1: DATA is not a list with entries; expected a list of \"- type: ...\" entries";

std::string formula(int number, const std::string& range, const std::string& coefficients) {
  return fmt::format("DATA:\n  - type: formula {}\n    wavelength_range: {}\n    coefficients: {}\n", number, range,
                     coefficients);
}

std::string no_number(int line, const std::string& text) {
  return fmt::format("f.yml:{}: \"{}\" is no number; expected a finite number such as 1.5168 or 2.86E-06", line, text);
}

std::string no_range(const std::string& text) {
  return "f.yml:3: the wavelength range is \"" + text +
         "\"; expected two numbers in micrometres, the lower first, above 0";
}

std::string no_number_of(int formula, int count, int missing, const std::string& factor, int number) {
  return fmt::format("f.yml:4: formula {} has {} coefficients; expected number {}, too, which belongs to the {} of "
                     "number {}",
                     formula, count, missing, factor, number);
}

std::string no_type(const std::string& text) {
  return "f.yml:2: the type is \"" + text + "\"; expected formula 1 to 9, tabulated n, nk or k, or constant";
}

const Malformed cases[] = {
    {"Empty", "", no_map},
    {"Blank", " \n\n", no_map},
    {"Text", "just words", no_map},
    {"List", "- 1\n- 2\n", no_map},
    {"NoData", "COMMENTS: none\n", "f.yml: there is no DATA; expected a DATA list with formulas or tables"},
    {"LowerCaseData", "data:\n  - type: constant\n",
     "f.yml: there is no DATA; expected a DATA list with formulas or tables"},
    {"DataTwice", "DATA: []\nDATA: []\n",
     "f.yml: DATA is given twice; expected one list; check that the file is not doubled"},
    {"DataIsText", "DATA: 1.5\n", no_list},
    {"DataIsEmpty", "DATA: []\n", no_list},
    {"DataIsNull", "DATA:\n", "f.yml:2: DATA is not a list with entries; expected a list of \"- type: ...\" entries"},
    {"EntryIsText", "DATA:\n  - 1.5\n", "f.yml:2: the entry is not a map; expected \"- type: ...\" and its data"},
    {"NoType", "DATA:\n  - data: 1\n", "f.yml:2: the entry has no \"type\""},
    {"TypeIsList", "DATA:\n  - type: [1]\n", "f.yml:2: \"type\" is not text; expected numbers separated by blanks"},
    {"UnknownType", "DATA:\n  - type: tabulated\n", no_type("tabulated") + "; did you mean \"tabulated n\"?"},
    {"FormulaZero", "DATA:\n  - type: formula 0\n", no_type("formula 0") + "; did you mean \"formula 1\"?"},
    {"FormulaTen", "DATA:\n  - type: formula 10\n", no_type("formula 10") + "; did you mean \"formula 1\"?"},
    {"Nonlinear", "DATA:\n  - type: tabulated n2\n", no_type("tabulated n2") + "; did you mean \"tabulated nk\"?"},
    {"FormulaWithoutRange", "DATA:\n  - type: formula 1\n    coefficients: 0 1 1\n",
     "f.yml:2: the entry has no \"wavelength_range\""},
    {"FormulaWithoutCoefficients", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 2.5\n",
     "f.yml:2: the entry has no \"coefficients\""},
    {"FormulaCutAfterItsFirst", formula(4, "0.3 2.5", "1"),
     "f.yml:4: formula 4 has 1 coefficient; expected the terms after it, too: without them n is the same at all "
     "wavelengths; where that is meant, the type is \"constant\""},
    {"RangeOfOne", formula(1, "0.3", "0"), no_range("0.3")},
    {"RangeTurned", formula(1, "2.5 0.3", "0"), no_range("2.5 0.3")},
    {"RangeOfWords", formula(1, "0.3 to 2.5", "0"), no_number(3, "to")},
    {"RangeFromZero", formula(1, "0 2.5", "0"), no_range("0 2.5")},
    {"NoCoefficients", formula(1, "0.3 2.5", "\"\""), "f.yml:4: there are no coefficients; expected at least one"},
    {"CoefficientIsNoNumber", formula(1, "0.3 2.5", "0 1,5 0.1"), no_number(4, "1,5")},
    {"CoefficientIsNan", formula(1, "0.3 2.5", "0 nan"), no_number(4, "nan")},
    {"CoefficientOverflows", formula(1, "0.3 2.5", "0 1e999"), no_number(4, "1e999")},
    {"TooManyCoefficients", formula(8, "0.3 2.5", "1 2 3 4 5"),
     "f.yml:4: formula 8 has 5 coefficients; expected at most 4"},
    {"HalfAPair1", formula(1, "0.3 2.5", "0 1 0.1 2"), no_number_of(1, 4, 5, "2", 4)},
    {"HalfAPair2", formula(2, "0.3 2.5", "0 1"), no_number_of(2, 2, 3, "1", 2)},
    {"HalfAPair3", formula(3, "0.3 2.5", "2 0.1 -2 0.5"), no_number_of(3, 4, 5, "0.5", 4)},
    {"PartOfAGroup", formula(4, "0.3 0.9", "1 1.2 2 0.1 2 0.4 0 0.2"), no_number_of(4, 8, 9, "0.4", 6)},
    {"FactorAlone", formula(4, "0.3 0.9", "1 1.2"), no_number_of(4, 2, 3, "1.2", 2)},
    {"HalfAPair4", formula(4, "0.3 0.9", "1 0 0 0 0 0 0 0 0 1 2 3"), no_number_of(4, 12, 13, "3", 12)},
    {"HalfAPair5", formula(5, "0.3 2.5", "1.5 0.1"), no_number_of(5, 2, 3, "0.1", 2)},
    {"HalfAPair6", formula(6, "0.3 2.5", "0 0.05 230 0.01"), no_number_of(6, 4, 5, "0.01", 4)},
    {"HalfAPair8", formula(8, "0.3 2.5", "0.2 0.1"), no_number_of(8, 2, 3, "0.1", 2)},
    {"PartOfAGroup9", formula(9, "0.3 2.5", "2 0.5 3 0.3 1.5"), no_number_of(9, 5, 6, "0.3", 4)},
    {"Csv", "nm,n\n400,1.53\n700,1.51\n", no_map},
    {"Step", "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('a'),'2;1');\n", no_map},
    {"TableWithoutData", "DATA:\n  - type: tabulated n\n", "f.yml:2: the entry has no \"data\""},
    {"TypeOfManyLetters", "DATA:\n  - type: fffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff\n",
     no_type("ffffffffffffffffffffffffffffffffffffffff")},
    {"RangeOfManyNumbers", formula(1, "1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9", "1"),
     no_range("1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9 1 2 ")},
    {"TableIsEmpty", "DATA:\n  - type: tabulated n\n    data: \"\"\n",
     "f.yml:3: the table is empty; expected at least one row of numbers"},
    {"TableOfBlanks", "DATA:\n  - type: tabulated n\n    data: |\n\n\n",
     "f.yml:3: the table is empty; expected at least one row of numbers"},
    {"TableIsList", "DATA:\n  - type: tabulated n\n    data: [0.5, 1.5]\n",
     "f.yml:3: \"data\" is not text; expected numbers separated by blanks"},
    {"RowTooShort", "DATA:\n  - type: tabulated nk\n    data: |\n        0.5 1.5 0.1\n        0.6 1.5\n",
     "f.yml:5: the row has 2 numbers; expected 3: the wavelength in micrometres, n and k"},
    {"RowTooLong", "DATA:\n  - type: tabulated n\n    data: |\n        0.5 1.5 0.1\n",
     "f.yml:4: the row has 3 numbers; expected 2: the wavelength in micrometres and the value"},
    {"RowAfterABlankOne", "DATA:\n  - type: tabulated k\n    data: |\n        0.5 1.5\n\n        0.6 x\n",
     no_number(6, "x")},
    {"RowWithUnit", "DATA:\n  - type: tabulated n\n    data: |\n        500nm 1.5\n", no_number(4, "500nm")},
    {"RowIsInfinite", "DATA:\n  - type: tabulated n\n    data: |\n        0.5 inf\n", no_number(4, "inf")},
    {"NegativeWavelength", "DATA:\n  - type: tabulated n\n    data: |\n        -0.5 1.5\n",
     "f.yml:4: the wavelength is -0.5 um; expected a wavelength above 0"},
    {"ConstantWithoutValue", "DATA:\n  - type: constant\n", "f.yml:2: the entry has no \"value\""},
    {"SecondEntryBroken",
     "DATA:\n  - type: constant\n    value: 1.5\n  - type: tabulated k\n    data: |\n        0.5\n",
     "f.yml:6: the row has 1 numbers; expected 2: the wavelength in micrometres and the value"},
    {"BrokenYaml", "DATA:\n  - type: [\n",
     "f.yml:3: broken YAML: end of sequence flow not found; expected a file of the refractiveindex.info database"},
    {"Tabs", "DATA:\n\t- type: constant\n",
     "f.yml:2: broken YAML: illegal block entry; expected a file of the refractiveindex.info database"},
};

INSTANTIATE_TEST_SUITE_P(Dispersion, MalformedFile, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace nephroid::dispersion_test
