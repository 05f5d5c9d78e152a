// SPDX-License-Identifier: Apache-2.0
// The panel "Spectra": the mouse edits a light's spectrum, one gesture one entry; its numbers are the engine's; what is
// wrong is a sentence in it.
#include "photons/tables/run_tables.h"
#include "scatter/spectra.h"
#include "scenes.h"
#include "spectral/settings.h"
#include "ui/spectral/spectra/panel.h"
#include "window_fixture.h"

namespace nephroid::ui::spectra_panel_test {

using Type = preset::LightSpectrum::Type;
using Effort = photons::Settings::Effort;

constexpr const char* table = R"({"type": "table", "table": [[400, 0.2], [500, 1], [600, 0.5], [700, 0.8]]})";

class SpectraPanelTest : public test::WindowFixtureOf<test::SceneRuns> {
protected:
  SpectraPanelTest() : WindowFixtureOf("spectra") {}

  void open_room(const std::string& spectrum, const std::string& effort = "importance") {
    runs.steps = 100000;
    open(room_text(spectrum, effort));
    ASSERT_TRUE(until([&] { return workbench.run().scene_facts().spectra != nullptr; }));
    frames(2);
  }
  const SpectraPanel& panel() const { return workspace.panel<ui::SpectraPanel>(); }
  const Spectra& spectra() const { return panel().maker().spectra(); }
  const preset::LightSpectrum& light() const { return workbench.preset()->scene.lights[0].spectrum; }
  using WindowFixtureOf::click;
  void click(const std::string& widget) { click_in(panel(), widget, 0); }
};

TEST_F(SpectraPanelTest, AnIlluminantBecomesRowsToDrag) {
  open_room(R"("D65")");
  click("make editable");
  EXPECT_THAT(light().table, SizeIs(21)) << "a row every 20 nm";
  drag_between(panel().plot().place(560, light().table[9][1]), panel().plot().place(560, 0.2));
  EXPECT_NEAR(light().table[9][1], 0.2, 0.02);
  for (int i = 0; i < 2; ++i) press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(light().illuminant, "D65");
  EXPECT_FALSE(workbench.edits()->modified()) << "two entries";
}

TEST_F(SpectraPanelTest, ARowThatIsDraggedFollowsTheMouseAndIsOneEntry) {
  open_room(table);
  drag_between(panel().plot().place(600, 0.5), panel().plot().place(640, 0.9));
  const preset::LightSpectrum dragged = light();
  ASSERT_THAT(dragged.table, SizeIs(4));
  EXPECT_NEAR(dragged.table[2][0], 640, 2);
  EXPECT_NEAR(dragged.table[2][1], 0.9, 0.02);
  EXPECT_EQ(spectra().lights[0].spectrum, scatter::make_light_spectrum(dragged, "test"))
      << "the curve shown is of the preset as it is";
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(light().table[2], (PowerRow{600, 0.5}));
  EXPECT_FALSE(workbench.edits()->modified()) << "one entry";
}

TEST_F(SpectraPanelTest, ARowStopsAtItsNeighboursAndTheOthersStayWhereTheyAre) {
  open_room(table);
  drag_between(panel().plot().place(500, 1), panel().plot().place(650, 0.25));
  EXPECT_NEAR(light().table[1][0], 599.9, 1e-9);
  EXPECT_NEAR(light().table[1][1], 0.25, 0.02) << "the largest row sets the scale: it stays while it is held";
  EXPECT_EQ(light().table[0], (PowerRow{400, 0.2}));
  EXPECT_EQ(light().table[2], (PowerRow{600, 0.5}));
}

TEST_F(SpectraPanelTest, GesturesOfTwoPanelsAreTwoEntries) {
  open_room(table);
  drag(0, 40, 0); // the View's first gesture, then the panel's first
  drag_between(panel().plot().place(600, 0.5), panel().plot().place(640, 0.9));
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(light().table[2], (PowerRow{600, 0.5}));
  EXPECT_NE(camera().position[0], 0);
}

TEST_F(SpectraPanelTest, RowsAreAddedAndRemoved) {
  open_room(table);
  const auto place = panel().plot().place(550, 0.4);
  click(place);
  click(place);
  ASSERT_THAT(light().table, SizeIs(5));
  EXPECT_NEAR(light().table[2][0], 550, 1.5);
  EXPECT_NEAR(light().table[2][1], 0.4, 0.02);
  click(panel().plot().place(light().table[2][0], light().table[2][1]), 1);
  EXPECT_THAT(light().table, SizeIs(4));
  click(panel().plot().place(500, 1));
  for (int i = 0; i < 4; ++i) {
    click(panel().plot().place(light().table.back()[0], light().table.back()[1] / panel().plot().unit()));
    click("remove");
  }
  EXPECT_THAT(light().table, SizeIs(2)) << "a table keeps two rows";
  click("add");
  EXPECT_THAT(light().table, SizeIs(3));
  press(ImGuiKey_Delete);
  EXPECT_THAT(light().table, SizeIs(2)) << "the one that was added is marked";
  click("copy");
  EXPECT_EQ(std::string(ImGui::GetClipboardText()), to_csv(spectra()));
  ASSERT_THAT(workbench.messages(), SizeIs(1)) << "of the row that had to stay";
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("at least 2 must stay"));
}

// dispersion_panel_test.cpp has the other ways in which rows go while one is dragged.
TEST_F(SpectraPanelTest, DeleteWhileARowIsDraggedMovesNoOther) {
  open_room(table);
  const auto held = panel().plot().place(600, 0.5);
  press_at(held);
  move({held[0] + 10, held[1] - 10});
  frame();
  ASSERT_NE(light().table[2], (PowerRow{600, 0.5}));
  press(ImGuiKey_Delete);
  move({held[0] + 20, held[1] - 40});
  frames(2);
  EXPECT_THAT(light().table, ElementsAre(PowerRow{400, 0.2}, PowerRow{500, 1}, PowerRow{700, 0.8}));
  let_go();
  frame();
  EXPECT_THAT(light().table, SizeIs(3));
}

TEST_F(SpectraPanelTest, LinesAreDragged) {
  open_room(R"({"type": "lines", "table": [[450, 2], [546.1, 4]]})");
  drag_between(panel().plot().place(450, 0.5), panel().plot().place(480, 0.25));
  EXPECT_NEAR(light().table[0][0], 480, 2);
  EXPECT_NEAR(light().table[0][1], 1, 0.08) << "of 4";
}

TEST_F(SpectraPanelTest, ItsNumbersAreTheEngines) {
  open_room(R"("F10")");
  preset::Preset preset = *workbench.preset();
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  for (const Effort effort : {Effort::power, Effort::equal, Effort::importance, Effort::radziszewski, Effort::random})
    for (const auto cluster : {photons::Importance::Cluster::maximum, photons::Importance::Cluster::mean})
      for (const bool geometry : {true, false}) {
        spectral::settings(preset).effort = effort;
        spectral::settings(preset).importance = {cluster, geometry};
        spectral::settings(preset).estimator =
            effort == Effort::random ? photons::Settings::Estimator::sppm : photons::Settings::Estimator::automatic;
        const int made = runs.made;
        workbench.apply({command::Edit{"effort", preset}});
        ASSERT_TRUE(until([&] { return runs.made > made && workbench.run().snapshot_is_current(); }));
        frames(2);
        ASSERT_EQ(spectra().why_no_u, "");
        const photons::WavelengthImportance expected =
            photons::wavelength_importance(spectral::settings(preset), scene, bvh);
        EXPECT_EQ(spectra().importance.u, expected.u);
        ASSERT_EQ(spectra().importance.surroundings.size(), expected.surroundings.size());
        for (std::size_t i = 0; i < expected.surroundings.size(); ++i)
          EXPECT_EQ(spectra().importance.surroundings[i].lightness, expected.surroundings[i].lightness);
        const photons::RunTables tables = photons::make_lit_tables(spectral::settings(preset), scene, bvh, {});
        ASSERT_EQ(spectra().clusters.size(), tables.wavelengths.clusters.size());
        std::int64_t sum = 0;
        for (std::size_t c = 0; c < tables.importance.size(); ++c) {
          EXPECT_EQ(spectra().clusters[c].wavelengths, tables.wavelengths.clusters[c]);
          EXPECT_NEAR(spectra().clusters[c].importance, tables.importance[c], 1e-12);
          EXPECT_EQ(spectra().clusters[c].iterations, photons::iterations(tables.importance[c], 100));
          sum += photons::iterations(tables.importance[c], 100);
        }
        EXPECT_EQ(spectra().iterations(), sum);
        EXPECT_EQ(spectra().brute_force(), 40100);
      }
}

TEST_F(SpectraPanelTest, WhatDealsOutTheWorkIsFollowed) {
  open_room(R"("D65")");
  const std::int64_t before = spectra().iterations();
  edit([&](preset::Preset& p) { spectral::settings(p).importance.cluster = photons::Importance::Cluster::mean; });
  frame();
  EXPECT_LT(spectra().iterations(), before) << "without waiting for a run";
}

TEST_F(SpectraPanelTest, IdleFramesMakeNothingAnew) {
  open_room(table);
  const std::uint64_t made = panel().maker().updates();
  frames(20);
  EXPECT_EQ(panel().maker().updates(), made);
  move(panel().plot().place(600, 0.5));
  imgui.button(0, true);
  frame();
  move(panel().plot().place(620, 0.7));
  frames(2);
  const std::uint64_t dragged = panel().maker().updates();
  EXPECT_GT(dragged, made);
  for (int i = 0; i < 20; ++i) { // held, and at rest
    frame();
    EXPECT_TRUE(imgui.commands.empty());
  }
  imgui.button(0, false);
  frames(3);
  ASSERT_TRUE(until_current());
  frames(3);
  EXPECT_EQ(panel().maker().updates(), dragged) << "the new run's glass sees what the old one's saw";
}

TEST_F(SpectraPanelTest, WhatIsWrongIsASentence) {
  open_room(table);
  const auto with_light = [&](const preset::LightSpectrum& spectrum) {
    edit([&](preset::Preset& p) { p.scene.lights.at(0).spectrum = spectrum; });
    frames(3);
  };
  with_light({Type::table, "", 0, {{800, 1}, {900, 1}}});
  EXPECT_THAT(spectra().lights[0].error, HasSubstr("no power in 380..780 nm"));
  EXPECT_THAT(spectra().why_no_u, HasSubstr("no power"));
  EXPECT_THAT(spectra().clusters, IsEmpty());
  with_light({Type::illuminant, "D66", 0, {}});
  EXPECT_THAT(spectra().lights[0].error, HasSubstr("D65"));
  edit([](preset::Preset& p) { p.scene.lights.clear(); });
  frames(3);
  edit([](preset::Preset& p) {
    p.scene.lights = {preset::Light{}}, p.scene.materials["glass"].dispersion.coefficients = {-1};
  });
  frames(3);
  EXPECT_NE(spectra().why_no_u, "");
  for (const Message& message : workbench.messages()) EXPECT_THAT(message.line, Not(HasSubstr(SpectraPanel::title)));
}

TEST_F(SpectraPanelTest, NothingThatMattersIsASentence) {
  open_room(table);
  edit([](preset::Preset& p) {
    for (const char* name : {"red", "floor"}) p.scene.materials[name].reflectance = {.value = 0};
  });
  frames(3);
  EXPECT_THAT(spectra().why_no_u, HasSubstr("0 at every wavelength"));
  EXPECT_THAT(spectra().clusters, IsEmpty());
}

} // namespace nephroid::ui::spectra_panel_test
