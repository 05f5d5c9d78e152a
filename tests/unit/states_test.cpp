// SPDX-License-Identifier: Apache-2.0
// Meshes that deform: between their states by weight, matched by triangle; refused where they do not match or turn
// inside out. And the tree that follows them.
#include "preset/read.h"
#include "run/prepare.h"
#include "scene/bvh.h"
#include "scene/ray.h"
#include "scene/scene.h"
#include "tests/support/test.h"

namespace nephroid::states_test {

/// A tetrahedron about (0, 0, 0) whose top is at so many times its height.
std::string tetrahedron(double top, double shift = 0) {
  return fmt::format("v {0} {1} 0\nv {2} -1 -1\nv {3} -1 -1\nv {0} -1 1\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n", shift,
                     top, shift - 1, shift + 1);
}

class States : public testing::Test {
protected:
  States() {
    folder_.write("rest.obj", tetrahedron(1));
    folder_.write("tall.obj", tetrahedron(3));
    folder_.write("aside.obj", tetrahedron(1, 8));
    folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n");
    folder_.write("smooth.obj", "v 0 1 0\nv -1 -1 -1\nv 1 -1 -1\nv 0 -1 1\nvn 0 1 0\nvn -1 0 0\nvn 1 0 0\nvn 0 0 1\n"
                                "f 1//1 3//3 2//2\nf 1//1 4//4 3//3\nf 1//1 2//2 4//4\nf 2//2 3//3 4//4\n");
    preset_ = preset::read_preset(folder_.write(
        "a.json", R"({"engine": "spectral", "scene": {"materials": {"glass": {"type": "dielectric", "dispersion": 1.5}},
        "objects": [{"mesh": "rest.obj", "material": "glass"}]}})"));
  }
  scene::Scene loaded(std::vector<preset::State> states) {
    preset_.scene.objects[0].states = std::move(states);
    return scene::load_scene(preset_);
  }
  /// The top's height, in the preset's coordinates.
  static double top_of(const scene::Scene& scene) {
    return scene::bounds_of(scene, scene.objects[0]).high.y + scene.origin.y;
  }
  test::TemporaryFolder folder_;
  preset::Preset preset_;
};

TEST_F(States, VerticesGoAPartOfTheWayByWeight) {
  EXPECT_NEAR(top_of(loaded({})), 1, 1e-6);
  EXPECT_NEAR(top_of(loaded({{"tall.obj", 0}})), 1, 1e-6);
  EXPECT_NEAR(top_of(loaded({{"tall.obj", 0.25}})), 1.5, 1e-6);
  EXPECT_NEAR(top_of(loaded({{"tall.obj", 1}})), 3, 1e-6);
  const scene::Scene both = loaded({{"tall.obj", 0.5}, {"aside.obj", 0.5}});
  EXPECT_NEAR(top_of(both), 2, 1e-6);
  EXPECT_NEAR(scene::bounds_of(both, both.objects[0]).high.x + both.origin.x, 5, 1e-5);
  EXPECT_EQ(both.objects[0].triangle_count, 4u);
}

/// A file whose vertices are parted by their normals has as many triangles: its corners are matched.
TEST_F(States, FilesMayJoinTheirVerticesDifferently) {
  preset_.scene.objects[0].mesh = "smooth.obj";
  EXPECT_NEAR(top_of(loaded({{"tall.obj", 0.5}})), 2, 1e-6);
}

TEST_F(States, OtherTrianglesAreRefusedWithBothNumbers) {
  EXPECT_THAT(test::refusal_of([&] {
                loaded({{"tall.obj", 1}, {"flat.obj", 0}});
              }),
              HasSubstr("a.json#/scene/objects/0/states/1/mesh: has 1 triangle, and the object's mesh has 4"));
}

TEST_F(States, WeightsThatTurnTheMeshInsideOutAreRefused) {
  EXPECT_NO_THROW(loaded({{"tall.obj", -0.9}}));
  EXPECT_THAT(test::refusal_of([&] {
                loaded({{"tall.obj", -1.5}});
              }),
              HasSubstr("a.json#/scene/objects/0/states: weights of -1.5 turn the mesh inside out"));
}

TEST_F(States, ShapesHaveNone) {
  EXPECT_THAT(
      test::refusal_of([&] {
        preset::read_preset(folder_.write(
            "b.json", R"({"engine": "spectral", "scene": {"materials": {"glass": {"type": "diffuse"}}, "objects": [
                  {"shape": {"type": "box"}, "states": [{"mesh": "tall.obj"}], "material": "glass"}]}})"));
      }),
      HasSubstr("/scene/objects/0/states: is of a mesh only"));
}

/// Of spheres no triangle tells that they have changed.
TEST_F(States, TheTreeFollowsASphereThatGrows) {
  preset::Preset ball = preset_;
  ball.scene.objects[0].mesh.reset();
  ball.scene.objects[0].shape.emplace().radius = 1;
  const run::Prepared first = run::prepare(ball), same = run::prepare(ball, &first);
  EXPECT_EQ(same.loaded->bvh, first.loaded->bvh);
  ball.scene.objects[0].shape->radius = 2;
  const run::Prepared larger = run::prepare(ball, &first);
  const auto hit = scene::closest_hit(*larger.loaded->bvh, {0, 5, 0}, {0, -1, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 3, 1e-5);
}

/// Waves move a little: the tree is fitted to them. A mesh that is stretched by far has a new one. Rays meet the same.
TEST_F(States, TheTreeIsRefittedAndRebuiltWhereItsCostHasGrown) {
  preset::Preset water = preset_;
  water.scene.objects[0].mesh.reset();
  water.scene.objects[0].shape.emplace().type = preset::Shape::Type::water;
  water.scene.objects[0].shape->size = {2, 1, 2};
  water.scene.objects[0].shape->segments = 64;
  const run::Prepared first = run::prepare(water);
  water.scene.objects[0].shape->time_s = 0.1;
  const run::Prepared alone = run::prepare(water), after = run::prepare(water, &first);
  EXPECT_EQ(after.loaded->bvh->built_cost, first.loaded->bvh->built_cost);
  EXPECT_NE(after.loaded->bvh->nodes, first.loaded->bvh->nodes);
  EXPECT_NEAR(scene::cost_of(*after.loaded->bvh), scene::cost_of(*alone.loaded->bvh),
              0.02 * scene::cost_of(*alone.loaded->bvh));
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 from(-0.9 + 0.016 * i, 3, 0.4 - 0.011 * i), way(0.05, -1, 0.1);
    const auto a = scene::closest_hit(*alone.loaded->bvh, from, way),
               b = scene::closest_hit(*after.loaded->bvh, from, way);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->primitive, b->primitive);
    EXPECT_EQ(a->t, b->t);
  }

  // Every second vertex goes far away: boxes of neighbours overlap.
  scene::Mesh torn = first.loaded->scene.geometry;
  for (std::size_t i = 0; i < torn.positions.size(); i += 2) torn.positions[i].x += 1.5f;
  scene::Bvh worn = *first.loaded->bvh;
  scene::refit(worn, torn);
  EXPECT_GT(scene::cost_of(worn), 4.0 / 3 * worn.built_cost);
  EXPECT_LT(scene::cost_of(scene::refitted(*first.loaded->bvh, torn)), scene::cost_of(worn));
}

} // namespace nephroid::states_test
