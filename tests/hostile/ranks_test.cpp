// SPDX-License-Identifier: Apache-2.0
// Several ranks under mpirun: the bits of one process, also after one of them was killed, and a clear line where they
// do not belong together.
#include "tests/support/child.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::ranks_test {

using nephroid::read_file;
using nlohmann::json;
using testing::HasSubstr;

/// mpirun starts as root where it is told so twice.
Environment for_mpirun(const fs::path& cache) {
  Environment environment = own_cache(cache);
  environment["OMPI_ALLOW_RUN_AS_ROOT"] = environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
  return environment;
}

class Ranks : public testing::Test {
protected:
  TemporaryFolder scratch;

  std::vector<std::string> command(int ranks, const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"--oversubscribe",     "--bind-to",      "none", "-n",
                                 std::to_string(ranks), NEPHROID_PROGRAM, "run"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }
  Ended run(int ranks, std::vector<std::string> arguments, const std::string& folder) const {
    arguments.insert(arguments.end(), {"-o", folder});
    if (ranks > 1)
      return Child(command(ranks, arguments), scratch.path(), scratch.path(), for_mpirun(scratch.path()), "mpirun")
          .wait();
    arguments.insert(arguments.begin(), "run");
    return nephroid::test::nephroid(arguments, scratch.path(), scratch.path(), own_cache(scratch.path()));
  }
  /// The newest process of the program that works in the test's folder.
  pid_t last_rank() const {
    pid_t last = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
      const int process = std::atoi(entry.path().filename().c_str());
      std::error_code ignored;
      if (process > 0 && fs::read_symlink(entry.path() / "cwd", ignored) == fs::canonical(scratch.path()) &&
          fs::read_symlink(entry.path() / "exe", ignored) == fs::canonical(NEPHROID_PROGRAM))
        last = std::max(last, process);
    }
    return last;
  }
  void expect_same(const std::string& folder, const std::string& other) const {
    int files = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(scratch.path() / other))
      if (const auto kind = entry.path().extension(); kind == ".exr" || kind == ".stl") {
        EXPECT_TRUE(read_file(entry.path()) == read_file(scratch.path() / folder / entry.path().filename()))
            << folder << entry.path();
        ++files;
      }
    EXPECT_GT(files, 0);
  }
  /// On one rank, and on as many as are named, with new caches each.
  void expect_one_picture(const std::vector<std::string>& arguments, std::initializer_list<int> counts) const {
    const Ended alone = run(1, arguments, "alone");
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    for (const int ranks : counts) {
      fs::remove_all(scratch.path() / "nephroid"); // bakes
      const std::string folder = fmt::format("of{}", ranks);
      const Ended ended = run(ranks, arguments, folder);
      ASSERT_EQ(ended.exit_code, 0) << ended.err;
      expect_same(folder, "alone");
      EXPECT_EQ(json::parse(read_file(scratch.path() / folder / "run.json"))["ranks"]["count"], ranks);
    }
  }
};

// Photons that are dealt by variance, splats, photon maps, direct light with more samples where they help, previews.
TEST_F(Ranks, GiveOnePictureOfPhotons) {
  expect_one_picture({"first-light", "--passes", "5", "--set", "scene.camera.resolution=[96,72]", "--set",
                      "spectral.photons_per_pass=20000"},
                     {2, 3});
}

TEST_F(Ranks, GiveOnePictureOfProgressiveMaps) {
  expect_one_picture({"spectral/ball-lens", "--passes", "2", "--set", "scene.camera.resolution=[40,30]", "--set",
                      "spectral.estimator=sppm", "--set", "spectral.photons_per_pass=5000"},
                     {3});
}

TEST_F(Ranks, GiveOnePictureOfTiles) {
  expect_one_picture({"first-light", "--passes", "3", "--set", "scene.camera.resolution=[96,72]", "--set",
                      "spectral.estimator=tiles", "--set", "spectral.photons_per_pass=20000"},
                     {2, 3, 4});
}

TEST_F(Ranks, GiveOnePictureOfLayers) {
  expect_one_picture(
      {"first-light", "--passes", "2", "--set", "scene.camera.resolution=[40,30]", "--set", "spectral.relight=true"},
      {2});
}

// The bake, receivers around the object, light in the air, and photons.
TEST_F(Ranks, GiveOnePictureOfAnEnvironment) {
  expect_one_picture({"environment/beam", "--passes", "3", "--set", "scene.camera.resolution=[64,48]", "--set",
                      "environment.directions=26", "--set", "environment.photons=20000", "--set",
                      "environment.resolution=32"},
                     {3});
}

TEST_F(Ranks, FindABakeThatOneOfThemHas) {
  const std::vector<std::string> arguments{"environment/ball",
                                           "--passes",
                                           "2",
                                           "--set",
                                           "scene.camera.resolution=[40,30]",
                                           "--set",
                                           "environment.directions=26",
                                           "--set",
                                           "environment.photons=20000"};
  ASSERT_EQ(run(1, arguments, "alone").exit_code, 0);
  ASSERT_EQ(run(2, arguments, "both").exit_code, 0);
  expect_same("both", "alone");
  EXPECT_EQ(json::parse(read_file(scratch.path() / "both" / "run.json"))["bake"]["from_file"], 1);
}

// What rank 0 has rendered alone before, here and of a reference, leaves its kernels ready where the others' are not.
TEST_F(Ranks, GiveOnePictureWithAWhiteThatRank0Fits) {
  expect_one_picture({"first-light", "--passes", "2", "--set", "scene.camera.resolution=[40,30]", "--set",
                      "spectral.photons_per_pass=20000", "--set", "white=auto"},
                     {2});
}

// Facets and their judge, of light in colours.
TEST_F(Ranks, DesignOneObject) {
  expect_one_picture({"inverse/dispersion", "--passes", "1", "--set", "inverse.facets=[32,32]"}, {2, 3});
}

TEST_F(Ranks, GoOnWhereOneWasKilled) {
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"first-light", "--passes", "40", "--set", "scene.camera.resolution=[40,30]", "--set",
                               "spectral.photons_per_pass=20000"});
    return more;
  };
  const fs::path checkpoint = scratch.path() / "killed" / "checkpoint.bin";
  Child child(command(2, with({"--checkpoint-seconds", "0.1", "-o", "killed"})), scratch.path(), scratch.path(),
              for_mpirun(scratch.path()), "mpirun");
  ASSERT_TRUE(child.until([&] { return fs::exists(checkpoint); }));
  const pid_t last = last_rank();
  ASSERT_GT(last, 0);
  ::kill(last, SIGKILL);
  const Ended ended = child.wait();
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_THAT(ended.err, HasSubstr(fmt::format("process {} has died", last)));
  const Ended resumed = run(3, with({"--resume"}), "killed");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("going on in pass"));
  const Ended again = run(2, with({"--resume"}), "killed");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("this run is finished"));
  ASSERT_EQ(run(1, with({}), "alone").exit_code, 0);
  expect_same("killed", "alone");
}

TEST_F(Ranks, TakeTheNextRunOfASweep) {
  const std::string sweep =
      scratch.write("sweep.json", R"({"parent": "first-light", "sweep": {"seed": [1, 2, 3, 4, 5]}})");
  const std::vector<std::string> arguments{sweep, "--passes", "1", "--set", "scene.camera.resolution=[40,30]"};
  const Ended ended = run(2, arguments, "dealt");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  ASSERT_EQ(run(1, arguments, "alone").exit_code, 0);
  for (int seed = 1; seed <= 5; ++seed) {
    const std::string name = fmt::format("seed={}", seed);
    expect_same("dealt/" + name, "alone/" + name);
    EXPECT_THAT(ended.out, HasSubstr("dealt/" + name + "/image.png: 1 pass"));
  }
  EXPECT_EQ(read_file(scratch.path() / "dealt/sweep.json"), read_file(scratch.path() / "alone/sweep.json"));
}

/// A film of four frames by several ranks is that of one. Its one track goes from one number to another.
class RanksFilms : public Ranks {
protected:
  void expect_same_film(int ranks, std::vector<std::string> arguments, const std::string& path, int from, int to) {
    arguments.insert(arguments.end(),
                     {"--set", fmt::format(R"(animation={{"frames": 4, "tracks": [{{"path": "{}", "keys": [
                         {{"frame": 0, "value": {}}}, {{"frame": 3, "value": {}}}]}}]}})",
                                           path, from, to)});
    const Ended ended = run(ranks, arguments, "by-many");
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    ASSERT_EQ(run(1, arguments, "alone").exit_code, 0);
    expect_same("by-many", "alone");
  }
};

TEST_F(RanksFilms, RenderEachFrameTogether) {
  expect_same_film(3, {"first-light", "--passes", "2", "--set", "scene.camera.resolution=[40,30]"},
                   "scene.lights.0.power_w", 100, 200);
}

TEST_F(RanksFilms, TakeTheNextFrameWhereNoneBeginsWithAnother) {
  expect_same_film(
      2, {"inverse/shapes", "--passes", "1", "--set", "inverse.facets=[16,16]", "--set", "inverse.cells=[16,16]"},
      "inverse.receivers.0.distance_mm", 80, 95);
}

TEST_F(Ranks, HaveToBelongTogether) {
  // First-light on two ranks, the second of which is given something else.
  const auto run_apart = [this](const std::vector<std::string>& first, const std::vector<std::string>& second) {
    std::vector<std::string> command{"--oversubscribe"};
    for (const auto* options : {&first, &second}) {
      if (options == &second) command.emplace_back(":");
      command.insert(command.end(), {"-n", "1", NEPHROID_PROGRAM, "run", "first-light", "--passes", "1", "-o", "a"});
      command.insert(command.end(), options->begin(), options->end());
    }
    return Child(std::move(command), scratch.path(), scratch.path(), for_mpirun(scratch.path()), "mpirun").wait();
  };
  const Ended seeds = run_apart({}, {"--seed", "3"});
  EXPECT_EQ(seeds.exit_code, 2);
  EXPECT_THAT(seeds.err, HasSubstr("has another preset than rank 0"));
  const Ended sweeps = run_apart({"--set", R"(sweep={"seed":[1,2]})"}, {"--set", R"(sweep={"seed":[1,3]})"});
  EXPECT_EQ(sweeps.exit_code, 2);
  EXPECT_THAT(sweeps.err, HasSubstr("has another list of runs than rank 0"));
  EXPECT_FALSE(fs::exists(scratch.path() / "a")) << "neither may begin what the other is not to do";

  const Ended wrong = run(2, {"no-such-preset"}, "b");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("nephroid: preset: there is no preset 'no-such-preset'"));
}

// A program without its module: several would write into one folder.
TEST_F(Ranks, NeedMpi) {
  fs::create_directories(scratch.path() / "bin");
  fs::copy_file(NEPHROID_PROGRAM, scratch.path() / "bin/nephroid");
  const Ended ended = Child({"run", "first-light"}, scratch.path(), scratch.path(), {{"OMPI_COMM_WORLD_SIZE", "2"}},
                            (scratch.path() / "bin/nephroid").string())
                          .wait();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("was started as one of 2 processes, and this build knows no MPI"));
}

} // namespace nephroid::ranks_test
