// SPDX-License-Identifier: Apache-2.0
// What the handles do to a preset, against the scene that is loaded from it: the vertices of an object that was turned
// are those of the object before, turned.
#include "ui/view/gizmo_edits.h"

#include "scene/scene.h"
#include "scenes.h"
#include "tests/support/loaded_scenes.h"
#include "ui/view/gizmo.h"

#include <glm/gtc/matrix_transform.hpp>

namespace nephroid::ui::gizmo_edits_test {

using Kind = Selection::Kind;
constexpr Selection first_object{Kind::object, 0}, first_light{Kind::light, 0};

glm::dmat3 about(const glm::dvec3& axis, double degrees) {
  return glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::normalize(axis)));
}

double difference(const glm::dmat3& a, const glm::dmat3& b) {
  double most = 0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
  return most;
}

TEST(GizmoEdits, AnglesAreOfThatRotation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-360, 360);
  for (int i = 0; i < 2000; ++i) {
    // Every fourth one where two of the angles are about one axis.
    const preset::Vec3 angles{angle(random), i % 4 == 0 ? (i % 8 == 0 ? 90.0 : -90.0) : angle(random), angle(random)};
    const glm::dmat3 rotation = scene::rotation(angles);
    const preset::Vec3 near{angle(random), angle(random), angle(random)};
    EXPECT_LT(difference(scene::rotation(angles_of(rotation, near)), rotation), 1e-8)
        << angles[0] << ' ' << angles[1] << ' ' << angles[2];
  }
}

TEST(GizmoEdits, AnglesStayNearThoseBefore) {
  const preset::Vec3 before{170, 100, -400};
  const preset::Vec3 after = angles_of(scene::rotation({171, 101, -399}), before);
  EXPECT_NEAR(after[0], 171, 1e-6);
  EXPECT_NEAR(after[1], 101, 1e-6);
  EXPECT_NEAR(after[2], -399, 1e-6);
}

/// A box that is scaled, mirrored and turned, and its vertices in the preset's coordinates.
preset::Preset box() {
  preset::Preset preset = test::ball_over_floor();
  preset::Object& object = preset.scene.objects[0];
  object.shape->type = preset::Shape::Type::box;
  object.shape->size = {0.5, 0.7, 0.9};
  object.transform = {{1.5, -0.8, 2}, {20, -35, 110}, {0.4, 0.3, -0.2}};
  return preset;
}

std::vector<glm::dvec3> vertices(const preset::Preset& preset) {
  const scene::Scene scene = scene::load_scene(preset);
  std::vector<glm::dvec3> all;
  scene::for_each_corner(scene, scene.objects[0], [&](const glm::dvec3& p) { all.push_back(p + scene.origin); });
  return all;
}

TEST(GizmoEdits, ATurnTurnsTheVertices) {
  for (const glm::dvec3& pivot : {glm::dvec3(0), glm::dvec3(0.1, -0.2, 0.25)}) {
    preset::Preset preset = box();
    GizmoTarget grip = *grip_of(preset, first_object, nullptr);
    grip.at += scene::rotation(preset.scene.objects[0].transform.rotate_deg) * (glm::dvec3(1.5, -0.8, 2) * pivot);
    grip.pivot = pivot;
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -0.5));
    const std::vector<glm::dvec3> before = vertices(preset);
    turn(preset, first_object, grip, axis, 33);
    const std::vector<glm::dvec3> after = vertices(preset);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_LT(glm::distance(after[i], grip.at + about(axis, 33) * (before[i] - grip.at)), 1e-6);
  }
}

TEST(GizmoEdits, AMoveAndAStretchMoveTheVertices) {
  preset::Preset preset = box();
  const GizmoTarget grip = *grip_of(preset, first_object, nullptr);
  const std::vector<glm::dvec3> before = vertices(preset);
  move(preset, first_object, {0.25, 0, -0.5}, 4);
  stretch(preset, first_object, grip, {2, 1, 1});
  const std::vector<glm::dvec3> after = vertices(preset);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const glm::dvec3 arm = before[i] - grip.at, along = grip.axes[0];
    EXPECT_LT(glm::distance(after[i], grip.at + arm + glm::dot(arm, along) * along + glm::dvec3(0.25, 0, -0.5)), 1e-6);
  }
  EXPECT_EQ(preset.scene.objects[0].transform.translate, (preset::Vec3{0.65, 0.3, -0.7})) << "no more digits than that";
}

TEST(GizmoEdits, LightsAreAimedAndGrow) {
  preset::Preset preset = test::ball_over_floor();
  preset::Light& light = preset.scene.lights[0];
  light.type = preset::Light::Type::area;
  light.direction = {0, -1, 0};
  light.up = {0, 0, 1};
  GizmoTarget grip = *grip_of(preset, first_light, nullptr);
  EXPECT_EQ(grip.at, glm::dvec3(0, 3, 0));
  turn(preset, first_light, grip, {1, 0, 0}, 90); // y to z, z to -y
  EXPECT_EQ(light.direction, (preset::Vec3{0, 0, -1}));
  EXPECT_EQ(light.up, (preset::Vec3{0, -1, 0}));
  stretch(preset, first_light, grip, {2, 0.5, 7});
  EXPECT_EQ(light.size, (std::array<double, 2>{2, 0.5}));
  light.type = preset::Light::Type::point;
  EXPECT_EQ(usable_tool(*grip_of(preset, first_light, nullptr), Handles::Tool::turn), Handles::Tool::move);
  light.type = preset::Light::Type::directional;
  grip = *grip_of(preset, first_light, nullptr);
  EXPECT_EQ(usable_tool(grip, Handles::Tool::move), Handles::Tool::turn);
  EXPECT_FALSE(looking_at(preset, first_light, nullptr)) << "it comes from everywhere";
}

TEST(GizmoEdits, StepsAreRound) {
  EXPECT_DOUBLE_EQ(snap_step(4), 0.2);
  EXPECT_DOUBLE_EQ(snap_step(1000), 50);
  EXPECT_DOUBLE_EQ(snap_step(0.023), 0.001);
  EXPECT_EQ(decimals_for(4), 4);
  EXPECT_EQ(decimals_for(3e6), -2);
}

TEST(GizmoEdits, KeysNudgeAsThePictureSaysIt) {
  preset::Preset preset = test::ball_over_floor();
  preset.scene.camera.position = {4, 0.5, 0}; // looks along -x: to the right is -z
  preset.scene.camera.target = {0, 0, 0};
  const auto place = [&](Nudge nudge, bool snap = false) {
    return nudged(preset, first_object, {Handles::Tool::move, false, snap}, nullptr, nudge)
        ->scene.objects[0]
        .transform.translate;
  };
  EXPECT_EQ(place(Nudge::right), (preset::Vec3{0, 0, -0.02}));
  EXPECT_EQ(place(Nudge::left), (preset::Vec3{0, 0, 0.02}));
  EXPECT_EQ(place(Nudge::up, true), (preset::Vec3{0, 0.2, 0}));
  EXPECT_EQ(place(Nudge::away), (preset::Vec3{-0.02, 0, 0}));
  EXPECT_EQ(place(Nudge::nearer), (preset::Vec3{0.02, 0, 0}));
  const auto turned = nudged(preset, first_object, {Handles::Tool::turn, false, true}, nullptr, Nudge::right);
  EXPECT_EQ(turned->scene.objects[0].transform.rotate_deg, (preset::Vec3{0, 15, 0}));
  const auto grown = nudged(preset, first_object, {Handles::Tool::scale, false, true}, nullptr, Nudge::up);
  EXPECT_EQ(grown->scene.objects[0].transform.scale, (preset::Vec3{1.1, 1.1, 1.1}));
}

TEST(GizmoEdits, TheCameraIsNotAimedAtItself) {
  preset::Preset preset = test::ball_over_floor();
  preset.scene.objects[0].transform.translate = preset.scene.camera.position;
  EXPECT_FALSE(looking_at(preset, first_object, nullptr));
  preset.scene.objects[0].transform.translate = {0.5, 0, 0};
  EXPECT_EQ(looking_at(preset, first_object, nullptr)->target, (preset::Vec3{0.5, 0, 0}));
}

/// A camera somewhere, and a picture fitted or zoomed in a canvas.
struct Shown {
  preset::Camera camera;
  Canvas canvas{{30, 70}, {640, 411}};
  ViewSettings view_settings;
  Pinhole pinhole() const {
    return *make_pinhole(camera, place(view_settings, canvas, camera.resolution), camera.resolution);
  }
};

Shown shown(std::mt19937& random, bool fit) {
  std::uniform_real_distribution<double> any(-3, 3), fov(5, 150);
  Shown s;
  s.camera = {.position = {any(random), any(random), any(random)},
              .target = {any(random), any(random), any(random)},
              .fov_deg = fov(random),
              .resolution = {320, 200}};
  s.view_settings.fit = fit;
  s.view_settings.zoom = 1.7;
  s.view_settings.centre = {100, 30};
  return s;
}

TEST(Pinhole, IsTheScenesCamera) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const Shown s = shown(random, i % 2 == 0);
    const scene::Scene nothing;
    const scene::Camera camera = scene::make_camera(s.camera, nothing);
    const Pinhole pinhole = s.pinhole();
    const Placement placement = place(s.view_settings, s.canvas, s.camera.resolution);
    for (const auto& [x, y] : {std::array{0, 0}, std::array{319, 7}, std::array{160, 100}, std::array{12, 199}}) {
      const glm::dvec3 expected = glm::dvec3(camera.forward) +
                                  (2 * (x + 0.5) / 320 - 1) * camera.tan_x * glm::dvec3(camera.right) +
                                  (1 - 2 * (y + 0.5) / 200) * camera.tan_y * glm::dvec3(camera.up);
      const Point at = placement.to_screen({x + 0.5, y + 0.5});
      const Ray ray = pinhole.ray(at);
      EXPECT_LT(glm::distance(glm::normalize(ray.direction), glm::normalize(expected)), 1e-6);
      const auto back = pinhole.to_screen(ray.origin + 2.5 * ray.direction);
      ASSERT_TRUE(back);
      EXPECT_NEAR((*back)[0], at[0], 1e-6);
      EXPECT_NEAR((*back)[1], at[1], 1e-6);
      EXPECT_FALSE(pinhole.to_screen(ray.origin - ray.direction)) << "behind it";
    }
  }
}

TEST(Pinhole, IsNotThereForACameraThatSeesNothing) {
  preset::Camera camera;
  camera.target = camera.position;
  EXPECT_FALSE(make_pinhole(camera, {}, {1, 1}));
  camera = {.position = {0, 1, 4}, .target = {0, 5, 4}};
  EXPECT_FALSE(make_pinhole(camera, {}, {1, 1})) << "along its up";
}

TEST(GizmoMatrices, ProjectAsTheCameraDoes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Shown s = shown(random, i % 2 == 0);
    const Pinhole pinhole = s.pinhole();
    const GizmoFrame frame{
        pinhole, pinhole.position + 3.0 * pinhole.forward + glm::dvec3(any(random), any(random), any(random)), 2.5};
    const glm::dvec3 point = frame.base + 0.3 * glm::dvec3(any(random), any(random), any(random));
    const auto expected = pinhole.to_screen(point);
    ASSERT_TRUE(expected);
    // As ImGuizmo does: the frame's coordinates through both, then from -1..1 to its rectangle, y down.
    const glm::dvec4 from((point - frame.base) / frame.unit, 1);
    const glm::dvec4 clip = glm::dmat4(projection_matrix(pinhole, s.canvas)) * (glm::dmat4(view_matrix(frame)) * from);
    const double x = s.canvas.corner[0] + s.canvas.size[0] * (clip[0] / clip[3] + 1) / 2;
    const double y = s.canvas.corner[1] + s.canvas.size[1] * (1 - clip[1] / clip[3]) / 2;
    const double tolerance = 1e-4 * (1 + std::hypot((*expected)[0], (*expected)[1]));
    EXPECT_NEAR(x, (*expected)[0], tolerance);
    EXPECT_NEAR(y, (*expected)[1], tolerance);
  }
}

} // namespace nephroid::ui::gizmo_edits_test
