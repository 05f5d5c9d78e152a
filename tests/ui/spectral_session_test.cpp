// SPDX-License-Identifier: Apache-2.0
// A recorded session with the engine "spectral", in a real window: a preset is opened from the start page, its glass and its camera are
// changed, a run is pinned, preset and picture are saved. Skipped where there is no Xvfb, no xdotool or no ImageMagick.
#include "recorded_session.h"
#include "ui/spectral/dispersion/model.h"

namespace nephroid::ui::spectral_session_test {

class SpectralSession : public test::RealWindow {
protected:
  SpectralSession() : RealWindow({"Xvfb", "xdotool", "import", "montage"}) {}
};

double distance(const preset::Camera& camera)
{
  return std::hypot(camera.position[0] - camera.target[0], camera.position[1] - camera.target[1], camera.position[2] - camera.target[2]);
}

TEST_F(SpectralSession, FromTheStartPageToASavedPicture)
{
  test::RecordedSession<> session("spectral", folder.path());
  session.shot("The start page");
  session.click(session.workspace().start_page().place_of("first-light").value());
  session.until_opened("first-light");
  session.until_passed(0.01);
  session.shot("Open an example: the run begins");

  session.click(session.tab<DispersionPanel>());
  session.click(session.panel<DispersionPanel>().place_of("Make editable").value());
  const auto glass = [&](const preset::Preset& preset) { return sorted_points(preset.scene.materials.at("glass").dispersion); };
  const std::vector<ControlPoint> fitted = glass(*session.workbench().preset());
  ASSERT_GT(fitted.size(), 5u) << "the glass has points";
  session.shot("Dispersion: the glass becomes points");
  const std::size_t middle = fitted.size() / 2;
  session.drag(session.panel<DispersionPanel>().plot().to_screen(fitted[middle]), {0, -40});
  session.shot("One of them is dragged");
  session.drag(session.in_view(0.75, 0.85), {90, -30});
  session.until_passed(0.03);
  session.shot("The camera is turned");
  session.key("p");
  session.shot("The run is pinned");

  session.key("s", {"ctrl"});
  session.window().settle(10);
  session.shot("Saving asks for a name: the preset is a shipped one");
  session.key("Return");
  session.until_there("first-light-edited.json");
  session.key("e", {"ctrl"});
  session.key("Return");
  session.until_there("first-light-edited.png");
  session.shot("Preset and picture are saved");
  const Session left = session.quit();

  const preset::Preset shipped = preset::read_preset("first-light");
  const preset::Preset saved = preset::read_preset((session.saved() / "first-light-edited.json").string());
  const std::vector<ControlPoint> points = glass(saved);
  ASSERT_EQ(points.size(), fitted.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == middle) continue;
    EXPECT_EQ(points[i], fitted[i]) << i;
  }
  EXPECT_NEAR(points[middle][0], fitted[middle][0], 3);
  EXPECT_GT(points[middle][1], fitted[middle][1] + 1e-3) << "it was dragged upwards";
  EXPECT_NE(saved.scene.camera.position, shipped.scene.camera.position);
  EXPECT_EQ(saved.scene.camera.target, shipped.scene.camera.target);
  EXPECT_NEAR(distance(saved.scene.camera), distance(shipped.scene.camera), 1e-6) << "it was turned";
  EXPECT_EQ(saved.scene.objects, shipped.scene.objects);

  const image::Image picture = image::read_image(session.saved() / "first-light-edited.png");
  EXPECT_EQ((std::array{picture.width, picture.height}), shipped.scene.camera.resolution);
  double sum = 0;
  for (const float value : picture.data) sum += value;
  EXPECT_GT(sum / static_cast<double>(picture.data.size()), 0.02) << "the picture is not black";

  ASSERT_EQ(left.pins.size(), 1u) << "the run that was pinned";
  EXPECT_TRUE(left.closed);
  ASSERT_TRUE(left.edits);
  EXPECT_GE(left.edits->entries.size(), 4u) << "as opened, points, a point, the camera";
  EXPECT_EQ(left.edits->saved, left.edits->index);
}

} // namespace nephroid::ui::spectral_session_test
