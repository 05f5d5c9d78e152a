// SPDX-License-Identifier: Apache-2.0
// What other programs write into OBJ, PLY and STL files, against values worked out in comments: places on a map, seams,
// numbers and lists in every form that their formats have.
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/support/meshes.h"
#include "tests/support/test.h"

#include <algorithm>
#include <cstring>
#include <numbers>

namespace nephroid::scene::mesh_formats_test {

class MeshFormats : public testing::Test {
protected:
  Mesh read(const std::string& name, const std::string& bytes) const { return load_mesh(folder_.write(name, bytes)); }
  std::string refusal(const std::string& name, const std::string& bytes) const {
    return test::refusal_of([&] { read(name, bytes); });
  }

private:
  test::TemporaryFolder folder_;
};

/// A tetrahedron's faces, outwards for (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1).
constexpr const char* obj_faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
constexpr const char* obj_corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

void expect_tetrahedron(const Mesh& mesh, const std::string& what) {
  EXPECT_EQ(mesh.positions.size(), 4u) << what;
  EXPECT_EQ(mesh.triangles.size(), 4u) << what;
  EXPECT_TRUE(inspect(mesh).closed()) << what;
  EXPECT_DOUBLE_EQ(inspect(mesh).signed_volume, 1 / 6.0) << what;
}

TEST_F(MeshFormats, ObjInEveryForm) {
  const std::string same[] = {
      std::string(obj_corners) + obj_faces,
      "\xef\xbb\xbf# exported\r\no a\r\nv\t0 0 0 \r\nv +1 0. .0\r\nv 0 1.0e0 0\r\nv 0 0 1E+0\r\ng b\r\nusemtl c\r\n"
      "f 1// 3// 2// \r\nf 1 2 4\r\nf 2 3 4\r\nf 3 1 4\r\n",
      std::string(obj_corners) + "vt 0 0\nf -4 -2 -3\nf 1/1 2/1 4/1\nf 2 \\\n3 \\\r\n4 # end\nf 3 1 4",
      // A fourth number divides; six are a place and a colour.
      "v 0 0 0 2\nv 2 0 0 2\nv 0 1 0 .5 .5 .5\nv 0 0 1 1\n" + std::string(obj_faces),
      "mtllib not there.mtl\n" + std::string(obj_corners) + "l 1 2\np 3\n" + obj_faces + "vp 1\ncstype bezier\n"};
  for (const std::string& text : same) expect_tetrahedron(read("t.obj", text), text);
  EXPECT_THAT(refusal("t.obj", "v -1,0 2,5 0\n"), HasSubstr("line 1: '-1,0' has a decimal comma"));
  EXPECT_THAT(refusal("t.obj", "v 0 0\nv 1 0 0\n"), HasSubstr("line 1: a coordinate is missing"));
  EXPECT_THAT(refusal("t.obj", std::string(obj_corners) + "f 1 2 x\n"),
              HasSubstr("line 5: 'x' is no index of a vertex"));
  EXPECT_THAT(refusal("t.obj", "v 0 0 0\nsurf 0 1 0 1 1 2\nend\n"), HasSubstr("free-form surfaces (surf) alone"));
}

TEST_F(MeshFormats, ALeadingDotIsANumber) {
  const Mesh mesh =
      read("d.obj", "v .5 .5 .5\nv -.5 .5 .5\nv .5 -.5 .5\nv .5 .5 -.5\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
  EXPECT_TRUE(inspect(mesh).closed());
  EXPECT_DOUBLE_EQ(std::abs(inspect(mesh).signed_volume), 1 / 6.0);
}

TEST_F(MeshFormats, EachNormalHasItsOwnVertex) {
  const Mesh mesh = read("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 2\nvn 0 .6 .8\nvn .6 0 .8\n"
                                  "f 1//1 2//1 3//1\nf 2//2 4//2 3//2\nf 2//3 4//3 3//-1\nf 2/9/2 4//2 3//2\n");
  EXPECT_EQ(mesh.positions.size(), 9u); // 3, 3 and 3: the last face uses the second one's
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_THAT(refusal("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//1\n"),
              HasSubstr("line 5: the index 2 of a normal is out of range"));
}

TEST_F(MeshFormats, PolygonsThatAreConcaveAreCutInside) {
  // An arrow's head of area 1 / 2, from each of its corners on: a fan about one of them would reach outside.
  const std::string corners = "v 0 0 0\nv 1 1 0\nv 0 .5 0\nv -1 1 0\n";
  for (const char* face : {"f 1 2 3 4\n", "f 2 3 4 1\n", "f 3 4 1 2\n", "f 4 1 2 3\n"}) {
    const Mesh mesh = read("a.obj", corners + face);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles)
      area += glm::length(
                  glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x])) /
              2;
    EXPECT_NEAR(area, 0.5, 1e-6) << face;
  }
}

std::string ply_head(const std::string& format, const std::string& number, const std::string& faces) {
  return fmt::format("ply\r\nformat {0} 1.0\ncomment c\nobj_info i\nelement vertex 4\nproperty {1} x\nproperty {1} y\n"
                     "property {1} z\nproperty uchar red\n{2}\nend_header\n",
                     format, number, faces);
}

template <class T>
void put(std::string& bytes, T value, bool reversed) {
  std::string one(reinterpret_cast<const char*>(&value), sizeof value);
  if (reversed) std::reverse(one.begin(), one.end());
  bytes += one;
}

TEST_F(MeshFormats, PlyInEveryForm) {
  const std::string corners = "0 0 0 255\n1 0 0 255\n0 1 0 255\n0 .0 1e0 255\n";
  const std::string faces = "element face 4\nproperty list uchar int vertex_index\nproperty float quality";
  expect_tetrahedron(
      read("t.ply", ply_head("ascii", "double", faces) + corners + "3 0 2 1 .5\n3 0 1 3 .5\n3 1 2 3 .5\n3 2 0 3 .5\n"),
      "text");
  // (0, 2, 1), then turned (2, 3, 1) as (1, 2, 3); after -1 (2, 0, 3) and, turned, (0, 1, 3).
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices";
  expect_tetrahedron(read("s.ply", ply_head("ascii", "float", strips) + corners + "9 0 2 1 3 -1 2 0 3 1\n"), "strips");
  for (const bool reversed : {false, true}) {
    std::string bytes = ply_head(reversed ? "binary_big_endian" : "binary_little_endian", "double", faces);
    for (const auto& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
      for (int i = 0; i < 3; ++i) put(bytes, p[i], reversed);
      bytes += '\xff';
    }
    for (const auto& t : {glm::ivec3(0, 2, 1), glm::ivec3(0, 1, 3), glm::ivec3(1, 2, 3), glm::ivec3(2, 0, 3)}) {
      bytes += '\3';
      for (int i = 0; i < 3; ++i) put(bytes, t[i], reversed);
      put(bytes, 0.5f, reversed);
    }
    expect_tetrahedron(read("b.ply", bytes), reversed ? "big-endian" : "little-endian");
  }
  EXPECT_THAT(refusal("c.ply", ply_head("ascii", "float", faces) + "0,5 0 0 255\n"), HasSubstr("decimal comma"));
  EXPECT_THAT(refusal("p.ply", ply_head("ascii", "float", "") + corners), HasSubstr("the mesh has no triangles"));
}

/// Of a square's two triangles, whose corner (1, 1) has u, v of its own in each.
void expect_texcoords(const Mesh& mesh, const std::string& what) {
  ASSERT_EQ(mesh.texcoords.size(), 2u) << what;
  EXPECT_EQ(mesh.positions.size(), 4u) << what; // a seam of the texture is none of the surface
  EXPECT_EQ(mesh.texcoords[0], (Texcoords{{{0, 0}, {0.5, 0}, {0.5, 1}}})) << what;
  EXPECT_EQ(mesh.texcoords[1], (Texcoords{{{0, 0}, {1, 1}, {0, 1}}})) << what;
}

TEST_F(MeshFormats, TexcoordsBelongToCorners) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n",
                    places = "vt 0 0\nvt .5\nvt .5 1 0\nvt 1 1 # end\nvt 0 1\n";
  const Mesh mesh = read("s.obj", square + places + "f 1/1 2/2 3/-3\nf 1/1/ 3/4 4/5\n");
  expect_texcoords(mesh, "OBJ");
  test::TemporaryFolder folder;
  write_file_whole(folder.path() / "s.ply", [&](ByteSink& to) { write_ply(mesh, to); });
  expect_texcoords(load_mesh(folder.path() / "s.ply"), "PLY that we write");
  EXPECT_THAT(read("n.obj", square + "f 1/1 2/2 3/3\n").texcoords, IsEmpty());                    // no vt
  EXPECT_EQ(read("o.obj", square + places + "f 1/1 2/2 3/6\n").texcoords.at(0)[2], glm::vec2(0)); // no such vt
  EXPECT_THAT(read("p.obj", square + places + "f 1 2 3\n").texcoords, IsEmpty());                 // no corner has one
  const Mesh late = read("l.obj", square + "f 1 2 3\n" + places + "f 1/1 3/4 4/5\n");
  EXPECT_EQ(late.texcoords.at(0)[1], glm::vec2(0));
  EXPECT_EQ(late.texcoords.at(1)[1], glm::vec2(1));
  for (const char* names : {"u v", "s t", "texture_u texture_v"}) {
    const std::string u(names, std::strchr(names, ' ')), v = std::strchr(names, ' ') + 1;
    const Mesh by_vertex = read("v.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                         "property float z\nproperty float " +
                                             u + "\nproperty float " + v +
                                             "\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
                                             "0 0 0 0 1\n1 0 0 .25 nan\n0 1 0 .5 .75\n3 0 1 2\n");
    ASSERT_EQ(by_vertex.texcoords.size(), 1u) << names;
    EXPECT_EQ(by_vertex.texcoords[0], (Texcoords{{{0, 1}, {0, 0}, {0.5, 0.75}}})) << names;
  }
}

TEST_F(MeshFormats, TexcoordsStayWithTheirTriangles) {
  Mesh mesh = read("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                            "f 1/1 2/2 2/2\nf 2/2 4/4 3/3\n");
  drop_useless(mesh);
  ASSERT_EQ(mesh.texcoords.size(), 1u);
  EXPECT_EQ(mesh.texcoords[0], (Texcoords{{{1, 0}, {1, 1}, {0, 1}}}));
  turn_round(mesh);
  EXPECT_EQ(mesh.texcoords[0], (Texcoords{{{1, 0}, {0, 1}, {1, 1}}}));
}

TEST_F(MeshFormats, StlOfManySolids) {
  std::string text;
  const char* const corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  for (const auto& t : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{2, 0, 3}}) {
    text += "solid vertex of a facet\r\nfacet normal 0 0 0\r\n\touter loop\r\n";
    for (const int corner : t) text += fmt::format("\t\tvertex {}\r\n", corners[corner]);
    text += "\tendloop\r\nendfacet\r\nendsolid vertex of a facet\r\n";
  }
  expect_tetrahedron(read("t.stl", text), "text");
  EXPECT_THAT(refusal("t.stl", text.substr(0, text.rfind("\tendloop"))), HasSubstr("ends within a facet"));
  EXPECT_THAT(refusal("c.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0 0\n"),
              HasSubstr("line 4: '0,5' has a decimal comma"));
}

/// A ball of radius 1 of latitudes and longitudes; the last meridian is the first one again, with other rounding.
std::string ball(const glm::dvec3& centre, const char* format) {
  constexpr int rings = 8, sides = 16;
  std::string text;
  for (int ring = 0; ring <= rings; ++ring)
    for (int side = 0; side <= sides; ++side) {
      const double t = std::numbers::pi * ring / rings, p = 2 * std::numbers::pi * side / sides;
      const glm::dvec3 v = centre + glm::dvec3(std::sin(t) * std::cos(p), std::cos(t), -std::sin(t) * std::sin(p));
      text += fmt::format(fmt::runtime(format), v.x, v.y, v.z);
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      const int a = ring * (sides + 1) + side + 1, b = a + sides + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
    }
  return text;
}

TEST_F(MeshFormats, ASeamThatIsOpenByRoundingIsClosed) {
  const Mesh mesh = read("ball.obj", ball({0, 0, 0}, "v {:.17g} {:.17g} {:.17g}\n"));
  EXPECT_TRUE(inspect(mesh).closed()) << inspect(mesh).open_edges;
  EXPECT_GT(inspect(mesh).signed_volume, 3.9); // 4 pi / 3 less what chords cut off
  // What is open by more than rounding stays open: a gap of a millionth of the size.
  const std::string gap = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.000001 0 0\nv 1.000001 0 0\nv 0 -1 0\nf 1 2 3\nf 4 6 5\n";
  EXPECT_EQ(inspect(read("gap.obj", gap)).open_edges, 6u);
}

// In metres of a map (UTM), where floats are 0.5 apart, to a tenth of a millimetre.
TEST_F(MeshFormats, PlacesOnAMapAreExactAboutTheMeshsMiddle) {
  const glm::dvec3 centre(500000, 104, 5400000);
  const Mesh mesh = read("ball.obj", ball(centre, "v {:.4f} {:.4f} {:.4f}\n"));
  EXPECT_EQ(mesh.middle, centre);
  EXPECT_TRUE(inspect(mesh).closed());
  for (const glm::vec3& p : mesh.positions) EXPECT_NEAR(glm::length(glm::dvec3(p)), 1, 1e-4);
}

TEST_F(MeshFormats, TheTransformTakesTheMiddleWhereItIs) {
  const test::TemporaryFolder folder;
  folder.write("ball.obj", ball({500000, 104, 5400000}, "v {:.4f} {:.4f} {:.4f}\n"));
  preset::Preset preset;
  preset.source = (folder.path() / "scene.json").string();
  preset.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset::Object object;
  object.mesh = "ball.obj";
  object.material = "glass";
  object.transform.scale = {2, 2, 2};
  object.transform.translate = {-1000000, -200, -10800000}; // twice the centre, but for 8 m of height
  preset.scene.objects.push_back(object);
  const Scene scene = load_scene(preset);
  EXPECT_NEAR(glm::distance(scene.origin, {0, 8, 0}), 0, 1e-6);
  for (const glm::vec3& p : scene.geometry.positions) EXPECT_NEAR(glm::length(glm::dvec3(p)), 2, 2e-4);
}

} // namespace nephroid::scene::mesh_formats_test
