// SPDX-License-Identifier: Apache-2.0
// Runs of engine 2 in which photons follow the spheres: they go on to the truth and say how far they are, with the same
// bits however they got there.
#include "environment/photons.h"
#include "tests/environment/lit_ball.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::refined_job_test {

class EnvironmentRefined : public LitBallJobs {
protected:
  preset::Preset lit(const preset::Overrides& more = {}) const {
    preset::Overrides overrides{"scene.camera.resolution=[64, 48]", "environment.refine=true"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return LitBallJobs::lit(overrides);
  }

  /// Caustics by many photons alone, with random numbers of their own: of lit(), made once.
  const std::vector<float>& truth() const {
    static const std::vector<float> caustic = [&] {
      preset::Preset p = lit();
      p.seed += 1000;
      const EnvironmentPlan plan = plan_of(p);
      const auto job =
          environment::make_photons(p, *plan.render->scene, *plan.render->bvh, *plan.photons, bake_context());
      while (job->progress().step < 8) job->advance();
      return layer_rgb(job->snapshot(), "caustic");
    }();
    return caustic;
  }

  using EnvironmentPlan = environment::EnvironmentPlan;
};

double rel_l2(const std::vector<float>& a, const std::vector<float>& truth) {
  double off = 0, all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    off += std::pow(static_cast<double>(a[i]) - truth[i], 2);
    all += std::pow(static_cast<double>(truth[i]), 2);
  }
  return std::sqrt(off / all);
}

double sum(const std::vector<float>& rgb) { return std::accumulate(rgb.begin(), rgb.end(), 0.0); }

TEST_F(EnvironmentRefined, GoesOnToTheTruth) {
  preset::Preset p = lit({"stop.passes=4"});
  const std::vector<float>& is = truth();
  const std::vector<float> refined = layer_rgb(run(p), "caustic");
  environment::settings(p).refine = false;
  const std::vector<float> spheres = layer_rgb(run(p), "caustic");
  EXPECT_GT(rel_l2(spheres, is), 0.2);
  EXPECT_LT(rel_l2(refined, is), 0.05);
  EXPECT_NEAR(sum(refined) / sum(is), 1, 0.01);
}

// Spheres of a ball are as near as spheres come.
TEST_F(EnvironmentRefined, IsNearerThanSpheresAfterAPass) {
  const preset::Preset p = lit();
  const std::vector<float>& is = truth();
  preset::Preset unrefined = p;
  environment::settings(unrefined).refine = false;
  const double spheres = rel_l2(layer_rgb(run(unrefined), "caustic"), is);
  const auto job = job_of(p);
  while (!job->finished()) {
    job->advance();
    const job::Snapshot now = job->snapshot();
    if (now.caption.empty() && now.progress.step > 0) {
      EXPECT_LT(rel_l2(layer_rgb(now, "caustic"), is), spheres) << now.progress.work << " photons";
    }
  }
}

TEST_F(EnvironmentRefined, SaysItsOwnError) {
  const preset::Preset p = lit();
  const auto job = job_of(p);
  EXPECT_TRUE(job->estimates_error());
  const job::Snapshot made = run(*job);
  preset::Preset more = p;
  more.stop.passes = 8;
  more.seed = 77;
  const job::Snapshot better = run(more);
  const std::vector<float> none(made.picture->rgb.size());
  ASSERT_EQ(made.picture->error_draw.size(), none.size());
  double said = 0, is = 0;
  for (std::size_t i = 0; i < none.size(); ++i) {
    said += std::pow(static_cast<double>(made.picture->error_draw[i]), 2);
    is += std::pow(static_cast<double>(made.picture->rgb[i]) - better.picture->rgb[i], 2);
  }
  is /= 1 + 2.0 / 8; // the better one has an error of its own, after its passes
  EXPECT_GT(std::sqrt(said / is), 0.6);
  EXPECT_LT(std::sqrt(said / is), 1.6);
}

// Photons do not wait for the bake, and the finished picture does not know what came first.
TEST_F(EnvironmentRefined, HasAPictureWhileItBakes) {
  const preset::Preset p = lit({"environment.photons=100000"});
  const auto cold = job_of(p);
  double caustics = 0;
  while (!cold->finished()) {
    cold->advance();
    const job::Snapshot now = cold->snapshot();
    if (!now.caption.empty()) caustics = std::max(caustics, sum(layer_rgb(now, "caustic")));
  }
  EXPECT_GT(caustics, 0) << "before the spheres";
  const auto warm = job_of(p);
  EXPECT_EQ(run(*warm).picture->rgb, cold->snapshot().picture->rgb);
}

TEST_F(EnvironmentRefined, GoesOnWithTheSameBits) {
  const preset::Preset p = lit();
  const std::vector<float> whole = run(p).picture->rgb;
  const auto begun = job_of(p);
  for (int step = 0; !begun->finished(); ++step) {
    if (step % 7 == 3) {
      const auto resumed = job_of(p);
      EXPECT_TRUE(load(*resumed, saved(*begun)));
      EXPECT_EQ(resumed->snapshot().picture->rgb, begun->snapshot().picture->rgb) << "after step " << step;
      EXPECT_EQ(run(*resumed).picture->rgb, whole) << "saved after step " << step;
    }
    begun->advance();
  }
}

TEST_F(EnvironmentRefined, AdoptsWithTheBitsOfARunOfItsOwn) {
  const std::vector<std::pair<std::string, std::function<void(preset::Preset&)>>> changes{
      {"camera",
       [](preset::Preset& p) {
         look(p, {-3, 1, 2}, {0, -1, 0}, 40);
       }},
      {"turn", [](preset::Preset& p) { p.scene.environment->rotate_deg = 75; }},
      {"lights", [](preset::Preset& p) { environment::settings(p).lights = 60; }},
      {"white", [](preset::Preset& p) { p.white = 3; }},
      {"lamp",
       [](preset::Preset& p) {
         p.scene.lights = {lamp({-0.5, -1, 0})};
       }},
      {"ball",
       [](preset::Preset& p) {
         p.scene.objects[0].transform.translate = {0.3, 0.2, 0};
       }},
  };
  const preset::Preset p = lit();
  const auto job = job_of(p); // takes back each change with the next
  run(*job);
  for (const auto& [name, change] : changes) {
    preset::Preset changed = p;
    change(changed);
    ASSERT_TRUE(job->adopt(changed)) << name;
    const std::vector<float> adopted = run(*job).picture->rgb, own = run(changed).picture->rgb;
    if (name == "ball") // what is moved is rounded otherwise than what is loaded there
      EXPECT_LT(rel_l2(adopted, own), 0.05);
    else
      EXPECT_EQ(adopted, own) << name;
  }
}

// Nothing to fall on: the sky is the picture.
TEST_F(EnvironmentRefined, WithoutReceiversThereAreNoCaustics) {
  preset::Preset p = lit();
  p.scene.objects.pop_back();
  EXPECT_EQ(plan_of(p).photons->layers, 1);
  const job::Snapshot made = run(p);
  EXPECT_EQ(made.progress.step, 2);
  EXPECT_EQ(sum(layer_rgb(made, "caustic")), 0);
}

} // namespace nephroid::refined_job_test
