// SPDX-License-Identifier: Apache-2.0
// The object is one closed solid, whatever its facets are; the files it is written to.
#include "inverse/bending.h"
#include "inverse/facets/files.h"
#include "inverse/facets/heights.h"
#include "inverse/facets/solid.h"
#include "tests/inverse/sound.h"

#include <nlohmann/json.hpp>
#include <regex>

namespace nephroid::solid_test {

using namespace inverse;

TEST(Solid, IsClosedWithAnySlopes) {
  for (int seed = 0; seed < 12; ++seed) {
    const Layout layout = small(23, 17);
    expect_sound(layout, make_solid(layout, random_slopes(layout, 0.7, seed)));
  }
}

// Equal heights at a corner, equal edges, and two high facets across from two low ones.
TEST(Solid, IsClosedWhereHeightsTie) {
  const Layout layout = small(8, 8);
  std::mt19937_64 random(3);
  for (int round = 0; round < 40; ++round) {
    std::vector<glm::dvec2> slopes(layout.facet_count());
    for (glm::dvec2& s : slopes)
      s = 0.2 * glm::dvec2(static_cast<int>(random() % 3) - 1, static_cast<int>(random() % 3) - 1);
    expect_sound(layout, make_solid(layout, slopes));
  }
}

TEST(Solid, IsClosedWhereHeightsNearlyTie) {
  const Layout layout = small(12, 12);
  for (int seed = 0; seed < 8; ++seed) {
    std::vector<glm::dvec2> slopes = random_slopes(layout, 1e-7 * std::pow(10, seed), seed);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] += 0.1 * glm::dvec2(i % 2, i % 3);
    expect_sound(layout, make_solid(layout, slopes));
  }
}

TEST(Solid, OfOneFacetOrOneRow) {
  for (const glm::ivec2& facets : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(2, 2)}) {
    const Layout layout = small(facets.x, facets.y);
    expect_sound(layout, make_solid(layout, random_slopes(layout, 0.3, 1)));
  }
}

TEST(Solid, FacetsHaveTheirNormals) {
  const Layout layout = small(9, 7);
  const std::vector<glm::dvec2> slopes = random_slopes(layout, 0.6, 5);
  const Solid solid = make_solid(layout, slopes);
  ASSERT_EQ(solid.parts.size(), solid.mesh.triangles.size());
  std::size_t facets = 0;
  for (std::size_t t = 0; t < solid.parts.size(); ++t) {
    const glm::uvec3 corners = solid.mesh.triangles[t];
    const glm::dvec3 a = solid.mesh.positions[corners.x], b = solid.mesh.positions[corners.y],
                     c = solid.mesh.positions[corners.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
    const Part part = solid.parts[t];
    if (part == Part::front) {
      EXPECT_GT(cross.z, 0.9999 * glm::length(cross));
    } else if (part != Part::facet) {
      EXPECT_LT(std::abs(cross.z), 1e-5 * glm::length(cross));
    }
    if (part != Part::facet) continue;
    ++facets;
    const glm::dvec2 cell = (glm::dvec2(middle.x, -middle.y) + layout.size / 2.0) / layout.facet();
    const std::size_t facet = static_cast<std::size_t>(cell.y) * 9 + static_cast<std::size_t>(cell.x);
    const glm::dvec3 normal = *inverse::facet_normal({0, 0, -1}, inverse::direction_of(slopes[facet]), layout.n);
    EXPECT_GT(glm::dot(glm::normalize(cross), normal), 1 - 1e-6) << t;
  }
  EXPECT_GE(facets, 4u * 63);
}

// Free heights against surfaces that have no walls, and against every other choice of heights; the solid stays closed.

/// The slope that has this gradient: the tilt's own, against the direction in which z rises.
glm::dvec2 slope_with(const glm::dvec2& gradient, double n) {
  const double steep = glm::length(gradient);
  return steep > 0 ? -gradient / steep * inverse::slope_behind(std::atan(steep), n) : glm::dvec2(0);
}

Layout tall(int columns, int rows) {
  Layout layout = test::small(columns, rows);
  layout.thickness = 20;
  layout.free_heights = true;
  return layout;
}

/// Of a surface z(p) with this gradient at each facet's middle.
template <class F>
std::vector<glm::dvec2> slopes_of(const Layout& layout, const F& gradient) {
  std::vector<glm::dvec2> slopes;
  for (std::size_t i = 0; i < layout.facet_count(); ++i)
    slopes.push_back(slope_with(gradient(layout.middle(i)), layout.n));
  return slopes;
}

std::vector<glm::dvec2> gradients_of(const Layout& layout, const std::vector<glm::dvec2>& slopes) {
  std::vector<glm::dvec2> gradients;
  for (const glm::dvec2& s : slopes) gradients.push_back(inverse::facet_gradient(s, layout.n));
  return gradients;
}

/// Sum over shared edges of the integral of the squared step, by Simpson's rule, which is exact for squares.
double squared_steps(const Layout& layout, const std::vector<glm::dvec2>& g, const std::vector<double>& h) {
  const auto columns = static_cast<std::size_t>(layout.facets.x);
  double sum = 0;
  const auto edge = [&](std::size_t i, std::size_t j, const glm::dvec2& along) {
    const glm::dvec2 middle = (layout.middle(i) + layout.middle(j)) / 2.0;
    const auto step = [&](double t) {
      const glm::dvec2 p = middle + t * along;
      return h[i] + glm::dot(g[i], p - layout.middle(i)) - h[j] - glm::dot(g[j], p - layout.middle(j));
    };
    sum += glm::length(along) / 6 * (step(-0.5) * step(-0.5) + 4 * step(0) * step(0) + step(0.5) * step(0.5));
  };
  for (std::size_t i = 0; i < h.size(); ++i) {
    if ((i + 1) % columns) edge(i, i + 1, {0, layout.facet().y});
    if (i + columns < h.size()) edge(i, i + columns, {layout.facet().x, 0});
  }
  return sum;
}

TEST(Heights, ATiltBehavesAsItsGradient) {
  for (const double n : {0.7, 1.5, 2.4})
    for (const glm::dvec2& g : {glm::dvec2(0.1, 0), glm::dvec2(-0.2, 0.15)}) {
      const glm::dvec2 back = inverse::facet_gradient(slope_with(g, n), n);
      EXPECT_NEAR(glm::length(back - (n > 1 ? g : -g)), 0, 1e-12) << n;
    }
}

// A plane: every facet lies in it, and there is no wall.
TEST(Heights, ATiltedPlaneHasNoWalls) {
  const Layout layout = tall(13, 9);
  const glm::dvec2 g{0.3, -0.2};
  const Solid solid = make_solid(layout, slopes_of(layout, [&](const glm::dvec2&) { return g; }));
  EXPECT_NEAR(solid.highest_wall, 0, 1e-12);
  EXPECT_NEAR(solid.relief(), 0.3 * 7 + 0.2 * 5, 1e-12);
  EXPECT_NEAR(solid.highest, solid.relief() / 2, 1e-12);
  for (std::size_t i = 0; i < layout.facet_count(); ++i)
    EXPECT_NEAR(solid.facets[i].height, glm::dot(g, layout.middle(i)), 1e-12);
  Layout flat = layout;
  flat.free_heights = false;
  EXPECT_GT(make_solid(flat, slopes_of(layout, [&](const glm::dvec2&) { return g; })).wall_area, 10);
}

// z = a x^2 / 2 + b y^2 / 2: facets that touch it in their middles, moved by a constant each, meet along their whole
// edges.
TEST(Heights, ALensIsContinuous) {
  const Layout layout = tall(24, 15);
  const double a = 0.11, b = -0.07;
  const auto slopes = slopes_of(layout, [&](const glm::dvec2& p) { return glm::dvec2(a * p.x, b * p.y); });
  const Solid solid = make_solid(layout, slopes);
  EXPECT_NEAR(solid.highest_wall, 0, 1e-12);
  const auto lens = [&](std::size_t i) {
    const glm::dvec2 p = layout.middle(i);
    return a * p.x * p.x / 2 + b * p.y * p.y / 2;
  };
  for (std::size_t i = 1; i < layout.facet_count(); ++i)
    EXPECT_NEAR(solid.facets[i].height - solid.facets[0].height, lens(i) - lens(0), 1e-12);
}

TEST(Heights, NoOthersHaveLowerWalls) {
  Layout layout = tall(17, 12);
  const auto slopes = test::random_slopes(layout, 0.4, 3);
  const auto gradients = gradients_of(layout, slopes);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const double band : {1e9, 0.5, 0.3}) { // 0.3: hardly more than a facet of 0.41 x 0.42 mm with these slopes
    layout.band = band;
    const std::vector<double> h = least_steps(layout, gradients);
    const double least = squared_steps(layout, gradients, h), half_x = layout.facet().x / 2,
                 half_y = layout.facet().y / 2;
    const auto bound = [&](std::size_t i) {
      return band - std::abs(gradients[i].x) * half_x - std::abs(gradients[i].y) * half_y;
    };
    EXPECT_LT(least, squared_steps(layout, gradients, std::vector<double>(h.size())));
    std::size_t at_bound = 0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      ASSERT_LE(std::abs(h[i]), bound(i) + 1e-12) << i;
      at_bound += std::abs(h[i]) > bound(i) - 1e-9;
      for (const double move : {-0.02, 0.02}) { // one alone
        std::vector<double> other = h;
        other[i] = std::clamp(h[i] + move, -bound(i), bound(i));
        EXPECT_GE(squared_steps(layout, gradients, other), least * (1 - 1e-6)) << i;
      }
    }
    EXPECT_EQ(at_bound > 0, band < 1);
    for (int round = 0; round < 50; ++round) { // all of them, by waves and by noise
      std::vector<double> other = h;
      const double kx = normal(random), ky = normal(random), noise = round % 2 ? 0.02 : 0;
      for (std::size_t i = 0; i < h.size(); ++i)
        other[i] = std::clamp(h[i] + 0.05 * std::cos(glm::dot({kx, ky}, layout.middle(i))) + noise * normal(random),
                              -bound(i), bound(i));
      EXPECT_GE(squared_steps(layout, gradients, other), least * (1 - 1e-6));
    }
  }
}

// A facet that is alone, and rows of them.
TEST(Heights, OfOneFacetOrOneRow) {
  for (const glm::ivec2& facets : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1)}) {
    const Layout layout = tall(facets.x, facets.y);
    const Solid solid =
        make_solid(layout, slopes_of(layout, [](const glm::dvec2& p) { return glm::dvec2(0.1, 0.05 * p.y); }));
    EXPECT_NEAR(solid.highest_wall, 0, 1e-12);
    test::expect_sound(layout, solid);
  }
}

// Heights with and without ties, and nearly with: solved ones, drawn ones and those at a bound.
TEST(Heights, TheSolidIsClosedWithAny) {
  for (int seed = 0; seed < 12; ++seed) {
    Layout layout = tall(19, 14);
    const auto slopes = test::random_slopes(layout, std::pow(10, -seed % 5) / 2, seed);
    if (seed % 2) layout.band = 0.6;
    test::expect_sound(layout, make_solid(layout, slopes));
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::vector<double> heights;
    for (std::size_t i = 0; i < layout.facet_count(); ++i)
      heights.push_back(static_cast<double>(random() % 4) * 0.5 + 1e-6 * static_cast<double>(random() % 3));
    test::expect_sound(layout, make_solid(layout, slopes, heights));
  }
}

// Flat heights are no solve: the same mesh as that of heights of 0.
TEST(Heights, FlatOnesAreZero) {
  Layout layout = tall(11, 8);
  layout.free_heights = false;
  const auto slopes = test::random_slopes(layout, 0.5, 9);
  const Solid none = make_solid(layout, slopes), zeros = make_solid(layout, slopes, std::vector<double>(slopes.size()));
  EXPECT_EQ(none.mesh.positions, zeros.mesh.positions);
  EXPECT_EQ(none.mesh.triangles, zeros.mesh.triangles);
  EXPECT_EQ(inverse::heights_of(layout, slopes), std::vector<double>(slopes.size()));
}

// The files for a workshop: the solid as independent readers find it (Assimp, behind load_mesh; admesh, which checks
// STL as slicers do and without which that test is skipped), facets, height map, page.

std::string text_of(const std::function<void(ByteSink&)>& write) {
  ByteStore store;
  write(store);
  return {reinterpret_cast<const char*>(store.bytes().data()), store.bytes().size()};
}

class InverseFiles : public testing::Test {
protected:
  test::TemporaryFolder folder;
  Layout layout = test::small(15, 11);
  Solid solid = make_solid(layout, test::random_slopes(layout, 0.5, 2));

  fs::path written(const char* name, const std::function<void(ByteSink&)>& write) const {
    write_file_whole(folder.path() / name, write);
    return folder.path() / name;
  }
};

TEST_F(InverseFiles, MeshesAreReadByOthers) {
  const auto obj = written("object.obj", [&](ByteSink&to) { inverse::write_obj(solid.mesh, to); }),
             stl = written("object.stl", [&](ByteSink&to) { inverse::write_stl(solid.mesh, to); }),
             ply = written("object.ply", [&](ByteSink&to) { scene::write_ply(solid.mesh, to, inverse::mesh_title); });
  for (const auto& file : {obj, stl, ply}) {
    const scene::Mesh mesh = scene::load_mesh(file);
    EXPECT_EQ(mesh.triangles.size(), solid.mesh.triangles.size()) << file;
    test::expect_sound(mesh, test::volume_of(layout, solid));
  }
}

// What admesh counts before and after its repairs: nothing to repair, one part, the volume of the slab in which the
// facets' middles lie.
TEST_F(InverseFiles, AMeshRepairerFindsNothingToRepair) {
  if (std::system("admesh --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the package admesh";
  const auto stl = written("object.stl", [&](ByteSink& to) { inverse::write_stl(solid.mesh, to); });
  const auto said = folder.path() / "said";
  ASSERT_EQ(std::system(("admesh '" + stl.string() + "' > '" + said.string() + "'").c_str()), 0);
  const std::string report = read_file(said);
  const auto figure = [&](const std::string& what) {
    std::smatch found;
    return std::regex_search(report, found, std::regex(what + R"( *: *(-?[0-9.]+))")) ? std::stod(found[1])
                                                                                      : std::nan("");
  };
  EXPECT_EQ(figure("Number of facets"), static_cast<double>(solid.mesh.triangles.size())) << report;
  EXPECT_EQ(figure("Number of parts"), 1) << report;
  for (const char* fault : {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed",
                            "Facets added", "Facets reversed", "Backwards edges", "Normals fixed"})
    EXPECT_EQ(figure(fault), 0) << fault << "\n" << report;
  EXPECT_NEAR(figure("Volume"), layout.size.x * layout.size.y * layout.thickness, 1e-3) << report;
}

TEST_F(InverseFiles, FacetsAreListedWithTheirPlanes) {
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

// One facet that rises by 0.2 mm a mm along x over 7 mm. Who looks at it from its own side has +x at the left; the
// object is thin there.
TEST_F(InverseFiles, TheHeightMapIsSeenFromTheFacets) {
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
  EXPECT_THAT(map.attributes.at("ImageDescription"),
              HasSubstr("thickness in mm; a pixel is 0.00683594 x 0.00683995 mm"));
}

TEST_F(InverseFiles, TheHeightMapsAgree) {
  const image::Image exr =
                         image::read_image(written("h.exr", [&](ByteSink&to) { write_height_exr(layout, solid, to); })),
                     png =
                         image::read_image(written("h.png", [&](ByteSink&to) { write_height_png(layout, solid, to); }));
  EXPECT_EQ(exr.channels, std::vector<std::string>{"Y"});
  ASSERT_EQ(exr.data.size(), png.data.size());
  const double step = solid.relief() / 65535, thinnest = layout.thickness - solid.highest;
  for (std::size_t i = 0; i < exr.data.size(); ++i)
    ASSERT_NEAR(thinnest + step * std::round(static_cast<double>(png.data[i]) * 65535), exr.data[i], 0.51 * step) << i;
  EXPECT_THAT(png.attributes.at("ImageDescription"), HasSubstr("thickness in mm ="));
  // The middle of the second pixel row of the last facet of the first row, which is the first seen from the facets.
  const int across = exr.width / 15;
  const inverse::Facet& f = solid.facets[14];
  const glm::dvec2 from_middle =
      layout.facet() / 2.0 - glm::dvec2(0.5 * layout.facet().x / across, 1.5 * layout.size.y / exr.height);
  EXPECT_NEAR(exr.data[static_cast<std::size_t>(exr.width)], 3 - f.height - glm::dot(f.gradient, from_middle), 1e-6);
}

// Two facets of 3.5 x 5 mm that fall towards each other by g: corners at +-1.75 g, no wall between them. The other way
// round they have none either; both falling to the right, the wall is 2 * 1.75 g high and 5 mm long.
TEST_F(InverseFiles, ThePageHasTheFigures) {
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
TEST_F(InverseFiles, AWallHasTwoPartsWhereEdgesCross) {
  layout.facets = {2, 1};
  solid = make_solid(layout, {{0, 0.1}, {0, -0.1}});
  const double g = std::abs(solid.facets[0].gradient.y);
  EXPECT_NEAR(solid.wall_area, 2 * 0.5 * 2.5 * 5 * g, 1e-12);
  EXPECT_NEAR(solid.highest_wall, 5 * g, 1e-12);
}

} // namespace nephroid::solid_test
