// SPDX-License-Identifier: Apache-2.0
// What engine 2 leaves out changes nothing that is to be seen: each case beside one in which it is not left out.
#include "tests/environment/maps.h"
#include "tests/environment/views.h"

namespace nephroid::leaving_out_test {

class EnvironmentLeavesOut : public EnvironmentJobs {
protected:
  static plan::Pass pass(const preset::Preset& p, const std::string& name)
  {
    const environment::EnvironmentPlan plan = plan_of(p);
    const auto found = std::ranges::find(plan.passes, name, &plan::Pass::name);
    EXPECT_NE(found, plan.passes.end()) << name;
    return found == plan.passes.end() ? plan::Pass{} : *found;
  }
  /// Those of `b` that `a` has too.
  static void expect_same_layers(const job::Snapshot& a, const job::Snapshot& b)
  {
    for (const job::Layer& of : a.picture->layers) EXPECT_EQ(of.rgb, layer_rgb(b, of.name)) << of.name;
  }
  static preset::Preset over_floor(const preset::Overrides& more = {})
  {
    preset::Preset p = ball_and(facing_quad("floor", {0, -1.5, 0}, {0, 1, 0}, 8), more);
    p.scene.lights = {lamp({0.3, -1, 0.2}, 3)};
    even_light(p);
    look(p, {2, 2, 4}, {0, -0.5, 0}, 50);
    return p;
  }
};

TEST_F(EnvironmentLeavesOut, TheVolumeWithoutAMedium)
{
  const preset::Preset none = over_floor(), thin = over_floor({"environment.extinction=1e-9"});
  EXPECT_FALSE(pass(none, "volume").runs);
  EXPECT_EQ(pass(none, "volume").reason, "there is no medium: environment.extinction or albedo is 0");
  EXPECT_TRUE(pass(thin, "volume").runs);
  EXPECT_TRUE(plan_of(thin).notes.empty());
  EXPECT_EQ(plan_of(over_floor({"environment.extinction=10"})).notes.size(), 1u) << "too thick";
  const job::Snapshot without = run(none), with = run(thin);
  expect_same_layers(without, with);
  EXPECT_LT(mean(layer_rgb(with, "volume")).y, 1e-8);
}

TEST_F(EnvironmentLeavesOut, CausticsThatAreSwitchedOff)
{
  const preset::Preset all = over_floor({"environment.extinction=0.1"}),
                       none = over_floor({"environment.extinction=0.1", "environment.cast=false"});
  EXPECT_FALSE(pass(none, "cast").runs);
  EXPECT_EQ(pass(none, "cast").reason, "environment.cast is false");
  const job::Snapshot with = run(all), without = run(none);
  for (const char* name : {"background", "direct", "volume"}) EXPECT_EQ(layer_rgb(with, name), layer_rgb(without, name)) << name;
  EXPECT_GT(mean(layer_rgb(with, "caustic")).y, 0.001);
  EXPECT_EQ(mean(layer_rgb(without, "caustic")), glm::dvec3(0));
  // And on again in the same job.
  const auto job = job_of(none);
  run(*job);
  ASSERT_TRUE(job->adopt(all));
  expect_same_layers(run(*job), with);
}

// The other scene has an object so far away and so small that no ray meets it.
TEST_F(EnvironmentLeavesOut, RaysToLightsWhereNothingStands)
{
  const auto view = [](const std::string& others) {
    preset::Preset p = ball_and(others);
    p.scene.lights = {lamp({0.3, -1, 0.2}, 3)};
    even_light(p);
    look(p, {2, 2, 4}, {0, -0.5, 0}, 50);
    return p;
  };
  const preset::Preset alone = view(""), speck = view(facing_quad("speck", {50, -80, 60}, {0, 1, 0}, 1e-3));
  EXPECT_FALSE(pass(alone, "occlusion").runs);
  EXPECT_EQ(pass(alone, "occlusion").reason, "nothing stands around the object");
  EXPECT_TRUE(pass(speck, "occlusion").runs);
  expect_same_layers(run(alone), run(speck));
}

TEST_F(EnvironmentLeavesOut, ABakeThatIsRight)
{
  const preset::Preset p = over_floor();
  EXPECT_TRUE(pass(p, "bake").runs);
  const job::Snapshot baked = run(p);
  EXPECT_FALSE(pass(p, "bake").runs);
  EXPECT_NE(pass(p, "bake").reason.find("the same object, material and settings"), std::string::npos);
  const job::Snapshot read = run(p);
  EXPECT_EQ(read.progress.work, baked.progress.work);
  expect_same_layers(baked, read);
}

// The lights are those that cutting makes, so the picture is.
TEST_F(EnvironmentLeavesOut, CutsOfOneColour)
{
  preset::Preset p = over_floor();
  EXPECT_FALSE(pass(p, "segments").runs);
  EXPECT_EQ(pass(p, "segments").reason, "the environment has one colour all around: 24 equal lights");
  p.leave_out = false;
  EXPECT_TRUE(pass(p, "segments").runs);
  const environment::CubeMap cube = environment::make_cube_map(uniform_map(64, 32, {2, 1, 0.5}));
  ASSERT_TRUE(cube.even);
  EXPECT_FALSE(environment::make_cube_map(synthetic_maps(64)[2].map).even);
  for (const int q : {6, 24})
    for (const environment::SegmentMethod method : {environment::SegmentMethod::variance, environment::SegmentMethod::thesis}) {
      const environment::Segmentation even = environment::even_segments(cube, q),
                                      cut = environment::segment(cube, {.lights = q, .method = method});
      ASSERT_EQ(even.lights.size(), cut.lights.size());
      for (std::size_t i = 0; i < even.lights.size(); ++i) {
        EXPECT_EQ(even.lights[i].face, cut.lights[i].face);
        EXPECT_EQ(even.lights[i].rect, cut.lights[i].rect);
        EXPECT_LT(glm::distance(even.lights[i].direction, cut.lights[i].direction), 1e-12);
        EXPECT_LT(glm::distance(even.lights[i].flux, cut.lights[i].flux), 1e-12);
        EXPECT_EQ(even.lights[i].solid_angle_sr, cut.lights[i].solid_angle_sr);
      }
      EXPECT_LT(glm::distance(even.total_flux, cut.total_flux), 1e-10);
    }
  // More lights are about as even as those that are looked for: 1.28 beside 1.16.
  const auto unevenness = [](const environment::Segmentation& lights) {
    const auto [least, most] = std::ranges::minmax(lights.lights, {}, [](const environment::Region& light) { return light.flux.y; });
    return most.flux.y / least.flux.y;
  };
  const environment::Segmentation even = environment::even_segments(cube, 96);
  EXPECT_EQ(even.lights.size(), 96u);
  EXPECT_LE(unevenness(even), 1.15 * unevenness(environment::segment(cube, {.lights = 96})));
  EXPECT_EQ(environment::even_segments(cube, 25).lights.size(), 54u);
}

} // namespace nephroid::leaving_out_test
