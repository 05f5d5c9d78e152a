// SPDX-License-Identifier: Apache-2.0
// Stones of GemCad: volumes and facets against closed forms, which way indices turn, what is refused; and the convex
// bodies that they are made of.
#include "formats/import/convex.h"
#include "scene/mesh.h"
#include "tests/import/imports_scenes.h"

#include <numbers>
#include <random>

namespace nephroid::gemcad_import_test {

using std::numbers::pi;

double sin_deg(double angle) { return std::sin(angle * pi / 180); }
double cos_deg(double angle) { return std::cos(angle * pi / 180); }
double tan_deg(double angle) { return std::tan(angle * pi / 180); }

const std::string head = "GemCad 5.0\ng 96 0.0\ny 4 n\nI 1.54\nH A stone\n";
const std::string cube = head + "a 90.0 1.0 96 n S 24 48 72\na 0.0 1.0 96 n T\na -0.0 1.0 96 n C G Cut\nF end\n";

class GemcadImport : public test::ImportsScenes {
protected:
  preset::Preset imported(const std::string& text) { return ImportsScenes::imported(text, "in.asc"); }
  /// The first object's mesh, in mm.
  scene::Mesh stone(const std::string& text) {
    return scene::load_mesh(folder.path() / *imported(text).scene.objects.at(0).mesh);
  }
  std::string refusal(const std::string& text) {
    const std::string line = test::refusal_of([&] { imported(text); });
    EXPECT_FALSE(fs::exists(folder.path() / "out.json"));
    EXPECT_THAT(line, AllOf(HasSubstr("in.asc"), Not(HasSubstr("\n"))));
    return line;
  }
};

glm::dvec3 normal_of(const scene::Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::normalize(glm::cross(b - a, c - a));
}

/// Different normals, as far as single precision tells.
std::vector<glm::dvec3> facets_of(const scene::Mesh& mesh) {
  std::vector<glm::dvec3> facets;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 n = normal_of(mesh, t);
    if (std::ranges::none_of(facets, [&](const glm::dvec3& known) { return glm::length(known - n) < 1e-3; }))
      facets.push_back(n);
  }
  return facets;
}

/// How many facets are so many degrees from the table's plane; below 0: of the pavilion.
std::ptrdiff_t facets_at(const std::vector<glm::dvec3>& facets, double angle_deg) {
  const double up = std::copysign(cos_deg(angle_deg), angle_deg);
  return std::ranges::count_if(facets, [&](const glm::dvec3& n) { return std::abs(n.y - up) < 2e-4; });
}

// 10 mm across, whatever the file's lengths are.
TEST_F(GemcadImport, ACubeHasItsVolume) {
  const scene::Mesh mesh = stone(cube);
  const scene::MeshReport report = scene::inspect(mesh);
  EXPECT_TRUE(report.closed());
  EXPECT_NEAR(report.signed_volume, 1000, 1e-3);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_THAT(made.notes, ElementsAre(HasSubstr("the stone is 10 mm across, 5 times the file's lengths")));
}

TEST_F(GemcadImport, ThePresetHasTheStoneAboveATableWithALampAndACamera) {
  const preset::Preset p = imported(cube);
  EXPECT_EQ(p.unit, preset::Preset::Unit::mm);
  ASSERT_EQ(p.scene.objects.size(), 2u);
  EXPECT_EQ(material_of(p, 0).type, preset::Material::Type::dielectric);
  EXPECT_EQ(material_of(p, 0).dispersion.n, 1.54);
  EXPECT_EQ(material_of(p, 1).type, preset::Material::Type::diffuse);
  EXPECT_EQ(p.scene.lights.size(), 1u);
  EXPECT_FALSE(p.scene.environment.value().lights);
  EXPECT_NEAR(p.scene.objects[0].transform.translate[1], 5 + 1.5, 1e-9); // its centre, 1.5 mm above half its height
  EXPECT_GT(p.scene.camera.position[1], 10);
  // 100 mW in a cone of 75 degrees, 4.66 sr, 57 mm away: 6.6 W/m^2, of which the eye takes about a third; over pi.
  EXPECT_NEAR(*p.white, 0.7, 0.15);
}

// An octagon about a circle of radius 1 has the area 8 tan 22.5. Above and below it are a frustum and a pyramid.
TEST_F(GemcadImport, ASingleCutHasItsVolume) {
  constexpr double crown = 34.5, pavilion = 40.75, half_girdle = 0.03, table = 0.6;
  const double height = (1 - table) * tan_deg(crown), area = 8 * tan_deg(22.5);
  const std::string all = " 96 12 24 36 48 60 72 84\n";
  const scene::Mesh mesh =
      stone(head + fmt::format("a -{} {:.12f}{}", pavilion, sin_deg(pavilion) + cos_deg(pavilion) * half_girdle, all) +
            "a 90 1" + all + fmt::format("a {} {:.12f}{}", crown, sin_deg(crown) + cos_deg(crown) * half_girdle, all) +
            fmt::format("a 0 {:.12f} 96\n", half_girdle + height));
  const double volume =
      area * (tan_deg(pavilion) / 3 + 2 * half_girdle + height * (1 + table + table * table) / 3) * 5 * 5 * 5;
  EXPECT_NEAR(scene::inspect(mesh).signed_volume, volume, 1e-5 * volume);
  const std::vector<glm::dvec3> facets = facets_of(mesh);
  EXPECT_EQ(facets.size(), 25u);
  EXPECT_EQ(facets_at(facets, crown), 8);
  EXPECT_EQ(facets_at(facets, -pavilion), 8);
}

// The mains pass through the girdle's corners, the breaks through its edges, the stars through the table's corners:
// distance = sin a r + cos a z of a point r from the axis and z high.
TEST_F(GemcadImport, ARoundBrilliantHasItsFacets) {
  constexpr double g = 0.02, table = 0.56;
  const double corner = 1 / cos_deg(11.25);
  const auto through = [](double angle, double r, double z) { return sin_deg(angle) * r + cos_deg(angle) * z; };
  const double main = through(34.5, corner, g), top = (main - sin_deg(34.5) * table) / cos_deg(34.5);
  const std::string mains = " 96 12 24 36 48 60 72 84\n", stars = " 6 18 30 42 54 66 78 90\n",
                    breaks = " 3 n 2 9 15 21 27 33 39 45\n51 57 63 69 n n 75 81 87 93 G as n G\n";
  const scene::Mesh mesh =
      stone(head + fmt::format("a -40.75 {:.8f}{}", through(40.75, corner, g), mains) +
            fmt::format("a -42 {:.8f}{}", through(42, 1, g), breaks) + "a 90 1" + breaks +
            fmt::format("a 34.5 {:.8f}{}", main, mains) + fmt::format("a 40 {:.8f}{}", through(40, 1, g), breaks) +
            fmt::format("a 22 {:.8f}{}", through(22, table * cos_deg(22.5), top), stars) +
            fmt::format("a 0 {:.8f} 96\n", top));
  EXPECT_TRUE(scene::inspect(mesh).closed());
  EXPECT_EQ(2 * mesh.positions.size() - mesh.triangles.size(), 4u); // corners - edges + triangles = 2
  const std::vector<glm::dvec3> facets = facets_of(mesh);
  EXPECT_EQ(facets.size(), 73u);
  EXPECT_EQ(facets_at(facets, -40.75), 8);
  EXPECT_EQ(facets_at(facets, -42), 16);
  EXPECT_EQ(facets_at(facets, 90), 16);
  EXPECT_EQ(facets_at(facets, 34.5), 8);
  EXPECT_EQ(facets_at(facets, 40), 16);
  EXPECT_EQ(facets_at(facets, 22), 8);
  EXPECT_EQ(facets_at(facets, 0), 1);
  EXPECT_EQ(made.notes.size(), 1u); // no facet cuts nothing
}

// Index 0 looks along +x. A quarter of the gear further is -z, which is counterclockwise seen from above.
TEST_F(GemcadImport, IndicesTurnCounterclockwiseSeenFromTheTable) {
  const auto side = [&](const std::string& gear, const std::string& index) {
    std::string text = cube + "a 45 1.2 " + index + "\n";
    text.replace(text.find("g 96 0.0"), 8, gear);
    for (const glm::dvec3& n : facets_of(stone(text)))
      if (std::abs(n.y - std::sqrt(0.5)) < 1e-5) return n / std::sqrt(0.5);
    return glm::dvec3(0);
  };
  const auto is = [](double x, double z) {
    return [=](const glm::dvec3& n) { return std::hypot(n.x - x, n.z - z) < 1e-5; };
  };
  EXPECT_PRED1(is(1, 0), side("g 96 0.0", "96"));
  EXPECT_PRED1(is(0, -1), side("g 96 0.0", "24"));
  EXPECT_PRED1(is(0, 1), side("g -96 0.0", "24"));
  EXPECT_PRED1(is(0, -1), side("g 96 24", "0"));
  EXPECT_PRED1(is(cos_deg(11.25 / 2), -sin_deg(11.25 / 2)), side("g96", "1.5"));
}

TEST_F(GemcadImport, ACuletIsAFlatFacetBelow) {
  for (const char* culet : {"a -0.0 0.5 96", "a 0.0 -0.5 96", "a -0 0.5"}) {
    SCOPED_TRACE(culet);
    std::string text = cube;
    text.replace(text.find("a -0.0 1.0 96"), 13, culet);
    EXPECT_NEAR(scene::inspect(stone(text)).signed_volume, 750, 1e-3);
  }
}

TEST_F(GemcadImport, WhatIsLeftOutIsSaid) {
  std::string text = cube + "a 45 9 96 48\np CAM 1\nfrom a friend\n";
  text.erase(text.find("I 1.54"), 7);
  EXPECT_EQ(material_of(imported(text), 0).dispersion.n, 1.54);
  EXPECT_THAT(made.notes, IsSupersetOf({HasSubstr("in.asc:9: 2 of its 2 facets cut nothing of the stone"),
                                        HasSubstr("in.asc:10: 2 lines of no record that is known here are left out"),
                                        HasSubstr("no index of refraction: 1.54 of quartz")}));
}

// A file that is cut before its table.
TEST_F(GemcadImport, AStoneWithoutATableIsSaid) {
  imported(head + "a -45 1 0 24 48 72\na 45 1 0 24 48 72\n");
  EXPECT_THAT(made.notes, Contains(HasSubstr("has no table")));
}

TEST_F(GemcadImport, WhatIsNoStoneIsRefused) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = cube;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal(head), HasSubstr("has no facets; expected GemCad's lines such as a 41.0 0.65 96 12 24"));
  EXPECT_THAT(refusal("ncols 4\nnrows 4\n1 2 3 4\n"), HasSubstr("has no facets"));
  EXPECT_THAT(refusal(changed("g 96 0.0\n", "")), HasSubstr("has no gear"));
  EXPECT_THAT(refusal(changed("g 96", "g 0")), HasSubstr("in.asc:2: a gear of 0 teeth"));
  EXPECT_THAT(refusal(changed("g 96", "g 9.5")), HasSubstr("in.asc:2: a gear of 9.5 teeth"));
  EXPECT_THAT(refusal(changed("72\n", "97\n")), HasSubstr("in.asc:6: an index of 97 on a gear of 96 teeth"));
  EXPECT_THAT(refusal(changed("72\n", "-1\n")), HasSubstr("in.asc:6: an index of -1"));
  EXPECT_THAT(refusal(changed("72\n", "7x\n")), HasSubstr("in.asc:6: its index \"7x\" is no number"));
  EXPECT_THAT(refusal(changed("90.0", "nan")), HasSubstr("in.asc:6: its angle \"nan\" is no number"));
  EXPECT_THAT(refusal(changed("90.0", "90.5")), HasSubstr("in.asc:6: an angle of 90.5 degrees"));
  EXPECT_THAT(refusal(changed("90.0 1.0", "90.0 1e-9")),
              HasSubstr("in.asc: the facets leave a stone that is too thin"));
  EXPECT_THAT(refusal(cube + "a 40 1 0 n\na 40 1 97"), HasSubstr("in.asc:11: an index of 97"));
  EXPECT_THAT(refusal(cube + "a 40"), HasSubstr("in.asc:10: its distance is missing"));
  EXPECT_THAT(refusal(cube + "a 40 1"), HasSubstr("in.asc:10: the facet has no index"));
  EXPECT_THAT(refusal(cube + "a 40 -1 96"), HasSubstr("in.asc:10: a distance of -1 leaves nothing of the stone"));
  EXPECT_THAT(refusal(changed("1.54", "0")), HasSubstr("in.asc:4: its index of refraction is out of range"));
  EXPECT_THAT(refusal(changed("a 0.0 1.0 96 n T\n", "")), HasSubstr("open above: give it a table or a crown"));
  EXPECT_THAT(refusal(changed("a -0.0 1.0 96 n C G Cut\n", "")), HasSubstr("open below: give it a pavilion"));
  EXPECT_THAT(refusal(changed("a 90.0 1.0 96 n S 24 48 72\n", "")), HasSubstr("open at its sides: give it a girdle"));
  std::string many = head + "a 90 1";
  for (int i = 0; i <= 1000; ++i) many += " 3";
  EXPECT_THAT(refusal(many), HasSubstr("in.asc:6: the stone has more than 1000 facets"));
}

// Planes that touch a unit sphere: the body has it inside, each corner is inside of all, and is closed.
TEST(ConvexBody, OfManyPlanesIsClosed) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    std::vector<formats::HalfSpace> planes(static_cast<std::size_t>(20 + 20 * (round % 10)));
    for (formats::HalfSpace& plane : planes)
      plane.normal = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const formats::ConvexBody body = formats::intersection(planes);
    ASSERT_TRUE(body.is_bounded());
    EXPECT_GT(body.volume(), 4 * pi / 3);
    for (const glm::dvec3& corner : body.corners)
      for (const formats::HalfSpace& plane : planes) EXPECT_LT(glm::dot(plane.normal, corner) - plane.distance, 2e-6);
    EXPECT_TRUE(scene::inspect(formats::mesh_of(body)).closed());
  }
}

// 200 planes through one point, as the mains of a stone whose distances have been rounded.
TEST(ConvexBody, PlanesThatNearlyMeetInAPointStayClosed) {
  std::mt19937 random(3);
  for (const double rounding : {0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3}) {
    SCOPED_TRACE(rounding);
    std::uniform_real_distribution<double> off(-rounding, rounding);
    std::vector<formats::HalfSpace> planes{{{0, -1, 0}, 0.5}};
    constexpr int count = 200;
    for (int i = 0; i < count; ++i) {
      const double turn = 2 * pi * i / count, angle = 0.5 + 0.2 * (i % 3);
      planes.push_back({{std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn)},
                        std::cos(angle) + (rounding > 0 ? off(random) : 0)});
    }
    const formats::ConvexBody body = formats::intersection(planes);
    ASSERT_TRUE(body.is_bounded());
    EXPECT_TRUE(scene::inspect(formats::mesh_of(body)).closed());
    // a cone whose apex is 1.5 above its base; the steepest planes decide
    const double radius = 1.5 / std::tan(0.9);
    EXPECT_NEAR(body.volume(), pi * radius * radius * 0.5, 0.01 * pi * radius * radius * 0.5);
  }
}

} // namespace nephroid::gemcad_import_test
