// SPDX-License-Identifier: Apache-2.0
// The files for a workshop: the solid as independent readers find it (Assimp, behind load_mesh; admesh, which checks STL as slicers do and
// without which that test is skipped), facets, height map, page.
#include "base/files.h"
#include "image/image.h"
#include "inverse/bending.h"
#include "inverse/facets/files.h"
#include "tests/inverse/sound.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <regex>

namespace nephroid::files_test {

using namespace inverse;

std::string text_of(const std::function<void(ByteSink&)>& write)
{
  ByteStore store;
  write(store);
  return {reinterpret_cast<const char*>(store.bytes().data()), store.bytes().size()};
}

class InverseFiles : public testing::Test {
protected:
  test::TemporaryFolder folder;
  Layout layout = test::small(15, 11);
  Solid solid = make_solid(layout, test::random_slopes(layout, 0.5, 2));

  std::filesystem::path written(const char* name, const std::function<void(ByteSink&)>& write) const
  {
    write_file_whole(folder.path() / name, write);
    return folder.path() / name;
  }
};

TEST_F(InverseFiles, MeshesAreReadByOthers)
{
  const auto obj = written("object.obj", [&](ByteSink&to) { inverse::write_obj(solid.mesh, to); }),
             stl = written("object.stl", [&](ByteSink&to) { inverse::write_stl(solid.mesh, to); }),
             ply = written("object.ply", [&](ByteSink&to) { inverse::write_ply(solid.mesh, to); });
  for (const auto& file : {obj, stl, ply}) {
    const scene::Mesh mesh = scene::load_mesh(file);
    EXPECT_EQ(mesh.triangles.size(), solid.mesh.triangles.size()) << file;
    test::expect_sound(mesh, test::volume_of(layout, solid));
  }
}

// What admesh counts before and after its repairs: nothing to repair, one part, the volume of the slab in which the facets' middles lie.
TEST_F(InverseFiles, AMeshRepairerFindsNothingToRepair)
{
  if (std::system("admesh --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the package admesh";
  const auto stl = written("object.stl", [&](ByteSink& to) { inverse::write_stl(solid.mesh, to); });
  const auto said = folder.path() / "said";
  ASSERT_EQ(std::system(("admesh '" + stl.string() + "' > '" + said.string() + "'").c_str()), 0);
  const std::string report = read_file(said);
  const auto figure = [&](const std::string& what) {
    std::smatch found;
    return std::regex_search(report, found, std::regex(what + R"( *: *(-?[0-9.]+))")) ? std::stod(found[1]) : std::nan("");
  };
  EXPECT_EQ(figure("Number of facets"), static_cast<double>(solid.mesh.triangles.size())) << report;
  EXPECT_EQ(figure("Number of parts"), 1) << report;
  for (const char* fault : {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
                            "Facets reversed", "Backwards edges", "Normals fixed"})
    EXPECT_EQ(figure(fault), 0) << fault << "\n" << report;
  EXPECT_NEAR(figure("Volume"), layout.size.x * layout.size.y * layout.thickness, 1e-3) << report;
}

TEST_F(InverseFiles, FacetsAreListedWithTheirPlanes)
{
  const auto list = nlohmann::json::parse(text_of([&](ByteSink& to) { write_facets(layout, solid, to); }));
  EXPECT_EQ(list.at("columns"), 15);
  EXPECT_EQ(list.at("rows"), 11);
  ASSERT_EQ(list.at("facets").size(), solid.facets.size());
  for (std::size_t i = 0; i < solid.facets.size(); ++i) {
    const std::vector<double> f = list.at("facets")[i];
    const glm::dvec3 normal = glm::normalize(glm::dvec3(f[2], f[3], -1)), out = inverse::direction_of({f[0], f[1]});
    EXPECT_NEAR(glm::length(glm::refract(glm::dvec3(0, 0, -1), -normal, layout.n) - out), 0, 1e-5); // GLSL's own
    EXPECT_NEAR(f[4], solid.facets[i].height, 1e-6);
  }
}

// One facet that rises by 0.2 mm a mm along x over 7 mm. Who looks at it from its own side has +x at the left; the object is thin there.
TEST_F(InverseFiles, TheHeightMapIsSeenFromTheFacets)
{
  layout.facets = {1, 1};
  const double g = 0.2, slope = -0.1076; // near enough for a rise: its own gradient is asked for below
  solid = make_solid(layout, {{slope, 0}});
  const double rise = solid.facets[0].gradient.x;
  EXPECT_NEAR(rise, g, 0.02);
  const image::Image map = height_map(layout, solid);
  ASSERT_EQ(map.width, 1024);
  const double pixel = 7.0 / 1024;
  EXPECT_NEAR(map.data[0], 3 - rise * (3.5 - pixel / 2), 1e-6);
  EXPECT_NEAR(map.data[1023], 3 + rise * (3.5 - pixel / 2), 1e-6);
  EXPECT_THAT(map.attributes.at("ImageDescription"), HasSubstr("thickness in mm; a pixel is 0.00683594 x 0.00488281 mm"));
}

TEST_F(InverseFiles, TheHeightMapsAgree)
{
  const image::Image exr = image::read_image(written("h.exr", [&](ByteSink&to) { write_height_exr(layout, solid, to); })),
                     png = image::read_image(written("h.png", [&](ByteSink&to) { write_height_png(layout, solid, to); }));
  EXPECT_EQ(exr.channels, std::vector<std::string>{"Y"});
  ASSERT_EQ(exr.data.size(), png.data.size());
  const double step = solid.relief() / 65535, thinnest = layout.thickness - solid.highest;
  for (std::size_t i = 0; i < exr.data.size(); ++i)
    ASSERT_NEAR(thinnest + step * std::round(static_cast<double>(png.data[i]) * 65535), exr.data[i], 0.51 * step) << i;
  EXPECT_THAT(png.attributes.at("ImageDescription"), HasSubstr("thickness in mm ="));
  // The middle of the second pixel row of the last facet of the first row, which is the first seen from the facets.
  const int across = exr.width / 15;
  const inverse::Facet& f = solid.facets[14];
  const glm::dvec2 from_middle = layout.facet() * glm::dvec2(0.5 - 0.5 / across, 0.5 - 1.5 / across);
  EXPECT_NEAR(exr.data[static_cast<std::size_t>(exr.width)], 3 - f.height - glm::dot(f.gradient, from_middle), 1e-6);
}

// Two facets of 3.5 x 5 mm that fall towards each other by g: corners at +-1.75 g, no wall between them. The other way round they have
// none either; both falling to the right, the wall is 2 * 1.75 g high and 5 mm long.
TEST_F(InverseFiles, ThePageHasTheFigures)
{
  layout.facets = {2, 1};
  solid = make_solid(layout, {{0.1, 0}, {-0.1, 0}});
  EXPECT_EQ(solid.highest_wall, 0);
  solid = make_solid(layout, {{0.1, 0}, {0.1, 0}});
  const double g = std::abs(solid.facets[0].gradient.x);
  EXPECT_NEAR(solid.highest_wall, 3.5 * g, 1e-12);
  EXPECT_NEAR(solid.wall_area, 3.5 * g * 5, 1e-12);
  EXPECT_NEAR(solid.relief(), 3.5 * g, 1e-12);
  EXPECT_NEAR(solid.steepest_deg, std::atan(g) * 180 / 3.141592653589793, 1e-9);
  const std::string page = workshop_page(layout, solid, "PMMA");
  EXPECT_THAT(page, HasSubstr("| width x height | 7 x 5 mm |"));
  EXPECT_THAT(page, HasSubstr("| volume | 0.105 cm3 |")); // 7 x 5 x 3 mm
  EXPECT_THAT(page, HasSubstr("| material | PMMA |"));
  EXPECT_THAT(page, HasSubstr("| smallest facet | 3.5 x 5 mm"));
  EXPECT_THAT(page, HasSubstr(fmt::format("| smallest thickness | {:.4g} mm |", 3 - 1.75 * g)));
  EXPECT_THAT(page, HasSubstr(fmt::format("| depth of the relief | {:.4g} mm |", 3.5 * g)));
}

// Facets whose edges cross in the middle: two triangles of half the edge's length.
TEST_F(InverseFiles, AWallHasTwoPartsWhereEdgesCross)
{
  layout.facets = {2, 1};
  solid = make_solid(layout, {{0, 0.1}, {0, -0.1}});
  const double g = std::abs(solid.facets[0].gradient.y);
  EXPECT_NEAR(solid.wall_area, 2 * 0.5 * 2.5 * 5 * g, 1e-12);
  EXPECT_NEAR(solid.highest_wall, 5 * g, 1e-12);
}

} // namespace nephroid::files_test
