// SPDX-License-Identifier: Apache-2.0
// Edits of a light's spectrum, and what the panel "Spectra" makes of a preset: without a window.
#include "optics/spectrum.h"
#include "photons/clusters/scene_clusters.h"
#include "photons/effort/importance.h"
#include "scatter/spectra.h"
#include "scenes.h"
#include "spectral/settings.h"
#include "ui/spectral/spectra/curves.h"

namespace nephroid::ui::spectra_edits_test {

using preset::LightSpectrum;
using Type = LightSpectrum::Type;

LightSpectrum table(std::vector<PowerRow> rows) { return {Type::table, "", 0, std::move(rows)}; }

TEST(LightEdits, ATableIsAsNearAsItCanBe) {
  const LightSpectrum d65{Type::illuminant, "D65", 0, {}};
  const LightSpectrum rows = as_table(d65);
  ASSERT_THAT(rows.table, SizeIs(21));
  EXPECT_EQ(rows.table.front()[0], 380);
  EXPECT_EQ(rows.table.back()[0], 780);
  // CIE 015: D65 is 117.812 at 460 nm, its largest value, and 100 at 560 nm.
  EXPECT_NEAR(rows.table[9][1], 100 / 117.812, 5e-4);
  const auto smooth = scatter::make_light_spectrum(rows, "test"), exact = optics::illuminant("D65");
  double displaced = 0; // power that is at another wavelength, both sum to 1
  for (std::size_t w = 0; w < exact.size(); ++w) displaced += std::abs(smooth[w] - exact[w]) / 2;
  EXPECT_LT(displaced, 0.03);
}

TEST(LightEdits, WhatHasNoPowerStillBecomesALight) {
  for (const LightSpectrum& dark :
       {LightSpectrum{Type::illuminant, "D66", 0, {}}, LightSpectrum{Type::lines, "", 0, {{1064, 1}}}})
    EXPECT_NO_THROW(scatter::make_light_spectrum(as_table(dark), "test"));
  EXPECT_EQ(largest_power(table({{400, 0}, {500, 0}})), 1);
  EXPECT_EQ(largest_power({Type::blackbody, "", 5000, {}}), 1);
}

TEST(LightEdits, FiguresAreWhatAPersonReads) {
  EXPECT_EQ(readable({523.4567, 1.234567}), (PowerRow{523.5, 1.235}));
  EXPECT_EQ(readable({523.4567, 123456}), (PowerRow{523.5, 123500}));
  EXPECT_EQ(readable({400, -3}), (PowerRow{400, 0}));
  EXPECT_EQ(readable({400, 1e300}), (PowerRow{400, 1e9})) << "what a preset may have";
  EXPECT_TRUE(std::isnan(readable({400, std::nan("")})[1])) << "no place, which edits refuse";
}

TEST(LightEdits, TheWidestGapTakesARow) {
  const LightSpectrum light = sorted(table({{700, 1}, {400, 3}, {500, 2}}));
  EXPECT_THAT(light.table, ElementsAre(PowerRow{400, 3}, PowerRow{500, 2}, PowerRow{700, 1}));
  EXPECT_EQ(in_widest_gap(light), (PowerRow{600, 1.5})) << "on the line that the table is";
  EXPECT_EQ(in_widest_gap(table({{600, 1}, {700, 2}})), (PowerRow{490, 0})) << "a table has nothing outside";
  EXPECT_EQ(in_widest_gap({Type::lines, "", 0, {{546.1, 4}}})[1], 2) << "half of the largest";
}

TEST(LightEdits, ATableKeepsTwoRowsAndLinesOne) {
  EXPECT_EQ(row_rules(table({{400, 1}, {500, 1}})).fewest, 2u);
  EXPECT_EQ(row_rules({Type::lines, "", 0, {{546.1, 4}}}).fewest, 1u);
}

/// What the program would bring along with a run.
std::shared_ptr<const SeenByGlass> seen_of(const preset::Preset& preset) {
  const scene::Scene scene = scene::load_scene(preset);
  return SeenByGlass::of(preset, scene, scene::build_bvh(scene.geometry));
}

TEST(SpectraMaker, MakesAnewWhatChangedOnly) {
  preset::Preset preset = preset::parse_preset(test::room_text(R"("D65")"), "room.json");
  SpectraMaker maker;
  EXPECT_THAT(maker.update(preset, nullptr).why_no_u, HasSubstr("before a run"));
  EXPECT_EQ(maker.spectra().lights[0].spectrum, optics::illuminant("D65"));
  maker.update(preset, nullptr);
  EXPECT_EQ(maker.updates(), 1u);
  const auto seen = seen_of(preset);
  const Spectra& spectra = maker.update(preset, seen);
  EXPECT_EQ(spectra.why_no_u, "");
  maker.update(preset, seen_of(preset));
  EXPECT_EQ(maker.updates(), 2u) << "another run saw the same";
  preset.scene.lights[0].spectrum.illuminant = "A";
  const std::size_t clusters = spectra.clusters.size();
  const double before = spectra.importance.u[50];
  maker.update(preset, seen);
  EXPECT_EQ(spectra.clusters.size(), clusters);
  EXPECT_LT(spectra.importance.u[50], before) << "there is less blue in A, and no run was needed to know";
}

TEST(SpectraMaker, LeavesOutWavelengthsThatNoLightHas) {
  preset::Preset preset =
      preset::parse_preset(test::room_text(R"({"type": "lines", "table": [[450, 1], [600, 1]]})"), "room.json");
  SpectraMaker maker;
  const Spectra& spectra = maker.update(preset, seen_of(preset));
  ASSERT_THAT(spectra.clusters, SizeIs(2));
  EXPECT_THAT(spectra.clusters[0].wavelengths, ElementsAre(70));
  EXPECT_EQ(spectra.cluster_of[70], 0);
  EXPECT_EQ(spectra.cluster_of[71], -1);
  EXPECT_EQ(spectra.clusters[1].iterations, 100) << "600 nm matters most of the two";
  EXPECT_EQ(spectra.equal_effort(), 200);
  EXPECT_EQ(spectra.brute_force(), 40100);
}

// Layers for another light split clusters by what absorbing glass takes on a path as long as the object is, which the
// preset does not say.
TEST(SpectraMaker, LayersHaveTheClustersOfTheRun) {
  preset::Preset preset = preset::parse_preset(test::room_text(R"("D65")", "power"), "room.json");
  spectral::settings(preset).relight = true;
  preset::Dispersion& glass = preset.scene.materials["glass"].dispersion;
  glass.type = preset::Dispersion::Type::file;
  glass.file = "rhodamine-6G-Seckin";
  SpectraMaker maker;
  EXPECT_THAT(maker.update(preset, nullptr).why_no_u, HasSubstr("not known before a run"));
  const auto seen = seen_of(preset);
  const Spectra& spectra = maker.update(preset, seen);
  const scene::Scene scene = scene::load_scene(preset);
  EXPECT_EQ(spectra.why_no_u, "");
  EXPECT_THAT(spectra.clusters, SizeIs(photons::scene_clusters(spectral::settings(preset), scene).size()));
  preset.scene.lights[0].spectrum.illuminant = "A"; // no new run
  EXPECT_EQ(maker.update(preset, seen).why_no_u, "");
  spectral::settings(preset).threshold_deg = 1;
  EXPECT_THAT(maker.update(preset, seen).why_no_u, HasSubstr("not known before a run"));
}

TEST(SpectraMaker, WeighsSeveralLightsByTheirWattsAsTheyAreNow) {
  preset::Preset preset = preset::parse_preset(test::room_text(R"("D65")"), "room.json");
  preset.scene.lights.push_back(preset.scene.lights[0]);
  preset.scene.lights[1].position = {-1, 1, 0.5};
  preset.scene.lights[1].spectrum.illuminant = "A";
  SpectraMaker maker;
  const auto seen = seen_of(preset);
  for (const auto effort : {photons::Settings::Effort::importance, photons::Settings::Effort::power}) {
    spectral::settings(preset).effort = effort;
    for (const double watts : {0.0, 10.0, 90.0}) { // looked at with 10 W
      preset.scene.lights[1].power_w = watts;
      const scene::Scene scene = scene::load_scene(preset);
      const auto expected =
          photons::wavelength_importance(spectral::settings(preset), scene, scene::build_bvh(scene.geometry));
      EXPECT_EQ(maker.update(preset, seen).importance.u, expected.u) << watts << " W";
    }
  }
}

TEST(SpectraMaker, GivesMaterialsTheirColours) {
  const preset::Preset preset = preset::parse_preset(test::room_text(R"("D65")"), "room.json");
  SpectraMaker maker;
  const Spectra& spectra = maker.update(preset, nullptr);
  ASSERT_THAT(spectra.reflectances, SizeIs(2)) << "glass reflects by Fresnel, and nothing is of the unused material";
  EXPECT_EQ(spectra.reflectances[0].material, "floor");
  for (const double channel : spectra.reflectances[0].srgb)
    EXPECT_NEAR(channel, optics::srgb_encode(0.5), 2e-3) << "grey under D65";
  // The ColorChecker's red is (175, 54, 60) in sRGB: X-Rite's own figures, under D50 adapted to D65.
  EXPECT_NEAR(255 * spectra.reflectances[1].srgb[0], 175, 12);
  EXPECT_NEAR(255 * spectra.reflectances[1].srgb[1], 54, 12);
  EXPECT_NEAR(255 * spectra.reflectances[1].srgb[2], 60, 12);
}

TEST(SpectraMaker, WritesEveryCurveAsCsv) {
  const preset::Preset preset = preset::parse_preset(test::room_text(R"("E")", "equal"), "room.json");
  SpectraMaker maker;
  const std::string csv = to_csv(maker.update(preset, seen_of(preset)));
  EXPECT_THAT(csv, StartsWith("wavelength_nm,light 1,luminosity,\"reflectance of floor\",\"reflectance of "
                              "red\",u,cluster,iterations\n380,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 402);
  EXPECT_THAT(csv, HasSubstr("\n555,")) << csv;
  EXPECT_THAT(csv, EndsWith(",100\n")) << "equal effort: every cluster has every pass";
}

TEST(WavelengthColour, IsBlueThenGreenThenRed) {
  const auto blue = wavelength_colour(450 - 380), green = wavelength_colour(530 - 380),
             red = wavelength_colour(640 - 380);
  EXPECT_GT(blue[2], std::max(blue[0], blue[1]));
  EXPECT_GT(green[1], std::max(green[0], green[2]));
  EXPECT_GT(red[0], std::max(red[1], red[2]));
  for (int w = 0; w < optics::wavelength_count; ++w)
    for (const double channel : wavelength_colour(w)) {
      EXPECT_GE(channel, 0);
      EXPECT_LE(channel, 1);
    }
}

} // namespace nephroid::ui::spectra_edits_test
