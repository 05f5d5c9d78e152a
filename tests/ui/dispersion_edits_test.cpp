// SPDX-License-Identifier: Apache-2.0
// What can be done to a dispersion: places snap to a grid, a glass becomes control points, files are loaded or refused,
// also by the panel "Dispersion".
#include "dispersion_fixture.h"
#include "optics/dispersion_file.h"

namespace nephroid::ui::dispersion_edits_test {

using photons::ClusterMethod;

optics::Spectrum glass(const std::string& name) {
  return optics::sample_n(optics::load_dispersion(shipped(name)), optics::Extrapolation::automatic);
}

TEST(DispersionEdits, SnapsToAGrid) {
  const ControlPoint point = snapped({512.4, 1.5231}, {1, 0.005});
  EXPECT_EQ(point[0], 512);
  EXPECT_NEAR(point[1], 1.525, 1e-12);
  EXPECT_EQ(snapped({512.4, 1.5231}, {0, 0}), (ControlPoint{512.4, 1.5231}));
}

TEST(DispersionEdits, AGlassBecomesControlPointsThatReproduceIt) {
  for (const char* name : {"N-BK7", "N-SF66", "water-20C-Daimon", "diamond-Peter"}) {
    const optics::Spectrum n = glass(name);
    const FittedPoints fitted = fit_points(n);
    EXPECT_LE(fitted.greatest_deviation, 1e-4) << name;
    EXPECT_LE(fitted.points.size(), 20u) << name;
    const optics::Spectrum again =
        optics::sample_n(optics::control_points(fitted.points), optics::Extrapolation::refuse);
    double worst = 0;
    for (std::size_t i = 0; i < n.size(); ++i) worst = std::max(worst, std::fabs(again[i] - n[i]));
    EXPECT_DOUBLE_EQ(worst, fitted.greatest_deviation) << name << ": it says what it is off by";
    RecordProperty(name, static_cast<int>(fitted.points.size()));
  }
}

TEST(DispersionEdits, AWildCurveTakesAllThePointsItMayHave) {
  const optics::Spectrum n = glass("rhodamine-6G-Seckin");
  const FittedPoints few = fit_points(n, 1e-5, 10), many = fit_points(n, 1e-5, 40);
  EXPECT_EQ(few.points.size(), 10u);
  EXPECT_LT(many.greatest_deviation, few.greatest_deviation);
  optics::Spectrum flat{};
  flat.fill(1.5);
  EXPECT_EQ(fit_points(flat).points.size(), 2u);
}

TEST(DispersionEdits, LoadsFilesAndSaysWhatIsWrongWithThem) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(load_dispersion(shipped("N-BK7"), "").file, shipped("N-BK7"));
  EXPECT_EQ(load_dispersion("N-BK7", "").file, "N-BK7") << "a shipped material's name means the same from every folder";
  const auto refusal = [](const std::string& file) { return test::refusal_of([&] { load_dispersion(file, ""); }); };
  EXPECT_THAT(refusal((folder.path() / "missing.yml").string()), HasSubstr("missing.yml"));
  EXPECT_THAT(refusal(folder.write("broken.yml", "DATA: [")), HasSubstr("broken.yml"));
  EXPECT_THAT(
      refusal(folder.write("only-k.yml", "DATA:\n  - type: tabulated k\n    data: |\n      0.3 0.1\n      0.9 0.1\n")),
      HasSubstr("no index of refraction"));
  EXPECT_THAT(
      refusal(folder.write("below.yml", "DATA:\n  - type: tabulated n\n    data: |\n      0.3 1.5\n      0.9 -1\n")),
      HasSubstr("expected n above 0"));
  EXPECT_NE(refusal(""), "");
}

TEST(DispersionEdits, DielectricsThatObjectsUseComeFirst) {
  preset::Preset preset;
  for (const char* name : {"air", "glass", "water"})
    preset.scene.materials[name].type = preset::Material::Type::dielectric;
  preset.scene.materials["wall"];
  for (const char* name : {"wall", "water", "nowhere", "glass", "water"})
    preset.scene.objects.emplace_back().material = name;
  EXPECT_THAT(dielectrics(preset), ElementsAre("water", "glass", "air"));
  EXPECT_EQ(shown_dielectric(preset, "air"), "air");
  EXPECT_EQ(shown_dielectric(preset, "wall"), "water");
  EXPECT_EQ(shown_dielectric(preset::Preset{}, "glass"), "");
}

/// The mean of asin(sin theta / n) over 0..89 degrees, in degrees, by the midpoint rule; n > 1.
double mean_angle(double n) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += std::asin(std::sin((i + 0.5) / steps * 89 * std::numbers::pi / 180) / n);
  return sum / steps * 180 / std::numbers::pi;
}

// n = 1.6 below 480 nm and 1.5 beyond, one cluster: both rays of 45 degrees go as one.
TEST(DispersionFigures, TheSpreadIsTheDifferenceOfTheAngles) {
  optics::Spectrum n{};
  for (std::size_t i = 0; i < n.size(); ++i) n[i] = i < 100 ? 1.6 : 1.5;
  const ClusterFigures figures = figures_of(photons::cluster_wavelengths(n, 45, ClusterMethod::optimal), n);
  ASSERT_EQ(figures.clustering.clusters.size(), 1u);
  const double at_45 = (std::asin(std::sqrt(0.5) / 1.5) - std::asin(std::sqrt(0.5) / 1.6)) * 180 / std::numbers::pi;
  EXPECT_NEAR(figures.at_45.greatest_deg, at_45, 1e-12);
  EXPECT_NEAR(figures.at_45.mean_deg, at_45, 1e-12);
  EXPECT_NEAR(figures.mean_over_angles.greatest_deg, mean_angle(1.5) - mean_angle(1.6), 1e-6);
  EXPECT_EQ(figures.saving, 401);
}

TEST(DispersionFigures, InsideAClusterTheMeanSpreadIsBelowTheThreshold) {
  for (const char* name : {"N-SF66", "arbitrary-1", "rhodamine-6G-Seckin"}) {
    const optics::Spectrum n = glass(name);
    for (const double threshold : {0.01, 0.05, 0.5}) {
      const ClusterFigures optimal = figures_of(photons::cluster_wavelengths(n, threshold, ClusterMethod::optimal), n);
      EXPECT_LE(optimal.mean_over_angles.greatest_deg, threshold) << name;
      EXPECT_LE(optimal.mean_over_angles.mean_deg, optimal.mean_over_angles.greatest_deg) << name;
      EXPECT_GT(optimal.mean_over_angles.mean_deg, 0) << name;
    }
    const ClusterFigures each = figures_of(photons::cluster_wavelengths(n, 0.05, ClusterMethod::brute_force), n);
    EXPECT_EQ(each.at_45.greatest_deg, 0);
    EXPECT_EQ(each.mean_over_angles.mean_deg, 0);
    EXPECT_EQ(each.saving, 1);
  }
}

class DispersionFilesTest : public test::DispersionFixture {};

TEST_F(DispersionFilesTest, FilesAreLoadedIntoTheGlassThatIsShown) {
  open_glass({{"a", from_points(five)}, {"glass", from_points(five)}});
  apply({command::ChooseMaterial{"glass"}});
  workbench.apply({command::Open{shipped("N-BK7")}}); // what dropping a file does
  frames(2);
  EXPECT_EQ(dispersion().file, shipped("N-BK7"));
  EXPECT_EQ(dispersion("a"), from_points(five));
  EXPECT_EQ(panel().model().curve().name, "N-BK7");
  EXPECT_EQ(shown_count(ClusterMethod::thesis), 12u);
  EXPECT_EQ(workbench.edits()->undo_label(), "load N-BK7 into glass");
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(points(), five);
}

TEST_F(DispersionFilesTest, AFileThatCannotBeLoadedIsAMessage) {
  open_glass({{"glass", from_points(five)}});
  for (const std::string& bad :
       {folder.write("broken.yml", "DATA: ["), folder.write("empty.yaml", ""),
        folder.write("only-k.yml", "DATA:\n  - type: tabulated k\n    data: |\n      0.3 0.1\n      0.9 0.1\n"),
        (folder.path() / "missing.yml").string()}) {
    apply({command::Open{bad}});
    ASSERT_FALSE(workbench.messages().empty()) << bad;
    EXPECT_TRUE(workbench.messages().back().error);
    EXPECT_THAT(last_message(workbench), HasSubstr(fs::path(bad).filename().string()));
    EXPECT_EQ(points(), five);
    EXPECT_FALSE(workbench.edits()->modified());
  }
  expect_true_counts();
}

TEST_F(DispersionFilesTest, WithoutGlassAFileIsRefused) {
  open();
  workbench.apply({command::Open{shipped("N-BK7")}});
  EXPECT_THAT(only_message(workbench), HasSubstr("this preset has no dielectric"));
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(DispersionFilesTest, AGlassIsMadeEditableAndBackByUndo) {
  open_glass({{"glass", from_file(shipped("N-SF66"))}});
  click("Make editable");
  frames(2);
  EXPECT_EQ(dispersion().type, preset::Dispersion::Type::points);
  EXPECT_EQ(panel().model().error(), "");
  EXPECT_EQ(shown_count(ClusterMethod::optimal), 32u);
  EXPECT_THAT(last_message(workbench), HasSubstr("they reproduce N-SF66 within 9e-05 of n"));
  drag_point(points()[3], {points()[3][0], points()[3][1] + 0.02});
  expect_true_counts();
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(dispersion(), from_file(shipped("N-SF66")));
}

TEST_F(DispersionFilesTest, ACurveThatIsNoneIsSaidAndNothingIsLost) {
  preset::Dispersion nowhere; // n^2 = 1 - 5 l^2 / (l^2 - .01) < 0
  nowhere.type = preset::Dispersion::Type::sellmeier;
  nowhere.b = {-5};
  nowhere.c_um2 = {0.01};
  open_glass({{"glass", nowhere}});
  EXPECT_THAT(panel().model().error(), HasSubstr("gives no number at 380 nm"));
  preset::Dispersion refused = from_file(shipped("N-SF66"));
  refused.outside = preset::Extrapolation::refuse;
  const preset::Dispersion missing = from_file("nowhere.yml");
  for (const preset::Dispersion& bad : {refused, missing, nowhere}) {
    edit([&](preset::Preset& p) { p.scene.materials.at("glass").dispersion = bad; });
    frames(3);
    EXPECT_NE(panel().model().error(), "");
    move(panel().plot().to_screen({500, 1.5}));
    click("Sorted");
    click("Make editable");
    EXPECT_EQ(dispersion(), bad) << "greyed";
  }
  apply({command::LoadDispersion{"N-BK7"}});
  EXPECT_EQ(panel().model().error(), "");
}

} // namespace nephroid::ui::dispersion_edits_test
