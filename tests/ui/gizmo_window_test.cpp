// SPDX-License-Identifier: Apache-2.0
// The handles in the real window: a ball is clicked and its arrow dragged by real X events, and the saved preset has it where it was
// dragged to. With the folder docs in NEPHROID_PICTURES the picture of docs/window.md is written there. Skipped where there is no Xvfb, no
// xdotool or no ImageMagick.
#include "places.h"
#include "real_window.h"
#include "seen_scene.h"

namespace nephroid::ui::gizmo_window_test {

constexpr std::array<int, 2> size{1200, 900};
constexpr double right_by = 0.8; ///< metres

/// A glass ball over a floor, seen from above its side, so that no axis is straight across the picture.
constexpr const char* scene_text = R"({
  "name": "Handles", "engine": "spectral", "unit": "m", "white": 1.5,
  "scene": {
    "camera": {"position": [1.5, 2.2, 5], "target": [0, 0.4, 0], "fov_deg": 40, "resolution": [480, 360]},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "floor": {"type": "diffuse", "reflectance": 0.8}},
    "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 0.5}, "material": "glass", "transform": {"translate": [-0.7, 0.6, 0]}},
                {"name": "floor", "shape": {"type": "quad", "size": [6, 1, 6]}, "material": "floor"}],
    "lights": [{"type": "spot", "power_w": 40, "position": [0.6, 1.7, -1], "direction": [-0.75, -1, 0.5], "half_angle_deg": 40},
               {"type": "area", "power_w": 30, "position": [-1.6, 1.5, 0.6], "direction": [0.6, -1, 0], "size": [0.5, 0.3]}]
  },
  "stop": {"passes": 1000000}
})";

class GizmoWindowTest : public test::RealWindow {
protected:
  GizmoWindowTest() : RealWindow({"Xvfb", "xdotool", "import"}) {}
};

struct Places {
  Pixel ball, tip, end; ///< of the arrow along x: where it is, and where it goes
};

/// Where a window shows the ball of a preset's first object, and its arrow once it is selected.
Places places_in(const std::string& file)
{
  const preset::Preset before = preset::read_preset(file);
  return test::in_window_like<test::SceneRuns>(size, "", file, [&](const Workspace& workspace, test::Headless& imgui, auto draw) {
    const ViewPanel& view = workspace.panel<ViewPanel>();
    const auto& resolution = before.scene.camera.resolution;
    const Sight sight = *make_sight(before.scene.camera, place(Look{}, view.canvas(), resolution), resolution);
    const glm::dvec3 middle = to_vector(before.scene.objects[0].transform.translate);
    const Point at = *sight.to_screen(middle);
    imgui.move(at[0], at[1]);
    draw();
    for (const bool down : {true, false}) {
      imgui.button(0, down);
      draw();
    }
    for (int i = 0; i < 3; ++i) draw();
    const Point arrow = view.overlay().gizmo().places().value()[1];
    // The tip stays under the mouse. The arrow is as long on the screen everywhere, so it shortens in the scene as it comes nearer.
    const Ray ray = sight.ray(arrow);
    const double away = (middle.z - ray.origin.z) / ray.direction.z; // in the plane of x and y through the middle
    const glm::dvec3 there = middle + glm::dvec3(right_by, 0, 0);
    const double length = (ray.origin + away * ray.direction - middle).x * sight.depth(there) / sight.depth(middle);
    return Places{pixel(at), pixel(arrow), pixel(*sight.to_screen(there + glm::dvec3(length, 0, 0)))};
  });
}

TEST_F(GizmoWindowTest, AnArrowMovesABall)
{
  const std::string file = folder.write("handles.json", scene_text);
  const preset::Preset before = preset::read_preset(file);
  const preset::Vec3 from = before.scene.objects[0].transform.translate;
  const auto [ball, tip, end] = places_in(file);
  test::PlayedWindow window(file, {"--size", fmt::format("{}x{}", size[0], size[1])}, folder.path());
  window.click(ball);
  window.move(tip);
  window.press();
  window.glide(tip, end);
  window.until("the picture follows while the ball is held", [&] {
    const image::Image picture = window.picture("held.png");
    const auto green = [&](const Pixel& at) { return test::bytes_at(picture, at[0], at[1])[1]; };
    return green({ball[0], ball[1] + 150}) > 40 && green({ball[0] - 20, ball[1] - 55}) < 20; // the floor is lit; where it was it is dark
  });
  if (const char* docs = std::getenv("NEPHROID_PICTURES")) {
    std::this_thread::sleep_for(std::chrono::seconds(4)); // until it is where the hand is
    window.picture("held.png");
    std::filesystem::copy_file(folder.path() / "held.png", std::filesystem::path(docs) / "window-handles.png",
                               std::filesystem::copy_options::overwrite_existing);
  }
  window.let_go();
  window.save();
  const test::Ended ended = window.quit();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const preset::Preset after = preset::read_preset(file);
  const preset::Vec3 to = after.scene.objects[0].transform.translate;
  EXPECT_NEAR(to[0] - from[0], right_by, 0.02 * right_by);
  EXPECT_EQ(to[1], from[1]);
  EXPECT_EQ(to[2], from[2]);
  EXPECT_EQ(after.scene.camera, before.scene.camera) << "nothing orbited";
}

} // namespace nephroid::ui::gizmo_window_test
