// SPDX-License-Identifier: Apache-2.0
// The window's runs on a real device: with kernels from a folder, where a changed one is built and shown and a broken
// one is a message; and the scenes to begin with, each of which has a picture at once.
#include "fake_job.h"
#include "ui/state/device_runs.h"

namespace nephroid::ui::device_runs_test {

class EngineTest : public testing::Test {
protected:
  test::TemporaryFolder folder;
  const fs::path kernels = folder.path() / "kernels";

  EngineTest() { fs::copy(NEPHROID_SOURCE_DIR "/kernels", kernels, fs::copy_options::recursive); }
  compute::DeviceOptions options() const { return {.selector = "", .kernels = kernels}; }
  std::string source() const { return read_file(kernels / "photons/direct.cl"); }
  /// In one step: a temporary file beside the kernels would be a change of its own.
  void write(const std::string& text) const {
    write_file_whole(folder.path() / "new.cl", text);
    fs::rename(folder.path() / "new.cl", kernels / "photons/direct.cl");
  }
};

/// Brightness of a snapshot's picture; 0 where there is none.
double sum(const std::shared_ptr<const job::Snapshot>& snapshot) {
  return snapshot ? std::accumulate(snapshot->picture->rgb.begin(), snapshot->picture->rgb.end(), 0.0) : 0;
}

TEST_F(EngineTest, AChangedKernelIsBuiltAndABrokenOneKeepsTheLastPicture) {
  DeviceRuns engine(options());
  Workbench workbench(engine);
  const auto until = [&](const std::function<bool()>& done) {
    return test::eventually([&] { workbench.update(); }, done);
  };
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {"stop.passes=2"}));
  ASSERT_TRUE(until([&] { return workbench.run().status().state == job::State::finished; }));
  const double bright = sum(workbench.run().snapshot());
  EXPECT_GT(bright, 0);
  const std::uint64_t first_run = workbench.run().status().generation;

  const std::string original = source();
  write("this is no kernel\n" + original);
  ASSERT_TRUE(until([&] { return workbench.run().status().state == job::State::failed; }));
  workbench.update();
  EXPECT_THAT(only_message(workbench), StartsWith("photons/direct.cl:1: "));
  EXPECT_EQ(sum(workbench.run().snapshot()), bright) << "the last picture stays";

  // Compiles again, and gives another picture: nothing is added to the film.
  std::string dark = original;
  const std::string added = "frame, xyz,";
  ASSERT_NE(dark.find(added), std::string::npos);
  dark.replace(dark.find(added), added.size(), "frame, 0.0f * xyz,");
  write(dark);
  ASSERT_TRUE(until(
      [&] { return workbench.run().status().state == job::State::finished && workbench.run().snapshot_is_current(); }));
  EXPECT_EQ(sum(workbench.run().snapshot()), 0);
  EXPECT_TRUE(workbench.messages().empty());

  write(original);
  ASSERT_TRUE(until([&] { return sum(workbench.run().snapshot()) == bright; })) << sum(workbench.run().snapshot());
  EXPECT_EQ(workbench.run().status().generation, first_run + 3) << "a change is one run";
}

TEST_F(EngineTest, ChangesWhileARunGoesOnReplaceIt) {
  DeviceRuns engine(options());
  Workbench workbench(engine);
  const auto until = [&](const std::function<bool()>& done) {
    return test::eventually([&] { workbench.update(); }, done);
  };
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {"stop.passes=null", "stop.seconds=3600"}));
  ASSERT_TRUE(until([&] { return workbench.run().snapshot() != nullptr; }));
  write(source() + "\n");
  ASSERT_TRUE(until([&] { return workbench.run().status().generation == 2; }));
  ASSERT_TRUE(until([&] { return workbench.run().snapshot_is_current(); }));
}

TEST_F(EngineTest, WithoutAFolderNothingChanges) {
  DeviceRuns engine({});
  const preset::Preset preset = preset::parse_preset(test::preset_text, "test");
  NewRun run = engine.make(preset, {});
  ASSERT_NE(run.job, nullptr);
  EXPECT_FALSE(engine.take_changed());
}

TEST_F(EngineTest, ALightIsChangedInAFinishedRunThatKeepsLayers) {
  DeviceRuns engine(options());
  Workbench workbench(engine);
  const auto until = [&](const std::function<bool()>& done) {
    return test::eventually([&] { workbench.update(); }, done);
  };
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {"stop.passes=2", "spectral.relight=true"}));
  ASSERT_TRUE(until([&] { return workbench.run().status().state == job::State::finished; }));
  const double bright = sum(workbench.run().snapshot());
  const std::uint64_t run = workbench.run().status().generation;
  EXPECT_GT(bright, 0);

  preset::Preset edited = *workbench.preset();
  edited.scene.lights[0].power_w *= 3;
  workbench.apply({command::Edit{"power", edited, 1, false}});
  ASSERT_TRUE(until([&] { return workbench.run().snapshot_is_current(); }));
  EXPECT_NEAR(sum(workbench.run().snapshot()) / bright, 3, 1e-4);
  EXPECT_EQ(workbench.run().snapshot()->progress.step, 2);
  EXPECT_EQ(workbench.run().status().generation, run);
}

TEST_F(EngineTest, APictureThatIsWhiteSaysSo) {
  DeviceRuns engine({});
  Workbench workbench(engine);
  const auto exposure = [&](const char* white) {
    EXPECT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {"stop.passes=2", white}));
    EXPECT_TRUE(test::eventually([&] { workbench.update(); },
                                 [&] { return workbench.run().status().state == job::State::finished; }));
    workbench.update();
    return workbench.run().exposure();
  };
  EXPECT_THAT(exposure("white=1e-6"),
              AllOf(HasSubstr("% of the picture is above white: white "), HasSubstr(" shows it")));
  EXPECT_EQ(exposure("white=1"), "");
}

TEST(NewScenesTest, EachIsDrawn) {
  for (const engine::Engine* engine : engine::engines()) {
    DeviceRuns runs({});
    Workbench workbench(runs);
    workbench.apply({command::New{engine->introduction.new_scene.preset}});
    EXPECT_TRUE(test::eventually([&] { workbench.update(); }, [&] { return sum(workbench.run().snapshot()) > 0; }))
        << name_of(*engine);
    EXPECT_TRUE(workbench.messages().empty()) << workbench.messages().front().line;
  }
}

/// Red over blue of a material's picture.
double warmth(DeviceRuns& engine, const preset::Material& material) {
  preset::Preset preset = preset::parse_preset(test::preset_text, "test");
  preset.scene.materials["shown"] = material;
  Messages messages;
  const RunInHand idle(engine, messages);
  MaterialBalls balls(engine);
  std::shared_ptr<const job::Picture> picture;
  const auto look = [&] {
    picture = balls.of("shown");
    balls.update(&preset, idle);
  };
  EXPECT_TRUE(test::eventually(look, [&] { return picture && !balls.works(); }));
  double red = 0, blue = 0;
  for (std::size_t i = 0; picture && i < picture->rgb.size(); i += 3) {
    red += picture->rgb[i];
    blue += picture->rgb[i + 2];
  }
  return red / blue;
}

TEST(MaterialBalls, AreOfTheMaterial) {
  DeviceRuns engine({});
  preset::Material material;
  material.type = preset::Material::Type::conductor;
  std::map<std::string, double> warm;
  for (const char* metal : {"copper", "silver"}) {
    material.metal = metal;
    warm[metal] = warmth(engine, material);
  }
  EXPECT_GT(warm["copper"], 1.1 * warm["silver"]);
  material.type = preset::Material::Type::diffuse;
  const double grey = warmth(engine, material);
  material.texture =
      preset::Texture{.type = preset::Texture::Type::checkerboard, .colour0 = {1, 0, 0}, .colour1 = {1, 0.5, 0}};
  EXPECT_GT(warmth(engine, material), 1.1 * grey) << "a texture is seen";
  material.type = preset::Material::Type::dielectric;
  material.thin = true;
  const double clear = warmth(engine, material);
  material.tint_texture = material.texture;
  EXPECT_GT(warmth(engine, material), 1.1 * clear) << "what passes glass is seen";
  material.coating.emplace();
  material.thin = false;
  EXPECT_GT(warmth(engine, material), 1.1 * clear) << "so it is below a coating";
}

} // namespace nephroid::ui::device_runs_test
