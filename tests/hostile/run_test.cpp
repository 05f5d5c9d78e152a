// SPDX-License-Identifier: Apache-2.0
// Runs that are interrupted, killed, resumed, repeated, given one thread or two, a full disk, no HOME: the same bits or
// a clear line.
#include "image/image.h"
#include "measure/run_files.h"
#include "preset/read.h"
#include "run/prepare.h"
#include "tests/support/plate_runs.h"
#include "tests/support/program_test.h"
#include "tests/support/test_kernels.h"

#include <sys/mount.h>

namespace nephroid::run_test {

using nephroid::read_file;
using nephroid::write_file_whole;
using nlohmann::json;

class Runs : public PlateRuns {
protected:
  fs::path file(const std::string& name, const char* which) const { return scratch.path() / name / which; }
  std::string picture(const std::string& name) const { return read_file(file(name, "image.exr")); }
};

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(Runs, LeaveEveryFileOfTheContract) {
  const Ended ended = run("a", {"--passes", "3"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(messages_of(ended), IsEmpty()) << "short runs and finished ones are quiet";
  EXPECT_THAT(ended.out, HasSubstr(file("a", "image.png").string() + ": 3 passes, 60000 photons"));

  const auto image = nephroid::image::read_image(file("a", "image.exr"));
  EXPECT_EQ(image.width, 48);
  EXPECT_EQ(image.height, 40);
  ASSERT_THAT(image.channels, testing::IsSupersetOf({"R", "G", "B", "caustic.R", "direct.G"}));
  const auto channel = [&](const char* name) {
    return static_cast<std::size_t>(std::find(image.channels.begin(), image.channels.end(), name) -
                                    image.channels.begin());
  };
  double sum = 0;
  for (std::size_t i = 0; i < image.data.size(); i += image.channels.size()) {
    EXPECT_EQ(image.data[i + channel("R")], image.data[i + channel("direct.R")] + image.data[i + channel("caustic.R")]);
    sum += image.data[i + channel("caustic.G")];
  }
  EXPECT_GT(sum, 0);
  EXPECT_EQ(image.attributes.at("nephroid:seed"), "1");
  EXPECT_EQ(image.attributes.at("nephroid:preset") + "\n", read_file(file("a", "preset.json")));

  const json result = run_json("a");
  EXPECT_EQ(result["finished"], true);
  EXPECT_EQ(result["passes"], 3);
  EXPECT_EQ(result["photons"], 60000);
  const json& energy = result["energy"];
  EXPECT_GT(energy["emitted_w"].get<double>(), 0);
  EXPECT_NEAR(energy["unaccounted_w"].get<double>(), 0, 1e-9 * energy["emitted_w"].get<double>());
  EXPECT_TRUE(json::parse(read_file(file("a", "plan.json"))).contains("passes"));
  const auto png = nephroid::image::read_image(file("a", "image.png"));
  EXPECT_EQ(png.width * png.height, 48 * 40);
}

TEST_F(Runs, AreShownAnewWithoutBeingComputed) {
  const std::vector<std::string> passes{"--passes", "2", "--set", "white=0.01"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), passes.begin(), passes.end());
    return more;
  };
  ASSERT_EQ(run("a", passes).exit_code, 0);
  const std::string exr = read_file(file("a", "image.exr")), png = read_file(file("a", "image.png"));
  const double seconds = run_json("a")["work_seconds"];
  const Ended filmic = run("a", with({"--resume", "--set", "display.tone=filmic"}));
  ASSERT_EQ(filmic.exit_code, 0) << filmic.err;
  EXPECT_THAT(filmic.err, HasSubstr("this run is finished"));
  EXPECT_TRUE(read_file(file("a", "image.exr")) == exr);
  EXPECT_FALSE(read_file(file("a", "image.png")) == png);
  EXPECT_EQ(run_json("a")["work_seconds"], seconds);
  EXPECT_EQ(run_json("a")["display"]["tone"], "filmic");
  ASSERT_EQ(run("b", with({"--set", "display.tone=filmic"})).exit_code, 0);
  EXPECT_TRUE(read_file(file("b", "image.exr")) == exr) << "whatever display says";
  for (const char* name : {"image.png", "preset.json"})
    EXPECT_TRUE(read_file(file("a", name)) == read_file(file("b", name))) << name;
  ASSERT_EQ(run("a", with({"--resume"})).exit_code, 0);
  EXPECT_TRUE(read_file(file("a", "image.png")) == png) << "and back";
}

TEST_F(Runs, AreTheSameBitsForTheSameSeedOnAnyThreadsAndFromTheirOwnPreset) {
  ASSERT_EQ(run("one", {"--passes", "5"}, {{"POCL_MAX_PTHREAD_COUNT", "1"}}).exit_code, 0);
  ASSERT_EQ(run("two", {"--passes", "5"}, {{"POCL_MAX_PTHREAD_COUNT", "2"}}).exit_code, 0);
  ASSERT_EQ(run("other", {"--passes", "5", "--seed", "2"}).exit_code, 0);
  const auto again =
      nephroid::test::nephroid({"run", file("one", "preset.json").string(), "-o", "again"}, scratch.path(), logs);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(picture("one") == picture("two"));
  EXPECT_TRUE(picture("one") == picture("again"));
  const auto one = nephroid::image::read_image(file("one", "image.exr")),
             other = nephroid::image::read_image(file("other", "image.exr"));
  EXPECT_NE(one.data, other.data);
}

TEST_F(Runs, KilledAndResumedEqualUninterruptedOnes) {
  ASSERT_EQ(run("whole", {"--passes", "80"}).exit_code, 0);
  {
    Child child(into("killed", {"--passes", "80", "--checkpoint-seconds", "0.05"}), scratch.path(), logs);
    ASSERT_TRUE(child.until([&] { return fs::exists(file("killed", "checkpoint.bin")); }));
    child.send(SIGKILL);
    ASSERT_EQ(child.wait().signal, SIGKILL) << "the run was over before it could be killed";
  }
  EXPECT_FALSE(fs::exists(file("killed", "image.exr")));
  write_file_whole(scratch.path() / "killed" / ".image.1-1.tmp.exr",
                   "half a picture"); // as a writer killed at its work leaves it
  const Ended resumed = run("killed", {"--passes", "80", "--resume"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("going on in pass"));
  EXPECT_TRUE(picture("whole") == picture("killed"));
  EXPECT_FALSE(fs::exists(scratch.path() / "killed" / ".image.1-1.tmp.exr"));
}

TEST_F(Runs, InterruptedOnesLeaveAPictureAndACheckpoint) {
  for (const auto& [signal, name] : {std::pair(SIGINT, "by Ctrl-C"), std::pair(SIGTERM, "by SIGTERM")}) {
    Child child(into(name, {"--passes", "1000000", "--checkpoint-seconds", "0.05"}), scratch.path(), logs);
    ASSERT_TRUE(child.until([&] { return fs::exists(file(name, "checkpoint.bin")); }));
    child.send(signal);
    const Ended ended = child.wait();
    EXPECT_EQ(ended.exit_code, 130);
    EXPECT_THAT(ended.err, HasSubstr("interrupted in pass"));
    EXPECT_THAT(ended.err, HasSubstr("--resume"));
    EXPECT_EQ(nephroid::image::read_image(file(name, "image.exr")).width, 48);
    EXPECT_EQ(run_json(name)["finished"], false);
    const int passes = run_json(name)["passes"];
    const Ended resumed = run(name, {"--passes", std::to_string(passes + 2), "--resume"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(run_json(name)["passes"], passes + 2);
  }
}

TEST_F(Runs, FinishedOnesSaySoAndCanBeExtended) {
  ASSERT_EQ(run("a", {"--passes", "3"}).exit_code, 0);
  const std::string before = picture("a");
  const Ended again = run("a", {"--passes", "3", "--resume", "--device", "no such device"}); // nothing is opened
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("this run is finished"));
  EXPECT_TRUE(picture("a") == before);
  ASSERT_EQ(run("a", {"--passes", "6", "--resume"}).exit_code, 0);
  ASSERT_EQ(run("b", {"--passes", "6"}).exit_code, 0);
  EXPECT_TRUE(picture("a") == picture("b"));
}

TEST_F(Runs, ThatCannotBeginLeaveTheFoldersThereWere) {
  fs::create_directory(file("mine", ""));
  for (const char* name : {"mine", "new"}) EXPECT_EQ(run(name, {"--set", "reference=none.exr"}).exit_code, 2);
  EXPECT_TRUE(fs::exists(file("mine", "")));
  EXPECT_FALSE(fs::exists(file("new", "")));
}

TEST_F(Runs, RefuseCheckpointsThatAreNotTheirs) {
  ASSERT_EQ(run("a", {"--passes", "2"}).exit_code, 0);
  const std::string good = read_file(file("a", "checkpoint.bin"));
  const auto answer = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--passes", "4", "--resume"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = run("a", arguments);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(lines(ended.err), 1u) << ended.err;
    return ended.err;
  };
  EXPECT_THAT(answer({"--seed", "2"}),
              HasSubstr("belongs to another preset or seed, or to other files; run without --resume"));
  EXPECT_THAT(answer({"--set", "scene.camera.fov_deg=41"}), HasSubstr("belongs to another preset"));
  // Its sums are the same, but the errors in its history are those of another picture.
  EXPECT_THAT(answer({"--set", "spectral.smoothing=on"}), HasSubstr("belongs to another preset"));
  std::string changed = good;
  changed[changed.size() / 2] ^= 1;
  for (const std::string& bytes :
       {good.substr(0, good.size() - 1), good.substr(0, good.size() / 2), good + "x", changed}) {
    write_file_whole(file("a", "checkpoint.bin"), bytes);
    EXPECT_THAT(answer({}), HasSubstr("is cut or damaged"));
  }
  for (const std::string& bytes : {std::string(), std::string(100, 'x')}) {
    write_file_whole(file("a", "checkpoint.bin"), bytes);
    EXPECT_THAT(answer({}), HasSubstr("is no checkpoint"));
  }
  EXPECT_EQ(run("a", {"--passes", "1"}).exit_code, 0) << "without --resume it starts over";
}

TEST_F(Runs, RefuseCheckpointsOfAnotherDeviceOrOtherKernels) {
  ASSERT_EQ(run("a", {"--passes", "2"}).exit_code, 0);
  const auto answer = [&](const std::vector<std::string>& more, const nephroid::test::Environment& environment = {}) {
    std::vector<std::string> arguments{"--passes", "4", "--resume"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = nephroid::test::nephroid(into("a", arguments), scratch.path(), logs, environment);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(lines(ended.err), 1u) << ended.err;
    return ended.err;
  };
  EXPECT_THAT(answer({}, {{"POCL_DEVICES", "basic"}}), HasSubstr("checkpoint.bin: was written on another device"));
  const fs::path kernels = scratch.path() / "kernels";
  fs::copy(nephroid::test::kernel_folder(), kernels, fs::copy_options::recursive);
  const std::string photons = read_file(kernels / "photons/photons.cl");
  write_file_whole(kernels / "photons/photons.cl", photons + "// other text\n");
  EXPECT_THAT(answer({"--kernels", kernels.string()}), HasSubstr("checkpoint.bin: was written with other kernels"));
  write_file_whole(kernels / "photons/photons.cl", photons);
  EXPECT_EQ(run("a", {"--passes", "4", "--resume", "--kernels", kernels.string()}).exit_code, 0)
      << "the same text from another place";
}

TEST_F(Runs, SweepsFillFoldersThatAreCalledByWhatVaries) {
  write_file_whole(
      scratch.path() / "sweep.json",
      R"({"parent": "spectral/plate.json", "scene": {"camera": {"resolution": [16, 16]}}, "sweep": {"seed": [4, 5, 6]}})");
  const std::vector<std::string> arguments{"run", "sweep.json", "--passes", "1", "--json"};
  const Ended ended = nephroid::test::nephroid(arguments, scratch.path(), logs);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  int seed = 4;
  for (const char* folder : {"out/sweep/seed=4", "out/sweep/seed=5", "out/sweep/seed=6"})
    EXPECT_EQ(run_json(folder)["seed"], seed++);

  // Every line names its run as run.json and the plan do.
  const std::vector<json> plans =
      json_lines(nephroid::test::nephroid({"plan", "sweep.json", "--json"}, scratch.path(), logs).out);
  ASSERT_EQ(plans.size(), 3u);
  std::size_t results = 0;
  for (const json& line : json_lines(ended.out)) {
    ASSERT_LT(results, 3u);
    EXPECT_EQ(line["name"], plans[results]["name"]);
    if (line["type"] != "result") continue;
    EXPECT_EQ(line["name"], run_json(line["folder"].get<std::string>())["name"]);
    ++results;
  }
  EXPECT_EQ(results, 3u);
}

TEST_F(Runs, OnePassIsNotPasses) {
  const Ended ended = run("a", {"--passes", "1", "--set", R"(reference={"type":"recipe","passes":1})"},
                          test::own_cache(scratch.path() / "cache"));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("image.png: 1 pass, "));
  EXPECT_THAT(ended.err, HasSubstr("rendering the reference, 2 x 1 pass; "));
}

TEST_F(Runs, JsonLinesEndWithTheResult) {
  const Ended ended = run("a", {"--seconds", "1.2", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const std::vector<json> all = json_lines(ended.out);
  ASSERT_GE(all.size(), 2u);
  double fraction = 0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    EXPECT_EQ(all[i]["type"], "progress");
    EXPECT_EQ(all[i]["stage"], "run");
    EXPECT_EQ(all[i]["name"], "plate");
    EXPECT_GE(all[i]["fraction"], fraction);
    fraction = all[i]["fraction"];
    EXPECT_GT(all[i]["photons_per_second"], 0);
  }
  EXPECT_EQ(fraction, 1);
  EXPECT_EQ(all.back()["type"], "result");
  EXPECT_EQ(all.back()["folder"], (scratch.path() / "a").string());
  for (const std::string name : all.back()["files"]) EXPECT_TRUE(fs::exists(scratch.path() / "a" / name));
  EXPECT_GE(all.back()["work_seconds"], 1.2);
}

TEST_F(Runs, SayOnATerminalThatTheyCompileKernels) {
  const std::string command = fmt::format("cd '{0}' && TERM=xterm POCL_CACHE_DIR='{0}/cache' script -qec \"'{1}' run "
                                          "spectral/plate --passes 1 -o a\" shown "
                                          ">/dev/null 2>&1 </dev/null",
                                          scratch.path().string(), NEPHROID_PROGRAM);
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(read_file(scratch.path() / "shown"), HasSubstr("\rplate  compiling kernels\033[K\r\033[K"));
  EXPECT_THAT(messages_of(run("b", {"--passes", "1"})), IsEmpty()) << "elsewhere it would be one line more to read";
}

TEST_F(Runs, BadOutputFoldersAreRefusedBeforeRendering) {
  write_file_whole(scratch.path() / "file", "mine");
  fs::create_directory(scratch.path() / "full");
  write_file_whole(scratch.path() / "full/letter.txt", "mine");
  const auto refused = [&](const std::string& name, int exit_code, const char* says) {
    const Ended ended = run(name, {"--seconds", "1000"});
    EXPECT_EQ(ended.exit_code, exit_code);
    EXPECT_EQ(lines(ended.err), 1u) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(says));
  };
  refused("file", 2, "is a file");
  refused("file/below", 1, "cannot be used");
  refused("full", 2, "holds files that are not of a run");
  refused("/proc/nephroid", 1, "cannot be used");
  EXPECT_EQ(read_file(scratch.path() / "file"), "mine");
  EXPECT_EQ(read_file(scratch.path() / "full/letter.txt"), "mine");
}

TEST_F(Runs, AFullDiskIsALineAndNoHalfFile) {
  const fs::path disk = scratch.path() / "disk";
  fs::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=20k") != 0) GTEST_SKIP() << "mounting a small disk needs root";
  const Ended ended = run("disk/a", {"--passes", "20", "--checkpoint-seconds", "0.05"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.out, "");
  EXPECT_THAT(ended.err, HasSubstr("No space left on device; free some space"));
  EXPECT_THAT(messages_of(ended), SizeIs(Le(2u))) << "a warning at the first checkpoint, the error at the end";
  for (const auto& entry : fs::directory_iterator(disk / "a")) {
    if (entry.path().filename() == "history.csv")
      EXPECT_NO_THROW(nephroid::measure::read_history(entry.path())); // small enough to fit, and whole
    else
      EXPECT_THAT(entry.path().extension(), ".json") << entry.path();
  }
  ::umount(disk.c_str());
}

// Linux's file names are bytes. In JSON, which is UTF-8, such a name cannot stand as it is; that must not cost the run.
TEST_F(Runs, FileAndFolderNamesMayBeAnyBytes) {
  fs::create_directory(scratch.path() / "f\xff");
  write_file_whole(scratch.path() / "f\xff/p\xfe.json",
                   R"({"parent": "spectral/plate.json", "scene": {"camera": {"resolution": [16, 16]}}})");
  for (const char* option : {"--json", "--resume"}) {
    const Ended ended =
        nephroid::test::nephroid({"run", "f\xff/p\xfe.json", "--passes", "2", option}, scratch.path(), logs);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
  EXPECT_EQ(run_json("out/p\xfe")["name"], "p\xef\xbf\xbd");
  EXPECT_EQ(nephroid::test::nephroid({"plan", "f\xff/p\xfe.json", "--json"}, scratch.path(), logs).exit_code, 0);
}

TEST_F(Runs, NeedNoHome) {
  const Ended ended = run("a", {"--passes", "1"},
                          {{"HOME", std::nullopt}, {"XDG_CACHE_HOME", std::nullopt}, {"POCL_CACHE_DIR", std::nullopt}});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

} // namespace nephroid::run_test
