// SPDX-License-Identifier: Apache-2.0
// Files are read whole, written whole or not at all, and found where a preset's reader says they are; nearest names.
#include "base/hashed_bytes.h"
#include "base/interrupts.h"
#include "base/nearest.h"
#include "tests/support/process_state.h"

#include <sys/mount.h>
#include <sys/stat.h>

namespace nephroid::files_test {

class Files : public testing::Test {
protected:
  nephroid::test::TemporaryFolder temporary;
  fs::path folder = temporary.path();

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path().filename());
    return found;
  }
};

TEST(PieceHash, IsOfTheBytesAndNotOfThePieces) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < 100; ++i) bytes.push_back(static_cast<std::byte>((i * 7) % 251));
  const auto hash = [&](std::size_t first) {
    PieceHash pieces;
    pieces.add(std::span(bytes).first(first));
    pieces.add(std::span(bytes).subspan(first, 5));
    pieces.add(std::span(bytes).subspan(first + 5));
    return pieces.value();
  };
  const std::uint64_t whole = hash(0);
  for (std::size_t first = 1; first < 96; ++first) EXPECT_EQ(hash(first), whole) << first;
  // Two signs: of a mirrored mesh, say, in doubles.
  bytes[15] ^= std::byte{0x80};
  bytes[23] ^= std::byte{0x80};
  EXPECT_NE(hash(0), whole);
}

// Pieces below, at and above what waits in a buffer before it is written or after it was read.
TEST_F(Files, PiecesAreWrittenAndReadInOrder) {
  const std::vector<std::size_t> sizes{1, 3, 65535, 65536, 0, 65537, 8, 200000, 7};
  std::vector<std::byte> all;
  write_file_whole(folder / "pieces", [&](ByteSink& file) {
    for (const std::size_t size : sizes) {
      std::vector<std::byte> piece;
      for (std::size_t i = 0; i < size; ++i) piece.push_back(static_cast<std::byte>((i * 7 + size) % 251));
      file.write(piece);
      all.insert(all.end(), piece.begin(), piece.end());
    }
  });
  const std::string text = read_file(folder / "pieces");
  ASSERT_EQ(text.size(), all.size());
  EXPECT_EQ(std::memcmp(text.data(), all.data(), all.size()), 0);
  const auto file = open_file(folder / "pieces");
  std::vector<std::byte> read(all.size());
  std::span<std::byte> into(read);
  for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
    EXPECT_EQ(file->left(), into.size());
    file->read(into.first(*size));
    into = into.subspan(*size);
  }
  EXPECT_EQ(read, all);
  EXPECT_EQ(file->left(), 0u);
  EXPECT_THAT(error_of([&] { file->read(std::span(read).first(1)); }).line(),
              HasSubstr("pieces: cannot be read: it ends early"));
}

TEST_F(Files, WhatFailsWhileItIsWrittenLeavesNothing) {
  EXPECT_EQ(error_of([&] {
              write_file_whole(folder / "half", [](ByteSink& file) {
                file.value(1);
                throw failed("job", "cannot go on");
              });
            }).line(),
            "job: cannot go on");
  EXPECT_THAT(names(), ElementsAre());
}

TEST_F(Files, ALinkLeadsOnAndTheModeStays) {
  write_file_whole(folder / "own", "old");
  fs::permissions(folder / "own", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("own", folder / "link");
  write_file_whole(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "own"), "new");
  EXPECT_EQ(fs::status(folder / "own").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Files, APipeIsNotReplaced) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { write_file_whole(folder / "pipe", "text"); }).line(),
              HasSubstr("pipe: cannot be written: it is not a regular file"));
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  EXPECT_THAT(names(), ElementsAre("pipe"));
}

TEST_F(Files, BytesSurviveWritingAndReading) {
  std::string bytes(300'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 2654435761u >> 13);
  write_file_whole(folder / "a.bin", bytes);
  EXPECT_EQ(read_file(folder / "a.bin"), bytes);
  write_file_whole(folder / "a.bin", "");
  EXPECT_EQ(read_file(folder / "a.bin"), "");
  EXPECT_THAT(names(), ElementsAre("a.bin")); // no temporary file is left
}

TEST_F(Files, FilesWithoutASizeAreReadToo) { EXPECT_THAT(read_file("/proc/self/status"), HasSubstr("Name:")); }

TEST_F(Files, WhatCannotBeReadIsBadInputWithItsName) {
  const Error missing = error_of([&] { read_file(folder / "none"); });
  EXPECT_EQ(missing.exit_code(), 2);
  EXPECT_THAT(missing.line(), HasSubstr((folder / "none").string() + ": cannot be read: No such file"));
  EXPECT_THAT(error_of([&] { read_file(folder); }).line(), HasSubstr("it is a folder"));
}

TEST_F(Files, DevicesAndPipesAreRefusedAndNotWaitedFor) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const fs::path& path : {fs::path("/dev/zero"), folder / "pipe"}) {
    EXPECT_THAT(error_of([&] { read_file(path); }).line(), HasSubstr("it is not a regular file")) << path;
    EXPECT_EQ(error_of([&] { FileFinder(folder).find(path.string(), "x"); }).line(),
              "x: '" + path.string() + "' is not a regular file; expected a file");
  }
  EXPECT_THAT(error_of([&] { FileFinder(folder).find("pipe", "x"); }).line(), HasSubstr("is not a regular file"));
}

TEST_F(Files, AMissingFolderAndAFolderInTheWayAreSaid) {
  const Error missing = error_of([&] { write_file_whole(folder / "no/such/a.txt", "x"); });
  EXPECT_EQ(missing.exit_code(), 1);
  EXPECT_THAT(missing.line(), HasSubstr("make the folder first"));
  fs::create_directory(folder / "taken");
  EXPECT_THAT(error_of([&] { write_file_whole(folder / "taken", "x"); }).line(), HasSubstr("cannot be written"));
  EXPECT_THAT(names(), ElementsAre("taken"));
}

TEST_F(Files, AFullDiskIsSaidAndTheOldFileStays) {
  const fs::path disk = folder / "disk";
  fs::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "mounting a small disk needs root";
  write_file_whole(disk / "a", "old");
  const Error full = error_of([&] { write_file_whole(disk / "a", std::string(200'000, 'x')); });
  EXPECT_THAT(full.line(), HasSubstr("No space left on device; free some space"));
  EXPECT_EQ(read_file(disk / "a"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(disk), fs::directory_iterator()), 1);
  ::umount(disk.c_str());
}

TEST_F(Files, AFolderWithoutPermissionIsSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  ::chmod(folder.c_str(), 0500);
  EXPECT_THAT(error_of([&] { write_file_whole(folder / "a", "x"); }).line(),
              HasSubstr("choose a folder that you may write to"));
  ::chmod(folder.c_str(), 0700);
}

// By them a run finds what a killed writer left, and must take nothing else for it.
TEST_F(Files, KnowsItsOwnTemporaryNames) {
  for (const char* name :
       {".image.17-0.tmp.exr", ".checkpoint.4194304-12.tmp.bin", ".a.1-1.tmp", "folder/.run.1-2.tmp.json"})
    EXPECT_TRUE(is_temporary_name(name)) << name;
  for (const char* name :
       {"image.exr", ".image.exr", ".notes.tmp", "image.17-0.tmp.exr", ".tmp", ".image.17-0.tmp.exr/mine", ""})
    EXPECT_FALSE(is_temporary_name(name)) << name;
}

class Finder : public Files {
protected:
  void SetUp() override {
    for (const char* name : {"beside", "presets", "data/glmark2/models"}) fs::create_directories(folder / name);
  }

  test::Variable presets{"NEPHROID_PRESETS", folder / "presets"}, data{"XDG_DATA_DIRS", folder / "data"};
};

TEST_F(Finder, LooksBesideThenInPresetsThenInTheSystemsModels) {
  const FileFinder finder(folder / "beside");
  for (const char* place : {"data/glmark2/models", "presets", "beside"}) { // each goes before the one before
    write_file_whole(folder / place / "bunny.obj", place);
    EXPECT_EQ(finder.find("bunny.obj", "x"), folder / place / "bunny.obj");
  }
}

TEST_F(Finder, SaysWhereItLookedAndForWhom) {
  const Error error = error_of([&] { FileFinder(folder / "beside").find("none.obj", "p.json#/scene/objects/0/mesh"); });
  EXPECT_EQ(error.exit_code(), 2);
  EXPECT_THAT(error.line(), StartsWith("p.json#/scene/objects/0/mesh: 'none.obj' not found; looked in "));
  for (const char* place : {"beside", "presets", "data/glmark2/models"})
    EXPECT_THAT(error.line(), HasSubstr((folder / place).string()));
  EXPECT_THAT(error_of([&] { FileFinder().find("/no/such/file", "x"); }).line(),
              HasSubstr("there is no file '/no/such/file'"));
  EXPECT_THAT(error_of([&] { FileFinder().find("", "x"); }).line(), HasSubstr("empty"));
}

TEST_F(Finder, FoldersAreSaidToBeFoldersUnlessAFileIsFoundLater) {
  const FileFinder finder(folder / "beside");
  fs::create_directory(folder / "beside/bunny.obj");
  EXPECT_EQ(error_of([&] { finder.find("bunny.obj", "x"); }).line(),
            "x: '" + (folder / "beside/bunny.obj").string() + "' is a folder; expected a file");
  write_file_whole(folder / "presets/bunny.obj", "v 0 0 0");
  EXPECT_EQ(finder.find("bunny.obj", "x"), folder / "presets/bunny.obj");
}

TEST_F(Finder, PresetsFolderOfTheEnvironmentMustBeThere) {
  EXPECT_EQ(presets_folder(), folder / "presets");
  const test::Variable nowhere("NEPHROID_PRESETS", "/no/such/folder");
  EXPECT_THAT(error_of([] { presets_folder(); }).line(), HasSubstr("NEPHROID_PRESETS: '/no/such/folder' is no folder"));
}

TEST(Presets, AreFoundFromTheBuildFolder) {
  const test::Variable unset("NEPHROID_PRESETS", std::nullopt);
  EXPECT_TRUE(fs::equivalent(presets_folder(), fs::path(NEPHROID_SOURCE_DIR) / "presets"));
}

TEST(Nearest, DistancesOfTheLiterature) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3); // Levenshtein's own example
  EXPECT_EQ(edit_distance("ca", "abc"), 3); // 3 in optimal string alignment, 2 in Damerau's unrestricted distance
  EXPECT_EQ(edit_distance("rnu", "run"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(Nearest, OnlyNearWordsAreOffered) {
  const std::vector<std::string> verbs{"run", "plan", "presets", "dispersion"};
  EXPECT_EQ(nearest("rnu", verbs), "run");
  EXPECT_EQ(nearest("preset", verbs), "presets");
  EXPECT_EQ(nearest("disprezion", verbs), "dispersion");
  EXPECT_EQ(nearest("clusters", verbs), "");
  EXPECT_EQ(nearest("", verbs), "");
}

TEST(Interrupts, TheFirstSignalSetsTheTokenAndTheSecondKills) {
  const auto twice = [] {
    const Interrupts interrupts;
    ::kill(::getpid(), SIGTERM);
    while (!interrupts.token().stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(::getpid(), SIGTERM);
    std::this_thread::sleep_for(std::chrono::minutes(5)); // it is killed long before
  };
  EXPECT_EXIT(twice(), testing::KilledBySignal(SIGTERM), "");
  {
    const Interrupts interrupts;
    ::kill(::getpid(), SIGINT);
    while (!interrupts.token().stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  sigset_t blocked;
  ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  EXPECT_FALSE(sigismember(&blocked, SIGINT)) << "signals are as before";
}

} // namespace nephroid::files_test
