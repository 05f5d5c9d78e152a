// SPDX-License-Identifier: Apache-2.0
// Runs of engine 2 that show a scene: going on after a save, adopting another camera, another turn and other lights,
// with the bits of a run of its own; what cannot be adopted; scenes without light, and with light of no one direction.
#include "environment/sheet.h"
#include "tests/environment/lit_ball.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::view_job_test {

class EnvironmentViewJob : public LitBallJobs {
protected:
  /// Of more pixels than a step has.
  preset::Preset lit() const { return LitBallJobs::lit({"scene.camera.resolution=[128, 96]"}); }

  static void expect_same(const job::Snapshot& a, const job::Snapshot& b, const std::string& what) {
    ASSERT_EQ(a.picture->layers.size(), b.picture->layers.size());
    for (std::size_t i = 0; i < a.picture->layers.size(); ++i)
      EXPECT_EQ(a.picture->layers[i].rgb, b.picture->layers[i].rgb) << what << ": " << a.picture->layers[i].name;
  }
};

TEST_F(EnvironmentViewJob, ShowsItsLayers) {
  const auto job = job_of(lit());
  EXPECT_NE(job->snapshot().caption, "") << "its picture is of the bake";
  while (job->progress().work == 0) job->advance(); // the bake
  const job::Snapshot coarse = job->snapshot(), made = run(*job);
  EXPECT_EQ(coarse.caption, "");
  EXPECT_EQ(made.progress.step, 2);
  EXPECT_EQ(made.progress.steps, 2);
  EXPECT_EQ(made.progress.fraction, 1);
  EXPECT_EQ(made.progress.work, 2u * 128 * 96);
  EXPECT_THAT(made.warnings, IsEmpty());
  ASSERT_EQ(made.pictures.front().name, "spheres");
  for (const char* name : {"background", "direct", "caustic"}) {
    EXPECT_GT(mean(layer_rgb(made, name)).y, 0.01) << name;
    // The first picture has one path for 4 x 4 pixels and no shadows of the map, but it is the same scene.
    EXPECT_NEAR(mean(layer_rgb(coarse, name)).y, mean(layer_rgb(made, name)).y, 0.25 * mean(layer_rgb(made, name)).y)
        << name;
  }
  const auto found = std::ranges::find(made.curves, "lights", &job::Curve::name);
  ASSERT_NE(found, made.curves.end());
  EXPECT_EQ(found->rows.size(), 24u);
}

// What is seen through the ball, and in it, is drawn by no random number there: paths that took another way would be
// squares in the picture.
TEST_F(EnvironmentViewJob, ItsFirstPictureHasNoNoise) {
  std::vector<float> first, last;
  for (const std::uint64_t seed : {1, 2}) {
    preset::Preset p = lit();
    p.seed = seed;
    const auto job = job_of(p);
    while (job->progress().work == 0) job->advance(); // the bake
    const std::vector<float> before = std::exchange(first, layer_rgb(job->snapshot(), "background")),
                             after = std::exchange(last, layer_rgb(run(*job), "background"));
    if (seed == 1) continue;
    EXPECT_EQ(first, before);
    EXPECT_NE(last, after) << "paths do take different ways";
  }
}

// Over the bake and the passes; then without the bake, which is read.
TEST_F(EnvironmentViewJob, ItsFractionRisesWithAllItDoes) {
  for (const char* what : {"baked", "read"}) {
    const auto job = job_of(lit());
    double before = 0;
    while (!job->finished()) {
      job->advance();
      const job::Progress now = job->progress();
      EXPECT_GE(now.fraction, before) << what << ", after pass " << now.step;
      EXPECT_LT(now.fraction, before + 0.3) << what << ", after pass " << now.step;
      EXPECT_EQ(now.fraction == 1, job->finished()) << what;
      before = now.fraction;
    }
  }
}

// Wherever it is saved: before anything is seen, among the pixels that are seen, cast, shaded, and have the light of
// the air.
TEST_F(EnvironmentViewJob, GoesOnWithTheSameBits) {
  preset::Preset p = lit();
  environment::settings(p).extinction = 0.1;
  const job::Snapshot whole = run(p);
  const auto begun = job_of(p);
  for (int step = 0; !begun->finished(); ++step) {
    // A pass has about eight steps: each kind once, of either pass.
    if (step % 3 == 1) {
      const auto bytes = saved(*begun);
      const auto resumed = job_of(p);
      EXPECT_TRUE(load(*resumed, bytes));
      EXPECT_EQ(resumed->progress().step, begun->progress().step);
      EXPECT_EQ(resumed->snapshot().picture->rgb, begun->snapshot().picture->rgb) << "after step " << step;
      expect_same(run(*resumed), whole, fmt::format("saved after step {}", step));
      for (const std::size_t cut : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_THAT(refusal_of([&] { load(*resumed, std::span(bytes).first(cut)); }), HasSubstr("checkpoint"));
    }
    begun->advance();
  }
}

// In the middle of a pass and after the last one. The job that adopts has seen other pixels and had other lights
// before.
TEST_F(EnvironmentViewJob, AdoptsWithTheBitsOfARunOfItsOwn) {
  const std::map<std::string, std::function<void(preset::Preset&)>> changes{
      {"camera",
       [](preset::Preset& p) {
         look(p, {-3, 1, 2}, {0, -1, 0}, 40);
       }},
      {"turn", [](preset::Preset& p) { p.scene.environment->rotate_deg = 75; }},
      {"more lights", [](preset::Preset& p) { environment::settings(p).lights = 60; }},
      {"segmentation",
       [](preset::Preset& p) { environment::settings(p).segmentation = environment::SegmentMethod::thesis; }},
      {"weights", [](preset::Preset& p) { environment::settings(p).weights = environment::SegmentWeights::texel; }},
      {"occlusion",
       [](preset::Preset& p) { environment::settings(p).occlusion = environment::Settings::Occlusion::thesis; }},
      {"white", [](preset::Preset& p) { p.white = 3; }},
      {"lamps",
       [](preset::Preset& p) {
         p.scene.lights = {lamp({-0.5, -1, 0}), lamp({0.3, -1, 0.2}, 2)};
       }},
      {"no map", [](preset::Preset& p) { p.scene.environment.reset(); }},
      {"brighter map", [](preset::Preset& p) { p.scene.environment->radiance = 2; }},
      {"all", [](preset::Preset& p) {
         look(p, {-3, 1, 2}, {0, -1, 0}, 40);
         p.scene.environment->rotate_deg = -20;
         environment::settings(p).lights = 12;
         environment::settings(p).threshold = 0.01;
         p.white = 0.5;
       }}};
  const preset::Preset before = lit();
  run(before); // bakes
  const auto job = job_of(before);
  for (const auto& [name, change] : changes) {
    preset::Preset now = before;
    change(now);
    ASSERT_TRUE(job->adopt(before)) << name;
    for (int step = 0; step < 2; ++step) job->advance();
    ASSERT_TRUE(job->adopt(now)) << name;
    expect_same(run(*job), run(now), name);
  }
}

/// The same but for rounding, which sends some paths another way.
void expect_near(const job::Snapshot& a, const job::Snapshot& b, const std::string& what) {
  for (std::size_t l = 0; l < a.picture->layers.size(); ++l) {
    const std::vector<float>&found = a.picture->layers[l].rgb, &expected = b.picture->layers[l].rgb;
    const double level = mean(expected).y;
    std::size_t off = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      off += std::abs(found[i] - expected[i]) > 1e-3 * (level + expected[i]) ? 1 : 0;
    fmt::print("{}, {}: {} of {} numbers are off\n", what, a.picture->layers[l].name, off, found.size());
    EXPECT_LT(off, found.size() / 200) << what << ": " << a.picture->layers[l].name;
    EXPECT_NEAR(mean(found).y, level, 1e-3 * level) << what << ": " << a.picture->layers[l].name;
  }
}

// The scene is not loaded again: what is there moves, in coordinates that another run would choose elsewhere.
TEST_F(EnvironmentViewJob, AdoptsWhereObjectsStand) {
  const auto caster = [](preset::Preset& p) {
    p.scene.objects[0].transform = {.rotate_deg = {10, 20, 30}, .translate = {0.2, 0.1, -0.3}};
  };
  const auto floor = [](preset::Preset& p) {
    p.scene.objects[1].transform = {.rotate_deg = {15, 0, 10}, .translate = {0.1, -1.7, 0}};
  };
  const std::map<std::string, std::function<void(preset::Preset&)>> changes{
      {"object", caster}, {"floor", floor}, {"all", [&](preset::Preset& p) {
                                               caster(p);
                                               floor(p);
                                               look(p, {-3, 1, 2}, {0, -1, 0}, 40);
                                               p.scene.environment->rotate_deg = 75;
                                               environment::settings(p).lights = 12;
                                               p.white = 3;
                                             }}};
  for (const double extinction : {0.0, 0.1}) {
    preset::Preset before = lit();
    environment::settings(before).extinction = extinction;
    const job::Snapshot as_it_was = run(before);
    const auto job = job_of(before);
    for (const auto& [name, change] : changes) {
      preset::Preset now = before;
      change(now);
      for (int step = 0; step < 3; ++step) job->advance();
      ASSERT_TRUE(job->adopt(now)) << name;
      expect_near(run(*job), run(now), name);
    }
    ASSERT_TRUE(job->adopt(before));
    expect_same(run(*job), as_it_was, "back where they were");
    preset::Preset far = before;
    far.scene.objects[0].transform.translate = {40, 1, 3};
    ASSERT_TRUE(job->adopt(far));
    expect_same(run(*job), run(far), "so far away that it is loaded again");
  }
}

// A change while the object is still baked is shown when it is.
TEST_F(EnvironmentViewJob, AdoptsWhileItBakes) {
  preset::Preset p = lit();
  const auto job = job_of(p);
  job->advance();
  p.scene.environment->rotate_deg = 75;
  environment::settings(p).lights = 8;
  look(p, {-3, 1, 2}, {0, -1, 0}, 40);
  ASSERT_TRUE(job->adopt(p));
  expect_same(run(*job), run(p), "while it bakes");
}

// The job that loads has shown another preset before.
TEST_F(EnvironmentViewJob, GoesBackToAHalfMadeBake) {
  const preset::Preset p = lit();
  preset::Preset now = p;
  look(now, {-3, 1, 2}, {0, -1, 0}, 40);
  const auto job = job_of(p);
  job->advance();
  const auto baking = saved(*job);
  run(*job);
  ASSERT_TRUE(job->adopt(now));
  run(*job);
  EXPECT_TRUE(load(*job, baking));
  EXPECT_EQ(job->progress().step, 0);
  expect_same(run(*job), run(now), "a bake again");
}

// The picture is the same, so what it took is, too.
TEST_F(EnvironmentViewJob, AnotherWhiteGoesOn) {
  const preset::Preset p = lit();
  preset::Preset brighter = p;
  brighter.white = 0.5 * p.white.value_or(1);
  const auto job = job_of(p);
  while (job->progress().step < 1) job->advance();
  const double seconds = job->progress().work_seconds;
  ASSERT_TRUE(job->adopt(brighter));
  EXPECT_EQ(job->progress().step, 1);
  EXPECT_EQ(job->progress().work_seconds, seconds);
  expect_same(run(*job), run(brighter), "brighter");
}

// Then only the lamp is left.
TEST_F(EnvironmentViewJob, AdoptsAThresholdThatDropsTheSky) {
  const preset::Preset p = lit();
  preset::Preset dropped = p;
  environment::settings(dropped).threshold = 1;
  const auto job = job_of(p);
  run(*job);
  ASSERT_TRUE(job->adopt(dropped));
  expect_same(run(*job), run(dropped), "no sky");
  EXPECT_EQ(plan_of(dropped).notes,
            std::vector<std::string>{
                "no part of the environment is above environment.threshold 1, so its light makes no caustics"});
}

// Saved right after a change that came in the middle of a pass: where the surfaces had theirs, but not yet the air.
TEST_F(EnvironmentViewJob, GoesOnAfterAChange) {
  preset::Preset before = lit();
  environment::settings(before).extinction = 0.1;
  before.stop.passes = 1;
  preset::Preset now = before;
  look(now, {-3, 1, 2}, {0, -1, 0}, 40);
  const job::Snapshot whole = run(now);
  EXPECT_GT(mean(layer_rgb(whole, "volume")).y, 0.001);
  const auto job = job_of(before);
  for (const int steps : {4, 6, 7}) {
    ASSERT_TRUE(job->adopt(before));
    for (int step = 0; step < steps && !job->finished(); ++step) job->advance();
    ASSERT_TRUE(job->adopt(now));
    const auto bytes = saved(*job);
    const auto resumed = job_of(now);
    EXPECT_TRUE(load(*resumed, bytes));
    expect_same(run(*resumed), whole, fmt::format("changed after {} steps", steps));
  }
}

TEST_F(EnvironmentViewJob, WhatItDoesNotAdopt) {
  const preset::Preset p = lit();
  const auto job = job_of(p);
  const std::vector<std::function<void(preset::Preset&)>> changes{
      [](preset::Preset& q) {
        q.scene.camera.resolution = {80, 60};
      },
      [](preset::Preset& q) { q.scene.environment.reset(), q.scene.lights.clear(); },
      [](preset::Preset& q) { q.scene.objects[0].transform.scale[0] = 1.5; },
      [](preset::Preset& q) { q.scene.objects.pop_back(); },
      [](preset::Preset& q) { environment::settings(q).photons = 7; },
      [](preset::Preset& q) { q.seed = 9; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    preset::Preset now = p;
    changes[i](now);
    EXPECT_FALSE(job->adopt(now)) << i;
    EXPECT_FALSE(environment::adoptable(p, now)) << i;
  }
  EXPECT_TRUE(job->adopt(p));
}

// What is refused changes nothing.
TEST_F(EnvironmentViewJob, RefusesToAdoptLightOfNoOneDirection) {
  const preset::Preset p = lit();
  const auto job = job_of(p);
  while (job->progress().step == 0) job->advance();
  preset::Preset now = p;
  now.scene.lights = {preset::Light{}};
  EXPECT_THAT(refusal_of([&] { job->adopt(now); }),
              testing::StartsWith("own.json#/scene/lights/0/type: is no directional light"));
  expect_same(run(*job), run(p), "after a refusal");
}

// Without light the bake is all there is: its sheet.
TEST_F(EnvironmentViewJob, WithoutLightTheBakeIsShown) {
  preset::Preset dark = lit();
  dark.scene.lights.clear();
  dark.scene.environment.reset();
  preset::Preset black = dark;
  even_light(black, 0);
  black.scene.lights = {lamp({0, -1, 0}, 0)};
  for (preset::Preset* p : {&dark, &black}) {
    p->stop.passes.reset();
    const environment::EnvironmentPlan plan = plan_of(*p);
    EXPECT_EQ(plan.render, nullptr);
    const auto job = job_of(*p, plan);
    const job::Snapshot made = run(*job);
    const environment::Bake bake = bake_of(*p);
    EXPECT_EQ(made.picture->rgb, sheet(bake, choose_shown(bake, 128, 96), 128, 96, p->white.value_or(1))->rgb);
    EXPECT_FALSE(job->adopt(lit()));
  }
}

// Whether light is black only the scene tells: then another run begins, which shows the bake.
TEST_F(EnvironmentViewJob, DoesNotAdoptBlackLight) {
  preset::Preset p = lit();
  p.scene.lights.clear();
  preset::Preset dark = p;
  dark.scene.environment->radiance = 0;
  EXPECT_TRUE(environment::adoptable(p, dark));
  const auto job = job_of(p);
  EXPECT_FALSE(job->adopt(dark)); // while it bakes
  while (job->progress().step == 0) job->advance();
  EXPECT_FALSE(job->adopt(dark));
  expect_same(run(*job), run(p), "after black light");
  dark.scene.lights = {lamp({0, -1, 0})};
  EXPECT_TRUE(job->adopt(dark));
  dark.scene.lights = {lamp({0, -1, 0}, 0)};
  EXPECT_FALSE(job->adopt(dark));
}

TEST_F(EnvironmentViewJob, RefusesLightOfNoOneDirection) {
  preset::Preset p = lit();
  for (const preset::Light::Type type :
       {preset::Light::Type::point, preset::Light::Type::spot, preset::Light::Type::area}) {
    p.scene.lights.resize(2);
    p.scene.lights[1] = {};
    p.scene.lights[1].type = type;
    const std::string line = refusal_of([&] { plan_of(p); });
    EXPECT_THAT(
        line, testing::StartsWith("own.json#/scene/lights/1/type: is no directional light; expected \"directional\""));
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

} // namespace nephroid::view_job_test
