// SPDX-License-Identifier: Apache-2.0
// The panel "Spectra" in the real window: a row of a light's table is dragged by real X events, and the preset that is
// saved has moved it. Skipped where there is no Xvfb or no xdotool.
#include "places.h"
#include "preset/read.h"
#include "real_window.h"
#include "spectra_scene.h"
#include "ui/spectral/spectra/panel.h"

#include <fmt/format.h>

#include <vector>

namespace nephroid::ui {
namespace {

using test::bytes_at;

constexpr std::array<int, 2> size{1280, 860};

/// Where a window draws these values of the upper plot.
std::vector<std::array<int, 2>> on_screen(const std::string& file, const std::vector<PowerRow>& values)
{
  return test::in_window_like<test::SeeingRuns>(size, "spectra", file, [&](const Workspace& workspace, auto&, auto) {
    std::vector<std::array<int, 2>> pixels;
    for (const PowerRow& value : values)
      pixels.push_back(test::pixel(workspace.panel<ui::SpectraPanel>().plot().place(value[0], value[1])));
    return pixels;
  });
}

class SpectraWindowTest : public test::RealWindow {};

TEST_F(SpectraWindowTest, ADraggedRowIsInThePresetThatIsSaved)
{
  const std::string file =
      folder.write("room.json", test::room_text(R"({"type": "table", "table": [[400, 0.2], [500, 1], [600, 0.5], [700, 0.8]]})"));
  const auto way = on_screen(file, {{600, 0.5}, {650, 0.9}});
  ASSERT_NO_FATAL_FAILURE(drag_and_save(file, {"--layout", "spectra", "--size", fmt::format("{}x{}", size[0], size[1])}, way[0], way[1]));
  const std::vector<PowerRow> after = preset::read_preset(file).scene.lights[0].spectrum.table;
  ASSERT_EQ(after.size(), 4u);
  EXPECT_NEAR(after[2][0], 650, 3);
  EXPECT_NEAR(after[2][1], 0.9, 0.02);
  EXPECT_EQ(after[1], (PowerRow{500, 1}));
  EXPECT_EQ(after[3], (PowerRow{700, 0.8}));

  // The lower plot's bars: in the real window too the spectrum goes from blue to red.
  const image::Image picture = screen();
  const auto at = on_screen(file, {{460, 0}, {620, 0}});
  const auto has = [&](int x, auto is_wanted) {
    for (int y = at[0][1] + 20; y < size[1]; ++y)
      if (is_wanted(bytes_at(picture, x, y))) return true;
    return false;
  };
  EXPECT_TRUE(has(at[0][0], [](const auto& c) { return c[2] > c[0] + 60; })) << "a blue bar";
  EXPECT_TRUE(has(at[1][0], [](const auto& c) { return c[0] > c[2] + 60; })) << "a red bar";
}

} // namespace
} // namespace nephroid::ui
