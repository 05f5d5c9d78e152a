// SPDX-License-Identifier: Apache-2.0
// The panel "Environment" under an injected mouse: the map is turned, the number of lights slid, a method chosen; what
// a run says of the lights; presets without an environment, or without one that can be read.
#include "environment/settings.h"
#include "tests/environment/maps.h"
#include "ui/environment/panel.h"
#include "window_fixture.h"

namespace nephroid::ui::environment_panel_test {

/// Fake jobs of which every other light is hidden by a quarter. A picture of a bake has no layers and says what it is.
class LitJob : public test::FakeJob {
public:
  LitJob(const preset::Preset& preset, test::FakeSettings& runs, int lights, bool bakes)
      : FakeJob(preset, runs), lights_(lights), bakes_(bakes) {}
  job::Snapshot snapshot() override {
    job::Snapshot made = FakeJob::snapshot();
    job::Curve curve{"lights", {"light", "azimuth_deg", "elevation_deg", "red", "green", "blue", "visible"}, {}};
    for (int i = 0; i < lights_; ++i) curve.rows.push_back({double(i + 1), 0, 0, 1, 1, 1, i % 2 == 0 ? 1 : 0.75});
    made.curves.push_back(curve);
    if (bakes_) {
      auto sheet = std::make_shared<job::Picture>(*made.picture);
      sheet->layers.clear();
      made.picture = sheet;
      made.caption = "what is being baked";
    }
    return made;
  }

private:
  int lights_;
  bool bakes_;
};

class LitRuns : public test::FakeRuns {
public:
  NewRun make(const preset::Preset& preset, const Watch& watch) override {
    NewRun run = FakeRuns::make(preset, watch);
    if (lights > 0 || bakes) run.job = std::make_unique<LitJob>(preset, *this, lights.load(), bakes.load());
    return run;
  }
  std::atomic<int> lights{0};
  std::atomic<bool> bakes{false}; ///< all the time
};

class EnvironmentPanelTest : public test::WindowFixtureOf<LitRuns> {
protected:
  EnvironmentPanelTest() : WindowFixtureOf("environment") {
    ImGui::GetIO().DisplaySize = {1300, 950};
    for (const auto& [name, map] : test::synthetic_maps(128))
      image::write_exr(folder.path() / (name + ".exr"), {map.width, map.height, {"R", "G", "B"}, map.rgb, {}});
  }
  const EnvironmentPanel& panel() const { return workspace.panel<EnvironmentPanel>(); }
  const environment::Settings& settings() const { return environment::settings(*workbench.preset()); }
  double rotation() const { return workbench.preset()->scene.environment->rotate_deg; }
  static std::string text(const std::string& environment, const std::string& engine = "environment") {
    return R"({"name": "Test", "engine": ")" + engine + R"(", "scene": {"camera": {"resolution": [64, 48]})" +
           environment + "}}";
  }
  void open_map(const std::string& environment = R"({"type": "file", "file": "noon.exr"})",
                const std::string& engine = "environment") {
    open(text(R"(, "environment": )" + environment, engine));
    rest();
  }
  /// Until the panel shows all that the preset wants.
  void rest() {
    frames(2);
    ASSERT_TRUE(until([&] { return panel().model().rests(); }));
    frames(2);
  }
  Point place(const std::string& widget) const {
    const auto at = panel().place_of(widget);
    EXPECT_TRUE(at) << widget;
    return at.value_or(Point{});
  }
  /// From its middle to the left by a quarter of its width.
  void drag_map() {
    const auto& [x, y, width, height] = panel().map().area();
    drag_by({x + width / 2, y + height / 2}, -width / 4);
  }
  /// Where a direction of the map is drawn.
  Point seen(const glm::dvec3& direction) const { return panel().place_on_map(direction); }
  /// What is drawn as text in this frame has glyphs that no test reads; the panel's own words are read where they come
  /// from.
  bool has(const std::string& widget) const { return panel().place_of(widget).has_value(); }
};

TEST_F(EnvironmentPanelTest, WithoutAnEnvironmentItSaysSo) {
  frames(3);
  open(text(""));
  EXPECT_FALSE(has("lights"));
  EXPECT_FALSE(has("rotation"));
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_EQ(panel().model().maps_read(), 0);
  click_in(panel(), "open map");
  EXPECT_EQ(workbench.questions().question(), Question::open_map);
}

TEST_F(EnvironmentPanelTest, OnlyPicturesOfABakeAreSaidToBeOfOne) {
  const auto label = [&] { return view().shown().label; };
  run_through(text(""));
  frames(2);
  EXPECT_EQ(label(), "");
  runs.bakes = true;
  workbench.apply({command::Restart{}});
  EXPECT_TRUE(until([&] { return label().find("baked") != std::string::npos; }));
}

TEST_F(EnvironmentPanelTest, IsForPresetsThatHaveAnEnvironment) {
  const auto is_for = [&](const std::string& text) {
    return EnvironmentPanel::serves(preset::parse_preset(text, "test.json"));
  };
  EXPECT_TRUE(is_for(text("")));
  EXPECT_TRUE(is_for(text(R"(, "environment": "a.exr")", "spectral")));
  EXPECT_FALSE(is_for(text("", "spectral")));
}

TEST_F(EnvironmentPanelTest, OtherEnginesTurnTheMapAndHaveNoLights) {
  open_map(R"({"type": "file", "file": "noon.exr"})", "spectral");
  EXPECT_FALSE(has("lights") || has("method") || has("threshold"));
  ASSERT_TRUE(has("rotation") && has("radiance"));
  EXPECT_TRUE(panel().figures().empty());
  drag_map();
  EXPECT_NEAR(rotation(), 90, 1);
}

TEST_F(EnvironmentPanelTest, ADragTurnsTheMapWithTheMouseAsOneEntry) {
  open_map(R"({"type": "file", "file": "noon.exr", "rotate_deg": 30})");
  const glm::dvec3 grasped = direction_of(20, 55);
  const Point from = seen(grasped), to{from[0] + 100, from[1] - 20};
  press_at(from);
  for (int step = 1; step <= 10; ++step) {
    move({from[0] + 10 * step, from[1] - 2 * step});
    ASSERT_NE(imgui.pushed<command::Edit>(), nullptr);
    EXPECT_TRUE(imgui.pushed<command::Edit>()->live);
    frame();
    const Point now = seen(grasped);
    EXPECT_NEAR(now[0], from[0] + 10 * step, 0.2) << "it stays under the mouse";
    EXPECT_EQ(now[1], from[1]);
  }
  let_go();
  EXPECT_NE(imgui.pushed<command::EndGesture>(), nullptr);
  EXPECT_NEAR(rotation(), 30 - 360 * 100 / panel().map().area()[2], 0.051);
  const double turned = rotation();
  EXPECT_EQ(workbench.edits()->undo_label(), "turn the environment");
  drag_between(to, from);
  EXPECT_NEAR(rotation(), 30, 0.11);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(rotation(), turned) << "the second drag was one entry";
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(rotation(), 30);
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_EQ(panel().model().maps_read(), 1);
  EXPECT_EQ(panel().model().cuts_made(), 1) << "the lights turn with it";
}

TEST_F(EnvironmentPanelTest, AClickChangesNothing) {
  open_map();
  click(seen(direction_of(0, 40)));
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_EQ(workbench.edits()->undo_label(), "");
}

// As a light of the scene: the sun of the map "noon" is at 63 degrees of elevation and 40 of azimuth, and the picture's
// middle is in front.
TEST_F(EnvironmentPanelTest, LightsTurnCounterclockwise) {
  open_map();
  const auto brightest = [&] {
    return *std::max_element(panel().figures().begin(), panel().figures().end(),
                             [](const RegionFigures& a, const RegionFigures& b) { return a.flux < b.flux; });
  };
  EXPECT_NEAR(brightest().azimuth_deg, 40, 2);
  EXPECT_NEAR(brightest().elevation_deg, 63, 2);
  const auto& [x, y, width, height] = panel().map().area();
  drag_between({x + width / 2, y + height / 2}, {x + width / 2 - 90.0 / 360 * width, y + height / 2});
  EXPECT_NEAR(rotation(), 90, 0.5);
  frame();
  EXPECT_NEAR(brightest().azimuth_deg, 40 - rotation(), 2);
  const glm::dvec3 in_front = environment::turned({0, 0, -1}, -rotation());
  EXPECT_NEAR(seen(in_front)[0], x + width / 2, 1e-6);
}

TEST_F(EnvironmentPanelTest, CausticsAreSwitched) {
  open_map();
  click(place("on surfaces"));
  EXPECT_FALSE(settings().cast);
  EXPECT_EQ(workbench.edits()->undo_label(), "caustics on surfaces");
  drag_by(place("extinction"), 50);
  EXPECT_EQ(settings().extinction, 0) << "there is no medium yet";
  click(place("in the air"));
  EXPECT_NEAR(settings().extinction, 0.2 / std::sqrt(17), 1e-12);
  drag_by(place("extinction"), 50);
  EXPECT_GT(settings().extinction, 0.06);
  click(place("in the air"));
  EXPECT_EQ(settings().extinction, 0);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_GT(settings().extinction, 0.06) << "of the drag";
  click(place("on surfaces"));
  EXPECT_TRUE(settings().cast);
}

TEST_F(EnvironmentPanelTest, InTheCubeTheFrontFollowsTheMouse) {
  open_map();
  click(place("cube"));
  rest();
  const auto& [x, y, width, height] = panel().map().area();
  EXPECT_NEAR(width / height, 4.0 / 3, 0.02);
  const auto front = [&] { return seen(environment::turned({0, 0, -1}, -rotation())); };
  const Point before = front();
  EXPECT_NEAR(before[0], x + 1.5 / 4 * width, 0.5);
  drag_between(before, {before[0] + width / 4, before[1]}); // to the middle of the next face
  EXPECT_NEAR(rotation(), 90, 0.5);
  EXPECT_NEAR(front()[0], before[0] + width / 4, 1);
  const Point lamp = seen(direction_of(63, 40));
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(seen(direction_of(63, 40)), lamp) << "the faces lie still";
}

TEST_F(EnvironmentPanelTest, AColourIsNotTurned) {
  open_map(R"({"type": "constant", "colour": [1, 0.5, 0.2]})");
  drag_map();
  drag_by(place("rotation"), 50);
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(EnvironmentPanelTest, TheNumberOfLightsIsSlidAsOneEntry) {
  open_map();
  EXPECT_THAT(panel().shown().cut->segmentation.lights, SizeIs(24));
  const Point at = place("lights");
  press_at(at);
  for (const double by : {10.0, 20.0, 30.0}) move({at[0] + by, at[1]});
  let_go();
  const int slid = settings().lights;
  EXPECT_GT(slid, 100) << "the middle of 6 to 4096 on a logarithmic scale is 157";
  EXPECT_LT(slid, 600);
  rest();
  EXPECT_THAT(panel().shown().cut->segmentation.lights, SizeIs(static_cast<std::size_t>(slid)));
  EXPECT_EQ(panel().shown().picture->cut, panel().shown().cut);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(settings().lights, 24);
  for (const auto& [by, end] : {std::pair(-2000.0, 6), std::pair(2000.0, 4096)}) {
    drag_between(at, {at[0] + by, at[1]});
    EXPECT_EQ(settings().lights, end);
    EXPECT_NO_THROW(preset::parse_preset(preset::to_json(*workbench.preset()), "slid.json"))
        << "the ends are what a preset may have";
  }
  rest();
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(EnvironmentPanelTest, AMethodIsChosen) {
  open_map();
  const auto before = panel().shown().cut;
  click(place("method"));
  frames(2);
  click(place("method:thesis"));
  rest();
  EXPECT_EQ(settings().segmentation, environment::SegmentMethod::thesis);
  EXPECT_NE(panel().shown().cut, before);
  EXPECT_EQ(panel().shown().cut_error, panel().shown().quality[1][4]);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(settings().segmentation, environment::SegmentMethod::variance);
}

TEST_F(EnvironmentPanelTest, RadianceAndThresholdAreEdited) {
  open_map();
  const double flux = panel().figures().front().flux;
  drag_by(place("radiance"), 80);
  frame();
  const double radiance = workbench.preset()->scene.environment->radiance;
  EXPECT_GT(radiance, 1.2);
  EXPECT_NEAR(panel().figures().front().flux, radiance * flux, 1e-9 * flux);
  EXPECT_EQ(panel().model().cuts_made(), 1);
  click(place("threshold"));
  retype("7");
  press(ImGuiKey_Enter);
  EXPECT_EQ(settings().threshold, 1) << "no more than all";
  rest();
  EXPECT_THAT(panel().shown().cut->segmentation.lights, SizeIs(0));
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(settings().threshold, 1e-7);
  EXPECT_EQ(workbench.preset()->scene.environment->radiance, radiance);
}

TEST_F(EnvironmentPanelTest, TheRegionUnderTheMouseIsFound) {
  open_map(R"({"type": "file", "file": "noon.exr", "rotate_deg": 200})");
  for (const char* layout : {"latitude, longitude", "cube"}) {
    click(place(layout));
    rest();
    const environment::Segmentation& cut = panel().shown().cut->segmentation;
    for (std::size_t i = 0; i < cut.lights.size(); ++i) {
      const environment::Rect& r = cut.lights[i].rect; // its middle, since its light may be at its edge
      const environment::CubePoint middle{
          cut.lights[i].face, (environment::border(r.x0, cut.cube_size) + environment::border(r.x1, cut.cube_size)) / 2,
          (environment::border(r.y0, cut.cube_size) + environment::border(r.y1, cut.cube_size)) / 2};
      if (r.width() < 6 || r.height() < 6) continue; // smaller than a pixel
      move(seen(environment::position(middle)));
      frame();
      EXPECT_EQ(panel().map().hovered(), i) << layout;
    }
  }
}

TEST_F(EnvironmentPanelTest, WhatIsHiddenComesFromTheRun) {
  runs.lights = 24;
  open_map();
  ASSERT_TRUE(until([&] { return panel().figures().at(0).occluded.has_value(); }));
  EXPECT_EQ(panel().figures().at(0).occluded, 0);
  EXPECT_EQ(panel().figures().at(1).occluded, 0.25);
  edit([&](preset::Preset& p) { environment::settings(p).lights = 12; });
  rest();
  ASSERT_THAT(panel().shown().cut->segmentation.lights, SizeIs(12));
  EXPECT_FALSE(panel().figures().at(0).occluded) << "the run's are of 24 lights";
}

TEST_F(EnvironmentPanelTest, AMissingMapIsOneLineAndCanBeMended) {
  open(text(R"(, "environment": "gone.exr")"));
  rest();
  EXPECT_THAT(panel().shown().error, HasSubstr("gone.exr"));
  EXPECT_FALSE(panel().shown().cut);
  drag_map(); // nothing to see, and nothing goes wrong
  edit([&](preset::Preset& p) { p.scene.environment->file = "room.exr"; });
  rest();
  EXPECT_EQ(panel().shown().error, "");
  EXPECT_TRUE(panel().shown().cut);
}

TEST_F(EnvironmentPanelTest, QualityFallsAndIsPlotted) {
  open_map();
  const ShownMap& shown = panel().shown();
  const auto [low, high] = error_range(shown);
  for (const Quality& quality : shown.quality)
    for (const double error : quality) {
      EXPECT_GT(100 * error, low);
      EXPECT_LT(100 * error, high);
    }
  EXPECT_GT(panel().plot().area().screen[2], 200);
  EXPECT_LT(panel().plot().area().x[0], 6);
  EXPECT_GT(panel().plot().area().x[1], 256);
  EXPECT_NEAR(panel().plot().area().y[0], low, 1e-6 * low);
  EXPECT_EQ(error_range({}), (std::array<double, 2>{1, 10}));
}

} // namespace nephroid::ui::environment_panel_test
