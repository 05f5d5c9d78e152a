// SPDX-License-Identifier: Apache-2.0
// Selecting and moving in the whole window, by injected mouse and keys on fake runs with a loaded scene: clicks, the
// list, the handles, the keys. What a person gets is looked at in the preset.
#include "scenes.h"
#include "window_fixture.h"

namespace nephroid::ui::select_test {

using Kind = Selection::Kind;
constexpr Selection nothing{}, ball{Kind::object, 0}, floor_quad{Kind::object, 1}, lamp{Kind::light, 0},
    spot{Kind::light, 1}, camera_target{Kind::camera, 0};

class Select : public test::WindowFixtureOf<test::SceneRuns> {
protected:
  explicit Select(const std::string& layout = {}) : WindowFixtureOf(layout) {
    runs.steps = 1000000;
    runs.step_ms = 1;
  }
  void open(const std::string& text = test::ball_text()) {
    WindowFixtureOf::open(text);
    ASSERT_TRUE(until([&] { return workbench.run().scene_facts().view != nullptr; }));
  }
  const preset::Scene& scene() const { return workbench.preset()->scene; }
  Pinhole pinhole() const {
    const ViewSettings& view_settings = workbench.view_state().view_settings;
    return *make_pinhole(scene().camera, place(view_settings, view().canvas(), view().shown().size),
                         view().shown().size);
  }
  Point at(double x, double y, double z) const { return *pinhole().to_screen({x, y, z}); }
  Selection selected() const { return workbench.view_state().selection; }
  void select(const Selection& selection) { apply({command::Select{selection}}); }
  /// On the screen: 0 their middle; 1, 2, 3 along x, y, z.
  Point handle(std::size_t i) const { return (*view().overlay().gizmo().places())[i]; }
  std::string undo() const { return workbench.edits()->undo_label(); }
};

TEST_F(Select, AClickSelectsWhatIsThere) {
  open();
  click(at(-0.5, 0, 0));
  EXPECT_EQ(selected(), ball);
  click(at(0, -1, 0.5));
  EXPECT_EQ(selected(), floor_quad);
  click(at(0.9, 0.9, 0));
  EXPECT_EQ(selected(), lamp);
  click(at(0.4, 0.5, 0));
  EXPECT_EQ(selected(), nothing) << "beside everything";
  EXPECT_EQ(undo(), "") << "a click is no edit";
}

TEST_F(Select, AnEscapeThatClosesAListDoesNothingElse) {
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard; // as the real window has it
  open();
  select(ball);
  click_in(view(), "tone", 2);
  ASSERT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  press(ImGuiKey_Escape);
  EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  EXPECT_EQ(selected(), ball);
  press(ImGuiKey_Escape);
  EXPECT_EQ(selected(), nothing);
}

TEST_F(Select, ADragOrbitsAndSelectsNothing) {
  open();
  drag_by(at(-0.5, 0, 0), 40);
  EXPECT_EQ(selected(), nothing);
  EXPECT_EQ(undo(), "orbit");
}

TEST_F(Select, AHandThatTremblesClicks) {
  open();
  const Point from = at(-0.5, 0, 0);
  press_at(from);
  move({from[0] + 1, from[1] - 1});
  let_go();
  EXPECT_EQ(selected(), ball);
  EXPECT_EQ(undo(), "");
}

TEST_F(Select, TheListSelectsByName) {
  open();
  click(*view().place_of("selected"));
  frame();
  click(*view().place_of("selected:light 2 (spot)"));
  EXPECT_EQ(selected(), spot);
}

TEST_F(Select, KeysGoThroughEverything) {
  open();
  for (const Selection& expected : {ball, floor_quad, lamp, spot, camera_target, ball}) {
    press(ImGuiKey_Period);
    EXPECT_EQ(selected(), expected);
  }
  press(ImGuiKey_Comma);
  EXPECT_EQ(selected(), camera_target);
}

TEST_F(Select, EscapeDeselectsAndNeverCancels) {
  open();
  select(ball);
  press(ImGuiKey_Escape);
  EXPECT_EQ(selected(), nothing);
  press(ImGuiKey_Escape);
  frames(5);
  EXPECT_EQ(workbench.run().status().state, job::State::running);
  press(ImGuiKey_F5, ImGuiMod_Shift);
  EXPECT_TRUE(until(job::State::cancelled));
}

TEST_F(Select, DeleteTakesItOutOfTheScene) {
  open();
  const std::size_t objects = scene().objects.size(), lights = scene().lights.size();
  select(ball);
  press(ImGuiKey_Delete);
  frames(2);
  EXPECT_EQ(scene().objects.size(), objects - 1);
  EXPECT_EQ(context().selection(), nothing);
  press(ImGuiKey_Delete);
  frames(2);
  EXPECT_EQ(scene().objects.size(), objects - 1) << "nothing is selected";
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  frames(2);
  EXPECT_EQ(scene().objects.size(), objects);
  select(spot);
  press(ImGuiKey_Delete);
  frames(2);
  EXPECT_EQ(scene().lights.size(), lights - 1);
}

TEST_F(Select, ASelectionThatIsGoneIsNone) {
  open();
  select(spot);
  edit([&](preset::Preset& p) { p.scene.lights.clear(); });
  frames(3);
  EXPECT_EQ(context().selection(), nothing);
  EXPECT_FALSE(view().overlay().gizmo().places());
}

TEST_F(Select, AnArrowMovesTheBall) {
  open();
  const double x = scene().objects[0].transform.translate[0];
  click(at(x, 0, 0));
  ASSERT_EQ(selected(), ball);
  frames(2);
  const Point tip = handle(1);
  // At the ball's depth, 4 in front of the camera, 0.6 to the right.
  const double pixels = at(x + 0.6, 0, 0)[0] - at(x, 0, 0)[0];
  press_at(tip);
  for (int i = 1; i <= 10; ++i) {
    move({tip[0] + pixels * i / 10, tip[1]});
    ASSERT_TRUE(imgui.pushed<command::Edit>());
    EXPECT_TRUE(imgui.pushed<command::Edit>()->live);
  }
  let_go();
  EXPECT_TRUE(imgui.pushed<command::EndGesture>());
  EXPECT_NEAR(scene().objects[0].transform.translate[0], x + 0.6, 0.01);
  EXPECT_EQ(scene().objects[0].transform.translate[1], 0);
  EXPECT_EQ(scene().objects[0].transform.translate[2], 0);
  EXPECT_EQ(scene().camera, workbench.edits()->opened().scene.camera) << "no orbit";
  EXPECT_EQ(undo(), "move ball");
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened()) << "one entry";
  EXPECT_EQ(selected(), ball);
}

TEST_F(Select, EscapeTakesADragBack) {
  open();
  edit([](preset::Preset& p) { p.scene.camera.fov_deg += 1; });
  select(ball);
  const preset::Preset before = *workbench.preset();
  const Point tip = handle(1);
  press_at(tip);
  press(ImGuiKey_Escape); // nothing has moved
  let_go();
  EXPECT_EQ(undo(), "edit") << "what was done before stays";
  press_at(tip);
  move({tip[0] + 40, tip[1]});
  ASSERT_EQ(undo(), "move ball");
  press(ImGuiKey_Escape);
  EXPECT_EQ(*workbench.preset(), before);
  move({tip[0] + 80, tip[1]});
  let_go();
  EXPECT_EQ(*workbench.preset(), before) << "it was let go";
  EXPECT_EQ(selected(), ball);
  press_at(tip);
  move({tip[0] + 40, tip[1]});
  press(ImGuiKey_Z, ImGuiMod_Ctrl); // taken back already
  press(ImGuiKey_Escape);
  let_go();
  EXPECT_EQ(*workbench.preset(), before);
}

TEST_F(Select, CtrlSnapsADrag) {
  open();
  select(ball);
  const Point tip = handle(2);
  imgui.key(ImGuiMod_Ctrl, true);
  drag_between(tip, {tip[0], tip[1] - 71});
  imgui.key(ImGuiMod_Ctrl, false);
  frame();
  const double y = scene().objects[0].transform.translate[1], steps = y / 0.2;
  EXPECT_GT(y, 0.1);
  EXPECT_NEAR(steps, std::round(steps), 1e-9) << "a fifth of a metre at 4 m";
}

TEST_F(Select, ADragThatLeavesTheViewGoesOn) {
  open();
  select(ball);
  press(ImGuiKey_S);
  ASSERT_EQ(workbench.view_state().handles.tool, Handles::Tool::scale);
  const Point tip = handle(1);
  const double right = view().canvas().corner[0] + view().canvas().size[0];
  press_at(tip);
  move({tip[0] + 20, tip[1]});
  move({right + 200, tip[1]}); // over another panel
  const double far = scene().objects[0].transform.scale[0];
  let_go();
  EXPECT_GT(far, 1.5);
  EXPECT_EQ(scene().objects[0].transform.scale[1], 1);
  move({tip[0] + 20, tip[1]});
  move({tip[0] + 60, tip[1]});
  EXPECT_EQ(scene().objects[0].transform.scale[0], far) << "it was let go there";
}

TEST_F(Select, ACircleTurnsTheFloor) {
  open();
  select(floor_quad);
  press(ImGuiKey_U);
  // The circle about z, towards the camera, is a circle in the picture: from its right to its top is a quarter.
  const Point middle = handle(0), right = handle(1);
  const double radius = 1.2 * (right[0] - middle[0]); // ImGuizmo's circles are wider than its arrows are long
  press_at({middle[0] + radius * std::cos(0.3), middle[1] - radius * std::sin(0.3)});
  for (int i = 1; i <= 10; ++i) {
    const double angle = 0.3 + 0.05 * i;
    move({middle[0] + radius * std::cos(angle), middle[1] - radius * std::sin(angle)});
  }
  let_go();
  EXPECT_NEAR(scene().objects[1].transform.rotate_deg[2], glm::degrees(0.5), 2);
  EXPECT_NEAR(scene().objects[1].transform.rotate_deg[0], 0, 1e-6);
  EXPECT_EQ(scene().objects[1].transform.translate, (preset::Vec3{0, -1, 0}));
  EXPECT_EQ(undo(), "turn floor");
}

TEST_F(Select, ALightIsMovedAndAimed) {
  open();
  select(spot);
  drag_by(handle(1), 30);
  EXPECT_GT(scene().lights[1].position[0], -1);
  EXPECT_EQ(scene().lights[1].position[1], 1);
  press(ImGuiKey_U);
  press(ImGuiKey_UpArrow);
  EXPECT_NE(scene().lights[1].direction, (preset::Vec3{0, -1, 0}));
}

TEST_F(Select, TheCamerasTargetIsMoved) {
  open();
  select(camera_target);
  const Point tip = handle(2);
  const double pixels = at(0, 0, 0)[1] - at(0, 0.5, 0)[1];
  drag_between(tip, {tip[0], tip[1] - pixels});
  EXPECT_NEAR(scene().camera.target[1], 0.5, 0.01);
  EXPECT_EQ(scene().camera.position, (preset::Vec3{0, 0, 4}));
}

TEST_F(Select, ArrowKeysNudge) {
  open();
  select(ball);
  for (int i = 0; i < 3; ++i) press(ImGuiKey_RightArrow);
  press(ImGuiKey_UpArrow);
  EXPECT_NEAR(scene().objects[0].transform.translate[0], -0.44, 1e-9);
  EXPECT_NEAR(scene().objects[0].transform.translate[1], 0.02, 1e-9);
  EXPECT_EQ(undo(), "nudge ball");
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened()) << "quick presses are one entry";
  press(ImGuiKey_RightArrow);
  frames(60); // a second
  press(ImGuiKey_RightArrow);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_NEAR(scene().objects[0].transform.translate[0], -0.48, 1e-9) << "after a rest it is another one";
  select(floor_quad);
  press(ImGuiKey_RightArrow);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_NEAR(scene().objects[0].transform.translate[0], -0.48, 1e-9) << "and so it is of another thing";
}

TEST_F(Select, ButtonsChooseTheTool) {
  open();
  const auto handles = [&] { return workbench.view_state().handles; };
  click(*view().place_of("Turn"));
  EXPECT_EQ(handles().tool, Handles::Tool::turn);
  click(*view().place_of("Scale"));
  EXPECT_EQ(handles().tool, Handles::Tool::scale);
  click(*view().place_of("Own axes"));
  click(*view().place_of("Snap"));
  EXPECT_TRUE(handles().own_axes && handles().snap);
}

TEST_F(Select, OwnAxesAreThoseOfTheObject) {
  open();
  select(floor_quad);
  edit([&](preset::Preset& p) { p.scene.objects[1].transform.rotate_deg = {0, 0, 90}; });
  press(ImGuiKey_W);
  const Point tip = handle(1); // its x is the scene's y
  drag_between(tip, {tip[0], tip[1] - 40});
  EXPECT_GT(scene().objects[1].transform.translate[1], -0.95);
  EXPECT_EQ(scene().objects[1].transform.translate[0], 0);
}

TEST_F(Select, HiddenIconsAreNotInTheWay) {
  open();
  select(ball);
  press(ImGuiKey_H);
  EXPECT_FALSE(view().overlay().gizmo().places());
  click(at(0.9, 0.9, 0));
  EXPECT_EQ(selected(), ball) << "a click selects nothing else";
  press(ImGuiKey_H);
  EXPECT_TRUE(view().overlay().gizmo().places());
}

TEST_F(Select, AMoveIsAdoptedByTheEnvironmentsRun) {
  open(test::ball_text("environment"));
  select(ball);
  const int made = runs.made;
  drag_by(handle(1), 60, 0, 30);
  EXPECT_GT(scene().objects[0].transform.translate[0], -0.4);
  EXPECT_TRUE(until_current());
  EXPECT_EQ(runs.made, made) << "no run was started again";
  EXPECT_GT(runs.adopted, 0);
  // The scene that was loaded has the ball where it was; it is found where it is.
  select(nothing);
  click(at(scene().objects[0].transform.translate[0], 0, 0));
  EXPECT_EQ(selected(), ball);
  select(nothing);
  click(at(-0.75, 0.05, 0));
  EXPECT_EQ(selected(), nothing) << "it is no longer there";
}

class SelectInParameters : public Select {
protected:
  SelectInParameters() : Select("parameters") {}
};

TEST_F(SelectInParameters, ItsFieldsAreBroughtIntoSight) {
  open();
  const auto shown = [&] {
    return workspace.panel<ParametersPanel>().place_of("/scene/lights/1/position/0").has_value();
  };
  frames(3);
  EXPECT_FALSE(shown());
  select(spot);
  EXPECT_TRUE(shown());
}

TEST_F(Select, OfAnInversePresetNothingIs) {
  ASSERT_TRUE(workbench.open("inverse/point"));
  frames(5);
  EXPECT_FALSE(view().place_of("selected"));
  press(ImGuiKey_Period);
  click(middle());
  select(camera_target);
  EXPECT_EQ(context().selection(), nothing);
  EXPECT_FALSE(view().overlay().gizmo().places());
}

} // namespace nephroid::ui::select_test
