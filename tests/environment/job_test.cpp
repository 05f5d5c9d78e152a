// SPDX-License-Identifier: Apache-2.0
// Runs of engine 2: the plan, the file that a second start reads and what is wrong with such a file, a run that goes on
// with the same bits, bad input.
#include "tests/environment/views.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::job_test {

using environment::EnvironmentPlan;

class EnvironmentJob : public EnvironmentJobs {
protected:
  static preset::Preset small(const preset::Overrides& more = {}) {
    preset::Overrides overrides{"environment.resolution=16", "environment.spheres=3", "environment.photons=40000"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return bake_preset(glass_ball, overrides);
  }
  static bool runs(const EnvironmentPlan& plan, std::string_view pass) {
    const auto found = std::ranges::find(plan.decisions, pass, &plan::Decision::name);
    EXPECT_NE(found, plan.decisions.end()) << pass;
    return found != plan.decisions.end() && found->runs;
  }
};

TEST_F(EnvironmentJob, BakesAndShowsItsSpheres) {
  const preset::Preset p = small({"scene.camera.resolution=[640, 320]"});
  const job::Snapshot made = run(p);
  EXPECT_EQ(made.progress.step, 26);
  EXPECT_EQ(made.progress.steps, 26);
  EXPECT_EQ(made.progress.fraction, 1);
  EXPECT_EQ(made.progress.work, 26u * 40000);
  EXPECT_EQ(made.picture->width, 640);
  ASSERT_EQ(made.picture->rgb.size(), 3u * 640 * 320);
  EXPECT_GT(*std::ranges::max_element(made.picture->rgb), 1);
  EXPECT_GE(made.pictures.size(), 3u);
  EXPECT_EQ(made.pictures.front().picture->layers.size(), 3u);
  EXPECT_EQ(made.curves.at(0).rows.size(), 26u);
  EXPECT_NEAR(job::scalar(made, "energy", "met"), 0.7854, 1e-3);
  EXPECT_NEAR(job::scalar(made, "energy", "sent") + job::scalar(made, "energy", "lost"), 1, 1e-6);
  EXPECT_THAT(made.warnings, IsEmpty());
}

// A sheet of any size is made, also one of a pixel, and before anything is baked.
TEST_F(EnvironmentJob, ShowsWhatIsThere) {
  for (const char* size : {"[1, 1]", "[3, 700]", "[2000, 16]"}) {
    const preset::Preset p = small({std::string("scene.camera.resolution=") + size});
    std::filesystem::remove(plan_of(p).baked[0].file); // the size before has it
    const auto job = job_of(p, plan_of(p));
    EXPECT_THAT(job->snapshot().pictures, IsEmpty());
    EXPECT_EQ(job->progress().fraction, 0);
    EXPECT_EQ(run(*job).picture->rgb.size(),
              3u * static_cast<std::size_t>(p.scene.camera.resolution[0] * p.scene.camera.resolution[1]));
  }
}

TEST_F(EnvironmentJob, ASecondStartReads) {
  const preset::Preset p = small();
  EnvironmentPlan plan = plan_of(p);
  EXPECT_TRUE(plan.bakes);
  EXPECT_TRUE(runs(plan, "bake"));
  const job::Snapshot first = run(*job_of(p, plan));
  EXPECT_EQ(job::scalar(first, "bake", "from_file"), 0);
  plan = plan_of(p);
  EXPECT_FALSE(plan.bakes);
  EXPECT_FALSE(runs(plan, "bake"));
  const auto job = job_of(p, plan);
  EXPECT_TRUE(job->finished());
  const job::Snapshot second = job->snapshot();
  EXPECT_EQ(job::scalar(second, "bake", "from_file"), 1);
  EXPECT_EQ(second.picture->rgb, first.picture->rgb);
  EXPECT_EQ(second.curves.at(0).rows, first.curves.at(0).rows);
  EXPECT_THAT(second.warnings, IsEmpty());
  // Where the object stands, how it is shown: the same bake. What changes light: another one.
  EXPECT_FALSE(
      plan_of(small({"scene.objects.0.transform.rotate_deg=[20, 0, 0]", "white=3", "scene.camera.fov_deg=20"})).bakes);
  for (const char* other :
       {"seed=2", "scene.materials.glass.dispersion=1.51", "scene.objects.0.shape.radius=1.01", "environment.spheres=4",
        "environment.radii=uniform", "environment.directions=98", "environment.photons=40001", "environment.reach=3"})
    EXPECT_TRUE(plan_of(small({other})).bakes) << other;
}

TEST_F(EnvironmentJob, ADamagedFileIsNeverUsed) {
  const preset::Preset p = small();
  const std::vector<float> picture = run(p).picture->rgb;
  const std::filesystem::path file = plan_of(p).baked[0].file;
  const std::string good = read_file(file);
  const auto changed = [&](std::size_t at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    return bytes;
  };
  // Seen by the plan, which says so: its first bytes, its version, its program, its key; cut short, also to nothing;
  // too long.
  const std::map<std::string, std::string> seen{{changed(0), "is no bake"},
                                                {changed(8), "was made by another version of the program"},
                                                {changed(16), "was made by another version of the program"},
                                                {changed(32), "is of another object or of other settings"},
                                                {good.substr(0, good.size() - 1), "it was cut short"},
                                                {good + "x", "it was cut short"},
                                                {good.substr(0, 40), "is no bake"},
                                                {"", "is no bake"}};
  for (const auto& [bytes, says] : seen) {
    write_file_whole(file, bytes);
    const EnvironmentPlan plan = plan_of(p);
    EXPECT_TRUE(plan.bakes);
    EXPECT_THAT(plan.notes, ElementsAre(AllOf(HasSubstr(file.string()), HasSubstr(says), HasSubstr("baked again"))));
    EXPECT_EQ(run(*job_of(p, plan)).picture->rgb, picture);
    EXPECT_EQ(read_file(file), good) << says; // the same bits once more
  }
  // Seen when it is read: other kernels, and every byte of the rest.
  const std::map<std::size_t, std::string> later{{24, "was made with other kernels"},
                                                 {80, "its checksum is wrong"},
                                                 {good.size() / 2, "its checksum is wrong"},
                                                 {good.size() - 1, "its checksum is wrong"}};
  for (const auto& [at, says] : later) {
    write_file_whole(file, changed(at));
    const EnvironmentPlan plan = plan_of(p);
    EXPECT_FALSE(plan.bakes) << at;
    const job::Snapshot made = run(*job_of(p, plan));
    EXPECT_THAT(made.warnings, ElementsAre(AllOf(HasSubstr(file.string()), HasSubstr(says), HasSubstr("baked again"))))
        << at;
    EXPECT_EQ(job::scalar(made, "bake", "from_file"), 0);
    EXPECT_EQ(made.picture->rgb, picture);
    EXPECT_EQ(read_file(file), good);
  }
}

// The bake of another object under this one's name.
TEST_F(EnvironmentJob, AnotherObjectsFileIsNotUsed) {
  const preset::Preset p = small(), other = small({"scene.objects.0.shape.radius=2"});
  run(other);
  std::filesystem::rename(plan_of(other).baked[0].file, plan_of(p).baked[0].file);
  const EnvironmentPlan plan = plan_of(p);
  EXPECT_TRUE(plan.bakes);
  EXPECT_THAT(plan.notes, ElementsAre(HasSubstr("is of another object or of other settings; it is baked again")));
}

TEST_F(EnvironmentJob, ABakeThatCannotBeKeptIsSaid) {
  write_file_whole(cache.path() / "file", "x");
  const test::Variable no_folder("XDG_CACHE_HOME", (cache.path() / "file").string());
  const job::Snapshot made = run(small());
  EXPECT_THAT(made.warnings, ElementsAre(AllOf(HasSubstr("cannot be made"), HasSubstr("the next start bakes again"))));
}

// The folder of bakes does not grow without end.
TEST_F(EnvironmentJob, TheOldestBakesGo) {
  environment::Bake bake = bake_of(small(), {{0, -1, 0}});
  const auto path = [](std::uint64_t key) { return environment::bake_path(key); };
  for (std::uint64_t key = 1; key <= 3; ++key) {
    write_bake(path(key), {key, 0}, bake);
    std::filesystem::last_write_time(path(key),
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(10 - key));
  }
  write_bake(path(4), {4, 0}, bake, 2 * std::filesystem::file_size(path(1)));
  EXPECT_FALSE(is_there(path(1)));
  EXPECT_FALSE(is_there(path(2)));
  EXPECT_TRUE(is_there(path(3)));
  write_bake(path(5), {5, 0}, bake, 1);
  EXPECT_FALSE(is_there(path(4)));
  EXPECT_TRUE(is_there(path(5)));
}

TEST_F(EnvironmentJob, GoesOnWithTheSameBits) {
  const preset::Preset p = small();
  const EnvironmentPlan plan = plan_of(p);
  run(*job_of(p, plan));
  const std::string whole = read_file(plan.baked[0].file);
  for (const std::int64_t directions : {0, 7}) {
    std::filesystem::remove(plan.baked[0].file);
    const auto begun = job_of(p, plan);
    while (begun->progress().step < directions) begun->advance();
    begun->advance(); // a part of a direction
    const std::uint64_t sent = begun->progress().work;
    const auto bytes = saved(*begun);
    const auto resumed = job_of(p, plan);
    EXPECT_TRUE(load(*resumed, bytes));
    EXPECT_EQ(resumed->progress().work, sent);
    run(*resumed);
    EXPECT_EQ(read_file(plan.baked[0].file), whole) << directions;
    for (const std::size_t cut : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
      const auto third = job_of(p, plan);
      EXPECT_THAT(refusal_of([&] { load(*third, std::span(bytes).first(cut)); }), HasSubstr("checkpoint"));
    }
  }
}

// A stop counts directions, or seconds; what is there is shown, and no half bake is kept.
TEST_F(EnvironmentJob, StopsWhereItIsTold) {
  const preset::Preset p = small({"stop.passes=2"});
  const EnvironmentPlan plan = plan_of(p);
  const job::Snapshot made = run(*job_of(p, plan));
  EXPECT_EQ(made.progress.step, 2);
  EXPECT_EQ(made.progress.steps, 2);
  EXPECT_EQ(made.progress.fraction, 1);
  EXPECT_FALSE(is_there(plan.baked[0].file));
  const preset::Preset timed = small({"stop.seconds=0.01"});
  EXPECT_LT(run(*job_of(timed, plan_of(timed))).progress.step, 26);
}

TEST_F(EnvironmentJob, ThePlanSaysWhatRuns) {
  const EnvironmentPlan plain = plan_of(small());
  EXPECT_FALSE(runs(plain, "colours"));
  EXPECT_FALSE(runs(plain, "mirrors"));
  EXPECT_FALSE(runs(plain, "attenuation"));
  EXPECT_TRUE(runs(plain, "bending"));
  const EnvironmentPlan coloured = plan_of(small({"scene.materials.glass.dispersion=materials/N-BK7.yml"}));
  EXPECT_TRUE(runs(coloured, "colours"));
  const auto bytes = [](const EnvironmentPlan& plan, std::string_view name) {
    const auto found = std::ranges::find(plan.buffers, name, &plan::PlannedBuffer::name);
    return found == plan.buffers.end() ? 0 : found->bytes;
  };
  // 5 x 9 blocks cover 18 x 18 texels, and there is one more column. A block has a way, a step and a colour.
  EXPECT_EQ(bytes(plain, "caustic spheres (host)"), 26u * 3 * (18 * 18 + 6 * 9 * 2 * 2));
  EXPECT_EQ(bytes(coloured, "caustic spheres (host)"), 26u * 3 * (18 * 18 + 6 * 9 * 2 * 3));
  const preset::Preset usual = bake_preset(glass_ball, {"scene.materials.glass.dispersion=materials/N-BK7.yml"});
  EXPECT_LT(environment::make_task(usual).bytes(), 100u << 20);
  EXPECT_EQ(bytes(plain, "spheres of one direction"), 3u * 256 * 8 * (1 + 3));
}

// What is left out changes nothing that is to be seen: photons that start towards the object alone, kernels without
// mirrors and colours.
TEST_F(EnvironmentJob, LeavesOutWhatChangesNothing) {
  const environment::Bake a = bake_of(small(), {{0, -1, 0}}), b = bake_of(small({"leave_out=false"}), {{0, -1, 0}});
  EXPECT_NEAR(a.baked[0].sent, b.baked[0].sent, 0.003);
  EXPECT_LT(relative_distance(a, 0, 2, [&](std::size_t t) { return b.at(0, 2, t).x; }), 0.1);
}

class EnvironmentInput : public EnvironmentJob {
protected:
  static std::string refusal(const std::string& objects, const preset::Overrides& overrides) {
    return refusal_of([&] { plan_of(bake_preset(objects, overrides)); });
  }
  static std::string refusal(const preset::Overrides& overrides) { return refusal(glass_ball, overrides); }
};

TEST_F(EnvironmentInput, CountsOutOfRange) {
  for (const char* count : {"0", "1", "100000"}) {
    EXPECT_THAT(refusal({std::string("environment.directions=") + count}), HasSubstr("from 26 to 386"));
    EXPECT_THAT(refusal({std::string("environment.spheres=") + count}), HasSubstr("from 2 to 64"));
    EXPECT_THAT(refusal({std::string("environment.resolution=") + count}), HasSubstr("from 8 to 1024"));
  }
  EXPECT_THAT(refusal({"environment.directions=27"}),
              AllOf(HasSubstr("environment.directions=27: is 27"), HasSubstr("expected 26, 98 or 386")));
  EXPECT_THAT(refusal({"environment.photons=0"}), HasSubstr("from 1 to"));
  EXPECT_THAT(refusal({"stop.error=1", "environment.refine=false"}), HasSubstr("nothing measures the error"));
  EXPECT_EQ(run(small({"environment.photons=1", "environment.resolution=8"})).progress.work, 26u);
}

// Of several: nested_test.cpp.
TEST_F(EnvironmentInput, NoObject) {
  const std::string wall = R"({"name": "wall", "shape": {"type": "quad"}, "material": "wall"})";
  EXPECT_THAT(refusal(wall, {}),
              AllOf(HasSubstr("#/environment/objects"), HasSubstr("no object of the scene is of glass or a mirror")));
  EXPECT_THAT(refusal("", {}), HasSubstr("no object of the scene is of glass or a mirror"));
  EXPECT_THAT(refusal(wall, {R"(environment.objects=["ball"])"}),
              HasSubstr("expected an object of glass or a mirror with a name"));
  EXPECT_EQ(plan_of(bake_preset(glass_ball + ", " + wall)).task->caster.name, "object 'ball'");
}

// A mesh that changes under its name is another object, also while the program runs and keeps meshes that it has read.
TEST_F(EnvironmentInput, AMeshThatChanges) {
  const auto stone = [&](const char* corner) {
    const std::string file = cache.write("stone.obj", std::string("v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 ") + corner +
                                                          "\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
                                                          "f 3 1 4\n");
    return bake_preset(R"({"name": "stone", "mesh": ")" + file + R"(", "material": "glass"})",
                       {"environment.resolution=16", "environment.spheres=3", "environment.photons=1000"});
  };
  const preset::Preset p = stone("1");
  run(p);
  EXPECT_FALSE(plan_of(p).bakes);
  EXPECT_TRUE(plan_of(stone("3")).bakes);
  EXPECT_FALSE(plan_of(stone("1")).bakes);
}

TEST_F(EnvironmentInput, AnObjectLargerThanItsSpheres) {
  const std::string cube = R"({"name": "cube", "shape": {"type": "box"}, "material": "glass"})";
  EXPECT_THAT(refusal(cube, {"environment.reach=0.8"}),
              AllOf(HasSubstr("#/environment/reach"), HasSubstr("does not enclose object 'cube'"),
                    HasSubstr("expected at least 0.867")));
  EXPECT_EQ(plan_of(bake_preset(cube, {"environment.reach=0.867"})).task->radii.size(), 16u);
}

// Quadratic radii by (3.1), uniform ones; the smallest begins at the surface.
TEST_F(EnvironmentInput, Radii) {
  const auto radii = [](const char* kind) {
    return plan_of(small({"environment.spheres=5", std::string("environment.radii=") + kind})).task->radii;
  };
  const std::vector<double> quadratic = radii("quadratic"), uniform = radii("uniform");
  for (std::size_t i = 0; i < 5; ++i) {
    const double part = static_cast<double>(i) / 4;
    EXPECT_NEAR(quadratic[i], 1.001 + (8 - 1.001) * part * part, 1e-6);
    EXPECT_NEAR(uniform[i], 1.001 + (8 - 1.001) * part, 1e-6);
  }
}

// An L has its middle outside of itself, a shell is open, a mirror is flat: baked, and said.
TEST_F(EnvironmentInput, OddObjects) {
  const std::string thirds =
      "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nv 0 0 1\nv 3 0 1\nv 3 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\n";
  const std::string corner =
      cache.write("l.obj", thirds + "f 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\n"
                                    "f 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n");
  const auto notes = [](const std::string& object) {
    const preset::Preset p = bake_preset(object, {"environment.resolution=16", "environment.photons=10000"});
    const EnvironmentPlan plan = plan_of(p);
    const environment::Bake bake = bake_of(p, {glm::normalize(glm::dvec3(0.2, -0.9, -0.4))});
    EXPECT_GT(power_through(bake, 0, 15).x, 0.9 * bake.baked[0].met);
    std::string all;
    for (const std::string& note : plan.notes) all += note + "\n";
    return all;
  };
  EXPECT_THAT(notes(R"({"name": "L", "mesh": ")" + corner + R"(", "material": "glass"})"), HasSubstr("outside of it"));
  const std::string open = cache.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 2 3 4\nf 1 2 4\n");
  EXPECT_THAT(notes(R"({"name": "shell", "mesh": ")" + open + R"(", "material": "glass"})"),
              HasSubstr("its mesh is open"));
  EXPECT_THAT(
      notes(
          R"({"name": "disc", "shape": {"type": "quad"}, "material": "mirror", "transform": {"rotate_deg": [90, 0, 0]}})"),
      AllOf(HasSubstr("outside of it"), testing::Not(HasSubstr("open")))); // a mirror may well be
}

} // namespace nephroid::job_test
