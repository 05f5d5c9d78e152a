// SPDX-License-Identifier: Apache-2.0
// A mesh that deforms, baked at steps of its states' weights: which shapes these are, their spheres one after the other
// in one bake, what is mixed of them, runs that go on, and what is refused.
#include "tests/environment/views.h"
#include "tests/support/saved_jobs.h"

#include <numbers>

namespace nephroid::deformed_test {

/// A ball about (0, 0, 0) of triangles, longer along x.
std::string ball(double radius, double longer = 1) {
  constexpr int around = 24, down = 12;
  std::string obj;
  for (int row = 0; row <= down; ++row)
    for (int i = 0; i < around; ++i) {
      const double zenith = std::numbers::pi * row / down, azimuth = 2 * std::numbers::pi * i / around,
                   sine = row % down == 0 ? 0 : std::sin(zenith);
      obj += fmt::format("v {} {} {}\n", radius * longer * sine * std::cos(azimuth), radius * std::cos(zenith),
                         radius * sine * std::sin(azimuth));
    }
  for (int row = 0; row < down; ++row)
    for (int i = 0; i < around; ++i) {
      const int a = row * around + i + 1, b = row * around + (i + 1) % around + 1;
      if (row > 0) obj += fmt::format("f {} {} {}\n", a, b, b + around);
      if (row < down - 1) obj += fmt::format("f {} {} {}\n", a, b + around, a + around);
    }
  return obj;
}

class EnvironmentStates : public EnvironmentJobs {
protected:
  EnvironmentStates() {
    for (const auto& [name, obj] :
         {std::pair("rest", ball(1)), {"large", ball(2)}, {"huge", ball(3)}, {"long", ball(1, 1.5)}})
      cache.write(std::string(name) + ".obj", obj);
  }
  preset::Preset deformed(const std::string& states, const preset::Overrides& more = {}) const {
    preset::Overrides overrides{"environment.resolution=32", "environment.spheres=4", "environment.photons=20000",
                                "environment.refine=false", "stop.passes=4"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return bake_preset(
        fmt::format(R"({{"name": "jelly", "mesh": "{}/rest.obj", "states": [{}], "material": "glass"}}, )",
                    cache.path().string(), states) +
            facing_quad("floor", {0, -4, 0}, {0, 1, 0}, 12),
        overrides);
  }
  std::string state(const char* mesh, double weight) const {
    return fmt::format(R"({{"mesh": "{}/{}.obj", "weight": {}}})", cache.path().string(), mesh, weight);
  }
  static preset::Preset lit(preset::Preset p) {
    p.scene.lights = {lamp(glm::normalize(glm::dvec3(0.3, -1, 0.2)))};
    look(p, {0, 6, 0.1}, {0, -4, 0}, 60);
    return p;
  }
  static environment::Bake baked(const preset::Preset& p) {
    const EnvironmentPlan plan = plan_of(p);
    environment::Baking baking(plan.task, plan.baked, ~std::size_t{0}, bake_context());
    while (!baking.is_complete()) baking.advance();
    return baking.bake();
  }
  using EnvironmentPlan = environment::EnvironmentPlan;
};

TEST_F(EnvironmentStates, TheShapesAreTheCornersOfTheCell) {
  const auto shapes = [&](const std::string& states, int steps) {
    std::vector<std::vector<double>> corners;
    for (const environment::BakedShape& shape :
         environment::baked_shapes(deformed(states, {fmt::format("environment.weight_steps={}", steps)}))) {
      corners.push_back({shape.weight});
      for (const preset::State& of : shape.preset.scene.objects[0].states) corners.back().push_back(of.weight);
    }
    return corners;
  };
  using Shapes = std::vector<std::vector<double>>;
  EXPECT_EQ(shapes("", 4), (Shapes{{1}}));
  EXPECT_EQ(shapes(state("long", 0.5), 4), (Shapes{{1, 0.5}}));
  EXPECT_EQ(shapes(state("long", 0.3), 10), (Shapes{{1, 0.3}}));
  EXPECT_EQ(shapes(state("long", 0.3), 0), (Shapes{{1, 0.3}}));
  EXPECT_EQ(shapes(state("long", 0.3125), 4), (Shapes{{0.75, 0.25}, {0.25, 0.5}}));
  EXPECT_EQ(shapes(state("long", -0.125), 2), (Shapes{{0.25, -0.5}, {0.75, 0}}));
  EXPECT_EQ(shapes(state("long", 0.75) + ", " + state("large", 0.25), 1),
            (Shapes{{0.1875, 0, 0}, {0.0625, 0, 1}, {0.5625, 1, 0}, {0.1875, 1, 1}}));
  EXPECT_EQ(shapes(state("long", 1) + ", " + state("large", 0.25), 1), (Shapes{{0.75, 1, 0}, {0.25, 1, 1}}));
}

// One bake has the bits of both, each kept in its own file for the next weight of the cell.
TEST_F(EnvironmentStates, EachShapeIsBakedOnce) {
  const preset::Preset p = deformed(state("long", 0.3125));
  const environment::Bake both = baked(p);
  EXPECT_EQ(both.weights, (std::vector<double>{0.75, 0.25}));
  EXPECT_EQ(both.directions.size(), 52u);
  const environment::Bake lower = bake_of(deformed(state("long", 0.25))), upper = bake_of(deformed(state("long", 0.5)));
  std::vector<std::uint8_t> texels = lower.texels;
  texels.insert(texels.end(), upper.texels.begin(), upper.texels.end());
  EXPECT_EQ(both.texels, texels);
  EXPECT_NEAR(both.size, 2 * (1 + 0.5 * 0.3125), 1e-6);
  EXPECT_FALSE(plan_of(deformed(state("long", 0.4))).bakes);
  EXPECT_FALSE(plan_of(deformed(state("long", 0.25))).bakes);
  const EnvironmentPlan next = plan_of(deformed(state("long", 0.6)));
  EXPECT_TRUE(next.baked[0].reads);
  EXPECT_FALSE(next.baked[1].reads);
  const auto row = std::ranges::find(next.decisions, "bake", &plan::Decision::name);
  EXPECT_THAT(row->reason, HasSubstr("for 1 of the 2 shapes"));
}

TEST_F(EnvironmentStates, OnAStepItIsABakeOfItsOwn) {
  const job::Snapshot own = run(lit(deformed(state("long", 0.5), {"environment.weight_steps=0"})));
  std::filesystem::remove_all(cache.path() / "nephroid" / "bakes");
  const job::Snapshot on_step = run(lit(deformed(state("long", 0.5))));
  EXPECT_EQ(job::scalar(on_step, "bake", "from_file"), 0);
  EXPECT_EQ(on_step.picture->rgb, own.picture->rgb);
  EXPECT_GT(mean(layer_rgb(own, "caustic")).x, 1e-3);
}

// A ball that grows: in sizes of itself nothing changes, so the mixture of the smallest and the largest is the ball
// between, with its radii.
TEST_F(EnvironmentStates, AGrowingBallIsTheBallBetween) {
  const auto of = [&](int steps) {
    return deformed(state("large", 0.3), {fmt::format("environment.weight_steps={}", steps)});
  };
  const environment::Bake both = baked(of(1)), own = baked(of(0));
  ASSERT_EQ(both.radii, own.radii);
  EXPECT_EQ(both.size, own.size);
  const auto mixed = [&](std::size_t direction, std::size_t sphere) {
    return relative_distance(own, direction, sphere, [&](std::size_t t) {
      return 0.7 * both.at(direction, sphere, t).x + 0.3 * both.at(26 + direction, sphere, t).x;
    });
  };
  for (const std::size_t sphere : {0, 1, 3}) EXPECT_LT(mixed(4, sphere), 0.02) << sphere;
  const std::vector<float> ours = layer_rgb(run(lit(of(1))), "caustic"), truth = layer_rgb(run(lit(of(0))), "caustic");
  double off = 0, length = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    off += std::pow(ours[i] - truth[i], 2);
    length += std::pow(truth[i], 2);
  }
  EXPECT_GT(length, 0);
  EXPECT_LT(std::sqrt(off / length), 0.02);
}

// The sets of a light are those of each shape, by its weight.
TEST_F(EnvironmentStates, LightIsSharedByWeight) {
  const std::vector<environment::DistantLight> light{{glm::normalize(glm::dvec3(0.3, -1, 0.2)), glm::dvec3(1, 2, 3)}};
  const auto alone = environment::turned_sets(light, glm::dmat3(1), 26, {1}),
             mixed = environment::turned_sets(light, glm::dmat3(1), 26, {0.75, 0.25});
  ASSERT_EQ(mixed.size(), 2 * alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (const std::size_t shape : {0, 1}) {
      const environment::TurnedSet& set = mixed[2 * i + shape];
      EXPECT_EQ(set.direction, alone[i].direction + 26 * static_cast<int>(shape));
      EXPECT_EQ(set.to_bake, alone[i].to_bake);
      EXPECT_NEAR(glm::distance(set.flux, (shape == 0 ? 0.75 : 0.25) * alone[i].flux), 0, 1e-12);
    }
}

// In the midst of the second bake. The first one's file is there, or gone; or another run has completed both.
TEST_F(EnvironmentStates, GoesOnWithTheSameBits) {
  const preset::Preset p = deformed(state("long", 0.3125), {"stop.passes=null"});
  const auto bakes = [&] { return plan_of(p).baked; };
  const auto begun = job_of(p);
  while (begun->progress().step < 30) begun->advance();
  begun->advance();
  const auto progress = begun->progress();
  EXPECT_EQ(progress.steps, 52);
  const auto bytes = saved(*begun);
  const job::Snapshot whole = run(*begun);
  const std::string second = read_file(bakes()[1].file);
  const auto go_on = [&](std::int64_t from) {
    const auto resumed = job_of(p);
    load(*resumed, bytes);
    EXPECT_EQ(resumed->progress().step, from);
    EXPECT_EQ(resumed->progress().work, from > 0 ? progress.work : 0);
    EXPECT_EQ(run(*resumed).picture->rgb, whole.picture->rgb);
    EXPECT_EQ(read_file(bakes()[1].file), second);
  };
  go_on(progress.step);
  std::filesystem::remove(bakes()[1].file);
  go_on(progress.step);
  std::filesystem::remove(bakes()[0].file);
  std::filesystem::remove(bakes()[1].file);
  go_on(0);
}

// Within a cell a run goes on, also while it bakes. On a step and beyond it another one begins.
TEST_F(EnvironmentStates, AdoptsWeightsBetweenTheSameSteps) {
  const auto at = [&](double weight, const preset::Overrides& more = {}) {
    return lit(deformed(state("long", weight), more));
  };
  for (const double weight : {0.25, 0.5, 0.6, 0.2}) EXPECT_FALSE(environment::adoptable(at(0.3), at(weight))) << weight;
  EXPECT_FALSE(
      environment::adoptable(at(0.3, {"environment.weight_steps=0"}), at(0.4, {"environment.weight_steps=0"})));
  ASSERT_TRUE(environment::adoptable(at(0.3), at(0.4)));
  const auto job = job_of(at(0.3));
  for (int i = 0; i < 3; ++i) job->advance();
  ASSERT_TRUE(job->adopt(at(0.35)));
  const std::vector<float> between = layer_rgb(run(*job), "caustic"), own = layer_rgb(run(at(0.35)), "caustic");
  EXPECT_EQ(between, own);
  ASSERT_TRUE(job->adopt(at(0.4)));
  const job::Snapshot later = run(*job), fresh = run(at(0.4));
  EXPECT_EQ(later.picture->rgb, fresh.picture->rgb);
  EXPECT_NE(layer_rgb(later, "caustic"), own);
  EXPECT_EQ(job::scalar(later, "bake", "size"), job::scalar(fresh, "bake", "size"));
}

TEST_F(EnvironmentStates, SaysWhichBakeIsInHand) {
  const auto job = job_of(lit(deformed(state("long", 0.3125), {"environment.refine=true"})));
  EXPECT_THAT(job->snapshot().caption, HasSubstr("bake 1 of 2"));
  const auto two = plan_of(deformed(state("long", 0.3125))).buffers,
             one = plan_of(deformed(state("long", 0.5))).buffers;
  const auto spheres = [](const std::vector<plan::PlannedBuffer>& buffers) {
    return std::ranges::find(buffers, "caustic spheres (host)", &plan::PlannedBuffer::name)->bytes;
  };
  EXPECT_EQ(spheres(two), 3 * spheres(one)); // and a copy of one
}

TEST_F(EnvironmentStates, BadInput) {
  std::string states;
  for (const double weight : {0.1, 0.2, 0.3, 0.4}) states += (states.empty() ? "" : ", ") + state("long", weight);
  EXPECT_THAT(refusal_of([&] { plan_of(deformed(states)); }),
              AllOf(HasSubstr("own.json#/environment/weight_steps: is 4, and more than 3 states"),
                    HasSubstr("at most 8 shapes")));
  EXPECT_NO_THROW(plan_of(deformed(states, {"environment.weight_steps=10"})));
  EXPECT_THAT(refusal_of([&] { deformed("", {"environment.weight_steps=-1"}); }), HasSubstr("from 0 to 64"));
  // Fine at the weight itself, inside out at the step beyond.
  EXPECT_NO_THROW(plan_of(deformed(state("huge", -0.45), {"environment.weight_steps=0"})));
  EXPECT_THAT(refusal_of([&] { plan_of(deformed(state("huge", -0.45), {"environment.weight_steps=1"})); }),
              AllOf(HasSubstr("own.json#/scene/objects/0"), HasSubstr("at a step of a state's weight")));
}

} // namespace nephroid::deformed_test
