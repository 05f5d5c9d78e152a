// SPDX-License-Identifier: Apache-2.0
// Where baked objects stand in the scene: their vertices there are those of the bake, turned and moved. What is around
// them: scenes without the caster, points of its surface, what is left out.
#include "environment/bake/caster.h"
#include "environment/occlusion/occlusion.h"
#include "scene/scene.h"
#include "tests/environment/bakes.h"
#include "tests/environment/maps.h"
#include "tests/environment/views.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::surroundings_test {

using environment::without_caster;
using preset::Shape;
using namespace nephroid::environment;

/// The largest distance between the caster's vertices in the scene and where the placement has them.
double largest_distance(const preset::Preset& preset) {
  const environment::Caster caster = environment::make_caster(preset);
  const scene::Scene scene = scene::load_scene(preset);
  const environment::Placement placement = environment::placement(preset, caster, scene);
  EXPECT_NEAR(glm::determinant(placement.turn), 1, 1e-12);
  EXPECT_EQ(caster.objects.size(), caster.scene.objects.size());
  double largest = 0;
  for (std::size_t i = 0; i < caster.objects.size(); ++i) {
    std::vector<glm::dvec3> baked, placed;
    for_each_corner(caster.scene, caster.scene.objects[i], [&](const glm::dvec3& p) { baked.push_back(p); });
    for_each_corner(scene, scene.objects[caster.objects[i]], [&](const glm::dvec3& p) { placed.push_back(p); });
    EXPECT_EQ(baked.size(), placed.size());
    for (std::size_t k = 0; k < std::min(baked.size(), placed.size()); ++k) {
      largest = std::max(largest, glm::distance(placement.turn * baked[k] + placement.middle, placed[k]));
    }
  }
  return largest;
}

// A mesh without symmetry, whose box's middle is not its own origin, among other things, so that the scene's origin is
// elsewhere.
TEST(Placement, TakesTheBakesVerticesToTheScenes) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("stone.obj", "v 3 0.2 -0.3\nv 1.5 0.9 0.1\nv 1.6 -0.8 0.2\nv 2.1 0.1 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
                                "f 3 1 4\n");
  const std::string
      wall = R"({"name": "wall", "shape": {"type": "quad", "size": [9, 1, 9]}, "material": "wall"})",
      mirror =
          R"({"name": "mirror", "shape": {"type": "quad"}, "material": "mirror", "transform": {"translate": [8, 1, 2]}})";
  for (const char* transform : {"{}", R"({"translate": [4, -5, 6]})", R"({"rotate_deg": [10, 20, 30]})",
                                R"({"scale": [1, 2, 0.5], "rotate_deg": [170, -85, 95], "translate": [1, 2, 3]})",
                                R"({"scale": [-1, 1, 1], "rotate_deg": [0, 90, 0], "translate": [100, 0, 0]})"}) {
    const std::string stone =
        R"({"name": "stone", "mesh": ")" + file + R"(", "material": "glass", "transform": )" + transform + "}";
    EXPECT_LT(largest_distance(bake_preset(wall + ", " + stone + ", " + mirror, {"environment.objects=[\"stone\"]"})),
              1e-5)
        << transform;
  }
}

// The scene without the object whose caustics are shown, against the scene that a preset without it makes.

/// Box, balls, cylinder and quad; the camera is in the box and in one of the balls.
preset::Preset crowd() {
  preset::Preset preset = test::ball_over_floor();
  preset.scene.objects = {
      test::shape_object("room", Shape::Type::box, "glass"), test::shape_object("ball", Shape::Type::sphere, "mirror"),
      test::shape_object("post", Shape::Type::cylinder, "glass"),
      test::shape_object("lens", Shape::Type::sphere, "glass"), test::shape_object("floor", Shape::Type::quad, "wall")};
  const double places[] = {0, -20, 0, 2.5, 0};
  for (std::size_t i = 0; i < 5; ++i) preset.scene.objects[i].transform.translate = {places[i], -0.1, 0};
  preset.scene.objects[0].transform.scale = {12, 12, 12};
  preset.scene.objects[1].transform.scale = {2, 1, 3};
  preset.scene.camera.position = {2.5, 0, 0.1};
  return preset;
}

/// The corners of an object's triangles one after the other, in the preset's coordinates.
std::vector<glm::dvec3> corners(const scene::Scene& scene, const scene::Object& object) {
  std::vector<glm::dvec3> found;
  for_each_corner(scene, object, [&](const glm::dvec3& corner) { found.push_back(scene.origin + corner); });
  return found;
}

class Without : public testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(EachOne, Without, testing::Range<std::size_t>(0, 5));

TEST_P(Without, TheRestIsWhatAPresetWithoutItMakes) {
  preset::Preset preset = crowd();
  const scene::Scene whole = scene::load_scene(preset);
  const scene::Scene rest = without_caster(whole, {GetParam()});
  preset.scene.objects.erase(preset.scene.objects.begin() + static_cast<std::ptrdiff_t>(GetParam()));
  const scene::Scene expected = scene::load_scene(preset);

  ASSERT_EQ(rest.objects.size(), 4u);
  EXPECT_EQ(rest.origin, whole.origin);
  EXPECT_EQ(rest.geometry.positions.size(), expected.geometry.positions.size());
  EXPECT_EQ(rest.geometry.normals.size(), expected.geometry.normals.size());
  EXPECT_EQ(rest.object_of_primitive, expected.object_of_primitive);
  EXPECT_EQ(rest.camera.inside, expected.camera.inside);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rest.objects[i].name, expected.objects[i].name);
    EXPECT_EQ(rest.objects[i].material, expected.objects[i].material);
    const std::vector<glm::dvec3> a = corners(rest, rest.objects[i]), b = corners(expected, expected.objects[i]);
    ASSERT_EQ(a.size(), b.size());
    // Glass that touches what is taken away is shrunk by some 3e-5 in the whole scene (scene/move.cpp).
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT(glm::distance(a[k], b[k]), 1e-4) << k;
  }
}

TEST(WithoutCaster, TheCameraKnowsTheOthersByTheirNewNumbers) {
  const scene::Scene whole = scene::load_scene(crowd());
  ASSERT_THAT(whole.camera.inside, ElementsAre(0, 3));
  EXPECT_THAT(without_caster(whole, {0}).camera.inside, ElementsAre(2));
  EXPECT_THAT(without_caster(whole, {2}).camera.inside, ElementsAre(0, 2));
  EXPECT_THAT(without_caster(whole, {3}).camera.inside, ElementsAre(0));
  EXPECT_THAT(without_caster(whole, {4}).camera.inside, ElementsAre(0, 3));
  EXPECT_THAT(without_caster(whole, {0, 2}).camera.inside, ElementsAre(1));
  EXPECT_THAT(without_caster(whole, {1, 4}).camera.inside, ElementsAre(0, 2));
}

TEST(WithoutCaster, OfOneObjectNothingIsLeft) {
  preset::Preset preset = test::ball_over_floor();
  preset.scene.objects.resize(1);
  const scene::Scene rest = without_caster(scene::load_scene(preset), {0});
  EXPECT_THAT(rest.objects, IsEmpty());
  EXPECT_THAT(rest.object_of_primitive, IsEmpty());
  EXPECT_THAT(rest.geometry.positions, IsEmpty());
  EXPECT_THAT(rest.geometry.ellipsoids, IsEmpty());
}

// Points all over an object, and what they see past a card that goes by: against closed forms of a ball.

glm::dvec3 middle(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

TEST(SurfacePoints, LieAllOverABall) {
  const scene::Scene scene = scene::load_scene(test::bake_preset());
  const std::vector<glm::dvec3> points = surface_points(scene, {0}, 1024);
  ASSERT_EQ(points.size(), 1024U);
  for (const glm::dvec3& point : points) ASSERT_NEAR(glm::length(point), 1, 1e-6);
  EXPECT_LT(glm::length(middle(points)), 0.005);
  for (int axis = 0; axis < 3; ++axis) // by Archimedes
    EXPECT_NEAR(std::ranges::count_if(points, [&](const glm::dvec3& p) { return p[axis] > 0.5; }), 256, 8) << axis;
}

/// A box of 1 x 2 x 3: 2 of 22 parts of its area are each of the two smallest faces.
TEST(SurfacePoints, AreEvenOverTriangles) {
  const std::string box = R"({"shape": {"type": "box", "size": [1, 2, 3]}, "material": "glass"})";
  const std::vector<glm::dvec3> points = surface_points(scene::load_scene(test::bake_preset(box)), {0}, 1024);
  ASSERT_EQ(points.size(), 1024U);
  const glm::dvec3 half(0.5, 1, 1.5), parts(6, 3, 2);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      EXPECT_NEAR(std::ranges::count_if(
                      points, [&](const glm::dvec3& p) { return std::abs(p[axis] - side * half[axis]) < 1e-5; }),
                  1024 * parts[axis] / 22, 3)
          << axis << ' ' << side;
  EXPECT_LT(glm::length(middle(points)), 0.03);
}

std::string card(double at) {
  return fmt::format(
      R"({{"shape": {{"type": "quad", "size": [10, 1, 10]}}, "material": "wall", "transform": {{"translate": [{}, 3, 0]}}}})",
      at - 5);
}

/// A card before a sun of half a degree straight above a ball: of the ball's surface (1 - x) / 2 are beyond x, where
/// the card's edge is.
TEST(SurfacePoints, SeeACardHideTheSunLittleByLittle) {
  const CubeMap cube = make_cube_map(
      test::made_map(512, 256, [](const glm::dvec3& d) { return glm::dvec3(d.y > std::cos(0.0087) ? 1e4 : 0.0); }));
  const Segmentation lights = segment(cube, {.lights = 6});
  Occlusion occlusion(test::bake_context(), lights, cube);
  for (const double edge : {-1.2, -0.9, -0.5, -0.2, 0.0, 0.3, 0.6, 0.95, 1.2}) {
    const scene::Scene scene = scene::load_scene(test::bake_preset(test::glass_ball + ", " + card(edge)));
    tracing::World world = surroundings_world(test::bake_context(), without_caster(scene, {0}));
    const std::vector<VisibleLight> seen = occlusion.visible_lights(world, 0, surface_points(scene, {0}, 1024));
    double flux = 0;
    for (const VisibleLight& light : seen) flux += light.flux.y;
    const double expected = std::clamp((1 - edge) / 2, 0.0, 1.0);
    EXPECT_NEAR(flux / lights.total_flux.y, expected, 0.02) << edge;
  }
}

// What engine 2 leaves out changes nothing that is to be seen: each case beside one in which it is not left out.

class EnvironmentLeavesOut : public EnvironmentJobs {
protected:
  static plan::Decision pass(const preset::Preset& p, const std::string& name) {
    const environment::EnvironmentPlan plan = plan_of(p);
    const auto found = std::ranges::find(plan.decisions, name, &plan::Decision::name);
    EXPECT_NE(found, plan.decisions.end()) << name;
    return found == plan.decisions.end() ? plan::Decision{} : *found;
  }
  /// Those of `b` that `a` has too.
  static void expect_same_layers(const job::Snapshot& a, const job::Snapshot& b) {
    for (const job::Layer& of : a.picture->layers) EXPECT_EQ(of.rgb, layer_rgb(b, of.name)) << of.name;
  }
  static preset::Preset over_floor(const preset::Overrides& more = {}) {
    preset::Preset p = ball_and(facing_quad("floor", {0, -1.5, 0}, {0, 1, 0}, 8), more);
    p.scene.lights = {lamp({0.3, -1, 0.2}, 3)};
    even_light(p);
    look(p, {2, 2, 4}, {0, -0.5, 0}, 50);
    return p;
  }
};

TEST_F(EnvironmentLeavesOut, TheVolumeWithoutAMedium) {
  const preset::Preset none = over_floor(), thin = over_floor({"environment.extinction=1e-9"});
  EXPECT_FALSE(pass(none, "volume").runs);
  EXPECT_EQ(pass(none, "volume").reason, "there is no medium: environment.extinction or albedo is 0");
  EXPECT_TRUE(pass(thin, "volume").runs);
  EXPECT_TRUE(plan_of(thin).notes.empty());
  EXPECT_EQ(plan_of(over_floor({"environment.extinction=10"})).notes.size(), 1u) << "too thick";
  const job::Snapshot without = run(none), with = run(thin);
  expect_same_layers(without, with);
  EXPECT_LT(mean(layer_rgb(with, "volume")).y, 1e-8);
}

TEST_F(EnvironmentLeavesOut, CausticsThatAreSwitchedOff) {
  const preset::Preset all = over_floor({"environment.extinction=0.1"}),
                       none = over_floor({"environment.extinction=0.1", "environment.cast=false"});
  EXPECT_FALSE(pass(none, "cast").runs);
  EXPECT_EQ(pass(none, "cast").reason, "environment.cast is false");
  const job::Snapshot with = run(all), without = run(none);
  for (const char* name : {"background", "direct", "volume"})
    EXPECT_EQ(layer_rgb(with, name), layer_rgb(without, name)) << name;
  EXPECT_GT(mean(layer_rgb(with, "caustic")).y, 0.001);
  EXPECT_EQ(mean(layer_rgb(without, "caustic")), glm::dvec3(0));
  // And on again in the same job.
  const auto job = job_of(none);
  run(*job);
  ASSERT_TRUE(job->adopt(all));
  expect_same_layers(run(*job), with);
}

// The other scene has an object so far away and so small that no ray meets it.
TEST_F(EnvironmentLeavesOut, RaysToLightsWhereNothingStands) {
  const auto view = [](const std::string& others) {
    preset::Preset p = ball_and(others);
    p.scene.lights = {lamp({0.3, -1, 0.2}, 3)};
    even_light(p);
    look(p, {2, 2, 4}, {0, -0.5, 0}, 50);
    return p;
  };
  const preset::Preset alone = view(""), speck = view(facing_quad("speck", {50, -80, 60}, {0, 1, 0}, 1e-3));
  EXPECT_FALSE(pass(alone, "occlusion").runs);
  EXPECT_EQ(pass(alone, "occlusion").reason, "nothing stands around the object");
  EXPECT_TRUE(pass(speck, "occlusion").runs);
  expect_same_layers(run(alone), run(speck));
}

TEST_F(EnvironmentLeavesOut, ABakeThatIsRight) {
  const preset::Preset p = over_floor();
  EXPECT_TRUE(pass(p, "bake").runs);
  const job::Snapshot baked = run(p);
  EXPECT_FALSE(pass(p, "bake").runs);
  EXPECT_NE(pass(p, "bake").reason.find("the same object, material and settings"), std::string::npos);
  const job::Snapshot read = run(p);
  EXPECT_EQ(read.progress.work, baked.progress.work);
  expect_same_layers(baked, read);
}

// The lights are those that cutting makes, so the picture is.
TEST_F(EnvironmentLeavesOut, CutsOfOneColour) {
  preset::Preset p = over_floor();
  EXPECT_FALSE(pass(p, "segments").runs);
  EXPECT_EQ(pass(p, "segments").reason, "the environment has one colour all around: 24 equal lights");
  p.leave_out = false;
  EXPECT_TRUE(pass(p, "segments").runs);
  const environment::CubeMap cube = environment::make_cube_map(uniform_map(64, 32, {2, 1, 0.5}));
  ASSERT_TRUE(cube.even);
  EXPECT_FALSE(environment::make_cube_map(synthetic_maps(64)[2].map).even);
  for (const int q : {6, 24})
    for (const environment::SegmentMethod method :
         {environment::SegmentMethod::variance, environment::SegmentMethod::thesis}) {
      const environment::Segmentation even = environment::even_segments(cube, q),
                                      cut = environment::segment(cube, {.lights = q, .method = method});
      ASSERT_EQ(even.lights.size(), cut.lights.size());
      for (std::size_t i = 0; i < even.lights.size(); ++i) {
        EXPECT_EQ(even.lights[i].face, cut.lights[i].face);
        EXPECT_EQ(even.lights[i].rect, cut.lights[i].rect);
        EXPECT_LT(glm::distance(even.lights[i].direction, cut.lights[i].direction), 1e-12);
        EXPECT_LT(glm::distance(even.lights[i].flux, cut.lights[i].flux), 1e-12);
        EXPECT_EQ(even.lights[i].solid_angle_sr, cut.lights[i].solid_angle_sr);
      }
      EXPECT_LT(glm::distance(even.total_flux, cut.total_flux), 1e-10);
    }
  // More lights are about as even as those that are looked for: 1.28 beside 1.16.
  const auto unevenness = [](const environment::Segmentation& lights) {
    const auto [least, most] =
        std::ranges::minmax(lights.lights, {}, [](const environment::Region& light) { return light.flux.y; });
    return most.flux.y / least.flux.y;
  };
  const environment::Segmentation even = environment::even_segments(cube, 96);
  EXPECT_EQ(even.lights.size(), 96u);
  EXPECT_LE(unevenness(even), 1.15 * unevenness(environment::segment(cube, {.lights = 96})));
  EXPECT_EQ(environment::even_segments(cube, 25).lights.size(), 54u);
}

} // namespace nephroid::surroundings_test
