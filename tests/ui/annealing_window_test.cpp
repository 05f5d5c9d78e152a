// SPDX-License-Identifier: Apache-2.0
// The panel "Annealing" in the real window: a facet is clicked by real X events, and its beam is drawn on every receiver. With the folder
// docs in NEPHROID_PICTURES it is the shipped shapes, and the picture of docs/inverse.md is written there. Skipped where there is no
// Xvfb or no xdotool.
#include "inverse_runs.h"
#include "places.h"
#include "real_window.h"
#include "ui/inverse/annealing/panel.h"

namespace nephroid::ui::annealing_window_test {

constexpr std::array<int, 2> size{1200, 960};

class AnnealingWindowTest : public test::RealWindow {};

/// Pixels in the colour of a beam's frame.
int beam_pixels(const image::Image& screen, const std::array<double, 4>& area)
{
  int found = 0;
  for (double y = area[1]; y < area[1] + area[3]; ++y)
    for (double x = area[0]; x < area[0] + area[2]; ++x) {
      const std::array<int, 3> c = test::bytes_at(screen, x, y);
      found += c[0] > 200 && c[1] > 130 && c[1] < 200 && c[2] < 80;
    }
  return found;
}

TEST_F(AnnealingWindowTest, AClickedFacetShowsItsBeam)
{
  const char* kept = std::getenv("NEPHROID_PICTURES");
  const std::string file = folder.write("small.json", test::inverse_text(3)), shown = kept ? "inverse/shapes" : file;
  const auto [facet, receivers] =
      test::in_window_like<test::InverseRuns>(size, "annealing", shown, [&](const Workspace& workspace, test::Headless& imgui, auto draw) {
        const auto& panel = workspace.panel<AnnealingPanel>();
        const auto& [left, top, width, height] = panel.area_of("slopes");
        const test::Pixel at = test::pixel({left + 0.3 * width, top + 0.7 * height});
        imgui.move(at[0], at[1]);
        for (const bool down : {true, false}) {
          draw();
          imgui.button(0, down);
        }
        for (int i = 0; i < 4; ++i) draw(); // the beams' row makes the panel longer
        return std::pair(at, std::array{panel.area_of("receiver_1"), panel.area_of("receiver_2")});
      });
  test::PlayedWindow window(shown, {"--layout", "annealing", "--size", fmt::format("{}x{}", size[0], size[1])}, folder.path());
  window.until("the run is over", [&] { return window.states().back().fraction == 1; });
  window.click(facet);
  window.move({size[0] - 9, 9});
  const test::Ended ended = window.quit();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_GT(beam_pixels(screen(), receivers[0]) + beam_pixels(screen(), receivers[1]), 20);
  if (kept)
    std::filesystem::copy_file(folder.path() / "screen.png", std::filesystem::path(kept) / "window-annealing-facet.png",
                               std::filesystem::copy_options::overwrite_existing);
}

} // namespace nephroid::ui::annealing_window_test
