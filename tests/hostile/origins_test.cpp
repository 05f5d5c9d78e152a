// SPDX-License-Identifier: Apache-2.0
// Who gave the value that an error is about, an override, a parent or a sweep, and which run of a sweep it is; and
// where the files that an override names are looked for.
#include "tests/support/program_test.h"

namespace nephroid::origins_test {

using nlohmann::json;

/// A refractiveindex.info file of one n everywhere.
std::string glass_file(const char* n) {
  const std::string text(n);
  return "DATA:\n  - type: tabulated n\n    data: |\n        0.3 " + text + "\n        0.9 " + text + "\n";
}

class Origins : public ProgramTest {
protected:
  void SetUp() override {
    std::filesystem::create_directory(folder / "scenes");
    write("scenes/ball.json", R"({
      "engine": "spectral",
      "scene": {
        "camera": {"resolution": [8, 8]},
        "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "floor": {"type": "diffuse"}},
        "objects": [{"shape": {"type": "sphere"}, "material": "glass"},
                    {"shape": {"type": "quad", "size": [9, 1, 9]}, "material": "floor", "transform": {"translate": [0, -1, 0]}}],
        "lights": [{"type": "point", "spectrum": "D65", "position": [0, 3, 0]}]},
      "stop": {"passes": 1}})");
  }

  /// Of the preset's glass with this override.
  double index_with(const std::string& override_text) const {
    const Ended ended = run({"clusters", "scenes/ball.json", "--json", "--set", override_text});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended.exit_code == 0 ? json::parse(ended.out)["clusters"][0]["n_mean"].get<double>() : 0;
  }
};

TEST_F(Origins, AFileThatAnOverrideNamesIsTheOverridesError) {
  const std::string dispersion = "scene.materials.glass.dispersion=nope.yml",
                    environment = "scene.environment=nope.exr",
                    object = R"(scene.objects.0={"mesh": "nope.obj", "material": "glass"})",
                    reference = "reference=nope.exr", nowhere = "scene.environment=/nowhere/a.exr";
  const auto missing = [](const std::string& text, const std::string& name) {
    return "nephroid: --set " + text + ": '" + name + "' not found; looked in the current folder, scenes, ";
  };
  const Wrong cases[] = {
      {{"plan", "scenes/ball.json", "--set", object}, missing(object, "nope.obj")},
      {{"run", "scenes/ball.json", "--set", object}, missing(object, "nope.obj")},
      {{"importance", "scenes/ball.json", "--set", object}, missing(object, "nope.obj")},
      {{"plan", "scenes/ball.json", "--set", dispersion}, missing(dispersion, "nope.yml")},
      {{"clusters", "scenes/ball.json", "--set", dispersion}, missing(dispersion, "nope.yml")},
      {{"plan", "scenes/ball.json", "--set", environment}, missing(environment, "nope.exr")},
      {{"plan", "scenes/ball.json", "--set", nowhere}, "--set " + nowhere + ": there is no file '/nowhere/a.exr'"},
      {{"run", "scenes/ball.json", "--set", "white=1", "--set", reference}, missing(reference, "nope.exr")},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
}

TEST_F(Origins, AFileThatAParentOrASweepNamesIsTheirs) {
  write("parent.json",
        R"({"parent": "scenes/ball.json", "scene": {"materials": {"glass": {"dispersion": "nope.yml"}}}})");
  write("child.json", R"({"parent": "parent.json", "seed": 2})");
  write("sweep.json",
        R"({"parent": "scenes/ball.json", "sweep": {"scene.materials.glass.dispersion": [1.5, "nope.yml"]}})");
  const Wrong cases[] = {
      {{"plan", "child.json"},
       "nephroid: parent.json#/scene/materials/glass/dispersion: 'nope.yml' not found; looked in ., "},
      {{"importance", "sweep.json"},
       "nephroid: sweep.json#/sweep/scene.materials.glass.dispersion/1: 'nope.yml' not found; looked in ., "},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
}

TEST_F(Origins, WhatIsWrongInOneRunOfASweepNamesTheRun) {
  const std::string black = R"(sweep={"scene.materials.floor.reflectance": [0], "seed": [1, 2]})",
                    effort = "spectral.effort=importance",
                    named = "in the run 'ball,reflectance=0,seed=1' of the sweep\n";
  write("seeds.json",
        R"({"parent": "scenes/ball.json", "reference": {"type": "recipe"}, "sweep": {"seed": [1, 1000000007]}})");
  const Wrong cases[] = {
      {{"importance", "scenes/ball.json", "--set", black}, named},
      {{"plan", "scenes/ball.json", "--set", black, "--set", effort}, named},
      {{"run", "scenes/ball.json", "--set", black, "--set", effort}, named},
      {{"plan", "seeds.json"},
       "expected other seeds than the run's; in the run 'seeds,seed=1000000007' of the sweep\n"},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
  EXPECT_THAT(run({"importance", "scenes/ball.json", "--set", "scene.lights.0.power_w=0"}).err,
              testing::Not(HasSubstr("in the run")));
}

TEST_F(Origins, WhatAnOptionAsksForIsTheOptionsError) {
  const Wrong wrong{{"run", "scenes/ball.json", "--until-error", "1", "--set", "measure.estimate=false"},
                    "nephroid: --until-error: nothing measures the error of this run: 'measure.estimate' is false; "};
  expect_refused(run(wrong.arguments), wrong);
}

TEST_F(Origins, FilesOfOverridesAreLookedForInTheCurrentFolderFirst) {
  const std::string name = "scene.materials.glass.dispersion=mine.yml";
  write("scenes/mine.yml", glass_file("1.25"));
  EXPECT_EQ(index_with(name), 1.25) << "as if the preset named it";
  write("mine.yml", glass_file("1.75"));
  EXPECT_EQ(index_with(name), 1.75) << "the current folder is first";
  EXPECT_EQ(index_with("scene.materials.glass.dispersion=scenes/mine.yml"), 1.25) << "as a shell completes it";

  const Ended ended = run({"run", "scenes/ball.json", "-o", "out", "--set", name});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const Ended again = run({"clusters", "out/preset.json", "--json"});
  EXPECT_EQ(json::parse(again.out)["clusters"][0]["n_mean"], 1.75) << "the run's preset means the same file";
}

} // namespace nephroid::origins_test
