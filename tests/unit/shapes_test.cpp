// SPDX-License-Identifier: Apache-2.0
// Shapes against their closed forms: volume, area, closedness, normals; the brilliant against the angles of its cut.
#include "preset/preset.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/support/test.h"

namespace nephroid::scene::shapes_test {

using Type = preset::Shape::Type;
constexpr double pi = std::numbers::pi;

glm::dvec3 area_vector(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a = mesh.positions[t.x];
  return 0.5 * glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) sum += glm::length(area_vector(mesh, t));
  return sum;
}

/// Closed, clean, and every vertex normal is unit and on the triangle's own side.
void expect_sound(const Mesh& mesh) {
  const MeshReport report = inspect(mesh);
  EXPECT_TRUE(report.closed()) << report.open_edges << " open, " << report.crowded_edges << " crowded";
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.duplicated, 0u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  std::vector<bool> is_used(mesh.positions.size());
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) is_used[t[i]] = true;
  EXPECT_THAT(is_used, Each(true));
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(glm::length(mesh.normals[t[i]]), 1, 1e-6);
      EXPECT_GT(glm::dot(glm::dvec3(mesh.normals[t[i]]), glm::normalize(area_vector(mesh, t))), 0.99);
    }
}

TEST(Shapes, QuadFacesUp) {
  const Mesh mesh = make_shape({.type = Type::quad, .size = {2, 99, 3}});
  EXPECT_NEAR(area(mesh), 6, 1e-6);
  for (const glm::uvec3& t : mesh.triangles) EXPECT_GT(area_vector(mesh, t).y, 0);
  EXPECT_EQ(inspect(mesh).open_edges, 4u);
}

TEST(Shapes, BoxAndPlate) {
  for (Type type : {Type::box, Type::plate}) {
    const Mesh mesh = make_shape({.type = type, .size = {2, 3, 4}});
    expect_sound(mesh);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(inspect(mesh).signed_volume, 24, 1e-9);
    EXPECT_NEAR(area(mesh), 2 * (6 + 8 + 12), 1e-9);
    glm::vec3 high(0);
    for (const glm::vec3& p : mesh.positions) high = glm::max(high, p);
    EXPECT_EQ(high, glm::vec3(1, 1.5, 2));
  }
}

TEST(Shapes, ASphereIsOne) {
  preset::Shape sphere{.type = Type::sphere, .radius = 2};
  const Mesh mesh = make_shape(sphere);
  EXPECT_TRUE(mesh.triangles.empty());
  ASSERT_EQ(mesh.ellipsoids.size(), 1u);
  EXPECT_NEAR(volume_of(mesh.ellipsoids[0]), 4.0 / 3 * pi * 8, 1e-9);
  EXPECT_EQ(longest_half_axis(mesh.ellipsoids[0]), 2);
  EXPECT_EQ(shortest_half_axis(mesh.ellipsoids[0]), 2);
  EXPECT_GT(normal_at(mesh.ellipsoids[0], {0, 2, 0}).y, 0);
  sphere.inwards = true;
  EXPECT_LT(normal_at(make_shape(sphere).ellipsoids[0], {0, 2, 0}).y, 0);
}

// The inscribed prism over a regular N-gon, exactly: volume N/2 sin(2 pi / N) r^2 h; area twice the base plus N sides.
TEST(Shapes, CylinderIsTheInscribedPrism) {
  const Mesh mesh = make_shape({.type = Type::cylinder, .radius = 0.5, .height = 3, .segments = 100});
  expect_sound(mesh);
  const double base = 50 * std::sin(2 * pi / 100) * 0.25;
  EXPECT_NEAR(inspect(mesh).signed_volume, base * 3, 1e-6);
  EXPECT_NEAR(area(mesh), 2 * base + 100 * (2 * 0.5 * std::sin(pi / 100)) * 3, 1e-5);
  // The rim is sharp: normals there are along y or across it, never between.
  for (const glm::vec3& n : mesh.normals) EXPECT_TRUE(n.y == 0 || std::abs(n.y) == 1) << n.y;
}

TEST(Shapes, PrismHasItsApexAtPlusZ) {
  const Mesh mesh = make_shape({.type = Type::prism, .height = 5, .apex_deg = 40, .side = 2});
  expect_sound(mesh);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_NEAR(inspect(mesh).signed_volume, 0.5 * 4 * std::sin(40 * pi / 180) * 5, 1e-5);
  // The two facets at the apex: their outward normals are 180 - 40 degrees apart and lean to +z; the third faces -z.
  std::set<std::pair<float, float>> sides;
  for (const glm::vec3& n : mesh.normals)
    if (std::abs(n.y) < 0.5) sides.insert({n.x, n.z});
  ASSERT_EQ(sides.size(), 3u);
  const auto [left, right] = std::pair(*sides.begin(), *sides.rbegin());
  EXPECT_NEAR(left.first * right.first + left.second * right.second, std::cos(140 * pi / 180), 1e-6);
  EXPECT_GT(left.second, 0);
  EXPECT_TRUE(std::any_of(sides.begin(), sides.end(), [](const auto& n) { return std::abs(n.second + 1) < 1e-6f; }));
}

/// Triangles by the plane of their vertex normal: facets have one exact normal each.
std::map<std::tuple<float, float, float>, std::vector<glm::uvec3>> facets(const Mesh& mesh) {
  std::map<std::tuple<float, float, float>, std::vector<glm::uvec3>> result;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 n = mesh.normals[t.x];
    result[{n.x, n.y, n.z}].push_back(t);
  }
  return result;
}

TEST(Shapes, BrilliantHas57FacetsAndAGirdle) {
  const Mesh mesh = make_shape({.type = Type::brilliant, .radius = 3});
  expect_sound(mesh);
  EXPECT_GT(inspect(mesh).signed_volume, 0);
  const auto planes = facets(mesh);
  EXPECT_EQ(planes.size(), 57u + 16u);
  const auto tilted = [&](double degrees) { // from +y
    return std::count_if(planes.begin(), planes.end(), [&](const auto& plane) {
      return std::abs(std::acos(std::clamp(double(std::get<1>(plane.first)), -1.0, 1.0)) * 180 / pi - degrees) < 1e-3;
    });
  };
  EXPECT_EQ(tilted(0), 1) << "table";
  EXPECT_EQ(tilted(34.5), 8) << "bezels";
  EXPECT_EQ(tilted(180 - 40.75), 8) << "mains";
  EXPECT_EQ(tilted(90), 16) << "girdle";
}

TEST(Shapes, BrilliantIsConvexPlanarAndEightfold) {
  const Mesh mesh = make_shape({.type = Type::brilliant}); // girdle radius 0.5
  for (const auto& [normal, triangles] : facets(mesh)) {
    const glm::dvec3 n(std::get<0>(normal), std::get<1>(normal), std::get<2>(normal));
    const double plane = glm::dot(n, glm::dvec3(mesh.positions[triangles[0].x]));
    for (const glm::uvec3& t : triangles)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::dot(n, glm::dvec3(mesh.positions[t[i]])), plane, 1e-7); // planar
    for (const glm::vec3& p : mesh.positions) EXPECT_LT(glm::dot(n, glm::dvec3(p)), plane + 1e-7);         // convex
  }
  // Turned by 45 degrees, or mirrored, every vertex lies on a vertex again.
  for (const glm::vec3& p : mesh.positions) {
    const glm::vec3 turned{(p.x + p.z) * std::sqrt(0.5f), p.y, (p.z - p.x) * std::sqrt(0.5f)}, mirrored{p.x, p.y, -p.z};
    float near_turned = 1, near_mirrored = 1;
    for (const glm::vec3& q : mesh.positions) {
      near_turned = std::min(near_turned, glm::distance(q, turned));
      near_mirrored = std::min(near_mirrored, glm::distance(q, mirrored));
    }
    EXPECT_LT(near_turned, 2e-7f);
    EXPECT_LT(near_mirrored, 2e-7f);
  }
}

// Tolkowsky's stone: the table is 53 % of the diameter; crown height (1 - 0.53) / 2 tan 34.5 = 16.2 %, pavilion depth
// tan 40.75 / 2 = 43.1 % of it; the girdle adds 3 %.
TEST(Shapes, BrilliantProportions) {
  const Mesh mesh = make_shape({.type = Type::brilliant}); // diameter 1
  float low = 0, high = 0, widest = 0, table = 0;
  for (const glm::vec3& p : mesh.positions) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
    widest = std::max(widest, std::hypot(p.x, p.z));
  }
  for (const glm::vec3& p : mesh.positions)
    if (p.y == high) table = std::max(table, std::hypot(p.x, p.z));
  EXPECT_NEAR(high - low, 0.1615 + 0.4308 + 0.03, 2e-4);
  EXPECT_NEAR(low, -high, 1e-6);
  EXPECT_NEAR(widest, 0.5, 1e-6);
  EXPECT_NEAR(table, 0.265, 1e-6);
}

TEST(Shapes, InwardsTurnsEverythingRound) {
  for (Type type : {Type::box, Type::cylinder, Type::prism, Type::plate, Type::brilliant}) {
    preset::Shape room{.type = type};
    const double volume = inspect(make_shape(room)).signed_volume;
    room.inwards = true;
    const Mesh mesh = make_shape(room);
    EXPECT_GT(volume, 0);
    EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, -volume);
    expect_sound(mesh);
  }
}

TEST(Shapes, CoarsestCylindersAreClosed) {
  for (int segments : {3, 4, 5}) {
    const MeshReport report = inspect(make_shape({.type = Type::cylinder, .segments = segments}));
    EXPECT_TRUE(report.closed());
    EXPECT_GT(report.signed_volume, 0);
  }
}

} // namespace nephroid::scene::shapes_test
