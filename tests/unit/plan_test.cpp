// SPDX-License-Identifier: Apache-2.0
// The plan as JSON and as text, and the switch that it names for a pass: the window draws a check box from it and the
// command line names it.
#include "plan/plan.h"
#include "preset/read.h"
#include "run/folder.h"
#include "spectral/engine.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/plans.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::plan_test {

using nephroid::plan::Plan;
using Json = nlohmann::json;
using Estimator = photons::Settings::Estimator;

Plan example() {
  Plan plan;
  plan.engine = "spectral";
  plan.decisions = {{"photons", true, "one light reaches 1 dielectric"}, {"absorption", false, "k is 0 everywhere"}};
  plan.buffers = {{"film", 3ull << 20}, {"tree", 5ull << 33}};
  plan.defines = {{"BVH_STACK", "32"}};
  plan.notes = {"bunny: 12 open edges"};
  plan.not_imported = {"in.xml:11: the shape hair is left out"};
  plan.inputs = {{"bunny.obj", "00ff"}};
  return plan;
}

TEST(Plan, JsonIsTheContract) {
  const auto json = Json::parse(to_json(example()));
  EXPECT_EQ(json["engine"], "spectral");
  EXPECT_EQ(json["passes"], Json::parse(R"([{"name":"photons","runs":true,"reason":"one light reaches 1 dielectric"},
                                                      {"name":"absorption","runs":false,"reason":"k is 0 everywhere"}])"));
  EXPECT_EQ(json["buffers"][1]["bytes"], 5ull << 33);
  EXPECT_EQ(json["defines"], (Json{{"BVH_STACK", "32"}}));
  EXPECT_EQ(json["notes"], (Json{"bunny: 12 open edges"}));
  EXPECT_EQ(json["inputs"], Json::parse(R"([{"file":"bunny.obj","content":"00ff"}])"));
  EXPECT_EQ(json["not_imported"], (Json{"in.xml:11: the shape hair is left out"}));
  EXPECT_EQ(json.size(), 7u);
}

// Lines of a sweep are told apart by their names.
TEST(Plan, AJsonLineHasTheNameToo) {
  const std::string line = to_json_line(example(), "a,seed=2");
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  EXPECT_TRUE(line.starts_with(R"({"name":"a,seed=2","engine":"spectral",)")) << line;
  auto json = Json::parse(line);
  json.erase("name");
  EXPECT_EQ(json, Json::parse(to_json(example())));
}

// What a panel draws its check box from, and what a person types.
TEST(Plan, APassNamesTheFieldThatTurnsItBackOn) {
  Plan plan = example();
  plan.decisions[1].field = "/leave_out";
  const auto json = Json::parse(to_json(plan));
  EXPECT_EQ(json["passes"][1]["field"], "/leave_out");
  EXPECT_EQ(json["passes"][1]["run_value"], false);
  EXPECT_FALSE(json["passes"][0].contains("field"));
  EXPECT_THAT(to_text(plan), HasSubstr("k is 0 everywhere; to compute it: --set leave_out=false\n"));
  plan.decisions[1].runs = true;
  EXPECT_THAT(to_text(plan), HasSubstr("k is 0 everywhere\n"));
}

TEST(Plan, EmptyListsAreListsAndObjects) {
  const auto json = Json::parse(to_json(Plan{}));
  EXPECT_TRUE(json["passes"].is_array() && json["buffers"].is_array() && json["notes"].is_array());
  EXPECT_TRUE(json["defines"].is_object());
}

TEST(Plan, TextSaysWhatIsLeftOutAndWhyAndAddsUpTheMemory) {
  const std::string text = to_text(example());
  EXPECT_THAT(text, HasSubstr("absorption  left out  k is 0 everywhere"));
  EXPECT_THAT(text, HasSubstr("3.00 MiB"));
  EXPECT_THAT(text, HasSubstr("total   40.0 GiB"));
  EXPECT_THAT(text, HasSubstr("-D BVH_STACK=32"));
  EXPECT_THAT(text, HasSubstr("bunny: 12 open edges"));
  EXPECT_THAT(text, HasSubstr("Not imported\n  in.xml:11: the shape hair is left out\n"));
}

/// Nothing where presets may not have these values together.
std::optional<preset::Preset> with_field(const preset::Preset& p, const std::string& pointer, bool value) {
  Json fields = Json::parse(preset::to_json(p));
  fields[Json::json_pointer(pointer)] = value;
  try {
    return preset::parse_preset(fields.dump(), p.source);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// JSON pointers of the preset's booleans that are no part of its scene.
std::vector<std::string> switches(const preset::Preset& p) {
  std::vector<std::string> pointers;
  const Json fields = Json::parse(preset::to_json(p)).flatten();
  for (const auto& [pointer, value] : fields.items())
    if (value.is_boolean() && (pointer.starts_with("/spectral/") || pointer == "/measure/estimate"))
      pointers.push_back(pointer);
  return pointers;
}

preset::Preset named(const std::string& name) {
  preset::Preset p = name == "ball"          ? ball_scene()
                     : name == "lines"       ? line_light_scene()
                     : name == "dark lights" ? dark_lights_scene()
                                             : preset::read_preset(name);
  for (preset::Object& object : p.scene.objects)
    if (object.shape) object.shape->segments = std::min(object.shape->segments, 16); // a small tree is soon made
  if (name == "ball") p.scene.environment = preset::Environment{preset::Environment::Type::constant, "", {1, 1, 1}};
  spectral::settings(p).jitter = spectral::settings(p).low_discrepancy = true;
  p.stop.passes = 8;
  return p;
}

class PlanFields : public testing::TestWithParam<std::string> {
protected:
  const preset::Preset preset_ = named(GetParam());
  const scene::Scene scene_ = scene::load_scene(preset_);
  const scene::Bvh bvh_ = scene::build_bvh(scene_.geometry);
  std::set<std::string> found_; ///< the fields of all passes

  /// Of a preset with this scene.
  plan::Decision pass_of(const preset::Preset& p, const std::string& name) const {
    const std::vector<plan::Decision> passes = spectral::make_plan(p, scene_, bvh_).decisions;
    const auto found =
        std::find_if(passes.begin(), passes.end(), [&](const plan::Decision& pass) { return pass.name == name; });
    return found == passes.end() ? plan::Decision{name, false, "there is no such pass"} : *found;
  }
  void expect_true_fields(const preset::Preset& p, const std::string& what) {
    const Json fields = Json::parse(preset::to_json(p));
    for (const plan::Decision& pass : spectral::make_plan(p, scene_, bvh_).decisions) {
      if (pass.field.empty()) continue;
      SCOPED_TRACE(what + ": " + pass.name + (pass.runs ? " runs: " : " is left out: ") + pass.reason);
      found_.insert(pass.field);
      const Json::json_pointer pointer(pass.field);
      ASSERT_TRUE(fields.contains(pointer)) << pass.field;
      const Json& value = fields[pointer];
      ASSERT_TRUE(value.is_boolean() || value.is_null()) << pass.field;
      if (!pass.runs) {
        EXPECT_NE(value, pass.run_value) << "it is so already";
      }
      EXPECT_TRUE(with_field(p, pass.field, value.is_null() ? !pass.runs : !value.get<bool>()))
          << pass.field << " the other way is refused";
      if (value == pass.run_value) continue; // it is the same preset
      const auto switched = with_field(p, pass.field, pass.run_value);
      if (switched && pass.runs) {
        EXPECT_TRUE(pass_of(*switched, pass.name).runs) << pass.field << " = " << pass.run_value << " turns it off";
      }
    }
  }
  void expect_true_fields_whatever_is_switched(const preset::Preset& p, const std::string& what) {
    expect_true_fields(p, what);
    const Json fields = Json::parse(preset::to_json(p));
    for (const std::string& pointer : switches(p))
      if (const auto other = with_field(p, pointer, !fields[Json::json_pointer(pointer)]))
        expect_true_fields(*other, what + ", " + pointer + " the other way");
  }
};

// Every switch is turned, one at a time, where nothing is left out: then few passes have a field to try, and there are
// few plans to make.
TEST_P(PlanFields, AreTrueWhateverIsSwitched) {
  expect_true_fields(preset_, "as it is");
  preset::Preset p = preset_;
  p.leave_out = false;
  expect_true_fields_whatever_is_switched(p, "nothing left out");
  for (const Estimator estimator : {Estimator::splat, Estimator::sppm}) {
    spectral::settings(p).estimator = estimator;
    expect_true_fields_whatever_is_switched(p, "another estimator");
  }
  spectral::settings(p).estimator = Estimator::points;
  p.stop.error = 1;
  expect_true_fields(p, "an error to stop at");
  for (const char* field : {"/spectral/direct", "/spectral/background", "/spectral/jitter", "/spectral/low_discrepancy",
                            "/spectral/relight", "/measure/estimate", "/leave_out"})
    EXPECT_TRUE(found_.contains(field)) << field;
}

// These passes run where their switch says so and nowhere else: the scenes have caustics, and no scene every type of
// light.
TEST_P(PlanFields, TurnTheirPassesOnAndOff) {
  for (const char* name : {"low discrepancy", "error estimate", "light types"}) {
    const plan::Decision pass = pass_of(preset_, name);
    SCOPED_TRACE(std::string(name) + ": " + pass.reason);
    ASSERT_NE(pass.field, "");
    EXPECT_TRUE(pass_of(with_field(preset_, pass.field, pass.run_value).value(), name).runs);
    EXPECT_FALSE(pass_of(with_field(preset_, pass.field, !pass.run_value).value(), name).runs);
  }
}

// A prism that the camera does not see is the simplest scene with dispersion. Each change has its reason in the plan.
TEST(AutomaticEstimator, IsTilesWhereTheyGain) {
  const auto why = [](const auto& change) {
    preset::Preset p = preset::read_preset("spectral/prism");
    change(p);
    const std::vector<plan::Decision> decisions = test::plan_of(p).decisions;
    const auto tiles = std::ranges::find(decisions, "tiles", &plan::Decision::name);
    return tiles == decisions.end() ? std::string("no row") : tiles->runs ? std::string("tiles") : tiles->reason;
  };
  const auto settings_with = [](const auto& change) {
    return [change](preset::Preset& p) { change(spectral::settings(p)); };
  };
  EXPECT_EQ(why([](auto&) {}), "tiles");
  EXPECT_EQ(why(settings_with([](auto& s) { s.estimator = Estimator::points; })), "spectral.estimator is points");
  EXPECT_THAT(why(settings_with([](auto& s) { s.relight = true; })), HasSubstr("relight"));
  EXPECT_THAT(why(settings_with([](auto& s) { s.jitter = false; })), HasSubstr("jitter false sends a cluster one way"));
  EXPECT_THAT(why([](auto& p) { p.scene.objects[0].normals = preset::Object::Normals::smooth; }), HasSubstr("tiles"));
  EXPECT_THAT(why([](auto& p) { p.scene.objects[0].shape->type = preset::Shape::Type::brilliant; }),
              HasSubstr("glass has 110 triangles"));
  EXPECT_EQ(why([](auto& p) { p.scene.camera.target = p.scene.objects[0].transform.translate; }), "tiles");
  EXPECT_THAT(why([](auto& p) {
                p.scene.objects.push_back(p.scene.objects[0]);
                p.scene.objects.back().name = "inside";
                p.scene.objects.back().transform.scale = {0.5, 0.5, 0.5};
              }),
              HasSubstr("glass meets glass"));
  EXPECT_THAT(why([](auto& p) {
                p.scene.lights[0].type = preset::Light::Type::area;
                p.scene.lights[0].size = {0.1, 0.1};
              }),
              HasSubstr("a lamp of a size"));
  EXPECT_THAT(why([](auto& p) {
                p.scene.environment.emplace().type = preset::Environment::Type::constant;
                p.scene.environment->lights = true;
              }),
              HasSubstr("an environment"));
  EXPECT_THAT(why([](auto& p) {
                p.scene.materials["gold"].type = preset::Material::Type::mirror;
                p.scene.objects.push_back(p.scene.objects[0]);
                p.scene.objects.back().name = "mirror";
                p.scene.objects.back().material = "gold";
                p.scene.objects.back().transform.translate[1] += 100;
              }),
              HasSubstr("mirrors"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, PlanFields,
                         testing::Values("ball", "lines", "dark lights", "spectral/prism", "spectral/F8BT-absorption"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace_if(
                               name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

} // namespace nephroid::plan_test
