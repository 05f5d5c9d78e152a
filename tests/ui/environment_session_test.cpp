// SPDX-License-Identifier: Apache-2.0
// A recorded session with the engine "environment", in a real window: a preset is found on the start page and opened, its sky is turned and
// cut into fewer lights, preset and picture are saved. Skipped where there is no Xvfb, no xdotool or no ImageMagick.
#include "environment/settings.h"
#include "recorded_session.h"
#include "ui/environment/panel.h"

namespace nephroid::ui::environment_session_test {

class EnvironmentSession : public test::RealWindow {
protected:
  EnvironmentSession() : RealWindow({"Xvfb", "xdotool", "import", "montage"}) {}
  /// A glass ball on a floor under a shipped sky of three lamps; a bake of a second or two.
  static std::string lamps()
  {
    return fmt::format(R"({{
  "name": "Three lamps", "description": "A glass ball under three lamps", "engine": "environment", "unit": "cm", "white": 10,
  "stop": {{"passes": 4}},
  "scene": {{
    "camera": {{"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34, "resolution": [512, 384]}},
    "materials": {{"glass": {{"type": "dielectric", "dispersion": 1.5}}, "floor": {{"type": "diffuse", "reflectance": 0.8}}}},
    "objects": [{{"name": "ball", "shape": {{"type": "sphere", "radius": 1}}, "material": "glass"}},
                {{"name": "floor", "shape": {{"type": "quad", "size": [30, 1, 30]}}, "material": "floor", "transform": {{"translate": [0, -1.2, 0]}}}}],
    "environment": {{"type": "file", "file": "{}/presets/spectral/three-lamps.hdr"}}
  }},
  "environment": {{"photons": 8192, "spheres": 4, "resolution": 64}}
}})",
                       NEPHROID_SOURCE_DIR);
  }
};

TEST_F(EnvironmentSession, FromTheStartPageToASavedPicture)
{
  test::RecordedSession<> session("environment", folder.path(), lamps());
  const preset::Preset before = preset::read_preset(session.file().string());
  session.open_listed("three lamps glass ball", "Three lamps");
  const auto& panel = session.panel<EnvironmentPanel>();
  session.until_placed("the map is cut", [&] { return panel.model().rests(); });
  session.until_finished();
  session.shot("Enter opens it: the ball is baked, and lit by the map");

  const auto map = panel.map().area();
  session.drag({map[0] + 0.3 * map[2], map[1] + 0.8 * map[3]}, {map[2] / 4, 0});
  session.until_finished();
  session.shot("The sky is turned by a quarter: the caustics follow");
  session.drag(panel.place_of("lights").value(), {-65, 0});
  session.until_placed("the map is cut anew", [&] { return panel.model().rests(); });
  session.until_finished();
  session.shot("It is cut into another number of lights");

  session.window().save();
  session.key("e", {"ctrl"});
  session.window().settle(10);
  session.shot("Preset saved; saving the picture asks for a name");
  session.key("Return");
  session.until_there("environment.png");
  session.shot("The picture is saved");
  const Session left = session.quit();

  const preset::Preset saved = preset::read_preset(session.file().string());
  EXPECT_NEAR(saved.scene.environment->rotate_deg, before.scene.environment->rotate_deg - 90, 1);
  EXPECT_NE(environment::settings(saved).lights, environment::settings(before).lights);
  EXPECT_EQ(environment::settings(saved).lights, environment::settings(*session.workbench().preset()).lights)
      << "as the other window has it";
  EXPECT_EQ(saved.scene.camera, before.scene.camera);
  const image::Image picture = image::read_image(session.saved() / "environment.png");
  EXPECT_EQ((std::array{picture.width, picture.height}), before.scene.camera.resolution);
  double sum = 0;
  for (const float value : picture.data) sum += value;
  EXPECT_GT(sum / static_cast<double>(picture.data.size()), 0.02) << "the picture is not black";
  ASSERT_TRUE(left.edits);
  EXPECT_EQ(left.edits->entries.size(), 3u) << "as opened, turned, cut";
  EXPECT_EQ(left.edits->saved, left.edits->index);
}

} // namespace nephroid::ui::environment_session_test
