// SPDX-License-Identifier: Apache-2.0
// A recorded session with each engine, in a real window, from the start page to what is saved. Skipped where there is
// no Xvfb, no xdotool or no ImageMagick.
#include "environment/settings.h"
#include "recorded_session.h"
#include "scenes.h"
#include "ui/environment/panel.h"
#include "ui/inverse/annealing/panel.h"

namespace nephroid::ui::recorded_sessions_test {

class SpectralSession : public test::PicturedWindow {};
class EnvironmentSession : public test::PicturedWindow {};
class InverseSession : public test::PicturedWindow {};

void expect_picture(const fs::path& file, const std::array<int, 2>& size) {
  const image::Image picture = image::read_image(file);
  EXPECT_EQ((std::array{picture.width, picture.height}), size);
  EXPECT_GT(std::accumulate(picture.data.begin(), picture.data.end(), 0.0) / static_cast<double>(picture.data.size()),
            0.02)
      << "the picture is not black";
}

double distance(const preset::Camera& camera) {
  return std::hypot(camera.position[0] - camera.target[0], camera.position[1] - camera.target[1],
                    camera.position[2] - camera.target[2]);
}

TEST_F(SpectralSession, FromTheStartPageToASavedPicture) {
  test::RecordedSession<> session("spectral", folder.path());
  session.shot("The start page");
  session.click(session.workspace().start_page().place_of("first-light").value());
  session.until_opened("first-light");
  session.until_passed(0.01);
  session.shot("Open an example: the run begins");

  session.click(session.tab<DispersionPanel>());
  session.click(session.panel<DispersionPanel>().place_of("Make editable").value());
  const auto glass = [&](const preset::Preset& preset) {
    return sorted_points(preset.scene.materials.at("glass").dispersion);
  };
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
  session.until_there("first-light-edited.nephroid.json");
  session.key("e", {"ctrl"});
  session.key("Return");
  session.until_there("first-light-edited.png");
  session.shot("Preset and picture are saved");
  const Session left = session.quit();

  const preset::Preset shipped = preset::read_preset("first-light");
  const preset::Preset saved = preset::read_preset((session.saved() / "first-light-edited.nephroid.json").string());
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

  expect_picture(session.saved() / "first-light-edited.png", shipped.scene.camera.resolution);

  ASSERT_EQ(left.pins.size(), 1u) << "the run that was pinned";
  EXPECT_TRUE(left.closed);
  ASSERT_TRUE(left.edits);
  EXPECT_GE(left.edits->entries.size(), 4u) << "as opened, points, a point, the camera";
  EXPECT_EQ(left.edits->saved, left.edits->index);
}

/// Pixels of a part of the screen whose bytes are so.
template <class Condition>
int pixels_with(const image::Image& screen, const std::array<double, 4>& area, Condition condition) {
  int count = 0;
  for (double y = area[1]; y < area[1] + area[3]; ++y)
    for (double x = area[0]; x < area[0] + area[2]; ++x) count += condition(test::bytes_at(screen, x, y));
  return count;
}

/// In the colour of lines between regions.
int line_pixels(const image::Image& screen, const std::array<double, 4>& area) {
  return pixels_with(screen, area, [](const std::array<int, 3>& c) { return c[1] > c[0] + 60 && c[1] > c[2] + 60; });
}

/// In the colour of a beam's frame.
int beam_pixels(const image::Image& screen, const std::array<double, 4>& area) {
  return pixels_with(screen, area,
                     [](const std::array<int, 3>& c) { return c[0] > 200 && c[1] > 130 && c[1] < 200 && c[2] < 80; });
}

TEST_F(EnvironmentSession, FromTheStartPageToASavedPicture) {
  test::RecordedSession<> session("environment", folder.path(),
                                  test::lamps_text("[512, 384]", R"("photons": 8192, "spheres": 4, "resolution": 64)"));
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
  const int lines = line_pixels(session.window().picture("before.png"), map);
  EXPECT_GT(lines, 200) << "the regions are drawn";
  session.drag(panel.place_of("lights").value(), {-65, 0});
  session.until_placed("the map is cut anew", [&] { return panel.model().rests(); });
  session.until_finished();
  EXPECT_LT(line_pixels(session.window().picture("fewer.png"), map), lines - 50) << "into fewer";
  const auto slider = session.panel<EnvironmentPanel>().place_of("lights").value();
  session.drag({slider[0] - 65, slider[1]}, {45, 0});
  session.until_placed("the map is cut once more", [&] { return panel.model().rests(); });
  session.until_finished();
  session.shot("It is cut into another number of lights");
  const auto brightest = std::ranges::max_element(panel.figures(), {}, &RegionFigures::flux);
  const auto& lights = panel.shown().cut->segmentation.lights;
  session.move(panel.place_on_map(lights.at(static_cast<std::size_t>(brightest - panel.figures().begin())).direction));
  EXPECT_GT(line_pixels(session.picture("window-environment.png"), map), lines)
      << "into more: " << environment::settings(*session.workbench().preset()).lights;

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
  EXPECT_GT(environment::settings(saved).lights, environment::settings(before).lights);
  EXPECT_EQ(environment::settings(saved).lights, environment::settings(*session.workbench().preset()).lights)
      << "as the other window has it";
  EXPECT_EQ(saved.scene.camera, before.scene.camera);
  expect_picture(session.saved() / "environment.png", before.scene.camera.resolution);
  ASSERT_TRUE(left.edits);
  EXPECT_EQ(left.edits->entries.size(), 4u) << "as opened, turned, cut twice";
  EXPECT_EQ(left.edits->saved, left.edits->index);
}

const preset::Object& object(const preset::Preset& preset, const std::string& name) {
  for (const preset::Object& one : preset.scene.objects)
    if (one.name == name) return one;
  throw std::runtime_error("no object " + name);
}

TEST_F(InverseSession, FromTheStartPageToASavedMesh) {
  // The shipped shapes, of fewer facets.
  test::RecordedSession<test::InverseRuns> session("inverse", folder.path(),
                                                   R"({"parent": "inverse/shapes", "name": "Small shapes",
    "description": "Few facets", "inverse": {"facets": [40, 40], "cells": [24, 24]}, "stop": {"passes": 6}})");
  const preset::Preset before = preset::read_preset(session.file().string());
  session.open_listed("small shapes few facets", "Small shapes");
  session.shot("Enter opens it: the search goes on");
  const auto& panel = session.panel<AnnealingPanel>();
  session.drag(panel.place_of("distance_3").value(), {24, 0});
  session.rest();
  session.shot("The third receiver is dragged away");
  session.until_finished();
  session.shot("The search is over");
  const auto& [left, top, width, height] = panel.area_of("slopes");
  session.click({left + 0.3 * width, top + 0.7 * height});
  const image::Image beams = session.picture("window-annealing-facet.png");
  EXPECT_GT(beam_pixels(beams, panel.area_of("receiver_1")) + beam_pixels(beams, panel.area_of("receiver_2")), 20);

  session.window().save();
  session.shot("Ctrl+S saves the preset");
  session.click(panel.place_of("show as glass").value());
  session.until_there("inverse-object/view.json");
  session.window().until("the glass is shown",
                         [&] { return session.window().title().find("view") != std::string::npos; });
  session.until_passed(0.12);
  session.shot("Show as glass: the meshes are saved, and light falls through them");
  session.quit();

  const preset::Preset saved = preset::read_preset(session.file().string());
  const auto& first = inverse::settings(before).receivers;
  const auto& after = inverse::settings(saved).receivers;
  ASSERT_EQ(after.size(), 3u);
  EXPECT_EQ(after[0], first[0]);
  EXPECT_EQ(after[1], first[1]);
  EXPECT_GT(after[2].distance_mm, first[2].distance_mm + 5);

  const fs::path made = session.saved() / "inverse-object";
  for (const char* file : {"object.obj", "object.stl", "object.ply"}) {
    const scene::MeshReport report = scene::inspect(scene::load_mesh(made / file));
    EXPECT_TRUE(report.closed()) << file;
    EXPECT_GT(report.signed_volume, 0) << file;
  }
  const preset::Preset view = preset::read_preset((made / "view.json").string());
  EXPECT_EQ(view.scene.objects.size(), 7u) << "the ground, and for each distance a receiver with the object over it";
  EXPECT_NEAR(object(view, "receiver 3").transform.translate[2], -after[2].distance_mm, 1e-6);
}

} // namespace nephroid::ui::recorded_sessions_test
