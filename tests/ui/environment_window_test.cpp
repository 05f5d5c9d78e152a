// SPDX-License-Identifier: Apache-2.0
// The panel "Environment" in the real window: the map is turned and the number of lights slid by real X events, and the saved preset has
// both. With the folder docs in NEPHROID_PICTURES the picture of docs/window.md is written there. Skipped where there is no Xvfb, no
// xdotool or no ImageMagick.
#include "environment/settings.h"
#include "places.h"
#include "preset/read.h"
#include "real_window.h"
#include "ui/environment/panel.h"

#include <fmt/format.h>

#include <cstdlib>
#include <tuple>

namespace nephroid::ui {
namespace {

using test::Pixel, test::pixel;

constexpr std::array<int, 2> size{1200, 900};

class EnvironmentWindowTest : public test::RealWindow {
protected:
  EnvironmentWindowTest() : RealWindow({"Xvfb", "xdotool", "import", "convert"})
  {
    // Bakes go with the test; compiled kernels stay.
    const char* const home = std::getenv("HOME");
    setenv("POCL_CACHE_DIR", (std::string(home ? home : "/tmp") + "/.cache/pocl/kcache").c_str(), 0);
    setenv("XDG_CACHE_HOME", (folder.path() / "cache").c_str(), 1);
  }
  /// A glass ball on a floor under a shipped sky of three lamps; a bake of a second or two.
  std::string written() const
  {
    return folder.write("lamps.json", fmt::format(R"({{
  "name": "Lamps", "engine": "environment", "unit": "cm", "white": 10, "stop": {{"passes": 4}},
  "scene": {{
    "camera": {{"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34, "resolution": [512, 256]}},
    "materials": {{"glass": {{"type": "dielectric", "dispersion": 1.5}}, "floor": {{"type": "diffuse", "reflectance": 0.8}}}},
    "objects": [{{"name": "ball", "shape": {{"type": "sphere", "radius": 1}}, "material": "glass"}},
                {{"name": "floor", "shape": {{"type": "quad", "size": [30, 1, 30]}}, "material": "floor", "transform": {{"translate": [0, -1.2, 0]}}}}],
    "environment": {{"type": "file", "file": "{}/presets/spectral/three-lamps.hdr", "rotate_deg": 25}}
  }},
  "environment": {{"photons": 8192, "spheres": 4, "resolution": 64}}
}})",
                                                  NEPHROID_SOURCE_DIR));
  }
};

/// Pixels in the colour of lines between regions.
int line_pixels(const image::Image& screen, const std::array<double, 4>& area)
{
  int found = 0;
  for (double y = area[1]; y < area[1] + area[3]; ++y)
    for (double x = area[0]; x < area[0] + area[2]; ++x) {
      const std::array<int, 3> c = test::bytes_at(screen, x, y);
      found += c[1] > c[0] + 60 && c[1] > c[2] + 60;
    }
  return found;
}

TEST_F(EnvironmentWindowTest, TheMapIsTurnedAndCut)
{
  const std::string file = written();
  const auto [map, slider,
              lamp] = test::in_window_like(size, "environment", file, [&](const Workspace& workspace, test::Headless&, auto draw) {
    const auto& panel = workspace.panel<EnvironmentPanel>();
    test::eventually(draw, [&] { return panel.model().rests(); });
    for (int i = 0; i < 4; ++i) draw(); // what was found moves what is below it
    const auto& figures = panel.figures();
    const auto brightest = std::max_element(figures.begin(), figures.end(), [](const auto& a, const auto& b) { return a.flux < b.flux; });
    const auto& cut = panel.shown().cut->segmentation;
    const std::size_t index = static_cast<std::size_t>(brightest - figures.begin());
    return std::tuple(panel.map().area(), pixel(panel.place_of("lights").value()), panel.place_on_map(cut.lights.at(index).direction));
  });
  test::PlayedWindow window(file, {"--layout", "environment", "--size", fmt::format("{}x{}", size[0], size[1])}, folder.path());
  window.until("the map is cut", [&] { return line_pixels(window.picture("before.png"), map) > 200; });
  const int lines = line_pixels(window.picture("before.png"), map);
  // To the right by a quarter of its width: it turns by -90 degrees.
  const Pixel from = pixel({map[0] + 0.3 * map[2], map[1] + 0.8 * map[3]}), to{from[0] + static_cast<int>(map[2] / 4), from[1]};
  window.drag(from, to);
  window.drag(slider, {slider[0] - 65, slider[1]}); // its middle is at 157 lights
  window.until("there are fewer lines", [&] { return line_pixels(window.picture("after.png"), map) < lines - 50; });
  window.drag({slider[0] - 65, slider[1]}, {slider[0] - 30, slider[1]});
  window.until("the bake is over", [&] { return window.states().back().fraction == 1; });
  const double turned = lamp[0] + (to[0] - from[0]);
  window.move(pixel({turned < map[0] + map[2] ? turned : turned - map[2], lamp[1]}));
  window.until("there are more lines again", [&] { return line_pixels(window.picture("window-environment.png"), map) > lines; });
  if (const char* kept = std::getenv("NEPHROID_PICTURES")) {
    const std::string command = fmt::format("convert '{}' +dither -colors 256 'png8:{}/window-environment.png'",
                                            (folder.path() / "window-environment.png").string(), kept);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  window.save();
  const preset::Preset saved = preset::read_preset(file);
  EXPECT_NEAR(saved.scene.environment->rotate_deg, 25 - 90, 1);
  EXPECT_GT(environment::settings(saved).lights, 24);
  EXPECT_EQ(window.quit().exit_code, 0);
}

} // namespace
} // namespace nephroid::ui
