// SPDX-License-Identifier: Apache-2.0
// Layouts of panels by engine: kept, restored, reset; panels closed and shown; the command palette.
#include "preset/change_engine.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::ui::layout_test {

class LayoutTest : public test::WindowFixture {
protected:
  using test::WindowFixture::WindowFixtureOf;
  void set_ini(const std::string& ini) {
    WindowSettings settings = workbench.setup().settings();
    settings.engines["spectral"].ini = ini;
    workbench.setup().set_settings(settings);
  }
  void open_palette() {
    open();
    apply({command::Ask{Question::command}});
  }
  /// Another engine's preset, and back.
  void leave_and_come_back() {
    ASSERT_TRUE(workbench.open("inverse/shapes"));
    frames(6);
    ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text)));
    frames(6);
  }
  /// Whether the panel is seen: drawn, and in front of its tabs.
  static bool seen(const char* title) {
    const ImGuiWindow* window = ImGui::FindWindowByName(title);
    return window && window->Active && !window->Hidden &&
           (!window->DockNode || window->DockNode->VisibleWindow == window);
  }
};

TEST_F(LayoutTest, AKeptLayoutIsWhereThePanelsAre) {
  open();
  frames(5);
  const ImGuiID left = ImGui::DockBuilderSplitNode(ImGui::FindWindowByName(ViewPanel::title)->DockId, ImGuiDir_Left,
                                                   0.3f, nullptr, nullptr);
  ImGui::DockBuilderDockWindow(ParametersPanel::title, left);
  ImGui::DockBuilderDockWindow(PlanPanel::title, left);
  ImGui::DockBuilderDockWindow(SpectraPanel::title, 0);
  ImGui::SetWindowPos(SpectraPanel::title, {100, 140});
  ImGui::SetWindowSize(SpectraPanel::title, {500, 175});
  frames(3);
  ImGui::SetWindowFocus(PlanPanel::title);
  frames(3);
  const float width = ImGui::FindWindowByName(PlanPanel::title)->Size.x;
  click({5, 695}); // the status line; what the mouse let go of is kept
  frames(3);
  leave_and_come_back();
  EXPECT_TRUE(seen(PlanPanel::title));
  EXPECT_FALSE(seen(ParametersPanel::title));
  const ImGuiWindow* view = ImGui::FindWindowByName(ViewPanel::title);
  const ImGuiWindow* plan = ImGui::FindWindowByName(PlanPanel::title);
  EXPECT_LT(plan->Pos.x, view->Pos.x) << "at the left of the picture";
  EXPECT_NEAR(plan->Size.x, width, 2);
  EXPECT_EQ(plan->DockId, ImGui::FindWindowByName(ParametersPanel::title)->DockId);
  const ImGuiWindow* spectra = ImGui::FindWindowByName(SpectraPanel::title);
  EXPECT_FALSE(spectra->DockNode);
  EXPECT_NEAR(spectra->SizeFull.x, 500, 2);
  EXPECT_NEAR(spectra->Pos.y, 140, 2);
}

TEST_F(LayoutTest, WhatTheMouseMakesOfItIsKeptForThatEngine) {
  open();
  frames(5);
  ASSERT_FALSE(workbench.setup().settings().engines.contains("spectral")) << "nobody touched it";
  const ImGuiWindow* view = ImGui::FindWindowByName(ViewPanel::title);
  const float before = view->Size.x;
  const Point edge{static_cast<double>(view->Pos.x + view->Size.x) + 1,
                   static_cast<double>(view->Pos.y + view->Size.y) / 2};
  drag_between(edge, {edge[0] - 150, edge[1]});
  frames(3);
  EXPECT_NEAR(ImGui::FindWindowByName(ViewPanel::title)->Size.x, before - 150, 8);
  ASSERT_TRUE(workbench.setup().settings().engines.contains("spectral"));
  leave_and_come_back();
  EXPECT_NEAR(ImGui::FindWindowByName(ViewPanel::title)->Size.x, before - 150, 8);
  workbench.apply({command::ResetLayout{}});
  frames(5);
  EXPECT_NEAR(ImGui::FindWindowByName(ViewPanel::title)->Size.x, before, 2);
  EXPECT_EQ(workbench.setup().settings().engines.at("spectral"), EngineLayout{});
}

TEST_F(LayoutTest, EachEngineHasItsOwn) {
  open();
  frames(5);
  EXPECT_TRUE(seen(ErrorPanel::title));
  const std::string inverse =
      folder.write("inverse.json", R"({"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": {
    "facets": [8, 8], "receivers": [{"distance_mm": 100, "picture": {"type": "ring"}}]}})");
  ASSERT_TRUE(workbench.open(inverse));
  frames(6);
  EXPECT_TRUE(seen("Annealing"));
  EXPECT_TRUE(seen(ParametersPanel::title)) << "below the picture";
  EXPECT_FALSE(seen(DispersionPanel::title));
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text)));
  frames(6);
  EXPECT_TRUE(seen(ErrorPanel::title));
  EXPECT_FALSE(seen(ParametersPanel::title)) << "a tab behind the others";
}

TEST_F(LayoutTest, TitlesOfTabsAreWhole) {
  resize({1600, 1000});
  open();
  frames(6);
  const ImGuiTabBar* tabs = ImGui::FindWindowByName(ErrorPanel::title)->DockNode->TabBar;
  ASSERT_GT(tabs->Tabs.Size, 5);
  for (const ImGuiTabItem& tab : tabs->Tabs)
    EXPECT_GE(tab.Width, ImGui::TabItemCalcSize(tab.Window->Name, false).x - 2) << tab.Window->Name;
}

TEST_F(LayoutTest, ASmallWindowHasRoomForThePictureAndEveryMenu) {
  resize({320, 240});
  open();
  frames(6);
  EXPECT_TRUE(seen(ViewPanel::title));
  EXPECT_GT(view().canvas().size[0], 250);
  EXPECT_GT(view().canvas().size[1], 100);
  click_in(workspace, "menu:Menu", 3);
  EXPECT_TRUE(workspace.place_of("menu:Help"));
  move(workspace.place_of("menu:File").value());
  frames(30); // it opens under the mouse
  click_in(workspace, "menu:File/New scene", 3);
  EXPECT_EQ(workbench.preset()->source, "");
}

class ParametersInFront : public LayoutTest {
protected:
  ParametersInFront() : LayoutTest("parameters") {}
};

TEST_F(ParametersInFront, AreSoInASmallWindowToo) {
  resize({320, 240});
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text)));
  frames(9);
  EXPECT_TRUE(seen(ParametersPanel::title));
  EXPECT_FALSE(seen(ViewPanel::title));
}

TEST_F(ParametersInFront, StaysInFrontForAnotherEngine) {
  open();
  frames(5);
  EXPECT_TRUE(seen(ParametersPanel::title));
  ASSERT_TRUE(workbench.open("inverse/shapes"));
  frames(6);
  EXPECT_TRUE(seen(ParametersPanel::title));
  EXPECT_FALSE(seen("Annealing"));
}

TEST_F(LayoutTest, APanelInFrontStaysThereWhenAnEditChangesTheEngine) {
  open();
  frames(5);
  apply({command::ShowPanel{"parameters", true}});
  frames(3);
  ASSERT_TRUE(seen(ParametersPanel::title));
  for (const char* engine : {"environment", "inverse", "spectral"}) {
    auto json = preset::Json::parse(preset::to_json(*workbench.preset()));
    preset::take_foreign(json, engine);
    json["engine"] = engine;
    apply({command::Edit{"engine", preset::parse_preset(json.dump(), workbench.preset()->source)}});
    frames(8);
    EXPECT_EQ(workbench.preset()->settings.engine(), engine);
    EXPECT_TRUE(seen(ParametersPanel::title)) << engine;
    EXPECT_TRUE(seen(ViewPanel::title)) << engine;
  }
}

TEST_F(LayoutTest, NamesThatAreNoPanelsAndPanelsThatItDoesNotKnowDoNoHarm) {
  open();
  frames(5);
  std::string of_another_version = layout_now();
  const std::string plan = std::string("[Window][") + PlanPanel::title + "]";
  ASSERT_NE(of_another_version.find(plan), std::string::npos);
  of_another_version.replace(of_another_version.find(plan), plan.size(), "[Window][Nobody]");
  set_ini(of_another_version);
  leave_and_come_back();
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_TRUE(ImGui::FindWindowByName(PlanPanel::title)->DockNode)
      << "what the layout does not have is docked somewhere";
  EXPECT_TRUE(seen(ViewPanel::title));
}

TEST_F(LayoutTest, EveryPanelIsClosedAndShownByItsAction) {
  open();
  for (const PanelEntry& entry : panel_table()) {
    const Action& toggle = action(fmt::format("Panel: {}", entry.title).c_str());
    if (!toggle.enabled(context())) {
      EXPECT_FALSE(serves(entry, *workbench.preset()));
      EXPECT_FALSE(toggle.why_not(context()).empty());
      continue;
    }
    const auto press_it = [&] {
      Commands commands;
      toggle.run(workbench.context(commands));
      workbench.apply(commands);
      frames(4);
    };
    if (!seen(entry.title)) press_it();
    EXPECT_TRUE(seen(entry.title)) << entry.title << ", a tab behind others, comes to the front";
    press_it();
    if (can_close(entry)) {
      EXPECT_FALSE(seen(entry.title)) << entry.title;
      EXPECT_FALSE(toggle.checked(context()));
      press_it();
    }
    EXPECT_TRUE(seen(entry.title)) << entry.title << " is in front";
    EXPECT_TRUE(toggle.checked(context()));
  }
}

TEST_F(LayoutTest, AnImpossibleSizeOfTextStaysAtTheEnd) {
  workbench.apply({command::SetAppearance{Theme::light, 1e9}});
  EXPECT_EQ(workbench.setup().settings().text_size, WindowSettings::largest_text);
  workbench.apply({command::SetAppearance{Theme::dark, -1}});
  EXPECT_EQ(workbench.setup().settings().text_size, WindowSettings::smallest_text);
}

TEST_F(LayoutTest, ThePaletteRunsWhatIsTyped) {
  open_palette();
  EXPECT_EQ(workspace.palette().matches().size(), actions().size() + preset::shipped_presets().size());
  type("brigh");
  ASSERT_FALSE(workspace.palette().matches().empty());
  EXPECT_EQ(workspace.palette().matches().front()->name, "Brighter");
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.view_state().view_settings.exposure_stops, 0.5);
  EXPECT_EQ(workbench.questions().question(), Question::none);
}

TEST_F(LayoutTest, TheArrowsChooseInThePalette) {
  open_palette();
  type("er text");
  ASSERT_EQ(workspace.palette().matches().size(), 2u);
  const std::string second = workspace.palette().matches()[1]->name;
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_DownArrow); // is at the end
  press(ImGuiKey_UpArrow);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(workbench.setup().settings().text_size, second == "Larger text" ? 1.1 : 1 / 1.1) << second;
}

TEST_F(LayoutTest, ThePaletteSaysWhyNot) {
  open_palette();
  type("compare with the next");
  press(ImGuiKey_Enter);
  EXPECT_EQ(only_message(workbench), "Compare with the next: no run is pinned and no picture is open");
}

TEST_F(LayoutTest, EscapeClosesThePaletteAndNotTheRun) {
  runs.steps = 100000;
  open_palette();
  press(ImGuiKey_Escape);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(workbench.run().status().state, job::State::running);
}

} // namespace nephroid::ui::layout_test
