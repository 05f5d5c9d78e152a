// SPDX-License-Identifier: Apache-2.0
// Layouts of panels by engine: kept, restored, reset; panels closed and shown; the command palette.
#include "ui/shell/layout.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::ui::layout_test {

class LayoutTest : public test::WindowFixture {
protected:
  using test::WindowFixture::WindowFixtureOf;
  ImGuiID dock_space() const
  {
    ImGuiID root = 0;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->DockNode) root = ImGui::DockNodeGetRootNode(window->DockNode)->ID;
    return root;
  }
  void set_layout(const Layout& layout)
  {
    Settings settings = workbench.settings();
    settings.engines["spectral"].layout = layout;
    workbench.set_settings(settings);
  }
  /// Whether the panel is seen: drawn, and in front of its tabs.
  static bool seen(const char* title)
  {
    const ImGuiWindow* window = ImGui::FindWindowByName(title);
    return window && window->Active && !window->Hidden && (!window->DockNode || window->DockNode->VisibleWindow == window);
  }
};

TEST_F(LayoutTest, AKeptLayoutIsWhereThePanelsAre)
{
  const Layout kept{{.split = Dock::Split::rows,
                     .first_part = 0.6,
                     .parts = {{.split = Dock::Split::columns,
                                .first_part = 0.3,
                                .parts = {{.tabs = {"parameters", "plan", "error", "annealing", "environment"}, .front = "plan"},
                                          {.tabs = {"view"}, .front = "view"}}},
                               {.tabs = {"dispersion"}, .front = "dispersion"}}},
                    {{"spectra", {0.1, 0.2, 0.5, 0.25}}}};
  set_layout(kept);
  open();
  frames(5);
  EXPECT_TRUE(seen(PlanPanel::title));
  EXPECT_FALSE(seen(ParametersPanel::title));
  EXPECT_TRUE(seen(DispersionPanel::title));
  const ImGuiWindow* view = ImGui::FindWindowByName(ViewPanel::title);
  const ImGuiWindow* plan = ImGui::FindWindowByName(PlanPanel::title);
  EXPECT_LT(plan->Pos.x, view->Pos.x) << "at the left of the picture";
  const ImVec2 area = ImGui::GetMainViewport()->WorkSize;
  EXPECT_NEAR(plan->Size.x / area.x, 0.3, 0.02);
  const ImGuiWindow* spectra = ImGui::FindWindowByName(SpectraPanel::title);
  EXPECT_FALSE(spectra->DockNode);
  EXPECT_NEAR(spectra->SizeFull.x, 0.5 * ImGui::GetMainViewport()->Size.x, 2);
  const Layout now = layout_now(dock_space());
  EXPECT_EQ(now.docks.parts[0].parts[0].front, "plan");
  EXPECT_NEAR(now.docks.first_part, 0.6, 0.01);
  ASSERT_EQ(now.floating.size(), 1u);
  EXPECT_NEAR(now.floating[0].place[1], 0.2, 0.01);
}

TEST_F(LayoutTest, WhatTheMouseMakesOfItIsKeptForThatEngine)
{
  open();
  frames(5);
  ASSERT_FALSE(workbench.settings().engines.contains("spectral")) << "nobody touched it";
  const ImGuiWindow* view = ImGui::FindWindowByName(ViewPanel::title);
  const float before = view->Size.x;
  const Point edge{static_cast<double>(view->Pos.x + view->Size.x) + 1, static_cast<double>(view->Pos.y + view->Size.y) / 2};
  drag_between(edge, {edge[0] - 150, edge[1]});
  frames(3);
  EXPECT_NEAR(ImGui::FindWindowByName(ViewPanel::title)->Size.x, before - 150, 8);
  ASSERT_TRUE(workbench.settings().engines.contains("spectral"));
  const Dock& docks = workbench.settings().engines.at("spectral").layout.docks;
  EXPECT_NEAR(docks.first_part, (before - 150) / ImGui::GetMainViewport()->WorkSize.x, 0.02);
  workbench.apply({command::ResetLayout{}});
  frames(5);
  EXPECT_NEAR(ImGui::FindWindowByName(ViewPanel::title)->Size.x, before, 2);
  EXPECT_EQ(workbench.settings().engines.at("spectral"), EngineLayout{});
}

TEST_F(LayoutTest, EachEngineHasItsOwn)
{
  open();
  frames(5);
  EXPECT_TRUE(seen(ErrorPanel::title));
  const std::string inverse = folder.write("inverse.json", R"({"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": {
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

class ParametersInFront : public LayoutTest {
protected:
  ParametersInFront() : LayoutTest("parameters") {}
};

TEST_F(ParametersInFront, StaysInFrontForAnotherEngine)
{
  open();
  frames(5);
  EXPECT_TRUE(seen(ParametersPanel::title));
  ASSERT_TRUE(workbench.open("inverse/shapes"));
  frames(6);
  EXPECT_TRUE(seen(ParametersPanel::title));
  EXPECT_FALSE(seen("Annealing"));
}

TEST_F(LayoutTest, NamesThatAreNoPanelsAndPanelsTwiceDoNoHarm)
{
  set_layout({{.split = Dock::Split::columns,
               .first_part = 0.9,
               .parts = {{.tabs = {"view", "view", "nothing"}, .front = "nothing"}, {.tabs = {"view"}, .front = "view"}}},
              {{"view", {0, 0, 1, 1}}, {"nobody", {0, 0, 1, 1}}}});
  open();
  frames(10);
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_TRUE(ImGui::FindWindowByName(PlanPanel::title)->DockNode) << "what the layout does not have is docked somewhere";
}

TEST_F(LayoutTest, EveryPanelIsClosedAndShownByItsAction)
{
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

TEST_F(LayoutTest, AnImpossibleSizeOfTextStaysAtTheEnd)
{
  workbench.apply({command::SetAppearance{Theme::light, 1e9}});
  EXPECT_EQ(workbench.settings().text_size, Settings::largest_text);
  workbench.apply({command::SetAppearance{Theme::dark, -1}});
  EXPECT_EQ(workbench.settings().text_size, Settings::smallest_text);
}

TEST_F(LayoutTest, ThePaletteRunsWhatIsTyped)
{
  open();
  workbench.apply({command::Ask{Question::command}});
  frames(3);
  EXPECT_EQ(workspace.palette().found().size(), actions().size() + preset::shipped_presets().size());
  type("brigh");
  ASSERT_FALSE(workspace.palette().found().empty());
  EXPECT_EQ(workspace.palette().found().front()->name, "Brighter");
  press(ImGuiKey_Enter);
  frames(2);
  EXPECT_EQ(workbench.chosen().look.exposure_stops, 0.5);
  EXPECT_EQ(workbench.question(), Question::none);
}

TEST_F(LayoutTest, TheArrowsChooseInThePalette)
{
  open();
  workbench.apply({command::Ask{Question::command}});
  frames(3);
  type("er text");
  ASSERT_EQ(workspace.palette().found().size(), 2u);
  const std::string second = workspace.palette().found()[1]->name;
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_DownArrow); // is at the end
  press(ImGuiKey_UpArrow);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_Enter);
  frames(2);
  EXPECT_EQ(workbench.question(), Question::none);
  EXPECT_EQ(workbench.settings().text_size, second == "Larger text" ? 1.1 : 1 / 1.1) << second;
}

TEST_F(LayoutTest, ThePaletteSaysWhyNot)
{
  open();
  workbench.apply({command::Ask{Question::command}});
  frames(3);
  type("compare with the next");
  press(ImGuiKey_Enter);
  frames(1);
  ASSERT_EQ(workbench.messages().size(), 1u);
  EXPECT_EQ(workbench.messages()[0].line, "Compare with the next: no run is pinned");
}

TEST_F(LayoutTest, EscapeClosesThePaletteAndNotTheRun)
{
  runs.steps = 100000;
  open();
  workbench.apply({command::Ask{Question::command}});
  frames(3);
  press(ImGuiKey_Escape);
  frames(2);
  EXPECT_EQ(workbench.question(), Question::none);
  EXPECT_EQ(workbench.run().status().state, job::State::running);
}

} // namespace nephroid::ui::layout_test
