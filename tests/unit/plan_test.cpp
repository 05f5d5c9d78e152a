// SPDX-License-Identifier: Apache-2.0
// The plan as others read it: their JSON, and the text a person sees.
#include "plan/plan.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::plan_test {

using nephroid::plan::Plan;

Plan example()
{
  Plan plan;
  plan.engine = "spectral";
  plan.passes = {{"photons", true, "one light reaches 1 dielectric"}, {"absorption", false, "k is 0 everywhere"}};
  plan.buffers = {{"film", 3ull << 20}, {"tree", 5ull << 33}};
  plan.defines = {{"MAX_SURFACES", "32"}};
  plan.notes = {"bunny: 12 open edges"};
  plan.inputs = {{"bunny.obj", "00ff"}};
  return plan;
}

TEST(Plan, JsonIsTheContract)
{
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(json["engine"], "spectral");
  EXPECT_EQ(json["passes"], nlohmann::json::parse(R"([{"name":"photons","runs":true,"reason":"one light reaches 1 dielectric"},
                                                      {"name":"absorption","runs":false,"reason":"k is 0 everywhere"}])"));
  EXPECT_EQ(json["buffers"][1]["bytes"], 5ull << 33);
  EXPECT_EQ(json["defines"], (nlohmann::json{{"MAX_SURFACES", "32"}}));
  EXPECT_EQ(json["notes"], (nlohmann::json{"bunny: 12 open edges"}));
  EXPECT_EQ(json["inputs"], nlohmann::json::parse(R"([{"file":"bunny.obj","content":"00ff"}])"));
  EXPECT_EQ(json.size(), 6u);
}

// Lines of a sweep are told apart by their names.
TEST(Plan, AJsonLineHasTheNameToo)
{
  const std::string line = to_json_line(example(), "a,seed=2");
  EXPECT_THAT(line, testing::Not(HasSubstr("\n")));
  EXPECT_TRUE(line.starts_with(R"({"name":"a,seed=2","engine":"spectral",)")) << line;
  auto json = nlohmann::json::parse(line);
  json.erase("name");
  EXPECT_EQ(json, nlohmann::json::parse(to_json(example())));
}

// What a panel draws its check box from, and what a person types.
TEST(Plan, APassNamesTheFieldThatTurnsItBackOn)
{
  Plan plan = example();
  plan.passes[1].field = "/leave_out";
  const auto json = nlohmann::json::parse(to_json(plan));
  EXPECT_EQ(json["passes"][1]["field"], "/leave_out");
  EXPECT_EQ(json["passes"][1]["run_value"], false);
  EXPECT_FALSE(json["passes"][0].contains("field"));
  EXPECT_THAT(to_text(plan), HasSubstr("k is 0 everywhere; to compute it: --set leave_out=false\n"));
  plan.passes[1].runs = true;
  EXPECT_THAT(to_text(plan), HasSubstr("k is 0 everywhere\n"));
}

TEST(Plan, EmptyListsAreListsAndObjects)
{
  const auto json = nlohmann::json::parse(to_json(Plan{}));
  EXPECT_TRUE(json["passes"].is_array() && json["buffers"].is_array() && json["notes"].is_array());
  EXPECT_TRUE(json["defines"].is_object());
}

TEST(Plan, TextSaysWhatIsLeftOutAndWhyAndAddsUpTheMemory)
{
  const std::string text = to_text(example());
  EXPECT_THAT(text, HasSubstr("absorption  left out  k is 0 everywhere"));
  EXPECT_THAT(text, HasSubstr("3.00 MiB"));
  EXPECT_THAT(text, HasSubstr("total   40.0 GiB"));
  EXPECT_THAT(text, HasSubstr("-D MAX_SURFACES=32"));
  EXPECT_THAT(text, HasSubstr("bunny: 12 open edges"));
}

} // namespace nephroid::plan_test
