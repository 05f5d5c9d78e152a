// SPDX-License-Identifier: Apache-2.0
// Host rays through the tree against every triangle on its own, along edges, and past triangles that do not count.
#include "scene/bvh.h"
#include "tests/support/meshes.h"
#include "tests/support/test.h"

namespace nephroid::ray_test {

using glm::dvec3;

/// Möller and Trumbore 1997; infinity: not hit. Nothing in common with ray.cpp.
double distance_to(const scene::Mesh& mesh, std::uint32_t triangle, const dvec3& origin, const dvec3& direction)
{
  const glm::uvec3 t = mesh.triangles[triangle];
  const dvec3 a = mesh.positions[t.x], ab = dvec3(mesh.positions[t.y]) - a, ac = dvec3(mesh.positions[t.z]) - a;
  const dvec3 p = glm::cross(direction, ac), q = glm::cross(origin - a, ab);
  const double det = glm::dot(ab, p), u = glm::dot(origin - a, p) / det, v = glm::dot(direction, q) / det;
  const double distance = glm::dot(ac, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : INFINITY;
}

double closest_of_all(const scene::Mesh& mesh, const dvec3& origin, const dvec3& direction, const scene::CountsPrimitive& counts)
{
  double closest = INFINITY;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (counts(t)) closest = std::min(closest, distance_to(mesh, t, origin, direction));
  return closest;
}

void append(scene::Mesh& mesh, const scene::Mesh& more)
{
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const glm::uvec3& t : more.triangles) mesh.triangles.push_back(t + first);
}

/// A ball, a small one beside it, and a room about both.
scene::Mesh balls_in_a_room()
{
  scene::Mesh mesh = sphere_mesh(24, 12);
  append(mesh, placed(sphere_mesh(24, 12), 0.05f, {2, 1, -1}));
  append(mesh, placed(box_mesh(), 10, {1, 2, 3}));
  return mesh;
}

TEST(HostRays, HitWhatEveryTriangleOnItsOwnSays)
{
  const scene::Mesh mesh = balls_in_a_room();
  const scene::Bvh bvh = scene::build_bvh(mesh);
  const scene::CountsPrimitive some = [](std::uint32_t t) { return t % 3 != 0; }, all = [](std::uint32_t) { return true; };
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

// From inside, no ray may leave a closed ball, wherever it is aimed: at vertices and at the middles of edges, in which two and more
// triangles meet.
TEST(HostRays, LeaveNoGapAtEdges)
{
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

// Of functions that are 1 on a cap of the sphere, the mean over the directions is the cap's share (1 - cos) / 2; as near as a lattice of
// so many points can be, whichever way the cap lies.
TEST(EvenDirections, MeasureSolidAngles)
{
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

} // namespace nephroid::ray_test
