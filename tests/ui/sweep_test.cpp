// SPDX-License-Identifier: Apache-2.0
// The sweep of a preset in the window: opened, edited, saved, undone; its runs in a queue, each pinned; the report over
// them.
#include "ui/runs/panel.h"
#include "ui/runs/sweep_section.h"
#include "ui/state/run_record.h"
#include "window_fixture.h"

namespace nephroid::ui::sweep_test {

using Queue = SweepQueue::State;

class SweepTest : public test::WindowFixture {
protected:
  SweepTest() : WindowFixture("runs") {}

  static std::string swept(const std::string& sweep) {
    std::string text = test::preset_text;
    return text.insert(text.rfind('}'), ", \"sweep\": " + sweep);
  }
  const RunsPanel& panel() const { return workspace.panel<RunsPanel>(); }
  void click_on(const std::string& widget) { click_in(panel(), widget); }
  void fill(const std::string& widget, const std::string& text) {
    click_on(widget);
    retype(text);
  }
  void choose(const std::string& key) {
    click_on("sweep field");
    frames(2);
    retype(key);
    press(ImGuiKey_Enter);
  }
  /// Until no run of the sweep is to come.
  void work_off() {
    workbench.apply({command::StartSweep{}});
    ASSERT_TRUE(until([&] { return !workbench.sweep().active(); }));
    frame();
  }
  std::vector<Queue> states() const {
    std::vector<Queue> all;
    for (const SweepQueue::QueuedRun& run : workbench.sweep().runs()) all.push_back(run.state);
    return all;
  }
  std::vector<PinnedRun> pins() const { return workbench.comparing().pinned().all(); }
  const preset::Sweep& sweep() const { return workbench.edits()->sweep(); }
};

const NumberField power{"scene.lights.0.power_w", false, preset::within(0, 100), "", "a number from 0 to 100", 10};
const NumberField passes{"stop.passes", true, preset::within(1, 1000), "", "a whole number from 1 to 1000", 20};

std::string refused_range(const NumberField& field, const SweepRange& range) {
  return refusal_of([&] { range_values(field, range); });
}

std::string refused_list(const NumberField& field, const std::string& text) {
  return refusal_of([&] { typed_values(field, text); });
}

TEST(SweepValues, ARangeHasItsEndsAndEqualSteps) {
  EXPECT_THAT(range_values(power, {0, 1, 5, false}), ElementsAre("0.0", "0.25", "0.5", "0.75", "1.0"));
  EXPECT_THAT(range_values(power, {0.1, 0.5, 5, false}), ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5"))
      << "and no 0.30000000000000004";
  EXPECT_THAT(range_values(power, {0.01, 100, 5, true}), ElementsAre("0.01", "0.1", "1.0", "10.0", "100.0"));
  EXPECT_THAT(range_values(power, {3, 1, 3, false}), ElementsAre("3.0", "2.0", "1.0"));
  EXPECT_THAT(range_values(power, {3, 7, 1, false}), ElementsAre("3.0"));
  EXPECT_THAT(range_values(passes, {1, 100, 3, true}), ElementsAre("1", "10", "100"));
}

TEST(SweepValues, ARangeThatCannotBeIsRefused) {
  EXPECT_THAT(refused_range(power, {0, 1, 0, false}),
              HasSubstr("scene.lights.0.power_w: 0 values; expected 1 to 10000"));
  EXPECT_THAT(refused_range(power, {0, 1, 1000000, false}), HasSubstr("1000000 values"));
  EXPECT_THAT(refused_range(power, {0, 1, -3, false}), HasSubstr("-3 values"));
  EXPECT_THAT(refused_range(power, {0, 101, 3, false}),
              HasSubstr("101 is out of its range; expected a number from 0 to 100"));
  EXPECT_THAT(refused_range(power, {0, std::nan(""), 3, false}), HasSubstr("nan is out of its range"));
  EXPECT_THAT(refused_range(power, {0, 1, 3, true}), HasSubstr("a logarithmic range has both ends above 0"));
  EXPECT_THAT(refused_range(power, {1, 1, 3, false}), HasSubstr("the value 1.0 is there twice")) << "an empty range";
  EXPECT_THAT(refused_range(passes, {1, 3, 5, false}), HasSubstr("is there twice")) << "whole numbers have no halves";
  EXPECT_THAT(refused_range(passes, {1.5, 3, 2, false}), HasSubstr("1.5 is out of its range"));
}

TEST(SweepValues, AListIsTypedAsPeopleDo) {
  EXPECT_THAT(typed_values(power, " .5, +3 1e1;2\n"), ElementsAre("0.5", "3.0", "10.0", "2.0"));
  const NumberField seed{"seed", true, preset::within(0, 18446744073709551615.0), "", "", 1};
  EXPECT_THAT(typed_values(seed, "18446744073709551615, 1e3"), ElementsAre("18446744073709551615", "1000"));
  EXPECT_THAT(refused_list(power, " ,; "), HasSubstr("there is no value"));
  EXPECT_THAT(refused_list(power, "1, two"), HasSubstr("a value is no number"));
  EXPECT_THAT(refused_list(power, "1, inf"), HasSubstr("inf is out of its range"));
  EXPECT_THAT(refused_list(power, "1, 1.0"), HasSubstr("is there twice"));
  EXPECT_THAT(refused_list(passes, "1.5"), HasSubstr("out of its range"));
  std::string many;
  for (int i = 1; i <= 10001; ++i) many += std::to_string(i) + ' ';
  EXPECT_THAT(refused_list({"x", true, preset::within(0, 1e9), "", "", 0}, many), HasSubstr("too many values"));
}

TEST_F(SweepTest, FieldsAreThoseOfThePresetThatHoldANumber) {
  open();
  std::vector<std::string> keys;
  for (const NumberField& field : number_fields(*workbench.preset())) keys.push_back(field.key);
  EXPECT_THAT(keys,
              IsSupersetOf({"seed", "white", "scene.camera.fov_deg", "scene.lights.0.power_w", "spectral.threshold_deg",
                            "stop.passes", "stop.seconds", "scene.materials.wall.reflectance.value"}));
  EXPECT_THAT(keys, Not(Contains(HasSubstr("inverse"))));
}

TEST_F(SweepTest, APresetWithASweepIsOpenedAndSavedWithIt) {
  open(swept(R"({"spectral.threshold_deg": [0.5, 0.1], "seed": [1, 2, 3]})"));
  ASSERT_THAT(sweep(), SizeIs(2));
  EXPECT_EQ(sweep()[0], (preset::SweptField{"spectral.threshold_deg", {"0.5", "0.1"}}));
  EXPECT_EQ(workbench.preset()->seed, 1u);
  EXPECT_EQ(workbench.preset()->name, "Test");
  EXPECT_FALSE(workbench.edits()->modified());
  edit([](preset::Preset& p) { p.scene.camera.fov_deg = 30; });
  workbench.apply({command::SavePreset{folder.path() / "saved.json"}});
  const auto runs_of_file = preset::read_presets((folder.path() / "saved.json").string());
  ASSERT_THAT(runs_of_file, SizeIs(6));
  EXPECT_EQ(runs_of_file[5].seed, 3u);
  EXPECT_EQ(runs_of_file[5].scene.camera.fov_deg, 30);
}

TEST_F(SweepTest, WhereTheFieldsAloneAreNoPresetTheFirstRunIsShown) {
  std::string text = swept(R"({"engine": ["spectral"]})");
  text.erase(text.find("\"engine\": \"spectral\", "), 22);
  open(text);
  EXPECT_EQ(workbench.preset()->name, "Test");
  EXPECT_THAT(sweep(), SizeIs(1));
}

TEST_F(SweepTest, AChildKeepsItsParentAndItsSweep) {
  folder.write("parent.json", swept(R"({"seed": [1, 2]})"));
  ASSERT_TRUE(workbench.open(folder.write("child.json", R"({"parent": "parent"})")));
  EXPECT_THAT(sweep(), SizeIs(1));
  const auto child = folder.path() / "child.json";
  const auto save = [&](const preset::Sweep& now) {
    workbench.apply({command::SetSweep{"sweep", now}, command::SavePreset{child}});
    return preset::read_presets(child.string()).size();
  };
  EXPECT_EQ(save({{"seed", {"1", "2"}}, {"white", {"1.0", "2.0"}}}), 4u);
  EXPECT_THAT(read_file(child), HasSubstr("\"parent\""));
  EXPECT_EQ(save({{"seed", {"4", "5", "6"}}}), 3u);
  EXPECT_THAT(read_file(child), HasSubstr("\"parent\""));
  EXPECT_EQ(save({}), 1u);
  EXPECT_THAT(read_file(child), HasSubstr("\"parent\""));
  // What cannot be said over the parent's sweep is said without it.
  EXPECT_EQ(save({{"white", {"1.0", "2.0"}}}), 2u);
  EXPECT_THAT(read_file(child), Not(HasSubstr("\"parent\"")));
}

TEST_F(SweepTest, ASweepThatCannotBeIsRefusedWithThePreset) {
  EXPECT_FALSE(workbench.open(folder.write("bad.json", swept(R"({"seed": []})"))));
  EXPECT_THAT(only_message(workbench), HasSubstr("bad.json#/sweep/seed"));
}

TEST_F(SweepTest, AFieldIsSweptByARangeAndUndone) {
  run_through();
  const int made = runs.made;
  click_on("sweep");
  choose("scene.lights.0.power_w");
  frames(2);
  fill("sweep from", "5");
  fill("sweep to", "15");
  fill("sweep count", "3");
  click_on("sweep set");
  ASSERT_THAT(sweep(), SizeIs(1)) << panel().sweep().problem();
  EXPECT_EQ(sweep()[0], (preset::SweptField{"scene.lights.0.power_w", {"5.0", "10.0", "15.0"}}));
  EXPECT_TRUE(workbench.edits()->modified());
  EXPECT_EQ(workbench.edits()->undo_label(), "sweep scene.lights.0.power_w");
  frames(5);
  EXPECT_EQ(runs.made, made) << "the run goes on: its preset is the same";
  EXPECT_EQ(workbench.run().status().state, job::State::finished);
  workbench.apply({command::Undo{}});
  EXPECT_THAT(sweep(), SizeIs(0));
  workbench.apply({command::Redo{}});
  EXPECT_THAT(sweep(), SizeIs(1));
  frames(5);
  EXPECT_EQ(runs.made, made);
  click_on("remove scene.lights.0.power_w");
  EXPECT_THAT(sweep(), SizeIs(0));
}

TEST_F(SweepTest, AListIsTypedAndEdited) {
  open();
  click_on("sweep");
  choose("seed");
  click_on("sweep list");
  fill("sweep values", "3, 4");
  press(ImGuiKey_Enter);
  ASSERT_THAT(sweep(), SizeIs(1)) << panel().sweep().problem();
  EXPECT_THAT(sweep()[0].values, ElementsAre("3", "4"));
  click_on("edit seed");
  fill("sweep values", "3, 4, 5");
  press(ImGuiKey_Enter);
  EXPECT_THAT(sweep()[0].values, ElementsAre("3", "4", "5"));
  fill("sweep values", "3, four");
  click_on("sweep set");
  EXPECT_THAT(panel().sweep().problem(), HasSubstr("seed: a value is no number"));
  EXPECT_THAT(sweep()[0].values, SizeIs(3)) << "nothing changes";
}

TEST_F(SweepTest, EachRunBecomesAPin) {
  run_measured(swept(R"({"scene.lights.0.power_w": [5, 15], "seed": [1, 2]})"));
  click_on("sweep run");
  EXPECT_TRUE(workbench.sweep().active());
  ASSERT_TRUE(until([&] { return !workbench.sweep().active(); }));
  EXPECT_THAT(states(), ElementsAre(Queue::done, Queue::done, Queue::done, Queue::done));
  ASSERT_THAT(pins(), SizeIs(4));
  EXPECT_EQ(pins()[0].name, "Test,power_w=5,seed=1");
  EXPECT_EQ(pins()[3].name, "Test,power_w=15,seed=2");
  EXPECT_EQ(pins()[3].history->rows.size(), 20u);
  frames(2);
  ASSERT_THAT(panel().rows(), SizeIs(5));
  EXPECT_EQ(PresetDifferences().of(panel().rows()[4], context()).in_short, "seed: 1 -> 2, 1 more");
  // The preset in hand runs again, and it is as it was.
  ASSERT_TRUE(until_current());
  finish();
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_EQ(workbench.run().snapshot_origin().preset->scene.lights[0].power_w, 10);
  workbench.apply({command::WriteReport{folder.path() / "sweep.html"}});
  ASSERT_TRUE(until_files_are_done());
  EXPECT_THAT(last_message(workbench), HasSubstr("a report over 5 runs"));
  EXPECT_EQ(
      preset::read_preset((folder.path() / "sweep-runs" / "04-Test,power_w=15,seed=2" / "preset.json").string()).seed,
      2u)
      << "a run, not the sweep";
}

TEST_F(SweepTest, WhatIsRefusedFailsAloneAndSaysWhy) {
  open(swept(R"({"stop.passes": [5, -1, 10]})"));
  work_off();
  EXPECT_THAT(states(), ElementsAre(Queue::done, Queue::failed, Queue::done));
  EXPECT_THAT(workbench.sweep().runs()[1].why, HasSubstr("stop.passes"));
  EXPECT_THAT(workbench.sweep().runs()[1].name, HasSubstr("passes=-1"));
  EXPECT_THAT(workbench.sweep().summary(), HasSubstr("2 of 3 done, 1 failed"));
  EXPECT_THAT(pins(), SizeIs(2));
}

TEST_F(SweepTest, ARunThatFailsDoesNotEndTheSweep) {
  run_through(swept(R"({"seed": [1, 2]})"));
  runs.fails = true;
  work_off();
  EXPECT_THAT(states(), ElementsAre(Queue::failed, Queue::failed));
  EXPECT_THAT(workbench.sweep().runs()[0].why, HasSubstr("the device is gone"));
  EXPECT_THAT(pins(), SizeIs(0));
}

TEST_F(SweepTest, AFieldThatIsNoneIsSaidAndNothingRuns) {
  run_through();
  workbench.apply({command::SetSweep{"sweep", {{"scene.lights.7.power_w", {"1", "2"}}}}, command::StartSweep{}});
  EXPECT_FALSE(workbench.sweep().active());
  EXPECT_THAT(only_message(workbench), HasSubstr("has no item '7'"));
}

TEST_F(SweepTest, MoreRunsThanTheWindowKeepsAreRefused) {
  open();
  std::vector<std::string> values;
  for (int i = 1; i <= 65; ++i) values.push_back(std::to_string(i));
  workbench.apply({command::SetSweep{"sweep", {{"seed", values}}}, command::StartSweep{}});
  EXPECT_THAT(only_message(workbench), HasSubstr("gives 65 runs"));
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("nephroid run"));
  EXPECT_FALSE(workbench.sweep().active());
  workbench.apply({command::SavePreset{folder.path() / "many.json"}});
  EXPECT_THAT(preset::read_presets((folder.path() / "many.json").string()), SizeIs(65));
}

TEST_F(SweepTest, AStopKeepsWhatIsDone) {
  open(swept(R"({"seed": [1, 2, 3]})"));
  workbench.apply({command::StartSweep{}});
  ASSERT_TRUE(until([&] { return pins().size() == 1; }));
  workbench.apply({command::StopSweep{}});
  EXPECT_FALSE(workbench.sweep().active());
  EXPECT_THAT(states(), ElementsAre(Queue::done, Queue::stopped, Queue::stopped));
  ASSERT_TRUE(until_current());
  EXPECT_THAT(pins(), SizeIs(1));
  EXPECT_EQ(workbench.run().snapshot_name(), "Test") << "the preset in hand";
}

TEST_F(SweepTest, TheButtonAndTheKeyStopTheSweep) {
  runs.steps = 1000000;
  open(swept(R"({"seed": [1, 2]})"));
  const auto running = [&] {
    return workbench.sweep().active() && workbench.run().status().state == job::State::running;
  };
  click_on("sweep run");
  ASSERT_TRUE(until(running));
  click_on("sweep run");
  EXPECT_FALSE(workbench.sweep().active());
  EXPECT_THAT(states(), ElementsAre(Queue::stopped, Queue::stopped));
  click_on("sweep run");
  ASSERT_TRUE(until(running));
  press(ImGuiKey_F5, ImGuiMod_Shift);
  EXPECT_FALSE(workbench.sweep().active());
  frame();
  EXPECT_NE(workbench.run().status().state, job::State::cancelled) << "the preset's own run goes on";
}

TEST_F(SweepTest, EditsWaitForTheEndOfTheSweep) {
  runs.step_ms = 4;
  open(swept(R"({"seed": [1, 2]})"));
  workbench.apply({command::StartSweep{}});
  ASSERT_TRUE(until(job::State::running));
  edit([](preset::Preset& p) { p.scene.lights[0].power_w = 20; });
  workbench.apply({command::Restart{}});
  ASSERT_TRUE(until([&] { return !workbench.sweep().active(); }));
  ASSERT_THAT(pins(), SizeIs(2));
  EXPECT_EQ(pins()[1].record->preset->scene.lights[0].power_w, 10);
  ASSERT_TRUE(until_current());
  EXPECT_EQ(workbench.run().snapshot_origin().preset->scene.lights[0].power_w, 20);
}

TEST_F(SweepTest, AnotherPresetEndsTheSweep) {
  runs.step_ms = 5;
  open(swept(R"({"seed": [1, 2, 3]})"));
  workbench.apply({command::StartSweep{}});
  ASSERT_TRUE(until(job::State::running));
  ASSERT_TRUE(workbench.open(folder.write("other.json", test::preset_text)));
  EXPECT_FALSE(workbench.sweep().active());
  finish();
  EXPECT_THAT(sweep(), SizeIs(0));
  EXPECT_THAT(pins(), SizeIs(0));
}

TEST_F(SweepTest, ASessionKeepsTheSweep) {
  open();
  workbench.apply(
      {command::SetSweep{"sweep", {{"seed", {"1", "2"}}}}, command::SetSweep{"sweep", {{"white", {"1.0", "2.0"}}}}});
  test::Bench next;
  reopen_in(next.workbench);
  const Workbench& other = next.workbench;
  ASSERT_NE(other.edits(), nullptr);
  EXPECT_EQ(other.edits()->sweep(), sweep());
  next.workbench.apply({command::Undo{}});
  ASSERT_THAT(other.edits()->sweep(), SizeIs(1));
  EXPECT_EQ(other.edits()->sweep()[0].key, "seed");
}

TEST_F(SweepTest, AFileThatGetsASweepIsTakenOver) {
  run_through();
  const int made = runs.made;
  folder.write("test.json", swept(R"({"seed": [1, 2]})"));
  workbench.apply({command::ReloadPreset{}});
  EXPECT_THAT(sweep(), SizeIs(1));
  EXPECT_FALSE(workbench.edits()->modified());
  frames(3);
  EXPECT_EQ(runs.made, made);
}

TEST_F(SweepTest, TheActionsSayWhyNot) {
  open();
  EXPECT_FALSE(action("Start the sweep").enabled(context()));
  EXPECT_THAT(action("Start the sweep").why_not(context()), HasSubstr("the preset has no sweep"));
  EXPECT_FALSE(action("Stop the sweep").enabled(context()));
  workbench.apply({command::SetSweep{"sweep", {{"seed", {"1", "2"}}}}});
  EXPECT_TRUE(action("Start the sweep").enabled(context()));
  workbench.apply({command::StartSweep{}});
  EXPECT_FALSE(action("Start the sweep").enabled(context()));
  EXPECT_TRUE(action("Stop the sweep").enabled(context()));
}

} // namespace nephroid::ui::sweep_test
