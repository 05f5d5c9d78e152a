// SPDX-License-Identifier: Apache-2.0
// What the spectral engine is given that is wrong or odd: dispersion curves, lights without visible power, glass whose
// mesh is damaged. Each gives one line that says where and what, or a finite answer and a word about it. Not here:
// malformed JSON (preset_test.cpp) and malformed dispersion files (tests/unit/dispersion_test.cpp).
#include "preset/read.h"
#include "scene/scene.h"
#include "tests/support/program_test.h"

namespace nephroid::spectral_input_test {

class SpectralInput : public test::ProgramTest {
protected:
  scene::Scene load(const std::string& scene_fields) const {
    return scene::load_scene(
        preset::parse_preset(R"({"engine":"spectral","scene":{)" + scene_fields + "}}", (folder / "p.json").string()));
  }
  /// The one line that loading gives, without the folder.
  std::string refusal(const std::string& scene_fields) const {
    const std::string line = refusal_of([&] { load(scene_fields); });
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line.starts_with(folder.string() + "/") ? line.substr(folder.string().size() + 1) : line;
  }
};

std::string glass(const std::string& dispersion) {
  return R"("materials":{"glass":{"type":"dielectric","dispersion":)" + dispersion + "}}";
}

/// A refractiveindex.info table of (micrometres, n).
std::string table_file(const std::string& rows) { return "DATA:\n  - type: tabulated n\n    data: |\n" + rows; }

// ------------------------------------------------------------------------------------------------------ dispersion
// curves

/// Rows every 10 nm from 380 to 780 nm but for those between 500 and 600 nm.
std::string rows_with_a_gap(const char* format, double unit_nm) {
  std::string rows;
  for (int nm = 380; nm <= 780; nm += 10)
    if (nm <= 500 || nm >= 600) rows += fmt::format(fmt::runtime(format), nm / unit_nm, 1.6 - nm * 1e-4);
  return rows;
}

TEST_F(SpectralInput, AGapInATableIsBridgedAndSaidOrRefused) {
  std::string rows = rows_with_a_gap("[{},{}],", 1);
  rows.pop_back();
  const std::string table = R"({"type":"table","table":[)" + rows + "]";
  const scene::Scene bridged = load(glass(table + "}"));
  EXPECT_THAT(
      bridged.warnings,
      ElementsAre("material 'glass': table: n is a straight line from 500 to 600 nm, where the table has a gap"));
  EXPECT_NEAR(bridged.materials.at(0).n[550 - 380], 1.545, 1e-12);
  EXPECT_EQ(refusal(glass(table + R"(,"outside":"refuse"})")),
            "p.json#/scene/materials/glass/dispersion: table: table has no n between 500 and 600 nm; expected a table "
            "without gaps from 380 to "
            "780 nm; outside \"hold\" draws a straight line across");
}

TEST_F(SpectralInput, AGapInAFileIsSaidByTheVerbs) {
  write("gap.yml", table_file(rows_with_a_gap("        {} {}\n", 1000)));
  const test::Ended bridged = run({"clusters", "--ior", "gap.yml", "--json"});
  EXPECT_EQ(bridged.exit_code, 0);
  EXPECT_EQ(bridged.err, "nephroid: gap: n is a straight line from 500 to 600 nm, where the table has a gap\n");
  const test::Ended refused = run({"clusters", "--ior", "gap.yml", "--outside", "refuse"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, StartsWith("nephroid: gap.yml: gap has no n between 500 and 600 nm; "));
}

// Few rows, or rows that are far apart everywhere, are a coarse table and no damaged one; control points are meant to
// be far apart.
TEST_F(SpectralInput, CoarseTablesHaveNoGap) {
  for (const char* type : {"table", "points"})
    EXPECT_THAT(load(glass(fmt::format(R"({{"type":"{}","table":[[380,1.6],[381,1.6],[780,1.5]]}})", type))).warnings,
                IsEmpty());
  EXPECT_THAT(
      load(glass(R"({"type":"table","table":[[380,1.6],[430,1.59],[500,1.58],[600,1.56],[700,1.55],[780,1.54]]})"))
          .warnings,
      IsEmpty());
  EXPECT_THAT(load(glass(R"("N-SF66")")).warnings, Each(testing::Not(HasSubstr("gap"))));
}

TEST_F(SpectralInput, RowsThatFallAreTheSameCurve) {
  for (const std::string type : {"table", "points"}) {
    const std::string begin = R"({"type":")" + type + R"(","table":)";
    const scene::Scene rising = load(glass(begin + "[[380,1.7],[500,1.6],[780,1.5]]}"));
    EXPECT_EQ(load(glass(begin + "[[780,1.5],[380,1.7],[500,1.6]]}")).materials.at(0).n, rising.materials.at(0).n);
  }
  write("rising.yml", table_file("        0.38 1.7\n        0.5 1.6\n        0.78 1.5\n"));
  write("falling.yml", table_file("        0.78 1.5\n        0.5 1.6\n        0.38 1.7\n"));
  EXPECT_EQ(load(glass(R"("falling.yml")")).materials.at(0).n, load(glass(R"("rising.yml")")).materials.at(0).n);
}

// A preset is written by a person, who is told. Files of the database do hold a wavelength twice: there the mean
// counts.
TEST_F(SpectralInput, AWavelengthTwiceIsRefusedInAPresetAndTheMeanInAFile) {
  for (const std::string type : {"table", "points"})
    EXPECT_EQ(refusal(glass(R"({"type":")" + type + R"(","table":[[400,1.5],[500,1.4],[400,1.6]]})")),
              "p.json#/scene/materials/glass/dispersion/table/2: 400 nm is given twice; expected each wavelength once");
  write("twice.yml", table_file("        0.4 1.5\n        0.4 1.7\n        0.7 1.5\n"));
  EXPECT_NEAR(load(glass(R"("twice.yml")")).materials.at(0).n[20], 1.6, 1e-12);
}

TEST_F(SpectralInput, AnIndexThatIsNoneIsRefusedWhereverItStands) {
  const std::string at = "p.json#/scene/materials/glass/dispersion";
  for (const char* n : {"0", "-1.5"}) {
    EXPECT_THAT(refusal(glass(n)), StartsWith(at));
    for (const char* type : {"table", "points"})
      EXPECT_THAT(refusal(glass(fmt::format(R"({{"type":"{}","table":[[380,1.5],[580,{}],[780,1.4]]}})", type, n))),
                  StartsWith(fmt::format("{}/table/1/1: is {}; expected a number", at, n)));
    write("bad.yml", table_file(fmt::format("        0.38 1.5\n        0.58 {}\n        0.78 1.5\n", n)));
    EXPECT_THAT(refusal(glass(R"("bad.yml")")),
                AllOf(StartsWith(at), HasSubstr("bad has n = "), HasSubstr("expected n above 0")));
  }
  for (const char* no_number : {"nan", "inf", "1e999"}) {
    write("bad.yml", table_file(fmt::format("        0.38 1.5\n        0.58 {}\n", no_number)));
    EXPECT_THAT(refusal(glass(R"("bad.yml")")),
                AllOf(StartsWith(at),
                      HasSubstr(fmt::format("bad.yml:5: \"{}\" is no number; expected a finite number", no_number))));
  }
}

TEST_F(SpectralInput, AThresholdOutOfRangeIsRefused) {
  for (const char* threshold : {"0", "90", "-0.05"}) {
    const test::Ended verb = run({"clusters", "--ior", "N-BK7", fmt::format("--threshold={}", threshold)});
    EXPECT_EQ(verb.exit_code, 2);
    EXPECT_EQ(verb.err, fmt::format("nephroid: clusters: the threshold is {} degrees; expected above 0 and below 90\n",
                                    threshold));
    const test::Ended preset =
        run({"plan", "spectral/plate", "--set", fmt::format("spectral.threshold_deg={}", threshold)});
    EXPECT_EQ(preset.exit_code, 2);
    EXPECT_EQ(
        preset.err,
        fmt::format(
            "nephroid: --set spectral.threshold_deg={0}: is {0}; expected a number above 0 and below 90 degrees\n",
            threshold));
  }
}

// -----------------------------------------------------------------------------------------------------------------
// lights

TEST_F(SpectralInput, ALightWithoutVisiblePowerIsRefused) {
  const auto light = [](const std::string& spectrum) {
    return R"("lights":[{"type":"point","spectrum":)" + spectrum + "}]";
  };
  const std::string at = "p.json#/scene/lights/0/spectrum";
  EXPECT_EQ(refusal(light(R"({"type":"table","table":[[400,0],[700,0]]})")),
            at + "/table: has no power at any wavelength; expected at least one power above 0");
  for (const char* table : {"[[900,1],[1000,1]]", "[[100,5],[379,5]]"})
    EXPECT_EQ(refusal(light(fmt::format(R"({{"type":"table","table":{}}})", table))),
              at + ": the light's table has no power in 380..780 nm; expected at least one wavelength with power there")
        << table;
  EXPECT_EQ(refusal(light(R"({"type":"lines","table":[[254,1],[1064,1]]})")),
            at + "/table: has no line that is rendered; expected at least one from 380 to 780 nm");
}

// --------------------------------------------------------------------------------------------------------- damaged
// meshes

/// A cube of edge 2 with vertex normals along its diagonals, as an OBJ file: every face turned round, every normal
/// turned round, or the last face left out.
std::string cube(bool faces_inwards, bool normals_inwards, bool open) {
  std::string obj;
  for (int i = 0; i < 8; ++i) {
    const std::array<int, 3> p{i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
    const int s = normals_inwards ? -1 : 1;
    obj += fmt::format("v {} {} {}\nvn {} {} {}\n", p[0], p[1], p[2], s * p[0], s * p[1], s * p[2]);
  }
  const std::array<std::array<int, 4>, 6> faces{
      {{1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 3, 4, 2}, {5, 6, 8, 7}}};
  for (std::size_t f = 0; f < (open ? 5u : 6u); ++f) {
    obj += "f";
    for (std::size_t i = 0; i < 4; ++i) {
      const int v = faces[f][faces_inwards ? 3 - i : i];
      obj += fmt::format(" {}//{}", v, v);
    }
    obj += '\n';
  }
  return obj;
}

class DamagedMeshes : public SpectralInput {
protected:
  std::string scene_of(const std::string& material, const char* damaged_meshes) const {
    return fmt::format(
        R"("damaged_meshes":"{}","materials":{{"glass":{{"type":"dielectric","dispersion":1.5}},"paint":{{"type":"diffuse"}},)"
        R"("silver":{{"type":"mirror"}}}},"objects":[{{"name":"floor","shape":{{"type":"quad"}},"material":"paint",)"
        R"("transform":{{"translate":[0,-2,0]}}}},{{"name":"die","mesh":"cube.obj","material":"{}","normals":"smooth"}}])",
        damaged_meshes, material);
  }
  /// The cube's volume and, for its first corner, how far the normal points outwards.
  static void expect_outwards(const scene::Scene& scene) {
    const scene::Object& die = scene.objects.at(1);
    EXPECT_NEAR(scene::signed_volume(scene.geometry, die.first_triangle, die.triangle_count), 8, 1e-6);
    const std::uint32_t corner = scene.geometry.triangles.at(die.first_triangle).x;
    EXPECT_NEAR(glm::dot(scene.geometry.normals.at(corner), glm::normalize(scene.geometry.positions.at(corner))), 1,
                1e-6);
  }
};

constexpr const char* remedy =
    "expected a closed mesh that faces outwards; mend it, or set scene.damaged_meshes to \"report\"";

TEST_F(DamagedMeshes, AHoleInGlassIsToldOrRefused) {
  write("cube.obj", cube(false, false, true));
  const std::string what = "object 'die': dielectric, but not closed: 4 edges with one triangle";
  EXPECT_THAT(load(scene_of("glass", "report")).warnings, ElementsAre(what + "; light that enters may never leave"));
  EXPECT_EQ(refusal(scene_of("glass", "refuse")), fmt::format("p.json#/scene/objects/1: {}; {}", what, remedy));
  for (const char* material : {"paint", "silver"})
    EXPECT_THAT(load(scene_of(material, "refuse")).warnings, IsEmpty()) << material;
}

TEST_F(DamagedMeshes, GlassThatIsInsideOutIsTurnedRoundOrRefused) {
  write("cube.obj", cube(true, true, false));
  const scene::Scene turned = load(scene_of("glass", "report"));
  EXPECT_THAT(turned.warnings, ElementsAre("object 'die': is inside out; its triangles are turned round"));
  expect_outwards(turned);
  EXPECT_EQ(refusal(scene_of("glass", "refuse")),
            fmt::format("p.json#/scene/objects/1: object 'die': is inside out; {}", remedy));
}

// Only the triangles say where the glass is; normals that disagree with them would make a smooth surface one of facets.
TEST_F(DamagedMeshes, NormalsThatDisagreeWithTheirTrianglesAreReplacedOrRefused) {
  write("cube.obj", cube(false, true, false));
  const scene::Scene turned = load(scene_of("glass", "report"));
  EXPECT_THAT(turned.warnings, ElementsAre("object 'die': its vertex normals look to the wrong side of its triangles; "
                                           "those of the triangles take their place"));
  expect_outwards(turned);
  EXPECT_EQ(refusal(scene_of("glass", "refuse")),
            fmt::format(
                "p.json#/scene/objects/1: object 'die': its vertex normals look to the wrong side of its triangles; {}",
                remedy));

  write("cube.obj", cube(true, false, false)); // the triangles inside out, the normals as they should be
  const scene::Scene both = load(scene_of("glass", "report"));
  EXPECT_THAT(both.warnings, ElementsAre("object 'die': is inside out; its triangles are turned round",
                                         "object 'die': its vertex normals look to the wrong side of its triangles; "
                                         "those of the triangles take their place"));
  expect_outwards(both);
}

TEST_F(DamagedMeshes, ASoundMeshIsAccepted) {
  write("cube.obj", cube(false, false, false));
  const scene::Scene sound = load(scene_of("glass", "refuse"));
  EXPECT_THAT(sound.warnings, IsEmpty());
  expect_outwards(sound);
}

} // namespace nephroid::spectral_input_test
