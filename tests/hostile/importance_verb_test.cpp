// SPDX-License-Identifier: Apache-2.0
// `nephroid importance` as scripts use it, and one line for whatever is wrong, here and with spectral.effort elsewhere.
#include "tests/support/json_lines.h"
#include "tests/support/program_test.h"

#include <nlohmann/json.hpp>

namespace nephroid::importance_verb_test {

using nlohmann::json;

class ImportanceVerb : public ProgramTest {
protected:
  void SetUp() override
  {
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

TEST_F(ImportanceVerb, AnswersInTheContractsShape)
{
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
  EXPECT_NEAR(answer["surroundings"][0]["lightness"].get<double>(), 116 * std::cbrt(0.8) - 16, 1e-9); // a reflectance of 0.8

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

TEST_F(ImportanceVerb, TakesTheMethodFromTheOptionElseFromThePreset)
{
  const auto method_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"importance", "ball.json", "--json"});
    const json answer = json::parse(run(arguments).out);
    const bool fixed = answer["surroundings"].empty() && std::abs(answer["importance"][0].get<double>() - 0.338048) < 1e-6;
    EXPECT_EQ(fixed, answer["method"] == "radziszewski");
    return answer["method"].get<std::string>();
  };
  EXPECT_EQ(method_of({}), "thesis");
  EXPECT_EQ(method_of({"--set", "spectral.effort=equal"}), "thesis");
  EXPECT_EQ(method_of({"--set", "spectral.effort=radziszewski"}), "radziszewski");
  EXPECT_EQ(method_of({"--set", "spectral.effort=radziszewski", "--method", "thesis"}), "thesis");
  EXPECT_EQ(method_of({"--method", "radziszewski"}), "radziszewski");
}

TEST_F(ImportanceVerb, PrintsTablesForPeople)
{
  const Ended ended = run({"importance", "ball.json", "--set", "stop.passes=1000"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, testing::AllOf(HasSubstr("1.0000   91.7  the \"floor\"\n"), HasSubstr(" 1000  "),
                                        HasSubstr("32 clusters alike: 32000"), HasSubstr("401 wavelengths one by one: 401000")));
}

// Lines of a sweep are told apart by their names.
TEST_F(ImportanceVerb, ASweepIsALineARun)
{
  for (const char* verb : {"importance", "plan"}) {
    const Ended ended = run({verb, "ball.json", "--json", "--set", R"(sweep={"seed": [1, 2]})"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    std::vector<std::string> names;
    for (const json& line : json_lines(ended.out)) names.push_back(line["name"].get<std::string>());
    EXPECT_THAT(names, testing::ElementsAre("ball,seed=1", "ball,seed=2")) << verb;
  }
}

TEST_F(ImportanceVerb, WhatIsWrongIsSaidInOneLine)
{
  const std::string says = "the importance (4.15) is 0 at every wavelength: ", zero = "ball.json#/spectral/effort: " + says;
  const std::vector<std::string> black{"--set", "scene.materials.the \"floor\".reflectance=0"};
  const Wrong cases[] = {
      {{"importance"}, "PRESET is required"},
      {{"importance", "no-such-preset"}, "no-such-preset"},
      {{"importance", "ball.json", "--method", "best"}, "best not in"},
      {{"importance", "ball.json", "--set", "scene.lights.0.power_w=0"}, zero + "no light sends power towards the caustic objects"},
      {{"importance", "ball.json", black[0], black[1]}, zero + "nothing around the caustic objects reflects"},
      {{"importance", "spectral/plate", "--set", "scene.objects=[]"}, "no object is of glass or a mirror"},
      {{"plan", "ball.json", black[0], black[1], "--set", "spectral.effort=importance"}, "--set spectral.effort=importance: " + says},
      {{"run", "ball.json", black[0], black[1], "--set", "spectral.effort=importance"}, "--set spectral.effort=importance: " + says},
      {{"plan", "ball.json", "--set", "spectral.effort=random"}, "random needs the estimator sppm"},
      {{"plan", "ball.json", "--set", "spectral.effort=variance", "--set", "spectral.estimator=sppm"},
       "variance is not measured by the estimator sppm"},
      {{"plan", "ball.json", "--set", R"(reference={"type": "recipe", "spectral": {"effort": "random"}})"},
       "random needs the estimator sppm"},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
}

} // namespace nephroid::importance_verb_test
