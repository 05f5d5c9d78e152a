// SPDX-License-Identifier: Apache-2.0
// What a run's folder says of it: whether it is new, claimed, of this preset, and finished.
#include "preset/read.h"
#include "run/folder.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/test.h"

namespace nephroid::run_folder_test {

class RunFolder : public testing::Test {
protected:
  void SetUp() override {
    write_file_whole(folder / "image.exr", "a picture");
    write_file_whole(folder / "preset.json", preset::to_json(preset, folder) + "\n");
  }
  std::optional<run::FinishedRun> with_run_json(const std::string& text) const {
    write_file_whole(folder / "run.json", text);
    return run::finished_run(folder, preset);
  }
  const preset::Preset preset = test::empty_preset();
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path();
};

constexpr const char* whole =
    R"({"finished":true,"passes":7,"photons":9000000000,"units":{"steps":"passes","work":"photons"},"work_seconds":1.5})";

TEST_F(RunFolder, AFinishedRunSaysHowFarItCame) {
  const auto run = with_run_json(whole);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->progress.fraction, 1);
  EXPECT_EQ(run->progress.step, 7);
  EXPECT_EQ(run->progress.work, 9000000000u);
  EXPECT_EQ(run->progress.work_seconds, 1.5);
}

TEST_F(RunFolder, AFinishedRunCountsAsItsEngineDoes) {
  const auto run = with_run_json(
      R"({"finished":true,"sweeps":1,"facets":8,"units":{"step":"sweep","steps":"sweeps","work":"facets"},"work_seconds":1})");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->progress.units.step, "sweep");
  EXPECT_EQ(run->progress.units.steps, "sweeps");
  EXPECT_EQ(run->progress.units.works, "facets");
}

TEST_F(RunFolder, ItsFilesAreInItAlone) {
  with_run_json(
      R"({"files":["image.exr","meters/floor.csv","../others.csv","meters/../../others.csv","/etc/passwd"]})");
  EXPECT_THAT(run::engine_files(folder), ElementsAre("image.exr", "meters/floor.csv"));
}

TEST_F(RunFolder, OnlyAFolderThatWasMadeIsNew) {
  fs::create_directory(folder / "of the user");
  for (const char* name : {"of the user", "new"}) run::ClaimedFolder(folder / name);
  EXPECT_TRUE(fs::exists(folder / "of the user"));
  EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST_F(RunFolder, IsClaimedOnce) {
  const auto claim = [&](bool alone) { return run::ClaimedFolder(folder / "film", alone); };
  const auto refused = [&](bool alone) {
    EXPECT_THAT([&] { claim(alone); }, ThrowsMessage<Error>(HasSubstr("is written into by another command")));
  };
  {
    const auto claimed = claim(true);
    refused(true);
    refused(false);
  }
  {
    const auto some = claim(false), others = claim(false);
    refused(true);
  }
  claim(true);
}

TEST_F(RunFolder, AnotherPresetIsAnotherRun) {
  ASSERT_TRUE(with_run_json(whole));
  preset::Preset other = preset;
  other.seed = 2;
  EXPECT_FALSE(run::finished_run(folder, other));
  fs::remove(folder / "image.exr");
  EXPECT_FALSE(run::finished_run(folder, preset));
}

TEST_F(RunFolder, ADamagedRunJsonIsNoFinishedRun) {
  for (const char* text : {"", "{", "[]", "7", "{}", R"({"finished":false})", R"({"finished":true})",
                           R"({"finished":"yes"})", R"({"finished":true,"passes":"7","photons":1,"work_seconds":1})",
                           R"({"finished":true,"passes":7,"photons":1,"work_seconds":null})", "\xff\xfe"})
    EXPECT_FALSE(with_run_json(text)) << text;
}

} // namespace nephroid::run_folder_test
