// SPDX-License-Identifier: Apache-2.0
// `nephroid gem` on stones whose light return has a closed form.
#include "tests/support/program_test.h"

#include <numbers>

namespace nephroid::light_test {

using nlohmann::json;

const std::string sides = "a 90.0 1.0 96 24 48 72\n", table = "a 0.0 1.0 96\n";

std::string stone_of(double n, const std::string& facets) {
  return fmt::format("GemCad 5.0\ng 96 0.0\nI {}\n{}", n, facets);
}

/// R of a surface at an angle of incidence, in radians, from the side of index n_i; 1: total reflection.
double reflectance(double angle, double n_i, double n_t) {
  const double sine = n_i / n_t * std::sin(angle);
  if (sine >= 1) return 1;
  const double c = std::cos(angle), t = std::sqrt(1 - sine * sine);
  const double s = (n_i * c - n_t * t) / (n_i * c + n_t * t), p = (n_t * c - n_i * t) / (n_t * c + n_i * t);
  return (s * s + p * p) / 2;
}

class Gems : public test::ProgramTest {
protected:
  json report(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"gem", "--json", "--rays", "40000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return json::parse(ended.out);
  }
  json report_of(const std::string& asc, const std::vector<std::string>& more = {}) const {
    write("stone.asc", asc);
    std::vector<std::string> arguments{"stone.asc"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return report(arguments);
  }
};

double value(const json& interval) { return interval.at("value"); }

TEST_F(Gems, WhatBendsNoLightSendsNoneBack) {
  const json r = report_of(stone_of(1, sides + table + "a -45.0 1.0 96 48\n"));
  for (const char* sky : {"iso", "cos", "head"}) EXPECT_NEAR(value(r["face_up"][sky]), 0, 1e-9);
  EXPECT_EQ(value(r["window_share"]), 1);
  EXPECT_NEAR(value(r["below_share"]), 1, 1e-9);
  EXPECT_NEAR(value(r["scintillation_per_deg"]), 0, 1e-9);
  EXPECT_EQ(r["critical_angle_deg"], 90);
  EXPECT_TRUE(r["fire_deg"].is_null());
}

// Two parallel surfaces: R + (1 - R)^2 R (1 + R^2 + ...) = 2 R / (1 + R), straight back to the head.
TEST_F(Gems, APlateReflectsTwice) {
  for (const double n : {1.54, 2.417}) {
    SCOPED_TRACE(n);
    const json r = report_of(stone_of(n, sides + table + "a -0.0 1.0 96\n"));
    const double reflected = reflectance(0, 1, n), back = 2 * reflected / (1 + reflected);
    EXPECT_NEAR(value(r["face_up"]["iso"]), back, 1e-4);
    EXPECT_NEAR(value(r["face_up"]["cos"]), back, 1e-4);
    EXPECT_EQ(value(r["face_up"]["head"]), 0);
    EXPECT_NEAR(value(r["below_share"]), 1 - back, 1e-4);
    EXPECT_EQ(value(r["window_share"]), 1);
    EXPECT_EQ(r["facets"], 6);
    EXPECT_NEAR(r["table_share"], 1, 1e-6);
    EXPECT_NEAR(r["outline_mm2"], 100, 1);
    EXPECT_NEAR(r["volume_mm3"], 1000, 1e-2);
  }
}

// A head of no size hides nothing, neither what a plate mirrors straight back.
TEST_F(Gems, AHeadOfNoSizeIsNone) {
  const json r = report_of(stone_of(1.54, sides + table + "a -0.0 1.0 96\n"), {"--head", "0"});
  EXPECT_EQ(value(r["face_up"]["head"]), value(r["face_up"]["iso"]));
}

// A roof of 90 degrees sends all light back to where it came from, by total reflection.
TEST_F(Gems, ARoofSendsAllBackToTheHead) {
  const json r = report_of(stone_of(1.6, sides + table + "a -45.0 0.8 96 48\n"));
  EXPECT_NEAR(value(r["face_up"]["iso"]), 1, 1e-4);
  EXPECT_NEAR(value(r["face_up"]["cos"]), 1, 1e-4);
  EXPECT_EQ(value(r["face_up"]["head"]), 0);
  EXPECT_EQ(value(r["dark_share"]), 1);
  EXPECT_EQ(value(r["window_share"]), 0);
}

// A thin wedge: what has been reflected by the bottom leaves at asin(n sin(2 k a - t)) from the slope's normal,
// where sin t = sin a / n.
TEST_F(Gems, AWedgePartsTheLinesAsSnellSays) {
  constexpr double slope = 2 * std::numbers::pi / 180, n[] = {1.6, 1.59, 1.62}; // d, C, F
  const json r = report_of(
      stone_of(1.6, sides + "a 2.0 0.045 96\na -0.0 0.01 96\n"),
      {"--set",
       R"(scene.materials.stone.dispersion={"type":"table","table":[[486.13,1.62],[587.56,1.6],[656.27,1.59]]})"});
  const auto inside = [&](int line) { return std::asin(std::sin(slope) / n[line]); };
  const auto out = [&](int line, int order) { return std::asin(n[line] * std::sin(2 * order * slope - inside(line))); };
  double weight = reflectance(slope, 1, n[0]), all = weight, spread = 0, left = 1 - weight;
  for (int order = 1; order < 5; ++order) {
    const double at_top = 2 * order * slope - inside(0);
    left *= reflectance((2 * order - 1) * slope - inside(0), n[0], 1);
    weight = left * (1 - reflectance(at_top, n[0], 1));
    left -= weight;
    all += weight;
    spread += weight * (out(2, order) - out(1, order));
  }
  const double fire_deg = spread / all * 180 / std::numbers::pi;
  EXPECT_NEAR(value(r["fire_deg"]), fire_deg, 0.02 * fire_deg);
  EXPECT_NEAR(value(r["face_up"]["iso"]), all, 0.01 * all);
}

// exp(-a d) of the light is left after each way through 2 mm of a = 0.5 / mm, k = a lambda / 4 pi.
TEST_F(Gems, APlateThatAbsorbsKeepsLessLight) {
  const double a = 0.5, k = a * 587.56e-6 / (4 * std::numbers::pi), n = 1.6;
  write("grey.yml",
        fmt::format("DATA:\n  - type: tabulated nk\n    data: |\n      0.3 {0} {1:.9e}\n      0.5875 {0} {1:.9e}\n"
                    "      0.588 {0} {1:.9e}\n      0.9 {0} {1:.9e}\n",
                    n, k));
  const json r = report_of(stone_of(n, sides + "a 0.0 0.2 96\na -0.0 0.2 96\n"), {"--material", "grey.yml"});
  const double reflected = reflectance(0, 1, n), passed = (1 - reflected) * (1 - reflected), left = std::exp(-a * 2),
               again = 1 / (1 - std::pow(reflected * left, 2));
  EXPECT_NEAR(value(r["face_up"]["iso"]), reflected + passed * reflected * left * left * again, 2e-4);
  EXPECT_NEAR(value(r["below_share"]), passed * left * again, 5e-4);
  EXPECT_EQ(value(r["window_share"]), 1) << "of the light that is left";
}

// What goes in comes out; a round stone is the same from four sides.
TEST_F(Gems, LightIsConservedAndTiltsAreSymmetric) {
  const std::string brilliant = read_file(fs::path(NEPHROID_SOURCE_DIR) / "tests/experiments/gems/round-brilliant.asc");
  const json r = report_of(brilliant);
  EXPECT_NEAR(value(r["face_up"]["iso"]) + value(r["below_share"]) + r["lost_share"].get<double>(), 1, 1e-4);
  EXPECT_EQ(r["facets"], 73);
  const json& tilts = r["tilts"];
  ASSERT_EQ(tilts.size(), 26u);
  for (std::size_t i = 0; i < 13; ++i) {
    SCOPED_TRACE(i);
    for (const std::size_t other : {12 - i, 13 + i, 25 - i})
      for (const char* sky : {"iso", "cos", "head"}) EXPECT_NEAR(value(tilts[i][sky]), value(tilts[other][sky]), 0.02);
  }
  EXPECT_EQ(report_of(brilliant), r); // the same seed
  EXPECT_NE(report_of(brilliant, {"--seed", "2"})["face_up"], r["face_up"]);
}

TEST_F(Gems, AMeshAndAPresetAreStonesToo) {
  write("corner.obj", "v 0 0 0\nv 4 0 0\nv 0 3 0\nv 0 0 4\nf 1 2 4\nf 1 3 2\nf 1 4 3\nf 2 3 4\n");
  const json r = report({"corner.obj", "--material", "1.7"});
  EXPECT_EQ(r["facets"], 4);
  EXPECT_NEAR(r["n"]["d"], 1.7, 1e-6);
  EXPECT_NEAR(r["volume_mm3"], 8, 1e-4);
  EXPECT_EQ(report({"spectral/thesis/diamond-arbitrary-1"})["facets"], 73);
}

TEST_F(Gems, FilesAreWritten) {
  report_of(stone_of(1.76, sides + table + "a -45.0 0.8 96 24 48 72\n"),
            {"--material", "materials/sapphire-o-Malitson.yml", "-o", "out"});
  for (const char* file : {"iso.png", "cos.png", "head.png", "colour.png", "fire.png", "report.json"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  EXPECT_NEAR(of("out/report.json")["n"]["d"], 1.768, 1e-3);
}

TEST_F(Gems, WhatIsNoStoneIsRefused) {
  const auto preset = [&](const char* name, const std::string& material, const std::string& more = {}) {
    write(name, fmt::format(R"({{"engine": "spectral", "scene": {{"materials": {{"m": {}}}, "objects": [)"
                            R"({{"name": "one", "shape": {{"type": "box"}}, "material": "m"}}{}]}}}})",
                            material, more));
  };
  preset("matt.json", R"({"type": "diffuse"})");
  preset("rough.json", R"({"type": "dielectric", "dispersion": {"type": "constant", "n": 1.5}, "roughness": 0.2})");
  preset("two.json", R"({"type": "dielectric", "dispersion": {"type": "constant", "n": 1.5}})",
         R"(, {"name": "two", "shape": {"type": "box"}, "material": "m", "transform": {"translate": [9, 0, 0]}})");
  write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nf 1 3 2\nf 1 4 3\n");
  write("cut.asc", stone_of(1.5, sides + table + "a -45.0"));
  const std::vector<test::Wrong> cases{
      {{"matt.json"}, "there is no stone"},
      {{"rough.json"}, "the stone is rough"},
      {{"two.json"}, R"(there are several bodies of glass: "one", "two"; expected one stone; choose it with --object)"},
      {{"two.json", "--object", "three"}, R"(there is no "three")"},
      {{"open.obj"}, "a mesh has no index of refraction; say what it is of"},
      {{"open.obj", "--material", "1.5"}, "the stone is open: its mesh has holes"},
      {{"cut.asc"}, "cut.asc:6: its distance is missing"},
      {{"missing.asc"}, "missing.asc"},
      {{"missing.stl", "--material", "1.5"}, "missing.stl"},
      {{"two.json", "--object", "one", "--material", "0.5"}, "--material: an index of 0.5"},
      {{"two.json", "--object", "one", "--material", "unobtainium"}, "unobtainium"},
      {{"two.json", "--head", "91"}, "--head"},
      {{"two.json", "--rays", "nan"}, "--rays"},
  };
  for (const test::Wrong& wrong : cases) {
    SCOPED_TRACE(testing::PrintToString(wrong.arguments));
    std::vector<std::string> arguments{"gem"};
    arguments.insert(arguments.end(), wrong.arguments.begin(), wrong.arguments.end());
    const test::Ended ended = run(arguments);
    test::expect_one_line(ended);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.err, HasSubstr(wrong.says));
  }
}

} // namespace nephroid::light_test
