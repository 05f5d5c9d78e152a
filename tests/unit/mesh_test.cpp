// SPDX-License-Identifier: Apache-2.0
// Mesh files of every format written here, checks of meshes, smooth normals and winding numbers.
#include "scene/mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/test.h"

#include <numbers>

namespace nephroid::scene::mesh_test {

/// Six quadrilaterals about the cube [0, 2]^3, outwards.
constexpr std::array<std::array<int, 4>, 6> cube_faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
glm::vec3 cube_corner(int i) { return {2 * (i & 1), 2 * (i >> 1 & 1), 2 * (i >> 2 & 1)}; }

Mesh cube(glm::vec3 offset = {0, 0, 0}, float scale = 1) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(scale * cube_corner(i) + offset);
  for (const auto& f : cube_faces) {
    mesh.triangles.emplace_back(f[0], f[1], f[2]);
    mesh.triangles.emplace_back(f[0], f[2], f[3]);
  }
  return mesh;
}

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string cube_obj() {
  std::string text = "# a cube of six quadrilaterals, a line and a point\n";
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", cube_corner(i).x, cube_corner(i).y, cube_corner(i).z);
  for (const auto& f : cube_faces) text += fmt::format("f {} {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1, f[3] + 1);
  return text + "l 1 2\np 3\n";
}

std::string cube_ply(bool binary) {
  std::string bytes =
      fmt::format("ply\nformat {} 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 6\nproperty list uchar int vertex_indices\nend_header\n",
                  binary ? "binary_little_endian" : "ascii");
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 p = cube_corner(i);
    if (!binary) bytes += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    if (binary) put(bytes, std::array{p.x, p.y, p.z});
  }
  for (const auto& f : cube_faces) {
    if (!binary) bytes += fmt::format("4 {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    if (binary) put(bytes, std::uint8_t{4}), put(bytes, f);
  }
  return bytes;
}

std::string cube_stl(bool binary) {
  const Mesh mesh = cube();
  std::string bytes = binary ? std::string(80, ' ') : "solid cube\n";
  if (binary) put(bytes, std::uint32_t(mesh.triangles.size()));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 corners[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const glm::vec3 n = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (binary) {
      put(bytes, std::array{n.x, n.y, n.z});
      for (const glm::vec3& p : corners) put(bytes, std::array{p.x, p.y, p.z});
      put(bytes, std::uint16_t{0});
    } else {
      bytes += fmt::format("facet normal {} {} {}\nouter loop\n", n.x, n.y, n.z);
      for (const glm::vec3& p : corners) bytes += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
      bytes += "endloop\nendfacet\n";
    }
  }
  return binary ? bytes : bytes + "endsolid cube\n";
}

/// The cube under two nodes: one mirrored at x = 0, one moved by 10 along y inside a parent that doubles sizes.
std::string cube_gltf() {
  const Mesh mesh = cube();
  std::string bytes;
  for (const glm::vec3& p : mesh.positions) put(bytes, std::array{p.x, p.y, p.z});
  for (const glm::uvec3& t : mesh.triangles)
    put(bytes, std::array{std::uint16_t(t.x), std::uint16_t(t.y), std::uint16_t(t.z)});
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1]}}],
    "nodes":[{{"mesh":0,"scale":[-1,1,1]}},{{"scale":[2,2,2],"children":[2]}},{{"mesh":0,"translation":[0,10,0]}}],
    "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
    "buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}],
    "bufferViews":[{{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":72}}],
    "accessors":[{{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[2,2,2]}},
                 {{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}}]}})",
                     bytes.size(), base64(bytes));
}

class MeshFiles : public testing::Test {
protected:
  fs::path write(const std::string& name, const std::string& bytes) const { return folder_.write(name, bytes); }

private:
  test::TemporaryFolder folder_;
};

void expect_cube(const Mesh& mesh) {
  EXPECT_EQ(mesh.positions.size(), 8u); // joined
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(inspect(mesh).closed());
  EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, 8);
}

TEST_F(MeshFiles, ObjWithPolygonsLinesAndPoints) { expect_cube(load_mesh(write("cube.obj", cube_obj()))); }
TEST_F(MeshFiles, PlyText) { expect_cube(load_mesh(write("cube.ply", cube_ply(false)))); }
TEST_F(MeshFiles, PlyBinary) { expect_cube(load_mesh(write("cube.ply", cube_ply(true)))); }
TEST_F(MeshFiles, StlText) { expect_cube(load_mesh(write("cube.stl", cube_stl(false)))); }

TEST_F(MeshFiles, StlBinaryWithoutItsFacetNormals) {
  const Mesh mesh = load_mesh(write("cube.stl", cube_stl(true)));
  expect_cube(mesh);
  EXPECT_TRUE(mesh.normals.empty());
}

// Mirrored once (its triangles must be turned back) and, eight times as large, moved by 2 * 10.
TEST_F(MeshFiles, GltfWithNodeTransforms) {
  const Mesh mesh = load_mesh(write("cubes.gltf", cube_gltf()));
  const MeshReport report = inspect(mesh);
  EXPECT_TRUE(report.closed());
  EXPECT_DOUBLE_EQ(report.signed_volume, 8 + 64);
  glm::vec3 low(100), high(-100);
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  EXPECT_EQ(low, glm::vec3(-2, 0, 0));
  EXPECT_EQ(high, glm::vec3(4, 24, 4));
}

TEST_F(MeshFiles, KeepsNormalsAndCreases) {
  // Two triangles that share an edge: with equal normals there they share its vertices, with different ones they do
  // not.
  const std::string two = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvn 0 0.6 0.8\n";
  EXPECT_EQ(load_mesh(write("flat.obj", two + "f 1//1 2//1 3//1\nf 2//1 4//1 3//1\n")).positions.size(), 4u);
  const Mesh creased = load_mesh(write("creased.obj", two + "f 1//1 2//1 3//1\nf 2//2 4//2 3//2\n"));
  EXPECT_EQ(creased.positions.size(), 6u);
  EXPECT_EQ(inspect(creased).open_edges, 4u); // the shared edge is not open: positions decide
  EXPECT_FLOAT_EQ(creased.normals[3].y, 0.6f);
}

TEST_F(MeshFiles, MendsNormalsOnTheWrongSide) {
  const Mesh mesh =
      load_mesh(write("wrong.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nvn 0 0 0\nvn 0 3 4\nf 1//1 2//2 3//3\n"));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
  EXPECT_NEAR(glm::distance(mesh.normals[2], glm::vec3(0, 0.6, 0.8)), 0, 1e-6);
}

TEST_F(MeshFiles, IsReadNoFurtherWhereNobodyWaits) {
  std::stop_source stop;
  stop.request_stop();
  try {
    load_mesh(write("cube.obj", cube_obj()), stop.get_token());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::interrupted) << error.line();
  }
}

TEST_F(MeshFiles, BunnyIsQuickAndClosed) {
  const fs::path bunny = "/usr/share/glmark2/models/bunny.obj";
  if (!fs::exists(bunny)) GTEST_SKIP() << "glmark2-data is not installed";
  const Mesh mesh = load_mesh(bunny);
  EXPECT_EQ(mesh.triangles.size(), 69666u);
  EXPECT_EQ(mesh.positions.size(), 34835u); // Euler: V - F / 2 = 2 for a closed surface without handles
  EXPECT_TRUE(inspect(mesh).closed());
  EXPECT_GT(inspect(mesh).signed_volume, 1);
}

TEST(Inspect, CountsWhatIsWrong) {
  Mesh mesh = cube();
  mesh.triangles.pop_back();
  EXPECT_EQ(inspect(mesh).open_edges, 3u);

  mesh = cube();
  mesh.triangles.emplace_back(mesh.triangles[0].y, mesh.triangles[0].z, mesh.triangles[0].x); // the same, turned
  mesh.triangles.emplace_back(0, 1, 1);                                                       // two equal corners
  EXPECT_EQ(inspect(mesh).duplicated, 1u);
  EXPECT_EQ(inspect(mesh).degenerate, 1u);
  EXPECT_TRUE(inspect(mesh).closed());
  EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, 8);
  mesh.positions.emplace_back(3, 3, 3);
  drop_useless(mesh);
  ASSERT_EQ(mesh.triangles.size(), cube().triangles.size());
  EXPECT_EQ(mesh.positions.size(), cube().positions.size()) << "a vertex that no triangle uses";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.positions[mesh.triangles[i][k]], cube().positions[cube().triangles[i][k]]);

  mesh = cube();
  std::swap(mesh.triangles[4].y, mesh.triangles[4].z); // one triangle faces inwards
  EXPECT_EQ(inspect(mesh).crowded_edges, 3u);
  EXPECT_EQ(inspect(mesh).open_edges, 0u);

  mesh = cube();
  mesh.positions.emplace_back(3, 3, 3);
  mesh.triangles.emplace_back(0, 1, 8); // a fin: its edge 0-1 has three triangles
  EXPECT_EQ(inspect(mesh).crowded_edges, 1u);
  EXPECT_EQ(inspect(mesh).open_edges, 2u);

  EXPECT_TRUE(inspect(Mesh{}).closed());
}

// A mesh that has but moved is looked at anew: its volume, triangles without area, vertices that come together.
TEST(Inspect, OfAMeshThatMoves) {
  Mesh mesh = cube();
  EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, 8);
  for (glm::vec3& p : mesh.positions) p.y *= 0.5f;
  EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, 4);
  EXPECT_TRUE(inspect(mesh).closed());
  for (glm::vec3& p : mesh.positions) p.y = 0;
  EXPECT_GT(inspect(mesh).duplicated + inspect(mesh).degenerate, 0u);
  EXPECT_DOUBLE_EQ(inspect(cube()).signed_volume, 8);
  EXPECT_EQ(inspect(cube()).duplicated + inspect(cube()).degenerate, 0u);
}

// A sliver across the middle of an edge closes the surface between triangles of different fineness: dropping it must
// not make the mesh open.
TEST(Inspect, SliversCloseTheSurface) {
  Mesh mesh{.positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 1}},
            .triangles = {{0, 3, 2}, {2, 3, 1}, {0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {1, 3, 4}}};
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.degenerate, 1u); // 0-2-1 lie on one line
  EXPECT_TRUE(report.closed());
  EXPECT_NEAR(std::abs(report.signed_volume), 1.0 / 3, 1e-12);
}

TEST(Inspect, NeedlesAreKeptAtAnyScale) {
  for (float scale : {1e-6f, 1.0f, 1e6f}) {
    Mesh mesh{.positions = {{0, 0, 0}, {scale, 0, 0}, {scale / 2, scale * 1e-6f, 0}}, .triangles = {{0, 1, 2}}};
    EXPECT_EQ(inspect(mesh).degenerate, 0u) << scale;
    mesh.positions[2].y = scale * 1e-8f; // below the spacing of floats at that size
    EXPECT_EQ(inspect(mesh).degenerate, 1u) << scale;
  }
}

TEST(Inspect, VolumeHoldsFarFromTheOrigin) { EXPECT_DOUBLE_EQ(inspect(cube({1e6f, -2e6f, 1e6f})).signed_volume, 8); }

TEST(Inspect, TurnRoundChangesTheSign) {
  Mesh mesh = cube();
  compute_smooth_normals(mesh);
  const std::vector<glm::vec3> before = mesh.normals;
  turn_round(mesh);
  EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, -8);
  EXPECT_DOUBLE_EQ(signed_volume(mesh, 0, 12), -8);
  EXPECT_EQ(mesh.normals[3], -before[3]);
}

// At a cube's corner three squares meet at equal angles, however they are cut into triangles: the mean is the diagonal.
TEST(SmoothNormals, DoNotDependOnTheCut) {
  Mesh mesh = cube();
  compute_smooth_normals(mesh);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_LT(glm::distance(mesh.normals[i], glm::normalize(mesh.positions[i] - glm::vec3(1))), 1e-6f) << i;
}

// Edges of a cube bend by 90 degrees, those of a prism with 12 sides by 30: its sides are one surface, and its ends are
// flat.
TEST(SmoothNormals, StopAtSharpEdges) {
  Mesh sharp = cube(), round = cube();
  compute_smooth_normals(sharp, 89);
  compute_smooth_normals(round, 91);
  EXPECT_EQ(sharp.positions.size(), 24u);
  EXPECT_EQ(round.positions.size(), 8u);
  for (const glm::vec3& n : sharp.normals) EXPECT_NEAR(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1, 1e-6);
  Mesh drum{.positions = {{0, 0, 0}, {0, 1, 0}}};
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double a = std::numbers::pi / 6 * i;
    for (const float y : {0.0f, 1.0f}) drum.positions.emplace_back(std::cos(a), y, -std::sin(a));
    const std::uint32_t low = 2 + 2 * i, next = 2 + 2 * ((i + 1) % 12);
    drum.triangles.insert(drum.triangles.end(),
                          {{low, next, low + 1}, {next, next + 1, low + 1}, {0, next, low}, {1, low + 1, next + 1}});
  }
  EXPECT_GT(inspect(drum).signed_volume, 0);
  compute_smooth_normals(drum, 40);
  EXPECT_EQ(drum.positions.size(), 24u + 2 * 13);
  EXPECT_TRUE(inspect(drum).closed());
  for (std::size_t i = 0; i < drum.normals.size(); ++i) {
    const glm::vec3 n = drum.normals[i], p = drum.positions[i];
    if (std::abs(n.y) > 1e-5f) {
      EXPECT_NEAR(n.y, p.y > 0 ? 1 : -1, 1e-6);
    } else {
      EXPECT_LT(glm::distance(n, glm::vec3(p.x, 0, p.z)), 1e-5f);
    }
  }
}

TEST(SmoothNormals, AreUnitEvenWhereNothingSaysSo) {
  Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}}; // back to back, and a vertex that nobody uses
  compute_smooth_normals(mesh);
  for (const glm::vec3& n : mesh.normals) EXPECT_FLOAT_EQ(glm::length(n), 1);
  EXPECT_EQ(std::abs(mesh.normals[0].z), 1);
}

TEST(WindingNumber, InsideOutsideAndOnTheSurface) {
  const Mesh mesh = cube();
  EXPECT_NEAR(winding_number(mesh, 0, 12, {1, 1, 1}), 1, 1e-12);
  EXPECT_NEAR(winding_number(mesh, 0, 12, {1e-6, 1.3, 1.9}), 1, 1e-9);
  EXPECT_NEAR(winding_number(mesh, 0, 12, {-1e-6, 1.3, 1.9}), 0, 1e-9);
  EXPECT_NEAR(winding_number(mesh, 0, 12, {1e6, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(winding_number(mesh, 0, 2, {1, 1, 1}), 1.0 / 6, 1e-12); // one of six equal faces
}

TEST(WindingNumber, CountsNestedSurfaces) {
  Mesh mesh = cube();
  const Mesh inner = cube({0.5f, 0.5f, 0.5f}, 0.5f);
  for (const glm::vec3& p : inner.positions) mesh.positions.push_back(p);
  for (const glm::uvec3& t : inner.triangles) mesh.triangles.push_back(t + 8u);
  EXPECT_NEAR(winding_number(mesh, 0, 24, {1, 1, 1}), 2, 1e-12);
  EXPECT_NEAR(winding_number(mesh, 0, 24, {0.2, 0.2, 0.2}), 1, 1e-12);
  EXPECT_NEAR(winding_number(mesh, 12, 12, {0.2, 0.2, 0.2}), 0, 1e-12);
  EXPECT_TRUE(inspect(mesh).closed());
}

} // namespace nephroid::scene::mesh_test
