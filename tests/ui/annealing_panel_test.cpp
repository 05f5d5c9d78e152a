// SPDX-License-Identifier: Apache-2.0
// The panel "Annealing" on real runs of engine 3: what it plots, which pictures it shows, and where a facet's light
// goes.
#include "scenes.h"
#include "ui/inverse/annealing/panel.h"
#include "window_fixture.h"

namespace nephroid::ui::annealing_panel_test {

class AnnealingPanelTest : public test::WindowFixtureOf<test::InverseRuns> {
protected:
  AnnealingPanelTest() : WindowFixtureOf("annealing") { ImGui::GetIO().DisplaySize = {1200, 1000}; }
  const AnnealingPanel& panel() const { return workspace.panel<AnnealingPanel>(); }
  void click_widget(const std::string& widget) { click_in(panel(), widget, 0); }
  /// On a facet of the map "slopes".
  void click_facet(int x, int y, int facets) {
    const auto& [left, top, width, height] = panel().area_of("slopes");
    ASSERT_GT(width, 0);
    click({left + (x + 0.5) * width / facets, top + (y + 0.5) * height / facets});
  }
  /// Where the light of a facet of 100 mm / facets hits a receiver, in mm about its middle.
  glm::dvec2 spot(int x, int y, int facets, double distance) const {
    const float* const slope = picture("slopes").rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * facets + x);
    return {(x + 0.5) * 100 / facets - 50 + slope[0] * distance, 50 - (y + 0.5) * 100 / facets + slope[1] * distance};
  }
  const job::Picture& picture(const std::string& name) const {
    for (const job::NamedPicture& named : workbench.run().snapshot()->pictures)
      if (named.name == name) return *named.picture;
    throw std::out_of_range(name);
  }
};

TEST_F(AnnealingPanelTest, EveryCurveOfTheRunIsPlottedLogOrLinear) {
  frames(3); // nothing is open
  run_through(test::inverse_text(3));
  ASSERT_THAT(panel().histories(), SizeIs(1));
  const HistoryLines& cost = panel().histories()[0];
  EXPECT_EQ(cost.x, "sweep");
  std::vector<std::string> names;
  for (const HistoryLine& line : cost.lines) names.push_back(line.name);
  EXPECT_THAT(names, ElementsAre("cost", "cost_all", "rel_l2", "missed", "judged"));
  EXPECT_THAT(cost.lines[4].x, ElementsAre(3));
  EXPECT_NEAR(cost.lines[4].y[0], cost.lines[0].y.back(), 0.1 * cost.lines[0].y.back());
  EXPECT_THAT(cost.lines[0].x, ElementsAre(0, 1, 2, 3));
  EXPECT_LT(cost.lines[0].y.back(), 0.5 * cost.lines[0].y.front());
  click_widget("over seconds");
  EXPECT_EQ(panel().histories()[0].x, "seconds");
  EXPECT_TRUE(std::is_sorted(panel().histories()[0].lines[0].x.begin(), panel().histories()[0].lines[0].x.end()));
  EXPECT_TRUE(workbench.messages().empty());
}

// A log axis has no 0 and nothing has a place that is not a number; a curve without seconds stays over its own count.
TEST(HistoryLines, LeaveOutWhatHasNoPlace) {
  const job::Curve curve{
      "annealing_1", {"move", "temperature", "refused"}, {{0, 8, 0}, {10, 4, 3}, {20, std::nan(""), 7}}};
  const HistoryLines log = history_lines(curve, {true, true}), linear = history_lines(curve, {false, false});
  EXPECT_EQ(log.x, "move");
  EXPECT_THAT(log.lines[0].y, ElementsAre(8, 4));
  EXPECT_THAT(log.lines[1].x, ElementsAre(10, 20));
  EXPECT_THAT(linear.lines[1].y, ElementsAre(0, 3, 7));
}

// A value of 1e-14, which is rounding, does not press all others to the plot's upper edge.
TEST_F(AnnealingPanelTest, ALogAxisHasFourDecadesAtMost) {
  HistoryPlot plot;
  const HistoryLines lines{"cost", "sweep", {{"cost", {0, 1}, {0.5, 0.1}}, {"missed", {0, 1}, {1e-14, 1e-13}}}};
  for (int i = 0; i < 3; ++i) {
    ImGui::NewFrame();
    ImGui::Begin("plot");
    plot.draw(lines, true, 200);
    ImGui::End();
    ImGui::Render();
  }
  EXPECT_GT(plot.area().y[0], 1e-5);
  EXPECT_GT(plot.area().y[1], 0.5);
}

TEST_F(AnnealingPanelTest, EveryReceiverHasItsPictures) {
  run_through(test::inverse_text(2));
  for (const char* name : {"target_1", "best_1", "receiver_1", "difference_1", "target_2", "best_2", "receiver_2",
                           "difference_2", "slopes", "conflict"})
    EXPECT_GT(panel().area_of(name)[2], 50) << name;
  EXPECT_LT(panel().area_of("target_1")[1], panel().area_of("receiver_1")[1]);
  EXPECT_LT(panel().area_of("target_1")[0], panel().area_of("target_2")[0]);
}

// The View has the object; held against something, the sheet of pictures. A drag turns it, and the run goes on.
TEST_F(AnnealingPanelTest, TheViewShowsTheObjectAndTurnsIt) {
  run_through(test::inverse_text(1));
  const auto before = workbench.run().snapshot();
  EXPECT_EQ(workbench.comparing().source(), before->in_view);
  const preset::Camera seen_by = engine::camera_of(*workbench.preset());
  drag(0, 60, 0);
  EXPECT_TRUE(until([&] { return workbench.run().snapshot()->in_view->rgb != before->in_view->rgb; }));
  EXPECT_EQ(runs.made, 1);
  const preset::Camera& turned = workbench.preset()->scene.camera; // about the object, from where it was seen
  EXPECT_NEAR(turned.position[2], seen_by.position[2], 1e-6);
  EXPECT_GT(std::abs(turned.position[0] - seen_by.position[0]), 10);
  apply({command::PinRun{}, command::Arrange{Arrangement::side_by_side}});
  EXPECT_EQ(workbench.comparing().source(), workbench.run().snapshot()->picture);
}

// By hand: the light of a facet at p with slope s is at p + s d, in cells from the receiver's top left corner.
TEST_F(AnnealingPanelTest, AClickedFacetShowsItsBeamOnEveryReceiver) {
  constexpr int facets = 24;
  run_through(test::inverse_text(3, facets));
  EXPECT_FALSE(panel().beam());
  int x = 0, y = 0; // a facet whose light is on both receivers: it goes to the middle of the last
  while (std::abs(spot(x, y, facets, 200).x) + std::abs(spot(x, y, facets, 200).y) > 40) {
    x = (x + 7) % facets;
    y += x == 0;
  }
  click_facet(x, y, facets);
  frames(2);
  ASSERT_TRUE(panel().beam());
  int drawn = 0; // corners of the beam's frames and cells, whose colour is pictures.cpp's
  for (const ImDrawList* list : ImGui::GetDrawData()->CmdLists)
    drawn += static_cast<int>(std::ranges::count(list->VtxBuffer, IM_COL32(255, 176, 32, 255), &ImDrawVert::col));
  EXPECT_GE(drawn, 8) << "on both receivers";
  const FacetBeam& beam = *panel().beam();
  EXPECT_EQ(beam.facet, glm::ivec2(x, y));
  const job::Picture& slopes = picture("slopes");
  ASSERT_THAT(beam.prints, SizeIs(2));
  ASSERT_THAT(workbench.view_state().lines, SizeIs(3)); // the View's: its way, and a box on each receiver
  EXPECT_NEAR(workbench.view_state().lines[0].back()[0], spot(x, y, facets, 200).x, 1e-4);
  EXPECT_NEAR(workbench.view_state().lines[0].back()[1], spot(x, y, facets, 200).y, 1e-4);
  EXPECT_EQ(workbench.view_state().lines[0].back()[2], -200);
  for (const std::size_t j : {0u, 1u}) { // a box is about its beam
    const glm::dvec2 at = spot(x, y, facets, 100 * static_cast<double>(j + 1));
    const auto& box = workbench.view_state().lines[j + 1];
    EXPECT_LT(box[0][0], at.x);
    EXPECT_GT(box[2][0], at.x);
    EXPECT_GT(box[0][1], at.y);
    EXPECT_LT(box[2][1], at.y);
  }
  for (const std::size_t j : {0u, 1u}) {
    const double distance = 100 * static_cast<double>(j + 1);
    const glm::dvec2 at = spot(x, y, facets, distance);
    const inverse::Footprint& print = beam.prints[j];
    double middle_x = 0, middle_y = 0;
    for (int k = 0; k < print.rows; ++k)
      for (int i = 0; i < print.columns; ++i) {
        const double part = print.cells[inverse::index_at(i, k, print.columns)];
        middle_x += part * (print.x0 + i + 0.5);
        middle_y += part * (print.y0 + k + 0.5);
      }
    EXPECT_NEAR(part_on(print), 1, 1e-9) << "it is on the receiver";
    EXPECT_NEAR(middle_x, (at.x + 50) / 100 * 12, 0.5);
    EXPECT_NEAR(middle_y, (50 - at.y) / 100 * 12, 0.5);
  }
  // All facets' beams are the light that the run believes to be there: receiver_J is scaled to the wanted energy.
  const inverse::Layout layout = inverse::make_layout(*workbench.preset());
  std::vector<double> light(12 * 12);
  for (int v = 0; v < facets; ++v)
    for (int u = 0; u < facets; ++u) {
      const auto one = facet_beam(slopes, layout, {u, v});
      ASSERT_TRUE(one);
      for_cells(layout, one->prints[1], [&](std::size_t cell, double part) { light[cell] += one->power * part; });
    }
  const job::Picture &shown = picture("receiver_2"), &wanted = picture("target_2");
  double sum = 0, shown_sum = 0, apart = 0;
  for (std::size_t c = 0; c < light.size(); ++c) {
    sum += light[c];
    shown_sum += shown.rgb[3 * c];
  }
  for (std::size_t c = 0; c < light.size(); ++c) apart += std::abs(light[c] / sum - shown.rgb[3 * c] / shown_sum);
  EXPECT_LT(apart, 0.05) << "the finished solid is judged by rays";
  EXPECT_GT(std::accumulate(wanted.rgb.begin(), wanted.rgb.end(), 0.0), 0);
}

TEST_F(AnnealingPanelTest, ADraggedDistanceOrWeightGoesOnInTheSameRun) {
  run_through(test::inverse_text(2));
  const auto settings = [&]() -> const inverse::Settings& { return inverse::settings(*workbench.preset()); };
  const auto steps = [&] { return workbench.run().snapshot()->progress.step; };
  const auto done = [&] {
    return workbench.run().snapshot_is_current() && workbench.run().status().state == job::State::finished &&
           std::isfinite(job::scalar(*workbench.run().snapshot(), "judged", "cost"));
  };
  const auto drag = [&](const std::string& widget, double by) {
    const auto at = panel().place_of(widget);
    ASSERT_TRUE(at) << widget;
    drag_between(*at, {(*at)[0] + by, (*at)[1]});
    ASSERT_TRUE(until(done));
  };
  const std::int64_t before = steps();
  drag("distance_2", 30);
  EXPECT_GT(settings().receivers[1].distance_mm, 215);
  EXPECT_GT(steps(), before);
  const std::int64_t between = steps();
  drag("weight_1", 60);
  EXPECT_GT(settings().receivers[0].weight, 1.1);
  EXPECT_GT(steps(), between);
  drag("distance_1", 4000); // no farther than the next
  EXPECT_LT(settings().receivers[0].distance_mm, settings().receivers[1].distance_mm);
  EXPECT_EQ(runs.made, 1) << "it is the same run";
  EXPECT_TRUE(workbench.messages().empty());
  for (int i = 0; i < 3; ++i) workbench.apply({command::Undo{}}); // a gesture is one entry
  EXPECT_EQ(settings().receivers[1].distance_mm, 200);
  EXPECT_EQ(settings().receivers[0].weight, 1);
  EXPECT_EQ(runs.made, 1);
}

// The preset of the finished object is of another engine: the View turns it, and this panel is gone.
TEST_F(AnnealingPanelTest, TheFinishedObjectIsShownAsGlass) {
  run_through(test::inverse_text(1));
  click_widget("show as glass");
  ASSERT_TRUE(until([&] { return workbench.preset()->settings.engine() == "spectral"; }));
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "test-object" / "object.obj"));
  EXPECT_EQ(fs::weakly_canonical(workbench.preset()->source),
            fs::weakly_canonical(folder.path() / "test-object" / "view.json"));
  EXPECT_EQ(workbench.preset()->scene.objects.size(), 5u) << "the ground, and twice the object and its receiver";
  EXPECT_EQ(free_name(folder.path() / "test-object"), folder.path() / "test-object-2")
      << "what is there may be edited by now";
}

TEST_F(AnnealingPanelTest, AFacetIsOfTheMapsSizeOrNoBeam) {
  inverse::Layout layout{.facets = {2, 1}, .distances = {100}};
  job::Picture slopes{2, 1, {0, 0, 1, 5, 0, 0.5f}, {}, {}};
  EXPECT_FALSE(facet_beam(slopes, layout, {2, 0}));
  EXPECT_FALSE(box_of(facet_beam(slopes, layout, {1, 0})->prints[0])) << "a slope of 5 misses it";
  slopes.width = 1;
  EXPECT_FALSE(facet_beam(slopes, layout, {0, 0})) << "of another run";
}

} // namespace nephroid::ui::annealing_panel_test
