// SPDX-License-Identifier: Apache-2.0
// What a workshop cuts from: files of solids that other programs read, and the sheet.
#include "inverse/describe_settings.h"
#include "inverse/facets/files.h"
#include "inverse/facets/smooth_solid.h"
#include "inverse/job.h"
#include "inverse/step/step.h"
#include "preset/read.h"
#include "tests/inverse/sound.h"
#include "tests/support/render.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <array>
#include <cstdio>

namespace nephroid::stock_test {

using namespace inverse;
using inverse::Layout;

bool has_step() {
  try {
    require_step("step");
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::string output_of(const std::string& command) {
  std::string said;
  std::array<char, 4096> piece{};
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), pipe)) said.append(piece.data(), got);
  EXPECT_EQ(::pclose(pipe), 0) << said;
  return said;
}

double volume_of_mesh(const scene::Mesh& mesh) {
  return scene::signed_volume(mesh, 0, static_cast<std::uint32_t>(mesh.triangles.size()));
}

/// Facets as a search leaves them: some heights tie, some corners have four heights.
Solid some_solid(Layout layout, double draft_deg = 0) {
  layout.draft = std::tan(glm::radians(draft_deg));
  std::vector<glm::dvec2> slopes = test::random_slopes(layout, 0.4, 3);
  for (std::size_t i = 0; i < slopes.size(); i += 3) slopes[i] = glm::dvec2(0.1, 0);
  return make_solid(layout, slopes);
}

Surface some_surface(const glm::dvec2& size) {
  Grid heights(9, 13);
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 13; ++column)
      heights(row, column) = 0.3 * std::sin(0.7 * column) * std::cos(0.5 * row) + 0.02 * column;
  return Surface(size, heights);
}

// By Assimp and by Python's own zip and XML: millimetres, every edge between two triangles, the volume.
TEST(ThreeMf, IsReadByOthersAsTheClosedObject) {
  const test::TemporaryFolder folder;
  const Layout layout = test::small(15, 11);
  for (const double draft : {0.0, 5.0}) {
    const Solid solid = some_solid(layout, draft);
    const fs::path file = folder.path() / "object.3mf";
    write_file_whole(file, [&](ByteSink& to) { write_3mf(solid.mesh, to); });
    EXPECT_NEAR(volume_of_mesh(scene::load_mesh(file)) / volume_of_mesh(solid.mesh), 1, 1e-6);
    const std::string script = folder.write("read.py", R"(
import sys, zipfile, collections
import xml.etree.ElementTree as xml
archive = zipfile.ZipFile(sys.argv[1])
assert archive.testzip() is None
assert archive.namelist() == ['[Content_Types].xml', '_rels/.rels', '3D/3dmodel.model']
for name in archive.namelist(): xml.fromstring(archive.read(name))
space = '{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}'
model = xml.fromstring(archive.read('3D/3dmodel.model'))
assert model.get('unit') == 'millimeter'
v = [tuple(float(p.get(k)) for k in 'xyz') for p in model.iter(space + 'vertex')]
t = [tuple(int(p.get(k)) for k in ('v1', 'v2', 'v3')) for p in model.iter(space + 'triangle')]
edges = collections.Counter((f[i], f[(i + 1) % 3]) for f in t for i in range(3))
assert all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items())
det = lambda a, b, c: (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                       + a[2] * (b[0] * c[1] - b[1] * c[0]))
print(len(v), len(t), sum(det(*(v[i] for i in f)) for f in t) / 6)
)");
    std::istringstream said(output_of("python3 '" + script + "' '" + file.string() + "' 2>&1"));
    std::size_t vertices = 0, triangles = 0;
    double volume = 0;
    said >> vertices >> triangles >> volume;
    EXPECT_EQ(vertices, solid.mesh.positions.size());
    EXPECT_EQ(triangles, solid.mesh.triangles.size());
    EXPECT_NEAR(volume / volume_of_mesh(solid.mesh), 1, 1e-6);
  }
}

// Each facet is one face in its plane; all faces close, and have the mesh's volume. By the faces themselves, without
// OpenCascade: the sum of their cones from the origin.
TEST(Step, FacesAreThePlanesOfTheSolid) {
  const Layout layout = test::small(15, 11);
  for (const double draft : {0.0, 5.0}) {
    const Solid solid = some_solid(layout, draft);
    const StepSolid step = step_faces(layout, solid);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
    double volume = 0, off = 0;
    std::size_t facets = 0;
    for (const StepFace& face : step.faces) {
      glm::dvec3 area(0);
      for (std::size_t i = 0; i < face.ring.size(); ++i) {
        const std::uint32_t a = face.ring[i], b = face.ring[(i + 1) % face.ring.size()];
        ++passed[{a, b}];
        area += glm::cross(step.vertices[a], step.vertices[b]) / 2.0;
        off = std::max(off, std::abs(glm::dot(step.vertices[a] - face.at, face.normal)));
      }
      volume += glm::dot(face.at, face.normal) * glm::dot(area, face.normal) / 3;
      EXPECT_GT(glm::dot(area, face.normal), 0);
      facets += face.normal.z < -0.5 && face.ring.size() >= 4;
    }
    for (const auto& [edge, count] : passed) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(passed.count({edge.second, edge.first}), 1u);
    }
    EXPECT_NEAR(volume / volume_of_mesh(solid.mesh), 1, 1e-6);
    EXPECT_LT(off, 3 * corners_join * std::min(layout.facet().x, layout.facet().y));
    EXPECT_GE(facets, layout.facet_count());
  }
}

TEST(Step, OfFacetsIsReadBackWithItsVolume) {
  if (!has_step()) GTEST_SKIP() << "built without OpenCascade";
  const Layout layout = test::small(15, 11);
  for (const double draft : {0.0, 5.0}) {
    const Solid solid = some_solid(layout, draft);
    const StepFile file = step_file(layout, solid, "a test");
    EXPECT_NEAR(file.volume / volume_of_mesh(solid.mesh), 1, 1e-6);
    EXPECT_EQ(file.faces, step_faces(layout, solid).faces.size());
    EXPECT_THAT(file.bytes, HasSubstr("AUTOMOTIVE_DESIGN")); // AP214
    EXPECT_THAT(file.bytes, HasSubstr("SI_UNIT(.MILLI.,.METRE.)"));
    EXPECT_THAT(file.bytes, HasSubstr("MANIFOLD_SOLID_BREP"));
  }
}

TEST(Step, OfALensIsItsSurface) {
  if (!has_step()) GTEST_SKIP() << "built without OpenCascade";
  Layout layout{.size = {12, 8}, .thickness = 3, .facets = {12, 8}};
  const Surface surface = some_surface(layout.size);
  for (const bool round : {false, true}) {
    layout.round = round;
    const Solid solid = make_smooth_solid(layout, surface, std::vector<int>(layout.facet_count(), 16));
    const StepFile file = step_file(layout, solid, "a lens");
    EXPECT_EQ(file.faces, round ? 3u : 6u);
    EXPECT_THAT(file.bytes, HasSubstr("B_SPLINE_SURFACE"));
    EXPECT_NEAR(file.volume / volume_of_mesh(solid.mesh), 1, round ? 1e-3 : 1e-5); // the mesh has a polygon's outline
  }
}

class Stock : public testing::Test {
protected:
  static preset::Preset with(const std::string& fields) {
    return preset::parse_preset(
        R"({"engine": "inverse", "unit": "mm", "inverse": {"facets": [24, 24], "cells": [12, 12],
      "receivers": [{"distance_mm": 150, "picture": {"type": "disc"}}])" +
            fields + R"(}, "stop": {"passes": 2}})",
        "stock.json");
  }
  static job::Snapshot design(const std::string& fields) {
    const preset::Preset p = with(fields);
    const inverse::InversePlan plan = make_plan(p);
    const auto job = make_job(p, plan, test::shared_context());
    while (!job->finished()) job->advance();
    return job->snapshot();
  }
  static scene::Mesh mesh_of(const job::Snapshot& made) {
    const test::TemporaryFolder folder;
    for (const job::ExtraFile& file : made.files)
      if (file.name == "object.ply") write_file_whole(folder.path() / "o.ply", file.write);
    return scene::load_mesh(folder.path() / "o.ply");
  }
  static std::string refusal(const std::string& fields) {
    return test::refusal_of([&] { make_plan(with(fields)); });
  }
};

// From the highest point of the relief to the front the object is as thick as the sheet, whatever the light is.
TEST_F(Stock, IsAsThickAsTheObject) {
  for (const char* more :
       {"", R"(, "heights": "free")", R"(, "draft_deg": 3)",
        R"(, "kind": "mirror", "light": {"type": "parallel", "tilt_deg": 20})",
        R"(, "light": {"type": "parallel", "tilt_deg": 10})", R"(, "light": {"type": "point", "distance_mm": 300})",
        R"(, "method": "lens")", R"(, "method": "lens", "outline": "round")"}) {
    const bool is_lens = std::string_view(more).find("lens") != std::string_view::npos; // it is deeper than facets
    const double sheet = is_lens ? 25.4 : 12.7;
    const scene::Mesh mesh = mesh_of(design(fmt::format(R"(, "stock_mm": {})", sheet) + more));
    float low = 1e9f, high = -1e9f;
    for (const glm::vec3& p : mesh.positions) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
    EXPECT_NEAR(high - low, sheet, 1e-4) << more;
  }
}

// Light straight on comes the same way through more glass: the same pictures to the rays' noise.
TEST_F(Stock, ChangesNoPictureOfLightStraightOn) {
  const double thick = job::scalar(design(R"(, "thickness_mm": 12)"), "judged", "rel_l2");
  EXPECT_NEAR(job::scalar(design(R"(, "stock_mm": 12)"), "judged", "rel_l2"), thick, 2e-3);
}

// A lamp's facets are bent for where the front is in the end.
TEST_F(Stock, OfALampCastsAsWell) {
  const std::string lamp = R"(, "light": {"type": "point", "distance_mm": 150})";
  const double thick = job::scalar(design(R"(, "thickness_mm": 12)" + lamp), "judged", "rel_l2");
  EXPECT_NEAR(job::scalar(design(R"(, "stock_mm": 12)" + lamp), "judged", "rel_l2"), thick, 0.02);
}

TEST_F(Stock, IsRefusedWhereTheReliefDoesNotFit) {
  EXPECT_THAT(refusal(R"(, "stock_mm": 12, "thickness_mm": 9)"),
              AllOf(HasSubstr("/inverse/stock_mm: is 12 mm, and thickness_mm is 9 mm"), HasSubstr("remove")));
  EXPECT_THAT(refusal(R"(, "stock_mm": 0.1)"),
              AllOf(HasSubstr("/inverse/stock_mm: lets facets"), HasSubstr("expected room for a relief of at least")));
  EXPECT_THAT(refusal(R"(, "stock_mm": 5, "min_thickness_mm": 5)"),
              AllOf(HasSubstr("/inverse/min_thickness_mm: is 5 mm, and the sheet is 5 mm thick"),
                    HasSubstr("choose a thicker sheet")));
  EXPECT_THAT(refusal(R"(, "stock_mm": 5, "min_thickness_mm": 4.9)"), HasSubstr("/inverse/stock_mm: lets facets"));
}

} // namespace nephroid::stock_test
