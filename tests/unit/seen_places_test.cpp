// SPDX-License-Identifier: Apache-2.0
// Where the frame before showed a pixel's place, against closed forms: a floor under a camera that moves, objects that
// move and turn, and what the picture did not show.
#include "photons/seen_places.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::photons::seen_places_test {

using test::shape_object;

constexpr int width = 40, height = 30;

/// A floor of 40 x 40 under a camera 10 above it, which looks down, x to the right and z down in the picture. A pixel
/// is a quarter of a unit.
preset::Preset floor_from_above() {
  preset::Preset preset{.source = "p.json"};
  preset.scene.materials["wall"];
  preset.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset.scene.objects = {shape_object("floor", preset::Shape::Type::quad, "wall", {.scale = {40, 1, 40}})};
  preset.scene.lights = {{.position = {0, 30, 0}}};
  preset::Camera& camera = preset.scene.camera;
  camera.position = {0, 10, 0}, camera.target = {0, 0, 0}, camera.up = {0, 0, -1};
  camera.resolution = {width, height};
  camera.projection = preset::Camera::Projection::orthographic;
  camera.height = 7.5;
  return preset;
}

struct Frame {
  explicit Frame(const preset::Preset& preset)
      : scene(scene::load_scene(preset)), seen(seen_places(scene, scene::build_bvh(scene.geometry))) {}
  scene::Scene scene;
  SeenPlaces seen;
};

/// What the frame now sees of a picture before whose red is the column and whose green is the row.
std::vector<float> columns_and_rows(const Frame& now, const Frame& before) {
  EXPECT_TRUE(has_parts_of(now.scene, before.seen));
  std::vector<float> picture;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.insert(picture.end(), {static_cast<float>(x), static_cast<float>(y), 1});
  return moved(picture, taps_before(now.seen, now.scene.geometry, before.seen));
}

void expect_at(const std::vector<float>& seen, int x, int y, double column, double row) {
  const auto pixel = static_cast<std::size_t>(3 * (y * width + x));
  EXPECT_NEAR(seen[pixel], column, 0.01) << x << " " << y;
  EXPECT_NEAR(seen[pixel + 1], row, 0.01) << x << " " << y;
}
bool is_missing(const std::vector<float>& seen, int x, int y) {
  return std::isnan(seen[static_cast<std::size_t>(3 * (y * width + x))]);
}

TEST(SeenPlaces, StandStillToTheLastBit) {
  preset::Preset preset = floor_from_above();
  preset.scene.camera = {.position = {3, 6, 8}, .target = {0.3, 0, 0.2}, .resolution = {width, height}};
  preset.scene.objects.push_back(shape_object("ball", preset::Shape::Type::sphere, "glass", {.translate = {0, 1, 0}}));
  const Frame frame(preset);
  const std::vector<float> seen = columns_and_rows(frame, frame);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      ASSERT_FALSE(is_missing(seen, x, y)) << x << " " << y;
      EXPECT_EQ(seen[static_cast<std::size_t>(3 * (y * width + x))], static_cast<float>(x));
      EXPECT_EQ(seen[static_cast<std::size_t>(3 * (y * width + x) + 1)], static_cast<float>(y));
    }
}

// By 0.625 to the right are 2.5 pixels: what is now in column x was in x + 2.5.
TEST(SeenPlaces, MoveWithACamera) {
  preset::Preset preset = floor_from_above();
  const Frame before(preset);
  preset.scene.camera.position[0] = preset.scene.camera.target[0] = 0.625;
  const std::vector<float> seen = columns_and_rows(Frame(preset), before);
  expect_at(seen, 0, 7, 2.5, 7);
  expect_at(seen, 30, 20, 32.5, 20);
  EXPECT_FALSE(is_missing(seen, 37, 5)) << "half of it is in the last column";
  EXPECT_TRUE(is_missing(seen, 38, 5)) << "that was outside of the picture";
}

// A camera of perspective that was 10 above the floor is now 5 above it: what is now d from the middle was d / 2.
TEST(SeenPlaces, MoveWithPerspective) {
  preset::Preset preset = floor_from_above();
  preset.scene.camera.projection = preset::Camera::Projection::perspective;
  const Frame before(preset);
  preset.scene.camera.position[1] = 5;
  const std::vector<float> seen = columns_and_rows(Frame(preset), before);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(12, 27), std::pair(39, 3)})
    expect_at(seen, x, y, 19.5 + (x - 19.5) / 2, 14.5 + (y - 14.5) / 2);
}

// The floor itself goes by two pixels, or turns by 90 degrees about y: x now was z before.
TEST(SeenPlaces, GoWithTheirObject) {
  preset::Preset preset = floor_from_above();
  const Frame before(preset);
  preset.scene.objects[0].transform.translate = {0.5, 0, 0};
  expect_at(columns_and_rows(Frame(preset), before), 20, 11, 18, 11);
  preset.scene.objects[0].transform.translate = {};
  preset.scene.objects[0].transform.rotate_deg = {0, 90, 0}; // (x, z) comes from (-z, x)
  expect_at(columns_and_rows(Frame(preset), before), 22, 10, 19.5 - (10 - 14.5), 14.5 + (22 - 19.5));
}

// A matt ellipsoid turns about the axis of view: its places turn with it. The floor that a ball uncovers was not seen
// before.
TEST(SeenPlaces, GoWithABall) {
  preset::Preset preset = floor_from_above();
  preset.scene.objects.push_back(
      shape_object("ball", preset::Shape::Type::sphere, "wall", {.scale = {2, 2, 4}, .translate = {0, 3, 0}}));
  const Frame lengthwise(preset);
  preset.scene.objects[1].transform.rotate_deg = {0, 90, 0};
  expect_at(columns_and_rows(Frame(preset), lengthwise), 24, 13, 19.5 - (13 - 14.5), 14.5 + (24 - 19.5));
  preset.scene.objects[1].transform = {.scale = {2, 2, 2}, .translate = {0, 2, 0}};
  const Frame before(preset);
  preset.scene.objects[1].transform = {.scale = {2, 2, 2}, .translate = {2, 2, 0}};
  const std::vector<float> seen = columns_and_rows(Frame(preset), before);
  expect_at(seen, 27, 14, 19, 14);
  EXPECT_TRUE(is_missing(seen, 18, 14));
  expect_at(seen, 10, 14, 10, 14);
}

// What glass shows has no place of its own in the picture: it is what it was only while all stands still.
TEST(SeenPlaces, BehindGlassStayOrAreGone) {
  preset::Preset preset = floor_from_above();
  preset.scene.objects.push_back(
      shape_object("ball", preset::Shape::Type::sphere, "glass", {.scale = {3, 3, 3}, .translate = {0, 3, 0}}));
  const Frame before(preset);
  expect_at(columns_and_rows(Frame(preset), before), 21, 13, 21, 13);
  preset.scene.objects[1].transform.translate = {1, 3, 0};
  EXPECT_TRUE(is_missing(columns_and_rows(Frame(preset), before), 21, 13));
}

TEST(SeenPlaces, AreWrittenAndRead) {
  preset::Preset preset = floor_from_above();
  preset.scene.objects.push_back(shape_object("ball", preset::Shape::Type::sphere, "wall", {.translate = {0, 1, 0}}));
  Frame frame(preset);
  ByteStore first, second;
  Archive to(first);
  frame.seen.serialize(to);
  StoredBytes bytes(first.bytes(), "afterimage");
  SeenPlaces read;
  Archive from(bytes);
  read.serialize(from);
  EXPECT_EQ(bytes.left(), 0u);
  Archive again(second);
  read.serialize(again);
  EXPECT_EQ(first.bytes(), second.bytes());
  EXPECT_TRUE(has_parts_of(frame.scene, read));
  read.positions.pop_back();
  EXPECT_FALSE(has_parts_of(frame.scene, read));
}

} // namespace nephroid::photons::seen_places_test
