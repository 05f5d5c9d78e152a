// SPDX-License-Identifier: Apache-2.0
// An edit of a light in a preset that keeps layers goes to the run in hand; every other edit starts a new run.
#include "fake_job.h"
#include "spectral/settings.h"

namespace nephroid::ui::relighting_test {

using namespace std::chrono_literals;

class RelightingTest : public test::WorkbenchFixture {
protected:
  void open(int steps, const std::string& setting = "spectral.relight=true") {
    runs.steps = steps;
    runs.reference = std::make_shared<measure::Reference>();
    ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {setting}));
    ASSERT_TRUE(until([&] {
      return workbench.run().snapshot() && workbench.run().plan() &&
             workbench.run().status().state != job::State::preparing;
    }));
  }
  void edit_power(double watts, bool live = false) {
    edit([&](preset::Preset& p) { p.scene.lights[0].power_w = watts; }, 1, live);
  }
  double shown_power() const { return photons::energy_of(*workbench.run().snapshot()).emitted_w; }
  bool shows(double watts) {
    return until([&] { return workbench.run().snapshot_is_current() && shown_power() == watts; });
  }
};

TEST_F(RelightingTest, AnotherSpectrumPowerOrWhiteGoesToTheRunInHand) {
  open(100000);
  edit([](preset::Preset& p) {
    p.scene.lights[0].spectrum.illuminant = "F10";
    p.scene.lights[0].power_w = 20;
    p.white = 2;
  });
  workbench.update();
  ASSERT_TRUE(shows(20));
  EXPECT_EQ(runs.made, 1);
  EXPECT_EQ(runs.adopted, 1);
  const auto steps = workbench.run().snapshot()->progress.step;
  EXPECT_TRUE(until([&] { return workbench.run().snapshot()->progress.step > steps; })) << "it goes on converging";
  workbench.apply({command::Undo{}});
  ASSERT_TRUE(shows(10));
  EXPECT_EQ(runs.made, 1);
}

TEST_F(RelightingTest, AnotherSceneOrCameraStartsANewRun) {
  open(100000);
  edit([](preset::Preset& p) { p.scene.lights[0].position[0] = 0.25; });
  ASSERT_TRUE(until([&] { return runs.made == 2; }));
  edit([](preset::Preset& p) { p.scene.camera.fov_deg = 30; });
  ASSERT_TRUE(until([&] { return runs.made == 3; }));
  edit([](preset::Preset& p) { spectral::settings(p).relight = false; });
  ASSERT_TRUE(until([&] { return runs.made == 4; }));
  EXPECT_EQ(runs.adopted, 0);
}

TEST_F(RelightingTest, WithoutLayersEveryEditStartsANewRun) {
  open(100000, "seed=1");
  edit_power(20);
  ASSERT_TRUE(until([&] { return runs.made == 2; }));
  EXPECT_EQ(runs.adopted, 0);
}

TEST_F(RelightingTest, ARunThatIsFinishedIsRelit) {
  open(3);
  ASSERT_TRUE(until(job::State::finished));
  edit_power(30);
  ASSERT_TRUE(shows(30));
  EXPECT_EQ(workbench.run().status().state, job::State::finished);
  EXPECT_EQ(runs.made, 1);
}

TEST_F(RelightingTest, ARunThatIsPausedIsRelitAndStaysPaused) {
  open(100000);
  workbench.apply({command::Pause{true}});
  ASSERT_TRUE(until(job::State::paused));
  edit_power(30);
  ASSERT_TRUE(shows(30));
  EXPECT_EQ(workbench.run().status().state, job::State::paused);
}

TEST_F(RelightingTest, AfterACancelAndWhereTheJobDoesNotAdoptAnEditStartsANewRun) {
  open(100000);
  workbench.apply({command::Cancel{}});
  ASSERT_TRUE(until(job::State::cancelled));
  edit_power(30);
  ASSERT_TRUE(shows(30));
  EXPECT_EQ(runs.made, 2);
  runs.adopts = false;
  edit_power(40);
  ASSERT_TRUE(shows(40));
  EXPECT_EQ(runs.made, 3);
}

TEST_F(RelightingTest, ALightThatCannotBeUsedIsOneMessageAndTheNextOneGoesOn) {
  open(100000);
  edit_power(13);
  ASSERT_TRUE(until([&] { return workbench.messages().size() == 1; }));
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("is unlucky"));
  edit_power(14);
  ASSERT_TRUE(shows(14));
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_EQ(runs.made, 1) << "what was computed is not thrown away";
}

TEST_F(RelightingTest, TheReferenceIsOfTheOldLight) {
  open(100000);
  workbench.apply({command::CompareWith{}});
  EXPECT_THAT(workbench.comparing().why_not(), Not(HasSubstr("no reference")));
  edit_power(20);
  ASSERT_TRUE(shows(20));
  EXPECT_NE(workbench.comparing().why_not(), "");
}

TEST_F(RelightingTest, ALightThatIsDraggedIsShownWhileTheMouseMoves) {
  open(100000);
  const int made = runs.made;
  int pictures = 0;
  double power = 20, last = shown_power();
  const auto move = [&] {
    edit_power(++power, true);
    workbench.update();
    std::this_thread::sleep_for(10ms);
    workbench.update();
    if (shown_power() != last) ++pictures;
    last = shown_power();
  };
  ASSERT_TRUE(eventually(move, [&] { return pictures >= 6; }));
  workbench.apply({command::EndGesture{}});
  ASSERT_TRUE(shows(power));
  EXPECT_EQ(runs.made, made);
}

} // namespace nephroid::ui::relighting_test
