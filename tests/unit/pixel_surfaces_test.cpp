// SPDX-License-Identifier: Apache-2.0
// The camera's frame and pixel rays by hand, the corners of objects and the box about them, host rays through the tree
// against every triangle on its own, and where a look through a pixel ends, against Snell's law by hand.
#include "photons/clusters/scene_clusters.h"
#include "photons/pixel_surfaces.h"
#include "scene/ray.h"
#include "scene/scene.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/meshes.h"
#include "tests/support/presets.h"

namespace nephroid::scene::pixel_surfaces_test {

using glm::dvec3;

Scene empty_scene(const glm::dvec3& origin = {0, 0, 0}) { return {.source = "p.json", .origin = origin}; }

/// The direction through the picture at (x, y) pixels from its top left corner: pixel (i, j) has its centre at (i + .5,
/// j + .5).
glm::dvec3 direction(const Camera& c, double x, double y) {
  return glm::dvec3(c.forward) + (2 * x / c.width - 1) * c.tan_x * glm::dvec3(c.right) +
         (1 - 2 * y / c.height) * c.tan_y * glm::dvec3(c.up);
}

// From (0, 0, 5) to the origin, 90 degrees high, 400 x 200 pixels: the plane z = 4, at distance 1, is seen from x = -2
// to 2 and from y = -1 to 1. Row 0 is the top, column 0 the left.
TEST(Camera, CornersOfThePicture) {
  preset::Camera preset{.position = {0, 0, 5}, .fov_deg = 90, .resolution = {400, 200}};
  const Camera camera = make_camera(preset, empty_scene());
  expect_near(direction(camera, 0, 0), {-2, 1, -1});
  expect_near(direction(camera, 400, 0), {2, 1, -1});
  expect_near(direction(camera, 0, 200), {-2, -1, -1});
  expect_near(direction(camera, 400, 200), {2, -1, -1});
  expect_near(direction(camera, 200, 100), {0, 0, -1});
  expect_near(direction(camera, 0.5, 0.5), {-1.995, 0.995, -1}); // the centre of the first pixel
}

// Straight down with up = +x: the picture's right is forward x up = (-y) x (+x) = +z.
TEST(Camera, LooksDown) {
  preset::Camera preset{.position = {1, 10, 2}, .target = {1, 3, 2}};
  preset.up = {5, 0.5, 0}; // only its part across the view counts
  const Camera camera = make_camera(preset, empty_scene());
  expect_near(camera.forward, {0, -1, 0});
  expect_near(camera.up, {1, 0, 0});
  expect_near(camera.right, {0, 0, 1});
  EXPECT_NEAR(camera.tan_y, std::tan(20 * M_PI / 180), 1e-12);
  EXPECT_DOUBLE_EQ(camera.tan_x, camera.tan_y);
}

TEST(Camera, KeepsItsPlaceFarAway) {
  preset::Camera preset{.position = {1e6 + 0.001, 1e6, 1e6 + 0.002}, .target = {1e6, 1e6, 1e6}};
  const Camera camera = make_camera(preset, empty_scene({1e6, 1e6, 1e6}));
  expect_near(camera.position, {0.001, 0, 0.002}, 1e-9);
  expect_near(camera.forward, {-1 / std::sqrt(5), 0, -2 / std::sqrt(5)}, 1e-6);
}

// From (0, 0, 5) with half a unit a unit of depth to each side. A shift of 1/4 of the width shows as much more to the
// right; without perspective, all rays are parallel and begin in the plane z = 5.
TEST(Camera, ShiftMovesThePictureAndParallelRaysBeginApart) {
  preset::Camera preset{.position = {0, 0, 5}, .resolution = {400, 200}};
  preset.fov_deg = 2 * std::atan(0.5) * 180 / M_PI;
  preset.shift = {0.25, -0.5};
  const auto check = [&](const glm::dvec3& from, const glm::dvec3& way) {
    const auto [begin, along] = make_camera(preset, empty_scene()).ray(1, 1); // the top right corner
    expect_near(begin, from);
    expect_near(along, way);
  };
  check({0, 0, 5}, {1 + 0.5, 0.5 - 0.5, -1});
  preset.projection = preset::Camera::Projection::orthographic;
  check({5 + 2.5, 2.5 - 2.5, 5}, {0, 0, -1}); // as high as the perspective picture is at the target
  preset.height = 2;
  check({2 + 1, 1 - 1, 5}, {0, 0, -1});
}

// The ball's box reaches from z = -1 to 1.
TEST(Camera, RefusesALensAndAPicturePlaneInGlass) {
  preset::Preset p = test::empty_preset(4);
  p.scene.materials["glass"] = test::glass(1.5);
  p.scene.objects.push_back(test::object("ball", {.type = preset::Shape::Type::sphere, .radius = 1}, "glass"));
  preset::Camera& camera = p.scene.camera;
  const auto refusal = [&] { return refusal_of([&] { load_scene(p); }); };
  camera.position = {1.5, 0, 0.5};
  camera.target = {1.5, 0, -5};
  camera.aperture = 0.9;
  EXPECT_NO_THROW(load_scene(p));
  camera.aperture = 1.1;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("#/scene/camera/aperture: the camera's lens may touch"), HasSubstr("'ball'")));
  camera.aperture = 0;
  camera.projection = preset::Camera::Projection::orthographic;
  camera.height = 0.9;
  EXPECT_NO_THROW(load_scene(p));
  camera.height = 1.1;
  EXPECT_THAT(refusal(), HasSubstr("#/scene/camera/projection: the camera's picture plane may touch"));
  camera.position[2] = 1.1;
  EXPECT_NO_THROW(load_scene(p));
}

TEST(Camera, RefusesWhatIsNoView) {
  const preset::Vec3 place = preset::Camera{}.position;
  const std::pair<const char*, preset::Camera> cases[] = {
      {"target", {.target = place}},
      {"up", {.up = {0, -1, -4}}}, // from (0, 1, 4) to the origin: along the view
      {"up", {.up = {0, 0, 0}}},
      {"position", {.position = {0, 1e12, 4}}},
      {"target", {.target = {0, std::nan(""), 0}}}};
  for (const auto& [field, camera] : cases)
    EXPECT_THAT(refusal_of([&] { make_camera(camera, empty_scene()); }),
                StartsWith(std::string("p.json#/scene/camera/") + field + ": "));
}

/// A box about the origin and a quad beside it.
Scene box_and_quad() {
  preset::Preset p = test::empty_preset(4);
  p.scene.materials["glass"] = test::glass(1.5);
  p.scene.materials["white"] = test::white();
  p.scene.objects = {test::object("box", test::box(2, 4, 6), "glass"),
                     test::object("floor", test::quad(10, 8), "white", test::at({0, -3, 1}))};
  return load_scene(p);
}

TEST(Corners, AreThoseOfTheObjectAlone) {
  const Scene scene = box_and_quad();
  const Bounds box = bounds_of(scene, scene.objects[0]), floor = bounds_of(scene, scene.objects[1]);
  EXPECT_EQ(scene.origin + box.low, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(scene.origin + box.high, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.origin + floor.low, glm::dvec3(-5, -3, -3));
  EXPECT_EQ(scene.origin + floor.high, glm::dvec3(5, -3, 5));
  int corners = 0;
  for_each_corner(scene, scene.objects[0], [&](const glm::dvec3& corner) {
    ++corners;
    EXPECT_EQ(glm::abs(scene.origin + corner), glm::dvec3(1, 2, 3));
  });
  EXPECT_EQ(corners, 6 * 4); // a side has vertices of its own
}

TEST(Corners, WithoutTrianglesThereIsNoBox) {
  Object nothing;
  const Bounds bounds = bounds_of(box_and_quad(), nothing);
  EXPECT_GT(bounds.low.x, bounds.high.x);
  EXPECT_EQ(enclosing(bounds, {glm::dvec3(1), glm::dvec3(2)}).high, glm::dvec3(2));
}

// Panels have scenes of materials and objects alone.
TEST(Corners, VerticesThatTheSceneDoesNotHoldAreRefused) {
  Scene outline = box_and_quad();
  const std::vector<Object> objects = outline.objects;
  for (const auto& [first, count] : {std::pair{27u, 2u}, {28u, 1u}, {29u, 0u}, {~0u, 2u}, {2u, ~0u}}) {
    outline.objects[1].first_vertex = first;
    outline.objects[1].vertex_count = count;
    EXPECT_THAT(error_of([&] { bounds_of(outline, outline.objects[1]); }).line(),
                HasSubstr("object 'floor' has vertices that the scene does not hold"))
        << first << " " << count;
  }
  outline.objects = objects;
  outline.geometry = {};
  outline.materials[0].absorbs = true;
  outline.materials[0].k.fill(1e-6);
  EXPECT_EQ(error_of([&] { photons::split_by_losses({{0, 1}}, outline, 8, 0.1); }).kind(), ErrorKind::failed);
}

/// Möller and Trumbore 1997; infinity: not hit. Nothing in common with ray.cpp.
double distance_to(const scene::Mesh& mesh, std::uint32_t triangle, const dvec3& origin, const dvec3& direction) {
  const glm::uvec3 t = mesh.triangles[triangle];
  const dvec3 a = mesh.positions[t.x], ab = dvec3(mesh.positions[t.y]) - a, ac = dvec3(mesh.positions[t.z]) - a;
  const dvec3 p = glm::cross(direction, ac), q = glm::cross(origin - a, ab);
  const double det = glm::dot(ab, p), u = glm::dot(origin - a, p) / det, v = glm::dot(direction, q) / det;
  const double distance = glm::dot(ac, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : INFINITY;
}

double closest_of_all(const scene::Mesh& mesh, const dvec3& origin, const dvec3& direction,
                      const scene::CountsPrimitive& counts) {
  double closest = INFINITY;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (counts(t)) closest = std::min(closest, distance_to(mesh, t, origin, direction));
  return closest;
}

void append(scene::Mesh& mesh, const scene::Mesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const glm::uvec3& t : more.triangles) mesh.triangles.push_back(t + first);
}

/// A ball, a small one beside it, and a room about both.
scene::Mesh balls_in_a_room() {
  scene::Mesh mesh = sphere_mesh(24, 12);
  append(mesh, placed(sphere_mesh(24, 12), 0.05f, {2, 1, -1}));
  append(mesh, placed(box_mesh(), 10, {1, 2, 3}));
  return mesh;
}

TEST(HostRays, HitWhatEveryTriangleOnItsOwnSays) {
  const scene::Mesh mesh = balls_in_a_room();
  const scene::Bvh bvh = scene::build_bvh(mesh);
  const scene::CountsPrimitive some = [](std::uint32_t t) { return t % 3 != 0; },
                               all = [](std::uint32_t) { return true; };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-3, 3);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const dvec3 origin(uniform(random), uniform(random), uniform(random));
    dvec3 direction = 2.5 * dvec3(random_direction(random));
    if (i % 7 == 0) direction[i % 3] = 0; // along the boxes' sides
    for (const scene::CountsPrimitive& counts : {some, all}) {
      const double expected = closest_of_all(mesh, origin, direction, counts);
      const auto hit = scene::closest_hit(bvh, origin, direction, counts);
      if (!std::isfinite(expected)) { // out through a missing triangle of the room
        EXPECT_FALSE(hit);
        continue;
      }
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->t, expected, 1e-9 * (1 + expected));
      EXPECT_TRUE(counts(hit->primitive));
      EXPECT_FALSE(scene::closest_hit(bvh, origin, direction, counts, 0.999 * expected));
      ++hits;
    }
  }
  EXPECT_GT(hits, 3000);
}

// From inside, no ray may leave a closed ball, wherever it is aimed: at vertices and at the middles of edges, in which
// two and more triangles meet.
TEST(HostRays, LeaveNoGapAtEdges) {
  const scene::Mesh mesh = sphere_mesh(32, 16);
  const scene::Bvh bvh = scene::build_bvh(mesh);
  for (const dvec3& origin : {dvec3(0), dvec3(0.1, 0.2, -0.3)})
    for (const glm::uvec3& t : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner) {
        const dvec3 a = mesh.positions[t[corner]], b = mesh.positions[t[(corner + 1) % 3]];
        for (const dvec3& aim : {a, 0.5 * (a + b)}) {
          const auto hit = scene::closest_hit(bvh, origin, aim - origin);
          ASSERT_TRUE(hit);
          EXPECT_NEAR(hit->t, 1, 1e-9);
        }
      }
}

TEST(HostRays, AnEmptyMeshIsNeverHit) { EXPECT_FALSE(scene::closest_hit(scene::build_bvh({}), dvec3(0), {0, 0, 1})); }

// Of functions that are 1 on a cap of the sphere, the mean over the directions is the cap's share (1 - cos) / 2; as
// near as a lattice of so many points can be, whichever way the cap lies.
TEST(EvenDirections, MeasureSolidAngles) {
  constexpr int count = 2048;
  for (const dvec3& axis : {dvec3(0, 0, 1), dvec3(1, 0, 0), glm::normalize(dvec3(1, -2, 0.5))})
    for (const double cosine : {0.9, 0.3, -0.6}) {
      int inside = 0;
      for (int i = 0; i < count; ++i) {
        const dvec3 d = scene::even_direction(i, count, 0.3);
        EXPECT_NEAR(glm::length(d), 1, 1e-12);
        inside += glm::dot(d, axis) > cosine;
      }
      EXPECT_NEAR(double(inside) / count, (1 - cosine) / 2, 0.003);
    }
}

constexpr double n = 1.5, degree = std::numbers::pi / 180;

/// A camera of one pixel at the origin; glass of n = 1.5, a mirror, a wall.
preset::Preset one_pixel(preset::Vec3 target) {
  preset::Preset p;
  p.source = "p.json";
  p.scene.materials["glass"] = test::glass(n);
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["wall"];
  p.scene.camera = {.position = {0, 0, 0}, .target = target, .fov_deg = 1, .resolution = {1, 1}};
  return p;
}

preset::Object& add(preset::Preset& p, const char* name, preset::Shape::Type type, const char* material,
                    preset::Vec3 scale, preset::Vec3 at) {
  return p.scene.objects.emplace_back(shape_object(name, type, material, {.scale = scale, .translate = at}));
}

struct Seen {
  photons::PixelSurfaces surfaces;
  glm::dvec3 place; ///< of its end, in the preset's coordinates
  std::string first, last;
};

Seen see(const preset::Preset& p) {
  const scene::Scene scene = scene::load_scene(p);
  const photons::PixelSurfaces surfaces =
      photons::surfaces_of_pixel(scene, scene::build_bvh(scene.geometry), scene.camera, 0, 0);
  const auto name = [&](int object) { return object < 0 ? "" : scene.objects[static_cast<std::size_t>(object)].name; };
  return {surfaces, scene.origin + glm::dvec3(surfaces.last.position), name(surfaces.first.object),
          name(surfaces.last.object)};
}

void expect_seen(const Seen& seen, const char* first, const char* last) {
  EXPECT_EQ(seen.first, first);
  EXPECT_EQ(seen.last, last);
}

TEST(PixelSurfaces, a_pane_displaces_what_is_behind_it) {
  // Straight down through a pane of thickness t that leans by a: t sin(a - b) / cos b to the side, with sin a = n sin
  // b.
  constexpr double lean = 40 * degree, thickness = 0.5;
  preset::Preset p = one_pixel({0, -1, 0});
  p.scene.camera.up = {0, 0, 1};
  add(p, "pane", preset::Shape::Type::box, "glass", {6, thickness, 6}, {0, -3, 0}).transform.rotate_deg = {0, 0, 40};
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, -8, 0});
  const Seen seen = see(p);
  expect_seen(seen, "pane", "wall");
  const double b = std::asin(std::sin(lean) / n);
  EXPECT_NEAR(std::abs(seen.place.x), thickness * std::sin(lean - b) / std::cos(b), 1e-5);
  EXPECT_NEAR(seen.place.y, -8, 1e-5);
  EXPECT_NEAR(seen.place.z, 0, 1e-5);
  EXPECT_NEAR(glm::length(glm::dvec3(seen.surfaces.way) - glm::dvec3(0, -1, 0)), 0, 1e-6);
  // A pixel is 1 degree wide; the way is 8 long, and a little more.
  EXPECT_NEAR(seen.surfaces.spacing, 8 * 2 * std::tan(0.5 * degree), 0.01 * seen.surfaces.spacing);
}

TEST(PixelSurfaces, total_reflection_is_followed) {
  // From within a block: 60 degrees onto its side is beyond the critical angle of 41.8, then 30 onto its top, where the
  // look leaves it.
  preset::Preset p = one_pixel({std::cos(60 * degree), std::sin(60 * degree), 0});
  add(p, "block", preset::Shape::Type::box, "glass", {1, 4, 4}, {0, 0, 0});
  add(p, "wall", preset::Shape::Type::quad, "wall", {40, 1, 40}, {0, 5, 0}).transform.rotate_deg = {180, 0, 0};
  const Seen seen = see(p);
  expect_seen(seen, "block", "wall");
  // Unfolded, y = 2 is met at x = 2 tan 30; the side, at x = 0.5, sends it back to 1 - 2 tan 30.
  const double out = std::asin(n * std::sin(30 * degree)), unfolded = 2 * std::tan(30 * degree);
  EXPECT_NEAR(seen.place.x, 1 - unfolded - 3 * std::tan(out), 1e-5);
  EXPECT_NEAR(seen.place.y, 5, 1e-5);
}

TEST(PixelSurfaces, a_mirror_is_followed_and_an_empty_one_shows_itself) {
  preset::Preset p = one_pixel({1, -1, 0});
  add(p, "mirror", preset::Shape::Type::quad, "mirror", {4, 1, 4}, {1, -1, 0});
  expect_seen(see(p), "mirror", "mirror");
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, 3, 0}).transform.rotate_deg = {180, 0, 0};
  const Seen seen = see(p);
  expect_seen(seen, "mirror", "wall");
  test::expect_near(seen.place, {5, 3, 0}, 1e-5);
}

TEST(PixelSurfaces, glass_that_bends_nothing_is_not_seen) {
  // A box of air, and one of the same glass inside a pane: neither shows, alone or before what does.
  preset::Preset p = one_pixel({0, 0, -1});
  p.scene.materials["air"] = test::glass(1);
  add(p, "nothing", preset::Shape::Type::box, "air", {1, 1, 1}, {0, 0, -2});
  EXPECT_EQ(see(p).surfaces.first.object, -1);
  add(p, "inner", preset::Shape::Type::box, "glass", {1, 1, 1}, {0, 0, -5});
  add(p, "pane", preset::Shape::Type::box, "glass", {3, 3, 3}, {0, 0, -5});
  expect_seen(see(p), "pane", "pane");
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, 0, -9}).transform.rotate_deg = {90, 0, 0};
  expect_seen(see(p), "pane", "wall");
}

TEST(PixelSurfaces, nothing_is_seen_where_nothing_is) {
  const Seen seen = see(one_pixel({0, 0, -1}));
  EXPECT_EQ(seen.surfaces.first.object, -1);
  EXPECT_EQ(seen.surfaces.last.object, -1);
}

TEST(PixelSurfaces, a_ball_bends_about_its_normals) {
  // A ball of n = 1.5 and radius 1: a look that meets it h off its axis leaves it turned towards the axis by 2 (a - b),
  // sin a = h, sin b = h / n.
  constexpr double h = 0.4;
  preset::Preset p = one_pixel({h, 0, -1});
  p.scene.camera.position = {h, 0, 0};
  add(p, "ball", preset::Shape::Type::sphere, "glass", {2, 2, 2}, {0, 0, -3});
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, 0, -9}).transform.rotate_deg = {90, 0, 0};
  const Seen seen = see(p);
  EXPECT_EQ(seen.last, "wall");
  const double turn = 2 * (std::asin(h) - std::asin(h / n));
  EXPECT_NEAR(seen.surfaces.way.x, -std::sin(turn), 1e-6);
  // The way leaves the ball with the same distance h from its centre.
  EXPECT_NEAR(seen.place.x, h / std::cos(turn) - 6 * std::tan(turn), 1e-5);
}

} // namespace nephroid::scene::pixel_surfaces_test
