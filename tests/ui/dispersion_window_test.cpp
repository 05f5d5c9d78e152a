// SPDX-License-Identifier: Apache-2.0
// The panel "Dispersion" in the real window: a control point is dragged by real X events, and the preset that is saved has moved it.
// Skipped where there is no Xvfb or no xdotool.
#include "image/image.h"
#include "places.h"
#include "preset/read.h"
#include "real_window.h"
#include "ui/spectral/dispersion/panel.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

using test::bytes_at;

constexpr std::array<int, 2> size{1100, 760};

preset::Preset with_glass()
{
  preset::Preset made = preset::parse_preset(test::preset_text, "test");
  preset::Material& glass = made.scene.materials["glass"];
  glass.type = preset::Material::Type::dielectric;
  glass.dispersion = with_points({}, {{380, 1.62}, {450, 1.58}, {550, 1.55}, {650, 1.53}, {780, 1.52}});
  preset::Object& ball = made.scene.objects.emplace_back();
  ball.name = "ball";
  ball.material = "glass";
  ball.shape = preset::Shape{};
  ball.shape->radius = 0.3;
  return made;
}

/// Where a window draws these points of a preset.
std::vector<std::array<int, 2>> on_screen(const std::string& file, const std::vector<ControlPoint>& points)
{
  return test::in_window_like(size, "dispersion", file, [&](const Workspace& workspace, auto&, auto) {
    std::vector<std::array<int, 2>> pixels;
    for (const ControlPoint& point : points) pixels.push_back(test::pixel(workspace.panel<ui::DispersionPanel>().plot().to_screen(point)));
    return pixels;
  });
}

/// Of pixels of exactly this colour (IM_COL32), one above the other in a column of the screen.
int longest_run(const image::Image& screen, int x, std::uint32_t colour)
{
  const std::array<int, 3> wanted{static_cast<int>(colour & 255), static_cast<int>(colour >> 8 & 255),
                                  static_cast<int>(colour >> 16 & 255)};
  int longest = 0, run = 0;
  for (int y = 0; y < screen.height; ++y) {
    run = bytes_at(screen, x, y) == wanted ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

class DispersionWindowTest : public test::RealWindow {};

TEST_F(DispersionWindowTest, ADraggedPointIsInThePresetThatIsSaved)
{
  const preset::Preset opened = with_glass();
  const std::vector<ControlPoint> before = sorted_points(opened.scene.materials.at("glass").dispersion);
  const std::string file = folder.write("glass.json", preset::to_json(opened));
  const auto way = on_screen(file, {before[2], {570, 1.59}});
  ASSERT_NO_FATAL_FAILURE(
      drag_and_save(file, {"--layout", "dispersion", "--size", fmt::format("{}x{}", size[0], size[1])}, way[0], way[1]));
  const std::vector<ControlPoint> after = sorted_points(preset::read_preset(file).scene.materials.at("glass").dispersion);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_NEAR(after[2][0], 570, 3);
  EXPECT_NEAR(after[2][1], 1.59, 0.003);
  for (const std::size_t i : {0u, 1u, 3u, 4u}) EXPECT_EQ(after[i], before[i]) << i;

  // What was saved is said at the foot for a while, which moves points up: their wavelengths are where they were.
  const image::Image picture = screen();
  const auto at = on_screen(file, {after[2], after[1]});
  EXPECT_GE(longest_run(picture, at[0][0], colour::note), 8) << "the selected point, where the preset has it";
  EXPECT_GE(longest_run(picture, at[1][0], colour::text), 8) << "one at its left; those at its right lie below its tooltip";
}

} // namespace
} // namespace nephroid::ui
