// SPDX-License-Identifier: Apache-2.0
// `nephroid dispersion`, `clusters` and `importance` as scripts use them: JSON as the contract has it, good files among
// bad ones, odd names, and one line for whatever is wrong, here and with spectral.effort elsewhere.
#include "tests/support/program_test.h"

namespace nephroid::spectral_verbs_test {

using nlohmann::json;

class SpectralVerbs : public ProgramTest {};

TEST_F(SpectralVerbs, GoodFilesAmongBadOnesAreStillAnswered) {
  write("Gauß (o), 1.5 μm.yml",
        "DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.6 -0.1\n        0.6 1.5 0.1\n");
  write("broken.yml", "DATA:\n  - type: tabulated n\n    data: |\n        0.4 one\n");
  write("k.yml", "DATA:\n  - type: tabulated k\n    data: |\n        0.4 0.5\n");
  const Ended ended = run({"dispersion", "N-BK7", "missing.yml", "Gauß (o), 1.5 μm.yml", "broken.yml", "k.yml", "--nm",
                           "500", "--nm", "700", "--json"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "");
  const std::vector<json> answers = json_lines(ended.out);
  ASSERT_EQ(answers.size(), 5u);

  EXPECT_EQ(answers[0]["file"], "N-BK7");
  EXPECT_EQ(answers[0]["range_nm"], json({300, 2500}));
  EXPECT_NEAR(answers[0]["samples"][0]["n"].get<double>(), 1.521415, 1e-5);
  EXPECT_EQ(answers[0]["samples"][0]["extrapolated"], false);
  EXPECT_EQ(answers[1]["file"], "missing.yml");
  EXPECT_THAT(answers[1]["error"].get<std::string>(), HasSubstr("not found; looked in"));
  EXPECT_EQ(answers[2]["name"], "Gauß (o), 1.5 μm");
  EXPECT_EQ(answers[2]["samples"][0], json({{"nm", 500.0}, {"n", 1.55}, {"k", 0.0}, {"extrapolated", false}}));
  EXPECT_EQ(answers[2]["samples"][1], json({{"nm", 700.0}, {"n", 1.5}, {"k", 0.1}, {"extrapolated", true}}));
  EXPECT_THAT(answers[3]["error"].get<std::string>(), StartsWith("broken.yml:4: \"one\" is no number"));
  EXPECT_EQ(answers[4]["samples"][0]["n"], nullptr);
  EXPECT_EQ(answers[4]["samples"][0]["k"], 0.5);
}

TEST_F(SpectralVerbs, AFormulaWithoutAValueIsNullAndSaid) {
  write("pole.yml", "DATA:\n  - type: formula 1\n    wavelength_range: 0.5 1\n    coefficients: 0 1.2 0.45\n");
  const Ended ended = run({"dispersion", "pole.yml", "--nm", "445", "--json"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(json_lines(ended.out).at(0)["samples"][0],
            json({{"nm", 445.0}, {"n", nullptr}, {"k", nullptr}, {"extrapolated", true}}));
  EXPECT_EQ(ended.err, "nephroid: pole.yml: the formula gives no finite n at 445 nm\n");
}

TEST_F(SpectralVerbs, TextHasTheUsualLinesAndTheAbbeNumber) {
  const Ended ended = run({"dispersion", "N-SF66"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, testing::AllOf(HasSubstr("587.5618   1.922860"), HasSubstr("Abbe number V_d 20.88"),
                                        HasSubstr("outside the range")));
}

TEST_F(SpectralVerbs, ClustersOfAFileAndOfAPreset) {
  const Ended ended = run({"clusters", "--ior", "N-SF66", "--threshold", "0.1", "--method", "thesis", "--json"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "nephroid: N-SF66: n is extrapolated below 390 nm (data: 390..2500 nm)\n");
  const json all = json::parse(ended.out);
  EXPECT_EQ(all["method"], "thesis");
  EXPECT_EQ(all["threshold_deg"], 0.1);
  EXPECT_EQ(all["count"], 21);
  EXPECT_NEAR(all["total_theta_deg2"].get<double>(), 130.936, 0.001);
  std::set<int> wavelengths;
  double total = 0;
  for (const json& cluster : all["clusters"]) {
    for (int nm : cluster["wavelengths_nm"]) wavelengths.insert(nm);
    total += cluster["theta_deg2"].get<double>();
  }
  EXPECT_EQ(wavelengths.size(), 401u);
  EXPECT_EQ(*wavelengths.begin(), 380);
  EXPECT_EQ(*wavelengths.rbegin(), 780);
  EXPECT_NEAR(total, all["total_theta_deg2"].get<double>(), 1e-9);

  const json plate = json::parse(run({"clusters", "spectral/plate", "--json"}).out);
  const json crown = json::parse(run({"clusters", "--ior", "N-BK7", "--json"}).out);
  EXPECT_EQ(plate, crown);
}

TEST_F(SpectralVerbs, OneClusterIsNotClusters) {
  EXPECT_THAT(run({"clusters", "--ior", "N-BK7", "--threshold", "80"}).out,
              StartsWith("N-BK7: 1 cluster by the method optimal"));
}

TEST_F(SpectralVerbs, APresetWithSeveralGlassesAsksForOne) {
  write("two.json", R"({"parent": "spectral/plate", "scene": {
    "materials": {"glass": {"type": "dielectric", "dispersion": "materials/N-BK7.yml"},
                  "dense/flint": {"type": "dielectric", "dispersion": "materials/missing.yml"},
                  "screen": {"type": "diffuse", "reflectance": 0.8}},
    "objects": [{"name": "a", "shape": {"type": "plate"}, "material": "glass"},
                {"name": "b", "shape": {"type": "sphere"}, "material": "dense/flint"}]}})");
  const Ended ended = run({"clusters", "two.json"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(
      ended.err,
      HasSubstr("objects are made of several dielectrics: dense/flint, glass; expected one of them with --material\n"));
  EXPECT_EQ(run({"clusters", "two.json", "--material", "glass"}).exit_code, 0);
  EXPECT_THAT(run({"clusters", "two.json", "--material", "screen"}).err,
              HasSubstr("no object is made of a dielectric \"screen\""));
  EXPECT_THAT(run({"clusters", "two.json", "--material", "dense/flint"}).err,
              HasSubstr("#/scene/materials/dense~1flint/dispersion: "));
}

TEST_F(SpectralVerbs, WhatIsWrongIsSaidInOneLine) {
  write("empty.yml", "");
  write("binary.yml", std::string("\0\x01\xff\"\\\x02", 6));
  write("k.yml", "DATA:\n  - type: tabulated k\n    data: |\n        0.4 0.5\n");
  write("negative.yml", "DATA:\n  - type: tabulated n\n    data: |\n        0.4 -1.5\n");
  const Wrong cases[] = {
      {{"dispersion"}, "FILE is required"},
      {{"dispersion", ""}, "the file name is empty"},
      {{"dispersion", "/"}, "it is a folder"},
      {{"dispersion", "/dev/zero"}, "/dev/zero: cannot be read: it is not a regular file"},
      {{"dispersion", "NSF66"}, "; did you mean 'N-SF66'?"},
      {{"dispersion", "empty.yml"}, "empty.yml: this is no refractiveindex.info file"},
      {{"dispersion", "binary.yml"}, "binary.yml"},
      {{"dispersion", std::string(5000, 'x')}, "not found"},
      {{"dispersion", "N-BK7", "--nm"}, "--nm"},
      {{"dispersion", "N-BK7", "--nm", "green"}, "--nm"},
      {{"dispersion", "N-BK7", "--nm", "0"}, "--nm: the wavelength is 0 nm; expected a number above 0"},
      {{"dispersion", "N-BK7", "--nm", "-500"}, "--nm: the wavelength is -500 nm"},
      {{"dispersion", "N-BK7", "--nm", "nan"}, "expected a number above 0"},
      {{"dispersion", "N-BK7", "--outside", "guess"}, "guess not in"},
      {{"dispersion", "N-BK7", "--outside", "refuse", "--nm", "200"},
       "expected a wavelength in its range 300..2500 nm"},
      {{"clusters"}, "nothing to cluster; expected a PRESET or --ior FILE"},
      {{"clusters", "spectral/plate", "--ior", "N-BK7"}, "both a preset and --ior are given"},
      {{"clusters", "no-such-preset"}, "no-such-preset"},
      {{"clusters", "N-BK7"}, "clusters: 'N-BK7' is a dispersion file, not a preset; take it with --ior N-BK7"},
      {{"clusters", "environment/bunny"},
       "bunny.json#/engine: is 'environment', which clusters no wavelengths; expected 'spectral'; choose"},
      {{"clusters", "first-light", "--set", "engine=inverse"},
       "--set engine=inverse: is 'inverse', which clusters no wavelengths"},
      {{"importance", "environment/ring"},
       "ring.json#/engine: is 'environment', which weighs no wavelengths; expected 'spectral'; choose"},
      {{"importance", "inverse/shapes"},
       "shapes.json#/engine: is 'inverse', which weighs no wavelengths; expected 'spectral'; choose"},
      {{"pictures", "first-light"},
       "first-light.json#/engine: is 'spectral', which casts no pictures; expected 'inverse'; choose"},
      {{"clusters", "k.yml"}, "take it with --ior k.yml"},
      {{"clusters", "--ior", "NBK7"}, "; did you mean 'N-BK7'?"},
      {{"clusters", "--ior", "no-such-glass"}, "'no-such-glass' not found"},
      {{"clusters", "--ior", "k.yml"}, "k has no index of refraction n, only k"},
      {{"clusters", "--ior", "negative.yml"}, "negative has n = -1.5 at 380 nm; expected n above 0"},
      {{"clusters", "--ior", "N-BK7", "--threshold", "0"}, "expected above 0 and below 90"},
      {{"clusters", "--ior", "N-BK7", "--threshold", "wide"}, "--threshold"},
      {{"clusters", "--ior", "N-BK7", "--threshold", "nan"}, "expected above 0 and below 90"},
      {{"clusters", "--ior", "N-BK7", "--method", "best"}, "best not in"},
      {{"clusters", "--ior", "N-SF66", "--outside", "refuse"}, "N-SF66 has no n at 380 nm"},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
}

class ImportanceVerb : public ProgramTest {
protected:
  void SetUp() override {
    write("ball.json", R"({
      "engine": "spectral", "unit": "m",
      "scene": {
        "materials": {"glass": {"type": "dielectric", "dispersion": "materials/N-SF66.yml"}, "the \"floor\"": {"type": "diffuse"}},
        "objects": [{"name": "ball", "shape": {"type": "sphere"}, "material": "glass"},
                    {"name": "floor", "shape": {"type": "quad", "size": [9, 1, 9]}, "material": "the \"floor\"",
                     "transform": {"translate": [0, -1, 0]}}],
        "lights": [{"type": "point", "spectrum": "D65", "position": [0, 3, 0]}]},
      "stop": {"passes": 200}})");
  }
};

TEST_F(ImportanceVerb, AnswersInTheContractsShape) {
  const Ended ended = run({"importance", "ball.json", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json answer = json::parse(ended.out);
  ASSERT_EQ(answer["wavelengths_nm"].size(), 401u);
  EXPECT_EQ(answer["name"], "ball");
  EXPECT_EQ(answer["wavelengths_nm"][0], 380);
  EXPECT_EQ(answer["wavelengths_nm"][400], 780);
  const auto u = answer["importance"].get<std::vector<double>>();
  ASSERT_EQ(u.size(), 401u);
  EXPECT_EQ(*std::max_element(u.begin(), u.end()), 1);
  EXPECT_EQ(answer["surroundings"].size(), 1u);
  EXPECT_EQ(answer["surroundings"][0]["material"], "the \"floor\"");
  EXPECT_EQ(answer["surroundings"][0]["share"], 1);
  EXPECT_NEAR(answer["surroundings"][0]["lightness"].get<double>(), 116 * std::cbrt(0.8) - 16,
              1e-9); // a reflectance of 0.8

  std::set<int> wavelengths;
  for (const json& cluster : answer["iterations"]) {
    double largest = 0;
    for (const int nm : cluster["wavelengths_nm"]) {
      wavelengths.insert(nm);
      largest = std::max(largest, u[static_cast<std::size_t>(nm - 380)]);
    }
    EXPECT_EQ(cluster["importance"], largest);
    EXPECT_EQ(cluster["iterations"], std::ceil(200 * largest));
  }
  EXPECT_EQ(wavelengths.size(), 401u);
  EXPECT_EQ(answer["iterations"].size(), 32u); // of N-SF66 at 0.05 degrees
}

TEST_F(ImportanceVerb, TakesTheMethodFromTheOptionElseFromThePreset) {
  const auto method_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"importance", "ball.json", "--json"});
    const json answer = json::parse(run(arguments).out);
    const bool fixed =
        answer["surroundings"].empty() && std::abs(answer["importance"][0].get<double>() - 0.338048) < 1e-6;
    EXPECT_EQ(fixed, answer["method"] == "radziszewski");
    return answer["method"].get<std::string>();
  };
  EXPECT_EQ(method_of({}), "thesis");
  EXPECT_EQ(method_of({"--set", "spectral.effort=equal"}), "thesis");
  EXPECT_EQ(method_of({"--set", "spectral.effort=radziszewski"}), "radziszewski");
  EXPECT_EQ(method_of({"--set", "spectral.effort=radziszewski", "--method", "thesis"}), "thesis");
  EXPECT_EQ(method_of({"--method", "radziszewski"}), "radziszewski");
}

TEST_F(ImportanceVerb, PrintsTablesForPeople) {
  const Ended ended = run({"importance", "ball.json", "--set", "stop.passes=1000"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out,
              testing::AllOf(HasSubstr("1.0000   91.7  the \"floor\"\n"), HasSubstr(" 1000  "),
                             HasSubstr("32 clusters alike: 32000"), HasSubstr("401 wavelengths one by one: 401000")));
}

// Lines of a sweep are told apart by their names.
TEST_F(ImportanceVerb, ASweepIsALineARun) {
  for (const char* verb : {"importance", "plan"}) {
    const Ended ended = run({verb, "ball.json", "--json", "--set", R"(sweep={"seed": [1, 2]})"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    std::vector<std::string> names;
    for (const json& line : json_lines(ended.out)) names.push_back(line["name"].get<std::string>());
    EXPECT_THAT(names, testing::ElementsAre("ball,seed=1", "ball,seed=2")) << verb;
  }
}

TEST_F(ImportanceVerb, WhatIsWrongIsSaidInOneLine) {
  const std::string says = "the importance (4.15) is 0 at every wavelength: ",
                    zero = "ball.json#/spectral/effort: " + says;
  const std::vector<std::string> black{"--set", "scene.materials.the \"floor\".reflectance=0"};
  const Wrong cases[] = {
      {{"importance"}, "PRESET is required"},
      {{"importance", "no-such-preset"}, "no-such-preset"},
      {{"importance", "ball.json", "--method", "best"}, "best not in"},
      {{"importance", "ball.json", "--set", "scene.lights.0.power_w=0"},
       zero + "no light sends power towards the caustic objects"},
      {{"importance", "ball.json", black[0], black[1]}, zero + "nothing around the caustic objects reflects"},
      {{"importance", "spectral/plate", "--set", "scene.objects=[]"}, "no object is of glass or a mirror"},
      {{"plan", "ball.json", black[0], black[1], "--set", "spectral.effort=importance"},
       "--set spectral.effort=importance: " + says},
      {{"run", "ball.json", black[0], black[1], "--set", "spectral.effort=importance"},
       "--set spectral.effort=importance: " + says},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
}

} // namespace nephroid::spectral_verbs_test
