// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/bvh.h against Embree on real meshes at several scales and places; every ray on which they differ is
// judged by a test of all triangles in double precision. NEPHROID_TRACE_RAYS sets the number of rays a case (default
// 20000; a million for the table).
#include "tests/support/meshes.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"
#include "tests/support/tracer.h"

namespace nephroid::trace_test {

using check::Verdict;

std::size_t ray_count() {
  const char* text = std::getenv("NEPHROID_TRACE_RAYS");
  return text ? std::strtoul(text, nullptr, 10) : 20000;
}

/// Towards the mesh from 4 and from 1.25 radii away; one in 16 with a component of 0, one in 16 along an axis.
std::vector<Ray> rays_at(float radius, const glm::vec3& centre, std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-0.7f, 0.7f);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const auto axis = static_cast<glm::length_t>(i / 16 % 3);
    const glm::vec3 from = test::random_direction(random) * (i % 2 ? 4.0f : 1.25f);
    glm::vec3 to(uniform(random), uniform(random), uniform(random));
    if (i % 16 == 0) to[axis] = from[axis];
    glm::vec3 direction = glm::normalize(to - from);
    if (i % 16 == 1) {
      direction = glm::vec3(i % 32 == 1 ? -0.0f : 0.0f);
      direction[axis] = from[axis] > 0 ? -1.0f : 1.0f;
      to[axis] = from[axis];
    }
    rays.push_back({.origin = (i % 16 == 1 ? to : from) * radius + centre, .direction = direction});
  }
  return rays;
}

struct MeshCase {
  std::string name;
  scene::Mesh (*mesh)();
};

struct Place {
  std::string name;
  float scale;
  glm::vec3 centre;
};

const Place places[] = {{"scale 1e-3", 1e-3f, {0, 0, 0}},
                        {"scale 1", 1, {0, 0, 0}},
                        {"scale 1e3", 1e3f, {0, 0, 0}},
                        {"at 1e4", 1, {7e3f, -7e3f, 1e3f}}};

class AgainstEmbree : public testing::TestWithParam<MeshCase> {
protected:
  static void compare(const compute::Context& context, const scene::Mesh& mesh, const Place& place) {
    test::KernelTracer kernel(context, mesh);
    const test::EmbreeTracer embree(mesh, RTC_SCENE_FLAG_ROBUST);
    const std::vector<Ray> rays = rays_at(place.scale, place.centre, ray_count());
    const std::vector<Hit> ours = kernel.closest(rays);
    const std::vector<std::uint32_t> any = kernel.any(rays);
    // 8 roundings of the longest distance that the arithmetic meets, also far from the origin: it begins with the
    // difference of vertex and ray origin, which is exact there.
    const check::Judge judge(mesh, 8 * 0x1p-24 * 5 * place.scale);
    std::array<std::size_t, 5> verdicts{};
    std::size_t hits = 0, differ = 0, any_differs = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit theirs = embree.closest(rays[i]);
      hits += theirs.primitive != no_primitive;
      differ += ours[i].primitive != theirs.primitive;
      any_differs += (any[i] != 0) != (ours[i].primitive != no_primitive);
      const Verdict verdict = judge.judge(rays[i], ours[i], theirs);
      if (verdict == Verdict::wrong && verdicts[static_cast<std::size_t>(verdict)] == 0)
        ADD_FAILURE() << fmt::format("{}, ray {}: triangle {:x} at {}, Embree's {:x} at {}", place.name, i,
                                     ours[i].primitive, ours[i].t, theirs.primitive, theirs.t);
      ++verdicts[static_cast<std::size_t>(verdict)];
    }
    fmt::print(
        "{:7} {:7} triangles, {:10}: {} rays, {} hits, {} differ: {} ties, {} at edges, {} at the start, {} wrong\n",
        GetParam().name, mesh.triangles.size(), place.name, rays.size(), hits, differ, verdicts[1], verdicts[2],
        verdicts[3], verdicts[4]);
    EXPECT_EQ(verdicts[4], 0u);
    EXPECT_EQ(any_differs, 0u);
    EXPECT_GT(hits, rays.size() / 8);
  }
};

TEST_P(AgainstEmbree, EveryDifferenceIsOneOfRounding) {
  const compute::Context context = compute::Context::open(test::device_options());
  const scene::Mesh original = GetParam().mesh();
  for (const Place& place : places) compare(context, test::placed(original, place.scale, place.centre), place);
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, AgainstEmbree,
    testing::Values(MeshCase{"bunny", [] { return scene::load_mesh("/usr/share/glmark2/models/bunny.obj"); }},
                    MeshCase{"horse", [] { return scene::load_mesh("/usr/share/glmark2/models/horse.3ds"); }},
                    MeshCase{"box", test::box_mesh}, MeshCase{"sphere", [] { return test::sphere_mesh(1000, 501); }}),
    [](const auto& tested) { return tested.param.name; });

class Trace : public testing::Test {
protected:
  static scene::Mesh triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    scene::Mesh mesh{.positions = {a, b, c}};
    mesh.triangles.emplace_back(0, 1, 2);
    return mesh;
  }
  std::vector<Hit> trace(const scene::Mesh& mesh, const std::vector<Ray>& rays,
                         const compute::Defines& defines = {}) const {
    return test::KernelTracer(context_, scene::build_bvh(mesh), defines).closest(rays);
  }
  compute::Context context_ = compute::Context::open(test::device_options());
};

/// Points inside a closed mesh.
std::vector<glm::vec3> inner_points(const scene::Mesh& mesh, std::size_t count, std::mt19937& random) {
  std::uniform_int_distribution<std::size_t> vertex(0, mesh.positions.size() - 1);
  std::vector<glm::vec3> points;
  while (points.size() < count) {
    const glm::vec3 p = 0.5f * (mesh.positions[vertex(random)] + mesh.positions[vertex(random)]);
    if (scene::winding_number(mesh, 0, static_cast<std::uint32_t>(mesh.triangles.size()), p) > 0.9) points.push_back(p);
  }
  return points;
}

TEST_F(Trace, NoRayLeavesAClosedMeshBetweenItsTriangles) {
  // From inside, aimed exactly at vertices and at points of edges, where a leak would be.
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const scene::Mesh& mesh :
       {test::sphere_mesh(40, 26), scene::load_mesh("/usr/share/glmark2/models/bunny.obj"), test::box_mesh()})
    for (const float shift : {0.0f, 100.0f}) {
      const scene::Mesh moved = test::placed(mesh, 1, glm::vec3(shift, -shift, 0.5f * shift));
      const std::vector<glm::vec3> origins = inner_points(moved, 32, random);
      std::uniform_int_distribution<std::size_t> any_triangle(0, moved.triangles.size() - 1);
      std::vector<Ray> rays;
      for (std::size_t i = 0; i < ray_count(); ++i) {
        const glm::uvec3& t = moved.triangles[any_triangle(random)];
        const float w = i % 3 == 0 ? 0 : uniform(random);
        const glm::vec3 aim = moved.positions[t.x] + w * (moved.positions[i % 2 ? t.y : t.z] - moved.positions[t.x]);
        const glm::vec3 origin = origins[i % origins.size()];
        rays.push_back({.origin = origin, .direction = glm::normalize(aim - origin)});
      }
      std::size_t escaped = 0;
      for (const Hit& hit : trace(moved, rays)) escaped += hit.primitive == no_primitive;
      EXPECT_EQ(escaped, 0u) << moved.triangles.size() << " triangles at " << shift;
    }
}

TEST_F(Trace, OfEqualDistancesTheLowestNumberWins) {
  // The same square a hundred times, in an order that the tree must not matter to.
  scene::Mesh mesh = triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  mesh.triangles.assign(100, mesh.triangles.front());
  const Ray ray{.origin = {0, 0, 2}, .direction = {0, 0, -1}};
  Ray skips = ray, ends = ray, begins_behind = ray;
  skips.skip = 0;
  ends.t_max = 1.9f;
  begins_behind.direction.z = 1;
  const std::vector<Hit> hits = trace(mesh, {ray, skips, ends, begins_behind});
  EXPECT_EQ(hits[0].primitive, 0u);
  EXPECT_EQ(hits[0].t, 2.0f);
  EXPECT_FLOAT_EQ(hits[0].u, 0.25f);
  EXPECT_FLOAT_EQ(hits[0].v, 0.25f);
  EXPECT_EQ(hits[1].primitive, 1u);
  EXPECT_EQ(hits[2].primitive, no_primitive);
  EXPECT_EQ(hits[2].t, 1.9f);
  EXPECT_EQ(hits[3].primitive, no_primitive);
}

TEST_F(Trace, AnyHitHonoursDistanceAndSkip) {
  test::KernelTracer kernel(context_, triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}));
  const Ray ray{.origin = {0, 0, 2}, .direction = {0, 0, -1}};
  Ray reaches = ray, ends = ray, skips = ray, misses = ray;
  reaches.t_max = 2;
  ends.t_max = 1.9f;
  skips.skip = 0;
  misses.origin.x = 5;
  EXPECT_EQ(kernel.any({ray, reaches, ends, skips, misses}), (std::vector<std::uint32_t>{1, 1, 0, 0, 0}));
}

TEST_F(Trace, NothingHitsAnEmptyOrDegenerateMesh) {
  const std::vector<Ray> rays = rays_at(1, glm::vec3(0), 1000);
  scene::Mesh degenerate = triangle({0, 0, 0}, {0, 0, 0}, {1, 0, 0}); // an edge, then a point, then a straight line
  degenerate.positions.insert(degenerate.positions.end(), {{0.5f, 0, 0}, {0, 1, 0}});
  degenerate.triangles.insert(degenerate.triangles.end(), {{0, 0, 0}, {0, 3, 2}, {0, 2, 4}});
  const std::vector<Hit> nothing = trace({}, rays), only_last = trace(degenerate, rays);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(nothing[i].primitive, no_primitive);
    EXPECT_TRUE(only_last[i].primitive == no_primitive || only_last[i].primitive == 3);
    EXPECT_FALSE(std::isnan(only_last[i].t) || std::isnan(only_last[i].u));
    hits += only_last[i].primitive == 3;
  }
  EXPECT_GT(hits, 10u);
  EXPECT_EQ(test::KernelTracer(context_, scene::Mesh{}).any(rays), std::vector<std::uint32_t>(rays.size(), 0));
}

/// Triangles that double in size and share a corner make the deepest trees.
scene::Mesh needles() {
  scene::Mesh mesh;
  for (int i = 0; i < 400; ++i) {
    const float size = std::ldexp(1e-12f, i % 80), turn = 0.01f * static_cast<float>(i / 80);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{0, 0, 0}, {size, 1e-3f * size, turn * size}, {size, 2e-3f * size, -turn * size}});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

TEST_F(Trace, NeedlesOfAnyLengthFitTheStack) {
  const scene::Bvh bvh = scene::build_bvh(needles());
  EXPECT_GE(bvh.stack, bvh.depth);
  EXPECT_LE(bvh.stack, 7 * bvh.depth + 1);
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    const float x = std::ldexp(0.7e-12f, i % 80);
    rays.push_back({.origin = {x, 1.4e-3f * x, x}, .direction = {0, 0, -1}});
  }
  const std::vector<Hit> hits = test::KernelTracer(context_, bvh).closest(rays);
  EXPECT_GT(std::count_if(hits.begin(), hits.end(), [](const Hit& h) { return h.primitive != no_primitive; }), 900);
}

TEST_F(Trace, ATreeThatIsFittedToWhereThingsMovedMeetsTheSameAsANewOne) {
  scene::Mesh mesh = test::sphere_mesh(61, 32);
  const std::size_t first = mesh.positions.size();
  for (const glm::vec3& p : test::box_mesh().positions) mesh.positions.push_back(0.3f * p);
  for (const glm::uvec3& t : test::box_mesh().triangles)
    mesh.triangles.emplace_back(t + static_cast<std::uint32_t>(first));
  for (int i = 0; i < 40; ++i) // a leaf has both
    mesh.ellipsoids.push_back(
        {.centre = 0.02f * glm::vec3(i, i % 7, -i), .half_axes = {{{0.05f, 0, 0}, {0, 0.03f, 0}, {0, 0, 0.02f}}}});
  scene::Bvh bvh = scene::build_bvh(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 p = mesh.positions[v];
    mesh.positions[v] =
        v < first ? glm::vec3(0.8f * p.x - 0.6f * p.z, p.y, 0.6f * p.x + 0.8f * p.z) : p + glm::vec3(0.4f, 0.9f, -0.2f);
  }
  for (scene::Ellipsoid& ellipsoid : mesh.ellipsoids) ellipsoid.centre.y += 0.7f;
  scene::refit(bvh, mesh);
  const std::vector<Ray> rays = rays_at(1, glm::vec3(0), 20000);
  const std::vector<Hit> fitted = test::KernelTracer(context_, bvh).closest(rays), anew = trace(mesh, rays);
  std::array<std::size_t, 3> hits{}; // of the sphere, the box, the ellipsoids
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(fitted[i].primitive, anew[i].primitive) << i;
    ASSERT_EQ(fitted[i].t, anew[i].t) << i;
    if (anew[i].primitive == no_primitive) continue;
    ++hits[anew[i].primitive < mesh.triangles.size() - 12 ? 0 : anew[i].primitive < mesh.triangles.size() ? 1 : 2];
  }
  EXPECT_GT(*std::ranges::min_element(hits), 20u);
  scene::Bvh nothing = scene::build_bvh({});
  scene::refit(nothing, {});
}

TEST_F(Trace, RefusesCornersThatAreMissingOrNotFinite) {
  scene::Mesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.triangles.emplace_back(0, 1, 3);
  EXPECT_THROW(scene::build_bvh(mesh), Error);
  mesh.positions.emplace_back(std::nanf(""), 0, 0);
  EXPECT_THROW(scene::build_bvh(mesh), Error);
}

/// Spheres of triangles and ellipsoids at several depths of one tree, and triangles that make the deepest one.
std::vector<scene::Mesh> meshes_of_all_kinds() {
  scene::Mesh mixed = test::sphere_mesh(60, 31);
  for (int i = 0; i < 40; ++i)
    mixed.ellipsoids.push_back(
        {.centre = 0.02f * glm::vec3(i, i % 7, -i), .half_axes = {{{0.05f, 0, 0}, {0, 0.03f, 0}, {0, 0, 0.02f}}}});
  return {mixed, test::sphere_mesh(60, 31), needles()};
}

TEST_F(Trace, WhatOtherDevicesRunGivesTheSameBits) {
  for (const scene::Mesh& mesh : meshes_of_all_kinds()) {
    const scene::Bvh bvh = scene::build_bvh(mesh);
    const std::vector<Ray> rays = rays_at(1, glm::vec3(0), 5000);
    test::KernelTracer fast(context_, bvh);
    const std::vector<Hit> expected = fast.closest(rays);
    for (const char* define : {"NEPHROID_BVH_PORTABLE", "NEPHROID_BVH_SCALAR"}) {
      test::KernelTracer other(context_, bvh, {{define, "1"}});
      const std::vector<Hit> hits = other.closest(rays);
      EXPECT_EQ(fast.any(rays), other.any(rays)) << define;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(expected[i].primitive, hits[i].primitive) << define << ", ray " << i;
        ASSERT_EQ(expected[i].t, hits[i].t) << define << ", ray " << i;
        ASSERT_EQ(expected[i].u, hits[i].u) << define << ", ray " << i;
        ASSERT_EQ(expected[i].v, hits[i].v) << define << ", ray " << i;
      }
    }
  }
}

} // namespace nephroid::trace_test
