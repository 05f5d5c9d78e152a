// SPDX-License-Identifier: Apache-2.0
// What glazings reflect and let pass, on the host: closed forms, a balance of the light between all faces, other
// formulas for films, published figures, and how far the table that kernels read is off between its angles.
#include "kernels/tracing/shared_types.h"
#include "optics/colour.h"
#include "optics/fresnel.h"
#include "optics/glazing.h"
#include "optics/spectrum.h"
#include "scatter/material.h"
#include "scatter/spectra.h"
#include "tests/support/test.h"

#include <complex>
#include <numbers>

namespace nephroid::glazing_test {

using optics::GlazingParts;
using optics::SpectralRange;
using optics::Spectrum;
using Complex = std::complex<double>;

constexpr std::size_t green = 550 - optics::first_nm;

optics::GlassPane glass(double n, double passes = 1) {
  optics::GlassPane pane;
  pane.n.fill(n);
  pane.passes.fill(passes);
  return pane;
}

optics::Film film(double n, double k, double thickness_nm) {
  optics::Film made{.thickness_nm = thickness_nm};
  made.n.fill(n);
  made.k.fill(k);
  return made;
}

GlazingParts parts(const std::vector<optics::Pane>& panes, double angle_deg, std::size_t wavelength = green) {
  return optics::glazing_parts(panes, std::cos(angle_deg * std::numbers::pi / 180), wavelength, SpectralRange::visible);
}

/// What one face of glass reflects of light polarised across the plane of incidence and in it: tan and sin of the sum
/// and the difference of both angles.
std::array<double, 2> face(double n, double angle_deg) {
  const double i = angle_deg * std::numbers::pi / 180, t = std::asin(std::sin(i) / n);
  if (i == 0) return {std::pow((n - 1) / (n + 1), 2), std::pow((n - 1) / (n + 1), 2)};
  return {std::pow(std::sin(i - t) / std::sin(i + t), 2), std::pow(std::tan(i - t) / std::tan(i + t), 2)};
}

// m lossless panes are 2 m faces that reflect R each: (1 - R) / (1 + (2 m - 1) R) passes (Stokes 1862), .92308 of a
// pane of n = 1.5 straight on.
TEST(Glazing, ClearPanesAreStokesPileOfPlates) {
  EXPECT_NEAR(parts({glass(1.5)}, 0).passes, 0.923077, 1e-6);
  for (const double angle_deg : {0.0, 30.0, 56.31, 60.0, 80.0, 89.0})
    for (std::size_t m = 1; m <= 3; ++m) {
      double passes = 0;
      for (const double r : face(1.5, angle_deg)) passes += (1 - r) / (1 + (2.0 * double(m) - 1) * r) / 2;
      const GlazingParts at = parts(std::vector<optics::Pane>(m, glass(1.5)), angle_deg);
      EXPECT_NEAR(at.passes, passes, 1e-12) << angle_deg << ", " << m;
      EXPECT_NEAR(at.front, 1 - passes, 1e-12);
      EXPECT_NEAR(at.back, 1 - passes, 1e-12);
    }
}

// The light between faces, followed until none is left: what goes on and back between face and face, and what each pane
// keeps, sums up to all.
TEST(Glazing, IsTheBalanceOfTheLightBetweenAllFaces) {
  const std::vector<double> n{1.5, 1.7, 1.6}, kept{0.9, 0.7, 0.95};
  std::vector<optics::Pane> panes;
  for (std::size_t i = 0; i < 3; ++i) panes.emplace_back(glass(n[i], kept[i]));
  for (const double angle_deg : {0.0, 45.0, 75.0}) {
    GlazingParts mean{0, 0, 0};
    double absorbed = 0;
    for (const std::size_t polarisation : {0u, 1u})
      for (const bool from_front : {true, false}) {
        // Gap g is before face g; on[g] goes towards the inside in it, back[g] the other way. Odd gaps are glass.
        std::array<double, 8> on{}, back{};
        (from_front ? on[0] : back[6]) = 1;
        double passed = 0, reflected = 0, lost = 0;
        for (int round = 0; round < 4000; ++round) {
          std::array<double, 8> next_on{}, next_back{};
          for (std::size_t f = 0; f < 6; ++f) {
            const double r = face(n[f / 2], angle_deg)[polarisation];
            next_on[f + 1] += on[f] * (1 - r) + back[f + 1] * r;
            next_back[f] += on[f] * r + back[f + 1] * (1 - r);
          }
          for (std::size_t g = 1; g < 6; g += 2) {
            const double inner = std::asin(std::sin(angle_deg * std::numbers::pi / 180) / n[g / 2]),
                         left = std::pow(kept[g / 2], 1 / std::cos(inner));
            lost += (next_on[g] + next_back[g]) * (1 - left);
            next_on[g] *= left;
            next_back[g] *= left;
          }
          passed += from_front ? next_on[6] : next_back[0];
          reflected += from_front ? next_back[0] : next_on[6];
          next_on[6] = next_back[0] = 0;
          on = next_on;
          back = next_back;
        }
        EXPECT_NEAR(passed + reflected + lost, 1, 1e-12);
        mean.passes += passed / 4;
        (from_front ? mean.front : mean.back) += reflected / 2;
        if (from_front) absorbed += lost / 2;
      }
    const GlazingParts at = parts(panes, angle_deg);
    EXPECT_NEAR(at.passes, mean.passes, 1e-12);
    EXPECT_NEAR(at.front, mean.front, 1e-12);
    EXPECT_NEAR(at.back, mean.back, 1e-12);
    EXPECT_NEAR(at.passes + at.front + absorbed, 1, 1e-12);
  }
}

// Turned round, it lets as much pass and reflects what its other side did. Here with silver between two layers.
TEST(Glazing, TurnedRoundItIsTheSameFromBehind) {
  optics::GlassPane low_e = glass(1.52, 0.95), flipped = low_e;
  low_e.back = {film(2.3, 0, 40), film(0.06, 3.5, 12), film(2, 0, 35)};
  flipped.front = {film(2, 0, 35), film(0.06, 3.5, 12), film(2.3, 0, 40)};
  for (const double angle_deg : {0.0, 50.0, 85.0}) {
    const GlazingParts a = parts({low_e, glass(1.5, 0.8)}, angle_deg), b = parts({glass(1.5, 0.8), flipped}, angle_deg);
    EXPECT_NEAR(a.passes, b.passes, 1e-12);
    EXPECT_NEAR(a.front, b.back, 1e-12);
    EXPECT_NEAR(a.back, b.front, 1e-12);
    EXPECT_LT(a.passes + a.front, 1);
    EXPECT_GT(std::abs(a.front - a.back), 0.01);
  }
}

// One layer: Airy's sum over its reflections, here with what passes too, for both polarisations.
TEST(Glazing, AFilmIsAirysSum) {
  for (const Complex layer : {Complex(1.38, 0), Complex(2.4, 0.05), Complex(0.06, 3.6)})
    for (const double angle_deg : {0.0, 40.0, 70.0}) {
      const double n = 1.52, thickness = 15, nm = 550, i = angle_deg * std::numbers::pi / 180;
      const Complex cos_l = std::sqrt(1.0 - std::pow(std::sin(i) / layer, 2)),
                    phase = std::exp(Complex(0, 2 * std::numbers::pi * thickness / nm) * layer * cos_l);
      const double cos_i = std::cos(i), cos_t = std::sqrt(1 - std::pow(std::sin(i) / n, 2));
      double passes = 0, front = 0, back = 0;
      for (const bool across : {true, false}) {
        const auto r = [&](Complex n1, Complex c1, Complex n2, Complex c2) {
          return across ? (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2) : (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
        };
        const auto t = [&](Complex n1, Complex c1, Complex n2, Complex c2) {
          return 2.0 * n1 * c1 / (across ? n1 * c1 + n2 * c2 : n2 * c1 + n1 * c2);
        };
        const Complex r1 = r(1, cos_i, layer, cos_l), r2 = r(layer, cos_l, n, cos_t), round = r1 * r2 * phase * phase;
        const double film_front = std::norm((r1 + r2 * phase * phase) / (1.0 + round)),
                     film_back = std::norm((-r2 - r1 * phase * phase) / (1.0 + round)),
                     film_passes =
                         std::norm(t(1, cos_i, layer, cos_l) * t(layer, cos_l, n, cos_t) * phase / (1.0 + round)) * n *
                         cos_t / cos_i;
        const double other = face(n, angle_deg)[across ? 0 : 1], all = 1 - film_back * other;
        passes += film_passes * (1 - other) / all / 2;
        front += (film_front + film_passes * film_passes * other / all) / 2;
        back += (other + (1 - other) * (1 - other) * film_back / all) / 2;
      }
      optics::GlassPane pane = glass(n);
      pane.front = {film(layer.real(), layer.imag(), thickness)};
      const GlazingParts at = parts({pane}, angle_deg);
      EXPECT_NEAR(at.passes, passes, 1e-9) << layer << ", " << angle_deg;
      EXPECT_NEAR(at.front, front, 1e-9);
      EXPECT_NEAR(at.back, back, 1e-9);
    }
}

// Behind a micrometre of silver nothing is seen, nor behind what exp() of would be no number.
TEST(Glazing, ThickSilverIsAMirror) {
  optics::GlassPane pane = glass(1.5);
  for (const double nm : {1000.0, 20000.0})
    for (const double angle_deg : {0.0, 60.0, 85.0}) {
      pane.front = {film(0.06, 3.6, nm)};
      EXPECT_NEAR(parts({pane}, angle_deg).front,
                  optics::conductor_reflectance(std::cos(angle_deg * std::numbers::pi / 180), 1, {0.06, 3.6}), 1e-9);
      EXPECT_NEAR(parts({pane}, angle_deg).passes, 0, 1e-9);
    }
}

// A pane that is known by what it does straight on is, without a coating, the pane that does that.
TEST(Glazing, AnUncoatedPaneIsFoundFromStraightOn) {
  for (const double n : {1.3, 1.52, 2.0})
    for (const double kept : {1.0, 0.8, 0.1}) {
      const GlazingParts straight = parts({glass(n, kept)}, 0);
      optics::MeasuredPane measured{.coated = false};
      measured.transmittance.fill(straight.passes);
      measured.front.fill(straight.front);
      measured.back.fill(straight.back);
      for (const double angle_deg : {0.0, 50.0, 80.0}) {
        const GlazingParts at = parts({measured}, angle_deg), truth = parts({glass(n, kept)}, angle_deg);
        EXPECT_NEAR(at.passes, truth.passes, 1e-9);
        EXPECT_NEAR(at.front, truth.front, 1e-9);
      }
    }
}

// The regressions: right straight on, a mirror at grazing incidence, and of clear glass off by what they are known for.
TEST(Glazing, ACoatedPaneGoesByRegression) {
  for (const double t : {0.1, 0.5, 0.8}) {
    optics::MeasuredPane pane;
    pane.transmittance.fill(t);
    pane.front.fill(0.15);
    pane.back.fill(0.05);
    const GlazingParts straight = parts({pane}, 0);
    EXPECT_NEAR(straight.passes, t, 1e-12);
    EXPECT_NEAR(straight.front, 0.15, 1e-12);
    EXPECT_NEAR(straight.back, 0.05, 1e-12);
    EXPECT_NEAR(parts({pane}, 90).front, 1, 1e-3);
    EXPECT_NEAR(parts({pane}, 90).passes, 0, 1e-12);
    for (double angle_deg = 0; angle_deg < 90; angle_deg += 1) {
      const GlazingParts at = parts({pane}, angle_deg);
      EXPECT_LE(at.passes + std::max(at.front, at.back), 1 + 1e-12);
      EXPECT_GE(at.front, straight.front - 1e-12);
    }
  }
  const optics::Pane clear = glass(1.52, 0.97);
  const GlazingParts straight = parts({clear}, 0);
  optics::MeasuredPane measured;
  measured.transmittance.fill(straight.passes);
  measured.front.fill(straight.front);
  measured.back.fill(straight.back);
  double worst = 0;
  for (double angle_deg = 0; angle_deg < 90; angle_deg += 1)
    worst = std::max({worst, std::abs(parts({measured}, angle_deg).passes - parts({clear}, angle_deg).passes),
                      std::abs(parts({measured}, angle_deg).front - parts({clear}, angle_deg).front)});
  RecordProperty("worst", fmt::format("{:.4f}", worst));
  EXPECT_LT(worst, 0.03);
}

scatter::Material made(std::vector<preset::Pane> panes, SpectralRange range = SpectralRange::visible) {
  preset::Material of;
  of.type = preset::Material::Type::glazing;
  of.panes = std::move(panes);
  std::vector<std::string> warnings;
  return scatter::make_material("m", of, FileFinder(), "test", warnings, range);
}

preset::Pane pane_of(const std::string& dispersion, double thickness_mm) {
  preset::Pane pane;
  pane.thickness_mm = thickness_mm;
  pane.dispersion.file = dispersion;
  return pane;
}

/// Straight on: of D65 as the eye sees it, as EN 410 and NFRC 300 have it. column: of the table by angle.
double visible(const scatter::Material& glazing, std::size_t column) {
  const Spectrum light = optics::illuminant("D65");
  Spectrum left = light;
  for (std::size_t w = 0; w < left.size(); ++w)
    left[w] *= glazing.by_angle[(GLAZING_ANGLES - 1) * GLAZING_ROW + column * GLAZING_PARTS + w];
  return optics::to_xyz(left)[1] / optics::to_xyz(light)[1];
}

// EnergyPlus, WindowGlassMaterials.idf: of single panes, mm. ASHRAE Handbook, Fundamentals, table "Visible
// transmittance
// ... of glazing": of units of two and three clear panes of 3.2 and 6 mm. Bronze and grey glass differ by maker.
TEST(Glazing, HasPublishedFigures) {
  struct Published {
    const char* glass;
    double mm, passes, reflects, tolerance;
  };
  for (const Published& p : {Published{"soda-lime-clear", 3, 0.898, 0.081, 0.002},
                             {"soda-lime-clear", 6, 0.881, 0.080, 0.002},
                             {"soda-lime-low-iron", 3, 0.914, 0.083, 0.002},
                             {"soda-lime-green", 3, 0.822, 0.075, 0.008},
                             {"soda-lime-green", 6, 0.749, 0.070, 0.008},
                             {"soda-lime-bronze", 3, 0.685, 0.065, 0.015},
                             {"soda-lime-bronze", 6, 0.534, 0.057, 0.015},
                             {"soda-lime-grey", 3, 0.611, 0.061, 0.015},
                             {"soda-lime-grey", 6, 0.431, 0.052, 0.015}}) {
    const scatter::Material pane = made({pane_of(p.glass, p.mm)});
    RecordProperty(fmt::format("{} {} mm", p.glass, p.mm), fmt::format("{:.4f}", visible(pane, 0)));
    EXPECT_NEAR(visible(pane, 0), p.passes, p.tolerance) << p.glass << ", " << p.mm << " mm";
    EXPECT_NEAR(visible(pane, 1), p.reflects, 0.003) << p.glass << ", " << p.mm << " mm";
  }
  struct Unit {
    std::size_t panes;
    double mm, passes;
  };
  for (const Unit& unit : {Unit{2, 3.2, 0.81}, {2, 6, 0.78}, {3, 3.2, 0.74}, {3, 6, 0.70}}) {
    const scatter::Material glazing = made(std::vector(unit.panes, pane_of("soda-lime-clear", unit.mm)));
    RecordProperty(fmt::format("{} of {} mm", unit.panes, unit.mm),
                   fmt::format("{:.4f} {:.4f}", visible(glazing, 0), visible(glazing, 1)));
    EXPECT_NEAR(visible(glazing, 0), unit.passes, 0.01) << unit.panes << " of " << unit.mm << " mm";
  }
}

preset::Coating layer(preset::Dispersion of, double nm) { return {std::move(of), nm}; }

/// Insulating glass with two coatings of silver.
std::vector<preset::Pane> triple() {
  preset::Pane first = pane_of("soda-lime-clear", 6), middle = pane_of("soda-lime-low-iron", 4), last = first;
  preset::Dispersion silver, oxide;
  silver.type = preset::Dispersion::Type::file;
  silver.file = "silver";
  oxide.n = 2;
  first.back_films = last.front_films = {layer(oxide, 35), layer(silver, 12), layer(oxide, 40)};
  return {first, middle, last};
}

// Between its angles the table is off by less than .2 % of the light, whatever the panes.
TEST(Glazing, ItsTableHasAnglesEnough) {
  preset::Pane measured;
  measured.type = preset::Pane::Type::measured;
  const preset::Pane clear = pane_of("soda-lime-clear", 4);
  for (const auto& panes : {std::vector{clear}, {clear, clear}, {clear, clear, clear}, triple(), {measured, clear}}) {
    const scatter::Material glazing = made(panes);
    double worst = 0;
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t i = 1; i + 1 < GLAZING_ANGLES; ++i)
        for (const std::size_t w : {std::size_t{0}, green, std::size_t{400}}) {
          const auto at = [&](std::size_t k) { return glazing.by_angle[k * GLAZING_ROW + column * GLAZING_PARTS + w]; };
          // The error of a straight line is an eighth of the second difference.
          worst = std::max(worst, std::abs(at(i - 1) - 2 * at(i) + at(i + 1)) / 8);
        }
    RecordProperty(fmt::format("worst of {} panes", panes.size()), fmt::format("{:.5f}", worst));
    EXPECT_LT(worst, 0.002) << panes.size() << " panes";
  }
}

std::string refusal(const preset::Pane& pane, SpectralRange range = SpectralRange::visible) {
  return refusal_of([&] { made({pane}, range); });
}

preset::Pane pane_in(const std::string& file) {
  preset::Pane pane;
  pane.type = preset::Pane::Type::file;
  pane.file = file;
  return pane;
}

TEST(Glazing, FilesOfMeasuredPanesAreRead) {
  const TemporaryFolder folder;
  const std::string rows = "0.30, 0.10, 0.20, 0.05\n0.50 0.60\t0.25 0.08\r\n\n2.5;0.2;0.5;0.6\n";
  const preset::Pane um = pane_in(folder.write("um.txt", "{ Units } SI Microns\n{ Thickness } 6\n" + rows)),
                     nm = pane_in(folder.write("nm.csv", "wavelength,T,Rf,Rb\n300,.1,.2,.05\n500,.6,.25,.08\n2500,.2,"
                                                         ".5,.6"));
  const scatter::Material a = made({um}), b = made({nm});
  EXPECT_THAT(a.by_angle, Pointwise(DoubleNear(1e-12), b.by_angle));
  const std::size_t straight = (GLAZING_ANGLES - 1) * GLAZING_ROW;
  EXPECT_NEAR(a.by_angle[straight + 120], 0.6, 1e-12);
  EXPECT_NEAR(a.by_angle[straight + GLAZING_PARTS + 120], 0.25, 1e-12);
  EXPECT_NEAR(a.by_angle[straight + 2 * GLAZING_PARTS + 120], 0.08, 1e-12);
  preset::Pane flipped = um;
  flipped.flipped = true;
  EXPECT_NEAR(made({flipped}).by_angle[straight + GLAZING_PARTS + 120], 0.08, 1e-12);
}

TEST(Glazing, WhatNoPaneCanBeIsRefused) {
  const TemporaryFolder folder;
  const auto refusal_of_text = [&](const std::string& text) {
    return refusal(pane_in(folder.write("pane.txt", text)));
  };
  EXPECT_THAT(refusal_of_text("300 .1 .2 .3\n400 .1 .2\n"),
              EndsWith("pane.txt:2: is no row of four numbers; expected wavelength, transmittance, front, back "
                       "reflectance"));
  EXPECT_THAT(refusal_of_text("400 .1 .2 .3\n300 .1 .2 .3\n"),
              EndsWith("pane.txt:2: has the wavelength 300; expected one above that of the row before"));
  EXPECT_THAT(refusal_of_text("400 .1 .2 .3\n500 .1 20 .3\n"),
              EndsWith("pane.txt:2: has the part 20; expected 0 to 1"));
  EXPECT_THAT(refusal_of_text("400 .1 .2 .3\n"), HasSubstr("pane.txt: has no table; expected two or more rows"));
  EXPECT_THAT(refusal_of_text("400 .9 .2 .3\n800 .9 .2 .3\n"),
              EndsWith("/panes/0: lets 0.9 pass and reflects 0.3 at 380 nm; expected no more than 1 together"));
  preset::Pane pane;
  pane.type = preset::Pane::Type::measured;
  pane.back_reflectance.value = 0.3;
  EXPECT_THAT(refusal(pane), HasSubstr("/panes/0: lets 0.8 pass and reflects 0.3"));
  preset::Pane gas;
  gas.dispersion = {};
  gas.dispersion.n = 0.9;
  EXPECT_THAT(refusal(gas), HasSubstr("/panes/0/dispersion: has the index 0.9; expected 1 to 4 for a pane"));
}

// In the sun's range a note says what is not known there.
TEST(Glazing, WhatIsAssumedBeyondTheDataIsSaid) {
  const TemporaryFolder folder;
  preset::Material of;
  of.type = preset::Material::Type::glazing;
  of.panes = {pane_in(folder.write("pane.txt", "300 .5 .1 .1\n2500 .5 .1 .1\n")), preset::Pane()};
  std::vector<std::string> notes;
  scatter::make_material("m", of, FileFinder(), "test", notes, SpectralRange::solar);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("pane.txt is known from 300 to 2500 nm alone; beyond, the values at the "
                                           "ends are taken"),
                                 HasSubstr("n is extrapolated below 310 nm")));
}

} // namespace nephroid::glazing_test
