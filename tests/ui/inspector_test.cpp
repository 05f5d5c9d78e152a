// SPDX-License-Identifier: Apache-2.0
// The panel Inspector: pixels and rectangles taken by the mouse and by keys, what it says of them, and what it copies.
// Statistics of rectangles against closed forms.
#include "layered_runs.h"
#include "spectral/settings.h"
#include "ui/inspector/panel.h"
#include "ui/inspector/pixels.h"
#include "window_fixture.h"

namespace nephroid::ui::inspector_test {

using Pixel = std::array<int, 2>;

class InspectorTest : public test::WindowFixtureOf<test::LayeredRuns> {
protected:
  InspectorTest() : WindowFixtureOf("inspector") {}
  const InspectorPanel& inspector() { return workspace.panel<InspectorPanel>(); }
  std::optional<Pixel> pixel() { return workbench.view_state().pixel; }
  /// The middle of a pixel on the screen.
  Point place_of(int x, int y) {
    return place(workbench.view_state().view_settings, view().canvas(), {64, 48}).to_screen({x + 0.5, y + 0.5});
  }
  void with_alt(const std::function<void()>& what) {
    imgui.key(ImGuiMod_Alt, true);
    what();
    imgui.key(ImGuiMod_Alt, false);
    frames(2);
  }
  void click_on(const std::string& widget) { click_in(inspector(), widget, 2); }
  PixelRow row(const std::string& name) {
    for (const PixelRow& row : pixel_rows(context(), pixel().value()))
      if (row.name == name) return row;
    ADD_FAILURE() << "no row " << name;
    return {};
  }
  /// With a switch of the engine on.
  void run_through_with(const std::string& name) {
    std::string text = test::preset_text;
    run_through(text.insert(text.find("\"stop\""), "\"spectral\": {\"" + name + "\": true}, "));
  }
  bool has_statistics() {
    return until([&] { return inspector().statistics() != nullptr; });
  }
};

TEST_F(InspectorTest, AltAndAClickTakesAPixelAndArrowsMoveIt) {
  run_through();
  const preset::Camera before = camera();
  with_alt([&] { click(place_of(40, 11)); });
  EXPECT_THAT(pixel(), Optional(Pixel{40, 11}));
  EXPECT_EQ(camera(), before) << "the camera stays";
  EXPECT_FALSE(workbench.view_state().region);
  press(ImGuiKey_LeftArrow);
  EXPECT_THAT(pixel(), Optional(Pixel{39, 11}));
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_RightArrow);
  press(ImGuiKey_UpArrow);
  EXPECT_THAT(pixel(), Optional(Pixel{40, 12}));
  workbench.apply({command::InspectPixel{Pixel{63, 0}}});
  press(ImGuiKey_RightArrow);
  press(ImGuiKey_UpArrow);
  EXPECT_THAT(pixel(), Optional(Pixel{63, 0})) << "not beyond the picture";
  frames(2);
  click_on("let go");
  EXPECT_FALSE(pixel());
  press(ImGuiKey_LeftArrow);
  EXPECT_FALSE(pixel());
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(InspectorTest, AKeyTakesThePixelInTheMiddleAndLetsItGo) {
  run_through();
  press(ImGuiKey_I);
  EXPECT_THAT(pixel(), Optional(Pixel{32, 24}));
  press(ImGuiKey_I);
  EXPECT_FALSE(pixel());
  workbench.apply({command::SetViewSettings{{.fit = false, .zoom = 8, .centre = {10.5, 1e9}}}});
  press(ImGuiKey_I);
  EXPECT_THAT(pixel(), Optional(Pixel{10, 47}));
}

TEST_F(InspectorTest, SaysValuesLayersAndTheReference) {
  runs.reference = test::even_reference({1, 1, 1}, {0.5f, 0, 0});
  std::const_pointer_cast<measure::Reference>(runs.reference)->error_draw.assign(3 * 64 * 48, -0.01f);
  run_through();
  workbench.apply({command::InspectPixel{Pixel{32, 12}}});
  EXPECT_THAT(row("this run").rgb, ElementsAre(0.75f, 0.75f, 0.125f));
  EXPECT_NEAR(row("this run").luminance, 0.704875, 1e-6) << ".2126 .75 + .7152 .75 + .0722 .125";
  // L* = 116 (Y)^(1/3) - 16
  EXPECT_NEAR(row("this run").lab[0], 116 * std::cbrt(0.704875) - 16, 1e-3);
  EXPECT_THAT(row("direct").rgb, ElementsAre(0.25f, 0.5f, 0.125f));
  EXPECT_THAT(row("caustic").rgb, ElementsAre(0.5f, 0.25f, 0));
  EXPECT_THAT(row("reference").rgb, ElementsAre(1, 1, 1));
  EXPECT_THAT(row("difference").rgb, ElementsAre(-0.25f, -0.25f, -0.875f));
  EXPECT_FALSE(row("difference").is_colour);
  EXPECT_THAT(row("reference's standard error").rgb, Each(0.01f));
  workbench.apply({command::ShowLayer{"caustic"}});
  EXPECT_THAT(row("reference: caustic").rgb, ElementsAre(0.5f, 0, 0));
  EXPECT_THAT(row("difference").rgb, ElementsAre(0, 0.25f, 0));
  frames(2);
  click_on("copy pixel");
  EXPECT_THAT(ImGui::GetClipboardText(),
              StartsWith("pixel (32, 12)\tR\tG\tB\tY W/m2/sr\tL*\ta*\tb*\nthis run\t0.75\t0.75\t0.125\t0.704"));
  EXPECT_THAT(ImGui::GetClipboardText(), HasSubstr("\ncaustic\t0.5\t0.25\t0\t"));
}

TEST_F(InspectorTest, APixelOutsideOfThePictureIsSaidAndComesBack) {
  run_through();
  apply({command::InspectPixel{Pixel{500, -3}}});
  EXPECT_TRUE(pixel_rows(context(), *pixel()).empty());
  press(ImGuiKey_LeftArrow);
  EXPECT_THAT(pixel(), Optional(Pixel{63, 0}));
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(InspectorTest, TheSpectrumOfThePixelIsShownAndCopied) {
  run_through_with("relight");
  workbench.apply({command::InspectPixel{Pixel{3, 4}}});
  ASSERT_TRUE(until([&] { return workbench.run().spectrum() != nullptr; }));
  EXPECT_EQ(workbench.run().spectrum()->pixel, (Pixel{3, 4}));
  frames(2);
  click_on("copy spectrum");
  EXPECT_THAT(ImGui::GetClipboardText(), StartsWith("wavelength_nm,"));
  EXPECT_THAT(ImGui::GetClipboardText(), HasSubstr("\n380,3,4,7\n381,3,4,7\n"));
  press(ImGuiKey_RightArrow);
  EXPECT_TRUE(until([&] { return workbench.run().spectrum()->pixel == Pixel{4, 4}; })) << "of a finished run too";
  press(ImGuiKey_I);
  EXPECT_EQ(workbench.run().spectrum(), nullptr);
}

TEST_F(InspectorTest, AButtonKeepsSpectraAsOneEdit) {
  run_through();
  workbench.apply({command::InspectPixel{Pixel{3, 4}}});
  ASSERT_TRUE(until([&] { return workbench.run().spectrum() && inspector().place_of("keep spectra"); }));
  click_on("keep spectra");
  EXPECT_TRUE(spectral::settings(*workbench.preset()).relight);
  EXPECT_EQ(workbench.edits()->undo_label(), "keep spectra");
  ASSERT_TRUE(until([&] { return workbench.run().spectrum() && workbench.run().spectrum()->why_not.empty(); }));
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_FALSE(spectral::settings(*workbench.preset()).relight);
}

TEST_F(InspectorTest, SpectraThatCannotBeAreNotOffered) {
  run_through_with("indirect");
  workbench.apply({command::InspectPixel{Pixel{3, 4}}});
  ASSERT_TRUE(until([&] { return workbench.run().spectrum() != nullptr; }));
  frames(2);
  EXPECT_FALSE(inspector().place_of("keep spectra"));
}

TEST_F(InspectorTest, AltAndADragTakesARectangle) {
  run_through();
  const preset::Camera before = camera();
  with_alt([&] { drag_between(place_of(31, 13), place_of(10, 4)); });
  EXPECT_THAT(workbench.view_state().region, Optional(PixelRegion{{10, 4}, {32, 14}})) << "both corners are in it";
  EXPECT_FALSE(pixel()) << "a drag is no click";
  EXPECT_EQ(camera(), before);
  ASSERT_TRUE(has_statistics());
  ASSERT_TRUE(until([&] { return inspector().statistics()->of.region == PixelRegion{{10, 4}, {32, 14}}; }));
  const PictureStatistics run = inspector().statistics()->pictures.at(0);
  EXPECT_EQ(run.pixels, 220u);
  EXPECT_NEAR(run.of[1].mean, 0.25 + 20.5 / 64, 1e-6) << "red: columns 10 to 31";
  EXPECT_NEAR(run.of[2].median, 0.5 + 8.5 / 48, 1e-6) << "green: rows 4 to 13";
  click_on("copy region");
  EXPECT_THAT(ImGui::GetClipboardText(), HasSubstr("\n10,4,32,14,\"run\",luminance,W/m2/sr,"));
  click_on("clear");
  EXPECT_FALSE(workbench.view_state().region);
  frames(2);
  EXPECT_EQ(inspector().statistics(), nullptr);
}

TEST_F(InspectorTest, AKeyTakesTheWholePictureAndTheReferenceIsHeldAgainst) {
  runs.reference = test::even_reference({1, 1, 1}, {0.5f, 0, 0});
  run_through();
  press(ImGuiKey_I, ImGuiMod_Shift);
  EXPECT_THAT(workbench.view_state().region, Optional(PixelRegion{{0, 0}, {64, 48}}));
  ASSERT_TRUE(has_statistics());
  const auto statistics = inspector().statistics();
  ASSERT_THAT(statistics->pictures, SizeIs(3));
  EXPECT_EQ(statistics->pictures[1].name, "reference");
  EXPECT_NEAR(statistics->pictures[1].of[0].mean, 1, 1e-6);
  EXPECT_NEAR(statistics->pictures[2].of[3].mean, 0.125 - 1, 1e-6) << "blue of the difference";
  EXPECT_THAT(statistics->histogram.counts, SizeIs(2));
  press(ImGuiKey_I, ImGuiMod_Shift);
  EXPECT_FALSE(workbench.view_state().region);
}

TEST_F(InspectorTest, RegionsOutsideOfThePictureDoNoHarm) {
  run_through();
  for (const PixelRegion& region :
       {PixelRegion{{900, 900}, {1000, 1000}}, PixelRegion{{-50, -50}, {5, 5}}, PixelRegion{{5, 5}, {5, 9}}}) {
    apply({command::SelectRegion{region}});
  }
  EXPECT_FALSE(workbench.view_state().region) << "the last one is empty";
  EXPECT_TRUE(workbench.messages().empty());
}

constexpr float float_nan = std::numeric_limits<float>::quiet_NaN(),
                float_infinity = std::numeric_limits<float>::infinity();

/// A picture of greys.
HeldPicture picture_of(int width, int height, const std::vector<float>& greys) {
  auto rgb = std::make_shared<std::vector<float>>();
  for (const float grey : greys) rgb->insert(rgb->end(), 3, grey);
  return {rgb, {width, height, *rgb, "greys"}};
}

TEST(Moments, OfTheFirstNumbers) {
  // 1 .. n: mean (n + 1) / 2, variance (n^2 - 1) / 12, median as the mean.
  for (const int n : {1, 2, 9, 1000}) {
    std::vector<double> values(static_cast<std::size_t>(n));
    std::iota(values.rbegin(), values.rend(), 1.0);
    const Moments m = moments(values);
    EXPECT_DOUBLE_EQ(m.mean, (n + 1) / 2.0);
    EXPECT_NEAR(m.deviation, std::sqrt((double(n) * n - 1) / 12), 1e-9 * n);
    EXPECT_DOUBLE_EQ(m.median, (n + 1) / 2.0);
    EXPECT_EQ(m.least, 1);
    EXPECT_EQ(m.most, n);
  }
  EXPECT_TRUE(std::isnan(moments({}).mean));
  EXPECT_TRUE(std::isnan(moments({}).median));
  // A large mean does not swallow a small deviation.
  EXPECT_NEAR(moments({1e9, 1e9 + 2}).deviation, 1, 1e-6);
}

TEST(Region, TakesItsPixelsOnly) {
  const HeldPicture picture = picture_of(4, 3, {0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23});
  const RegionStatistics s = region_statistics({picture, {}, "", {{1, 1}, {3, 3}}, 2});
  ASSERT_THAT(s.pictures, SizeIs(1));
  EXPECT_EQ(s.pictures[0].pixels, 4u);
  EXPECT_DOUBLE_EQ(s.pictures[0].of[1].mean, (11 + 12 + 21 + 22) / 4.0);
  EXPECT_NEAR(s.pictures[0].of[0].mean, 2 * 16.5, 1e-5) << "luminance is in W/m2/sr: times white";
  EXPECT_EQ(s.pictures[0].of[2].least, 11);
  EXPECT_EQ(s.pictures[0].of[3].most, 22);
  EXPECT_EQ(region_statistics({picture, {}, "", {{-5, 2}, {2, 9}}, 1}).pictures[0].pixels, 2u) << "cut to the picture";
  EXPECT_FALSE(cut_to({{4, 0}, {9, 3}}, 4, 3));
}

TEST(Region, CountsWhatIsNotOrdinaryAndLeavesItOut) {
  auto rgb = std::make_shared<std::vector<float>>(
      std::vector<float>{1, 1, 1, float_nan, float_infinity, 0, 0, -float_infinity, 0, -1, 2, 0, -1, -1, -1});
  const RegionStatistics s = region_statistics({{rgb, {5, 1, *rgb, "odd"}}, {}, "", {{0, 0}, {5, 1}}, 1});
  const PictureStatistics& p = s.pictures[0];
  EXPECT_EQ(p.pixels, 5u);
  EXPECT_EQ(p.nan, 1u);
  EXPECT_EQ(p.infinite, 1u);
  EXPECT_EQ(p.dark, 1u) << "(-1, 2, 0) is light, of a colour outside of sRGB";
  EXPECT_EQ(p.coloured, 2u);
  EXPECT_DOUBLE_EQ(p.of[1].mean, (1 - 1 - 1) / 3.0);
  EXPECT_EQ(p.of[2].most, 2);
}

TEST(Region, HoldsTwoPicturesAgainstEachOther) {
  const RegionStatistics s = region_statistics(
      {picture_of(2, 2, {1, 2, 3, 4}), picture_of(2, 2, {1, 1, 1, float_nan}), "a \"pin\"", {{0, 0}, {2, 2}}, 1});
  ASSERT_THAT(s.pictures, SizeIs(3));
  EXPECT_EQ(s.pictures[1].nan, 1u);
  EXPECT_EQ(s.pictures[2].name, "difference");
  EXPECT_EQ(s.pictures[2].nan, 1u);
  EXPECT_DOUBLE_EQ(s.pictures[2].of[1].mean, 1) << "0, 1, 2";
  EXPECT_DOUBLE_EQ(s.pictures[2].of[1].median, 1);
  const std::string csv = to_csv(s);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 4);
  EXPECT_THAT(csv, HasSubstr("\n0,0,2,2,\"a \"\"pin\"\"\",R,linear,1,0,1,1,1,4,1,0,0,0\n"));
}

TEST(RegionHistogram, CountsEveryPixelAboveZeroOnce) {
  std::vector<float> greys;
  for (int i = 0; i < 100; ++i) greys.push_back(std::pow(10.0f, -2 + 0.04f * static_cast<float>(i))); // .01 to 91
  greys.push_back(0);
  greys.push_back(-1);
  greys.push_back(float_nan);
  const Histogram h = region_statistics({picture_of(103, 1, greys), {}, "", {{0, 0}, {103, 1}}, 1}).histogram;
  ASSERT_THAT(h.counts, SizeIs(1));
  EXPECT_EQ(std::accumulate(h.counts[0].begin(), h.counts[0].end(), 0.0), 100);
  EXPECT_NEAR(h.first, -2, 0.11);
  EXPECT_NEAR(h.last, 2, 0.11);
  // 2.5 pixels a tenth of a decade.
  EXPECT_THAT(std::vector(h.counts[0].begin() + 1, h.counts[0].end() - 1), Each(AllOf(Ge(2), Le(3))));
  const Histogram none = region_statistics({picture_of(1, 1, {0}), {}, "", {{0, 0}, {1, 1}}, 1}).histogram;
  EXPECT_THAT(none.counts[0], Each(0));
}

TEST(NewestStatistics, AreMadeOnceOfWhatIsWanted) {
  Messages messages;
  TaskQueue tasks;
  NewestResult<RegionStatistics> statistics;
  const auto want = [&](const RegionRequest& wanted) {
    tasks.collect(messages);
    request_statistics(statistics, tasks, wanted);
  };
  const RegionRequest request{picture_of(2, 1, {1, 3}), {}, "", {{0, 0}, {2, 1}}, 1};
  ASSERT_TRUE(test::eventually([&] { return want(request), statistics.newest() != nullptr; }));
  const auto first = statistics.newest();
  for (int i = 0; i < 5; ++i) want(request);
  EXPECT_TRUE(tasks.empty());
  EXPECT_EQ(statistics.newest(), first);
  RegionRequest other = request;
  other.region = {{1, 0}, {2, 1}};
  ASSERT_TRUE(test::eventually([&] { return want(other), statistics.newest() != first; }));
  EXPECT_DOUBLE_EQ(statistics.newest()->pictures[0].of[1].mean, 3);
  RegionRequest newer = other;
  newer.picture = picture_of(2, 1, {1, 5});
  ASSERT_TRUE(test::eventually([&] { return want(newer), statistics.newest()->pictures[0].of[1].mean == 5; }))
      << "it rests, and then goes on";
  statistics.forget(tasks);
  EXPECT_EQ(statistics.newest(), nullptr);
}

} // namespace nephroid::ui::inspector_test
