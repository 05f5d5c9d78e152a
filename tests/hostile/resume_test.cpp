// SPDX-License-Identifier: Apache-2.0
// Runs of every engine that are resumed onto other files, or from a checkpoint of another state: refused with a line
// that says which.
#include "base/hashed_bytes.h"
#include "image/image.h"
#include "tests/support/program_test.h"

namespace nephroid::resume_test {

using nephroid::read_file;
using nlohmann::json;

std::string tetrahedron(double top) {
  return fmt::format("v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 {} 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n", top);
}

std::string index_file(double n) {
  return fmt::format("DATA:\n  - type: tabulated n\n    data: |\n        0.3 {0}\n        0.9 {0}\n", n);
}

/// The tetrahedron, as a glTF's buffer.
std::string gltf_buffer(float top) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, top, 0};
  const std::uint16_t indices[] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
  std::string bytes(sizeof positions + sizeof indices, '\0');
  std::memcpy(bytes.data(), positions, sizeof positions);
  std::memcpy(bytes.data() + sizeof positions, indices, sizeof indices);
  return bytes;
}

constexpr const char* gltf_beside_buffer =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
  "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,2,1]},
               {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
  "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
  "buffers":[{"byteLength":72,"uri":"c.bin"}]})";

class Resumed : public ProgramTest {
protected:
  Resumed() {
    write("a.obj", tetrahedron(1));
    write("b.gltf", gltf_beside_buffer);
    write("c.bin", gltf_buffer(1));
    write("glass.yml", index_file(1.5));
    for (const char* picture : {"sky.exr", "reference.exr", "mask.exr", "wanted.exr"}) write_picture(picture, 1);
    write("spectral.json",
          R"({"engine": "spectral", "seed": 7, "stop": {"passes": 1}, "reference": "reference.exr", "white": 1,
      "measure": {"mask": "mask.exr"}, "spectral": {"photons_per_pass": 1000}, "scene": {"camera": {"resolution": [16, 16]},
      "environment": "sky.exr", "lights": [{"type": "directional", "direction": [0, -1, 0]}],
      "materials": {"g": {"type": "dielectric", "dispersion": "glass.yml"}}, "objects": [{"mesh": "a.obj", "material": "g"}, {"mesh": "b.gltf", "material": "g", "transform": {"translate": [5, 0, 0]}}]}})");
    write("inverse.json", R"({"engine": "inverse", "stop": {"passes": 1}, "scene": {"camera": {"resolution": [16, 16]}},
      "inverse": {"facets": [16, 16], "cells": [16, 16], "index": "glass.yml",
                  "receivers": [{"distance_mm": 100, "picture": "wanted.exr"}, {"distance_mm": 200, "picture": {"type": "ring"}}]}})");
    write("environment.json",
          R"({"engine": "environment", "stop": {"passes": 1}, "environment": {"directions": 26, "spheres": 2,
      "resolution": 16, "photons": 1000}, "scene": {"camera": {"resolution": [16, 16]}, "environment": "sky.exr",
      "materials": {"g": {"type": "dielectric", "dispersion": "glass.yml"}, "floor": {"type": "diffuse", "reflectance": 0.5}},
      "objects": [{"mesh": "a.obj", "material": "g"},
                  {"shape": {"type": "box", "size": [8, 1, 8]}, "material": "floor", "transform": {"translate": [0, -3, 0]}}]}})");
  }

  /// Grey, brighter in the corner.
  void write_picture(const std::string& name, float brightest) const {
    nephroid::image::Image image;
    image.width = name == "sky.exr" ? 32 : 16;
    image.height = 16;
    image.channels = {"R", "G", "B"};
    image.data.assign(static_cast<std::size_t>(3 * 16 * image.width), 0.5f);
    std::fill_n(image.data.begin(), 24, brightest);
    nephroid::image::write_exr(folder / name, image);
  }
  Ended resume(const std::string& preset, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", preset + ".json", "-o", "out/" + preset, "--resume"});
    return run(more, test::own_cache(scratch.path() / "cache"));
  }
  fs::path checkpoint(const std::string& preset) const { return folder / "out" / preset / "checkpoint.bin"; }
  void expect_refused_line(const Ended& ended, const std::string& line) const {
    EXPECT_EQ(ended.exit_code, 2) << line;
    EXPECT_THAT(ended.err, testing::EndsWith("nephroid: " + line + "; run without --resume to start over\n"));
  }
};

TEST_F(Resumed, RunsOntoAnotherFileSayWhichItIs) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> presets{
      {"spectral", {"a.obj", "b.gltf", "glass.yml", "sky.exr", "reference.exr", "mask.exr"}},
      {"environment", {"a.obj", "glass.yml", "sky.exr"}},
      {"inverse", {"glass.yml", "wanted.exr"}}};
  for (const auto& [preset, files] : presets) {
    ASSERT_EQ(resume(preset).exit_code, 0) << resume(preset).err;
    for (const std::string& file : files) {
      const fs::path changes = folder / (file == "b.gltf" ? "c.bin" : file);
      const std::string before = read_file(changes);
      if (file == "a.obj")
        write(file, tetrahedron(2));
      else if (file == "b.gltf")
        write("c.bin", gltf_buffer(2));
      else if (file == "glass.yml")
        write(file, index_file(1.6));
      else
        write_picture(file, 0.75f);
      const std::string changed = fmt::format("the file '{}' has changed since the run began", file);
      expect_refused_line(resume(preset), fmt::format("out/{}: this run is finished, but {}", preset, changed));
      expect_refused_line(resume(preset, {"--passes", "2"}),
                          fmt::format("out/{}/checkpoint.bin: cannot go on: {}", preset, changed));
      nephroid::write_file_whole(changes, before);
    }
    EXPECT_THAT(resume(preset).err, HasSubstr("this run is finished")) << "every file is as it was";
    EXPECT_THAT(resume(preset, {"--passes", "2"}).err, HasSubstr("going on in"));
  }
}

// There files have their whole paths.
TEST_F(Resumed, RunsOfTheirOwnPresetSayWhichItIs) {
  ASSERT_EQ(resume("inverse").exit_code, 0);
  const std::string wanted = (folder / "wanted.exr").string(),
                    finished = "out/inverse: this run is finished, but the file '" + wanted;
  const auto resume_own = [&] { return run({"run", "out/inverse/preset.json", "-o", "out/inverse", "--resume"}); };
  const Ended again = resume_own();
  EXPECT_THAT(again.err, HasSubstr("this run is finished\n"));
  EXPECT_THAT(again.out, HasSubstr(" facets in ")) << "as its engine counts";
  write_picture("wanted.exr", 0.75f);
  expect_refused_line(resume_own(), finished + "' has changed since the run began");
  fs::remove(wanted);
  expect_refused_line(resume_own(), finished + "' is gone since the run began");
}

// What a file is called does not matter, and neither does where it lies.
TEST_F(Resumed, RunsGoOnWhereTheyWereMovedToOrTheirFilesAreRenamed) {
  ASSERT_EQ(resume("inverse").exit_code, 0);
  fs::rename(folder / "wanted.exr", folder / "other.exr");
  EXPECT_THAT(resume("inverse", {"--passes", "2", "--set", "inverse.receivers.0.picture=other.exr"}).err,
              HasSubstr("going on in"));
  fs::rename(folder / "other.exr", folder / "wanted.exr");
  fs::rename(folder, scratch.path() / "elsewhere");
  const Ended ended =
      nephroid({"run", "elsewhere/inverse.json", "-o", "elsewhere/out/inverse", "--passes", "4", "--resume"},
               scratch.path(), logs);
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.err, HasSubstr("going on in"));
}

TEST_F(Resumed, SweepsNameTheFileThatChanged) {
  write("sweep.json", R"({"parent": "inverse.json", "sweep": {"seed": [1, 2]}})");
  ASSERT_EQ(resume("sweep").exit_code, 0);
  write_picture("wanted.exr", 0.75f);
  expect_refused_line(
      resume("sweep"),
      "out/sweep/seed=1: this run is finished, but the file 'wanted.exr' has changed since the run began");
  fs::remove_all(folder / "out/sweep/seed=1");
  const Ended ended = resume("sweep");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(
      ended.err,
      HasSubstr("out/sweep/seed=2: this run is finished, but the file 'wanted.exr' has changed since the run began"));
}

// The frames of an animation are runs of their own, and those that are no longer the preset's are rendered again.
TEST_F(Resumed, FramesOfAnotherFileStartAnew) {
  write("film.json",
        R"({"parent": "spectral.json", "reference": null, "measure": {"mask": null}, "animation": {"frames": 2,
    "tracks": [{"path": "scene.camera.fov_deg", "keys": [{"frame": 0, "value": 40}, {"frame": 1, "value": 50}]}]}})");
  ASSERT_EQ(resume("film").exit_code, 0) << resume("film").err;
  EXPECT_THAT(resume("film").err, HasSubstr("these frames are finished"));
  const std::string before = read_file(folder / "out/film/frame_0001.exr");
  write("a.obj", tetrahedron(2));
  const Ended ended = resume("film");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.err,
              HasSubstr("note: film: the file 'a.obj' has changed since the run began: finished frames start anew\n"));
  EXPECT_THAT(ended.err, Not(HasSubstr("these frames are finished")));
  EXPECT_NE(read_file(folder / "out/film/frame_0001.exr"), before);
  EXPECT_THAT(resume("film").err, HasSubstr("these frames are finished"));
}

TEST_F(Resumed, ReferencesAreOfTheFilesAsTheyAre) {
  const std::vector<std::string> recipe{"--set", R"(reference={"type": "recipe", "passes": 1})"};
  const auto rendered = [&] {
    fs::remove_all(folder / "out");
    const Ended ended = resume("inverse", recipe);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended.err.find("rendering the reference") != std::string::npos;
  };
  EXPECT_TRUE(rendered());
  EXPECT_FALSE(rendered());
  write_picture("wanted.exr", 0.75f);
  EXPECT_TRUE(rendered()) << "of another picture";
  EXPECT_FALSE(rendered());
  write("glass.yml", index_file(1.6));
  EXPECT_TRUE(rendered()) << "of another index";
}

// With the right hash at its end, as a program of another version would have written it.
TEST_F(Resumed, CheckpointsOfAnotherStateSayWhich) {
  for (const std::string engine : {"spectral", "environment", "inverse"}) {
    ASSERT_EQ(resume(engine).exit_code, 0);
    const std::string good = read_file(checkpoint(engine));
    const auto refused = [&](std::size_t at, const std::string& bytes, const std::string& says) {
      std::string content = good.substr(0, good.size() - sizeof(std::uint64_t));
      content.replace(at, bytes.size(), bytes);
      nephroid::write_file_whole(checkpoint(engine), [&](nephroid::ByteSink& file) {
        nephroid::HashedSink hashed(file);
        hashed.write(std::as_bytes(std::span(content)));
        file.value(hashed.hash());
      });
      const Ended ended = resume(engine, {"--passes", "2"});
      expect_refused_line(ended, fmt::format("out/{}/checkpoint.bin: {}", engine, says));
    };
    const std::string program = good.substr(32, good.find('\0', 32) - 32);
    const int state = good[12];
    refused(8, std::string("\x03", 1), "has format 3, and this program has 4");
    refused(
        12, std::string("\x63", 1),
        fmt::format("has a state of version 99 of the engine '{}', and this program has version {}", engine, state));
    refused(16, std::string("other\0", 6), fmt::format("is of the engine 'other', and the preset's is '{}'", engine));
    refused(32, std::string("0.0.1\0", 6),
            fmt::format("was written by version 0.0.1 of the program, and this is {}", program));
    refused(good.size() - sizeof(std::uint64_t), "12345", "has 5 bytes more than the run's state");
  }
}

} // namespace nephroid::resume_test
