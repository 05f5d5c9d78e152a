// SPDX-License-Identifier: Apache-2.0
// Animations as the program renders them: each frame begins with the one before, one that is rendered by itself has the
// bits of a run of its own, killed ones go on at the missing frame, the video is asked for as ffmpeg wants it, and what
// cannot be is a clear line.
#include "image/image.h"
#include "tests/support/plate_runs.h"
#include "tests/support/program_test.h"

namespace nephroid::animation_test {

using nephroid::read_file;
using nephroid::write_file_whole;
using nlohmann::json;

class Animations : public PlateRuns {
protected:
  /// The plate turns about z by 0, 10, 20, ... degrees.
  static std::string turning(int frames) {
    return fmt::format(
        R"(animation={{"frames":{},"fps":12.5,"tracks":[{{"path":"scene.objects.0.transform.rotate_deg",)"
        R"("keys":[{{"frame":0,"value":[0,0,0]}},{{"frame":10,"value":[0,0,100]}}]}}]}})",
        frames);
  }
  std::vector<std::string> turned(int frames, std::vector<std::string> more) const {
    more.insert(more.end(), {"--set", turning(frames)});
    return more;
  }
  fs::path frame(const std::string& name, int number, const char* extension = ".exr") const {
    return file(name) / fmt::format("frame_{:04}{}", number, extension);
  }
  fs::path own(const std::string& name, int number, const char* which) const {
    return file(name) / "frames" / fmt::format("{:04}", number) / which;
  }
  /// A program of the name ffmpeg before all others on the PATH.
  Environment with_ffmpeg(const std::string& script) const {
    const fs::path bin = scratch.path() / "bin";
    fs::create_directories(bin);
    write_file_whole(bin / "ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
    return {{"PATH", bin.string() + ":" + std::getenv("PATH")}};
  }
};

// Each into the film's folder from the last one on: none of them has a frame before.
TEST_F(Animations, ByThemselvesHaveTheBitsOfSingleRunsAndEveryFile) {
  Ended ended;
  for (const char* number : {"2", "1", "0"}) {
    ended = run("film", turned(3, {"--passes", "2", "--frames", number}));
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.err.find("note: frame 2 begins by itself: of frame 1 there is nothing") != std::string::npos,
              *number == '2');
  }
  EXPECT_THAT(read_file(own("film", 2, "plan.json")), HasSubstr("begins by itself"));
  ended = run("film", turned(3, {"--passes", "2", "--resume", "--json"}));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(json_lines(ended.out).back()["rendered"], 0) << "whole pictures stay";
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    for (const char* which : {"run.json", "preset.json", "plan.json", "history.csv"})
      EXPECT_TRUE(fs::exists(own("film", i, which))) << which;
    EXPECT_FALSE(fs::exists(own("film", i, "checkpoint.bin"))) << "it would fill the disk";
    EXPECT_EQ(nephroid::image::read_image(frame("film", i, ".png")).width, 48);
    const std::string single = fmt::format("single{}", i);
    ASSERT_EQ(
        run(single, {"--passes", "2", "--set", fmt::format("scene.objects.0.transform.rotate_deg=[0,0,{}]", 10 * i)})
            .exit_code,
        0);
    const auto a = nephroid::image::read_image(frame("film", i)),
               b = nephroid::image::read_image(file(single) / "image.exr");
    EXPECT_EQ(a.channels, b.channels);
    EXPECT_TRUE(a.data == b.data);
  }
  EXPECT_NE(read_file(frame("film", 0, ".png")), read_file(frame("film", 2, ".png"))) << "the plate turns";
  const Ended again =
      nephroid::test::nephroid({"run", own("film", 1, "preset.json").string(), "-o", "again"}, scratch.path(), logs);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(read_file(frame("film", 1)) == read_file(file("again") / "image.exr"));

  const std::string figures = read_file(file("film") / "frames.csv");
  EXPECT_THAT(figures, testing::StartsWith("frame,step,work,work_seconds,error\n0,2,40000,"));
  EXPECT_EQ(std::count(figures.begin(), figures.end(), '\n'), 4);
}

TEST_F(Animations, KilledAndResumedEqualUninterruptedOnes) {
  ASSERT_EQ(run("whole", turned(5, {"--passes", "60"})).exit_code, 0);
  {
    Child child(into("killed", turned(5, {"--passes", "60", "--checkpoint-seconds", "0.02"})), scratch.path(), logs);
    ASSERT_TRUE(child.until([&] { return fs::exists(own("killed", 3, "checkpoint.bin")); }));
    child.send(SIGKILL);
    ASSERT_EQ(child.wait().signal, SIGKILL) << "the run was over before it could be killed";
  }
  EXPECT_TRUE(fs::exists(frame("killed", 2)));
  EXPECT_FALSE(fs::exists(frame("killed", 4)));
  fs::remove(own("killed", 0, "run.json"));
  fs::resize_file(frame("killed", 1), fs::file_size(frame("killed", 1)) / 2); // half a picture is a missing frame
  const Ended resumed = run("killed", turned(5, {"--passes", "60", "--resume", "--json"}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("0003: going on in pass"));
  for (int i = 0; i < 5; ++i)
    for (const char* kind : {".exr", ".png"})
      EXPECT_TRUE(read_file(frame("whole", i, kind)) == read_file(frame("killed", i, kind))) << i;

  const json last = json_lines(resumed.out).back();
  EXPECT_EQ(last["type"], "animation");
  EXPECT_EQ(last["frames"], 5);
  EXPECT_EQ(last["rendered"], 4) << "all but frame 2";
  EXPECT_EQ(last["finished"], true);
  std::vector<int> results;
  for (const json& line : json_lines(resumed.out))
    if (line["type"] == "result") {
      results.push_back(line["frame"]);
      EXPECT_EQ(line["name"], fmt::format("plate,frame={}", results.back()));
      EXPECT_EQ(line["finished"], true);
      EXPECT_EQ(line["passes"], 60);
    }
  EXPECT_THAT(results, testing::ElementsAre(0, 1, 2, 3, 4));
}

// Frame 1 of the film that stands still has less noise than frame 0, which has the bits of a run of its own.
TEST_F(Animations, BeginWithTheFrameBefore) {
  const auto film = [&](const std::string& name, std::vector<std::string> more) {
    const Ended ended = run(name, turned(4, std::move(more)));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended;
  };
  film("film", {"--passes", "2"});
  film("single", {"--passes", "2", "--frames", "0"});
  EXPECT_TRUE(read_file(frame("film", 0)) == read_file(frame("single", 0)));
  film("single", {"--passes", "2", "--frames", "2"});
  EXPECT_FALSE(read_file(frame("film", 2)) == read_file(frame("single", 2))) << "it begins by itself";
  film("single", {"--passes", "2", "--frames", "1-3"});
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(read_file(frame("film", i)) == read_file(frame("single", i))) << i;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(fs::exists(own("film", i, "afterimage.bin")), i == 3) << i;
  EXPECT_THAT(read_file(own("film", 2, "plan.json")), HasSubstr("../0001/afterimage.bin"));

  // Of another film, cut, or with a bit that has turned over it is not begun with.
  film("single", {"--passes", "3", "--frames", "3"});
  EXPECT_THAT(read_file(own("single", 3, "plan.json")), HasSubstr("begins by itself"));
  film("damaged", {"--passes", "2", "--frames", "0"});
  std::string left = read_file(own("damaged", 0, "afterimage.bin"));
  left[left.size() / 2] = static_cast<char>(left[left.size() / 2] ^ 1);
  write_file_whole(own("damaged", 0, "afterimage.bin"), left);
  film("damaged", {"--passes", "2", "--frames", "1"});
  EXPECT_THAT(read_file(own("damaged", 1, "plan.json")), HasSubstr("begins by itself"));

  // Frames that began with what is still there stay; those after another one start anew.
  const auto rendered = [&] {
    return json_lines(film("film", {"--passes", "2", "--resume", "--json"}).out).back()["rendered"];
  };
  film("film", {"--passes", "2", "--frames", "0-1"});
  EXPECT_EQ(rendered(), 0);
  film("film", {"--passes", "2", "--frames", "1"});
  EXPECT_EQ(rendered(), 2) << "frame 1 began by itself this time";
}

TEST_F(Animations, AskFfmpegForAVideo) {
  const Environment makes = with_ffmpeg(
      "printf '%s\\n' \"$@\" > arguments.txt\nfor last; do :; done\ncat frame_0000.png frame_0001.png > \"$last\"\n");
  const Ended made = run("film", turned(2, {"--passes", "1"}), makes);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr((file("film") / "animation.mp4").string() + ": 2 frames, 12.5 a second"));
  EXPECT_EQ(read_file(file("film") / "animation.mp4"),
            read_file(frame("film", 0, ".png")) + read_file(frame("film", 1, ".png")));
  EXPECT_THAT(read_file(file("film") / "arguments.txt"),
              HasSubstr("-framerate\n12.5\n-start_number\n0\n-i\nframe_%04d.png\n-frames:v\n2\n"));

  const Ended fails = run("film", turned(2, {"--passes", "1", "--resume"}),
                          with_ffmpeg("echo \"Unknown encoder 'libx264'\" >&2\nexit 1\n"));
  EXPECT_EQ(fails.exit_code, 0);
  EXPECT_THAT(fails.err, HasSubstr("these frames are finished"));
  EXPECT_THAT(fails.err, HasSubstr("there is no video: ffmpeg failed: Unknown encoder 'libx264'"));
  EXPECT_FALSE(fs::exists(file("film") / "animation.part.mp4"));

  const Ended none = run("film", turned(2, {"--passes", "1", "--resume"}), {{"PATH", "/nowhere"}});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_THAT(none.err, HasSubstr("there is no video: ffmpeg is not installed"));
}

TEST_F(Animations, RenderChosenFrames) {
  const Ended some = run("film", turned(4, {"--passes", "1", "--frames", "1-2"}));
  ASSERT_EQ(some.exit_code, 0) << some.err;
  EXPECT_THAT(some.err, HasSubstr("there is no video: 2 frames are missing; go on with --resume"));
  EXPECT_FALSE(fs::exists(frame("film", 0)));
  EXPECT_TRUE(fs::exists(frame("film", 1)));
  EXPECT_TRUE(fs::exists(frame("film", 2)));
  ASSERT_EQ(run("film", turned(4, {"--passes", "1", "--frames", "3"})).exit_code, 0);
  EXPECT_TRUE(fs::exists(frame("film", 2))) << "other frames stay";
  EXPECT_TRUE(fs::exists(frame("film", 3)));
  ASSERT_EQ(run("film", turned(2, {"--passes", "1", "--resume"})).exit_code, 0);
  EXPECT_TRUE(fs::exists(frame("film", 0)));
  EXPECT_FALSE(fs::exists(frame("film", 2))) << "it is a frame no more";
  EXPECT_FALSE(fs::exists(own("film", 2, "run.json")));

  ASSERT_EQ(run("film", {"--passes", "1"}).exit_code, 0) << "a run without an animation";
  EXPECT_FALSE(fs::exists(frame("film", 0)));
  EXPECT_TRUE(fs::exists(file("film") / "image.png"));
}

// Frames at night cost the others nothing. What "auto" makes white is of a frame by day.
TEST_F(Animations, AreDarkAtNight) {
  const std::string sky = R"(scene.environment={"type":"sky","lights":true,"place":{"latitude_deg":51.22,)"
                          R"("longitude_deg":4.4,"date":"2026-06-21","hour":12,"utc_offset_h":2}})",
                    day = R"(animation={"frames":3,"tracks":[{"path":"scene.environment.place.hour",)"
                          R"("keys":[{"frame":0,"value":3},{"frame":2,"value":23}]}]})";
  const std::vector<std::string> more{"--passes",        "1",     "--set",          sky,    "--set",
                                      "scene.lights=[]", "--set", "white=\"auto\"", "--set"};
  std::vector<std::string> film = more, sweep = more;
  film.push_back(day);
  sweep.push_back(R"(sweep={"scene.environment.place.hour":[3,13]})");
  const Ended ended = run("film", film);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("the sun is below the horizon in the frames 0, 2: the sky"));
  const auto light = [&](const fs::path& picture) {
    const std::vector<float> data = nephroid::image::read_image(picture).data;
    return std::accumulate(data.begin(), data.end(), 0.0);
  };
  EXPECT_EQ(light(frame("film", 0)), 0);
  EXPECT_GT(light(frame("film", 1)), 0);
  EXPECT_EQ(light(frame("film", 2)), 0);
  const json preset = json::parse(read_file(own("film", 1, "preset.json")));
  EXPECT_NE(preset["white"], 1);
  const Ended swept = run("sweep", sweep);
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  EXPECT_THAT(swept.err, HasSubstr("note: in 1 of 2 runs the sun is below the horizon"));
  EXPECT_EQ(light(file("sweep") / "hour=3" / "image.exr"), 0);
  EXPECT_EQ(json::parse(read_file(file("sweep") / "hour=3" / "preset.json"))["white"], preset["white"]);
}

TEST_F(Animations, AreRefusedBeforeTheFirstFrame) {
  const auto refused = [&](std::vector<std::string> more, const std::string& says) {
    const std::vector<std::string> arguments = into("none", more);
    expect_refused(nephroid::test::nephroid(arguments, scratch.path(), logs), {arguments, says});
    EXPECT_FALSE(fs::exists(file("none")));
  };
  for (const char* frames : {"x", "-1", "2-1", "1-", "1-2-3", "1.5"})
    refused(turned(4, {"--frames", frames}), "names no frames");
  refused(turned(4, {"--frames", "2-4"}), "--frames 2-4: the animation has no frame 4; its frames are 0 to 3");
  refused({"--frames", "0"}, "--frames: the preset has no animation");
  refused({"--set", turning(0)}, "is 0; expected a whole number from 1 to 10000");
  refused(
      {"--set",
       R"(animation={"frames":3,"tracks":[{"path":"scene.lights.0.direction","keys":[{"frame":0,"value":[-1,-1,0]},{"frame":2,"value":[1,1,0]}]}]})"},
      "has no length; expected a direction; in frame 1");
  refused(
      {"--set", "unit=m", "--set",
       R"(scene.objects.0.shape={"type":"water","size":[3,0.03,3],"segments":32,"fetch_m":500,"wind_m_s":0})", "--set",
       R"(animation={"frames":3,"tracks":[{"path":"scene.objects.0.shape.wind_m_s","keys":[{"frame":0,"value":0},{"frame":2,"value":40}]}]})"},
      "expected water that is deeper than its waves; take less wind_m_s or fetch_m, or deeper water; in frame 1");
}

} // namespace nephroid::animation_test
