// SPDX-License-Identifier: Apache-2.0
// Sessions: what is kept is what was there; a window that was killed is opened again with it; what cannot be read loses
// nothing.
#include "fake_job.h"
#include "ui/state/session_keeper.h"

namespace nephroid::ui::session_test {

/// A window without a display: a workbench with its keeper.
struct Window : test::Bench {
  explicit Window(const fs::path& state, const std::string& preset = {}) : keeper(state) {
    EXPECT_TRUE(preset.empty() || workbench.open(preset));
  }
  /// Until everything is in the files.
  void settle() {
    for (int i = 0; i < 3; ++i) { // what a write ends may have to be kept as well
      ASSERT_TRUE(until([&] { return workbench.tasks().empty(); }));
      keeper.update(workbench, later += std::chrono::seconds(20));
    }
    ASSERT_TRUE(until([&] { return workbench.tasks().empty(); }));
  }

  SessionKeeper keeper;
  SessionKeeper::Clock::time_point later =
      SessionKeeper::Clock::now(); ///< of the keeper, which writes at most once a second
};

class SessionTest : public testing::Test {
protected:
  TemporaryFolder folder;
  fs::path state() const { return folder.path() / "state"; }
  std::string preset_file() const { return folder.write("test.json", test::preset_text); }
  std::string text_of(const Workbench& workbench) const {
    Session session{.edits = workbench.edits()->state(), .view_state = workbench.view_state()};
    return SessionText().of(session);
  }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// An edit of some field, of list or map, at random.
void change_something(preset::Preset& preset, std::mt19937& random) {
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  auto& scene = preset.scene;
  const std::function<void()> changes[] = {
      [&] {
        scene.camera.position = {draw(-9, 9), draw(1, 9), draw(2, 9)};
      },
      [&] { scene.camera.fov_deg = draw(1, 170); },
      [&] { preset.seed = random(); },
      [&] { preset.description = "written \"by\" chance \u00e9 " + std::to_string(random()); },
      [&] {
        preset::Material& glass = scene.materials["glass" + std::to_string(random() % 4)];
        glass.type = preset::Material::Type::dielectric;
        glass.dispersion.n = draw(1, 3);
      },
      [&] {
        preset::Object& ball = scene.objects.emplace_back();
        ball.shape.emplace().radius = draw(0.1, 2);
        ball.material = "wall";
      },
      [&] { scene.objects.erase(scene.objects.begin(), scene.objects.begin() + (scene.objects.size() > 1)); },
      [&] { scene.lights.emplace_back().power_w = draw(1e-9, 1e9); },
      [&] { preset.stop.error = random() % 2 ? std::optional(draw(1e-6, 1)) : std::nullopt; },
  };
  changes[random() % std::size(changes)]();
}

TEST_F(SessionTest, AHundredEditsUndoneGiveTheSameBytes) {
  Window window(state(), preset_file());
  std::mt19937 random(7);
  std::vector<std::string> states{preset::to_json(*window.workbench.preset())};
  for (int i = 0; i < 100; ++i) {
    window.edit([&](preset::Preset& preset) { change_something(preset, random); });
    states.push_back(preset::to_json(*window.workbench.preset()));
  }
  for (std::size_t i = states.size(); i-- > 0;) {
    EXPECT_EQ(preset::to_json(*window.workbench.preset()), states[i]) << i;
    window.workbench.apply({command::Undo{}});
  }
  for (const std::string& state : states) {
    EXPECT_EQ(preset::to_json(*window.workbench.preset()), state);
    window.workbench.apply({command::Redo{}});
  }
}

TEST_F(SessionTest, AKilledWindowIsOpenedAgainAsItWas) {
  std::mt19937 random(3);
  std::vector<std::string> states;
  {
    Window window(state());
    EXPECT_TRUE(window.keeper.killed_session().empty());
    ASSERT_TRUE(window.workbench.open(preset_file()));
    states.push_back(preset::to_json(*window.workbench.preset()));
    for (int i = 0; i < 60; ++i) {
      window.edit([&](preset::Preset& preset) { change_something(preset, random); });
      states.push_back(preset::to_json(*window.workbench.preset()));
    }
    for (int i = 0; i < 20; ++i) window.workbench.apply({command::Undo{}});
    ViewSettings view_settings{.exposure_stops = 1.5};
    window.workbench.apply({command::SetViewSettings{view_settings}, command::ChooseMetric{"mse"},
                            command::SetBookmarks{{{"a camera", window.workbench.preset()->scene.camera}}}});
    window.settle();
  } // not closed
  Window window(state());
  EXPECT_FALSE(window.keeper.killed_session().empty());
  window.keeper.reopen(window.workbench);
  ASSERT_NE(window.workbench.preset(), nullptr);
  EXPECT_TRUE(window.workbench.messages().empty());
  EXPECT_TRUE(window.workbench.edits()->modified());
  EXPECT_EQ(window.workbench.view_state().view_settings.exposure_stops, 1.5);
  EXPECT_EQ(window.workbench.view_state().error_metric, "mse");
  ASSERT_EQ(window.workbench.view_state().bookmarks.size(), 1u);
  EXPECT_EQ(window.workbench.view_state().bookmarks[0].camera, window.workbench.preset()->scene.camera);
  EXPECT_EQ(window.workbench.preset()->source, (folder.path() / "test.json").string());
  for (int i = 0; i < 20; ++i) window.workbench.apply({command::Redo{}});
  for (std::size_t i = states.size(); i-- > 0;) {
    EXPECT_EQ(preset::to_json(*window.workbench.preset()), states[i]) << i;
    window.workbench.apply({command::Undo{}});
  }
  EXPECT_FALSE(window.workbench.edits()->modified()) << "back at what the file has";
  window.settle();
  EXPECT_EQ(std::distance(fs::directory_iterator(state() / "sessions"), {}), 1) << "the old one is not needed any more";
}

TEST_F(SessionTest, PinnedRunsComeBackWithTheirPictures) {
  {
    Window window(state());
    window.runs.history = [](int steps) { return test::falling_history(steps); };
    ASSERT_TRUE(window.workbench.open(preset_file()));
    ASSERT_TRUE(window.until(job::State::finished));
    window.workbench.apply({command::PinRun{}, command::ChangePin{1, "kept", 0xff112233, false}});
    window.settle();
  }
  Window window(state());
  window.keeper.reopen(window.workbench);
  window.settle();
  ASSERT_EQ(window.workbench.comparing().pinned().all().size(), 1u);
  const PinnedRun& pin = window.workbench.comparing().pinned().all().front();
  EXPECT_EQ(pin.name, "kept");
  EXPECT_EQ(pin.colour, 0xff112233);
  EXPECT_FALSE(pin.shown);
  EXPECT_EQ(pin.history->rows.size(), 20u);
  ASSERT_NE(pin.picture, nullptr);
  EXPECT_EQ(pin.picture->rgb[2], 4) << "the camera's z, which the fake picture has as its blue";
}

TEST_F(SessionTest, AClosedWindowIsOfferedButNotOpened) {
  {
    Window window(state(), preset_file());
    window.keeper.close(window.workbench);
  }
  Window window(state());
  EXPECT_TRUE(window.keeper.killed_session().empty());
  EXPECT_TRUE(window.keeper.has_earlier());
  window.workbench.apply({command::ReopenSession{}});
  ASSERT_TRUE(window.workbench.questions().take_reopen());
  window.keeper.reopen(window.workbench);
  EXPECT_NE(window.workbench.preset(), nullptr);
  EXPECT_FALSE(window.keeper.has_earlier());
}

TEST_F(SessionTest, AReopenedSessionIsGoneWhenTheNextIsKept) {
  Window(state(), preset_file()).settle(); // killed
  {
    Window closed(state());
    closed.keeper.reopen(closed.workbench);
    ASSERT_NE(closed.workbench.preset(), nullptr);
    closed.keeper.close(closed.workbench); // at once, before anything was kept
  }
  Window window(state());
  EXPECT_TRUE(window.keeper.killed_session().empty());
  EXPECT_TRUE(window.keeper.has_earlier());
}

TEST_F(SessionTest, OnlyOneWindowReopensASession) {
  Window(state(), preset_file()).settle(); // killed
  Window first(state()), second(state());
  EXPECT_FALSE(first.keeper.killed_session().empty());
  EXPECT_FALSE(second.keeper.killed_session().empty());
  first.keeper.reopen(first.workbench);
  EXPECT_NE(first.workbench.preset(), nullptr);
  EXPECT_TRUE(Window(state()).keeper.killed_session().empty()) << "it is this window's, though it was not kept yet";
  second.keeper.reopen(second.workbench);
  EXPECT_EQ(second.workbench.preset(), nullptr);
  EXPECT_EQ(only_message(second.workbench), "the earlier session was opened in another window");
  first.settle();
  EXPECT_TRUE(Window(state()).keeper.killed_session().empty());
}

TEST_F(SessionTest, AWindowThatIsOpenKeepsItsOwn) {
  Window first(state(), preset_file());
  first.settle();
  Window second(state());
  EXPECT_TRUE(second.keeper.killed_session().empty());
  EXPECT_FALSE(second.keeper.has_earlier());
}

TEST_F(SessionTest, AWindowThatOpenedNothingLeavesNothing) {
  Window(state()).settle(); // killed on its start page
  Window window(state());
  EXPECT_TRUE(window.keeper.killed_session().empty());
  EXPECT_FALSE(window.keeper.has_earlier());
}

TEST_F(SessionTest, WhatIsCutIsRefusedInOneLine) {
  Window window(state(), preset_file());
  window.edit([](preset::Preset& preset) { preset.seed = 5; });
  const std::string whole = text_of(window.workbench);
  EXPECT_NO_THROW(parse_session(whole, "whole"));
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    const std::string line = error_of([&] { parse_session(whole.substr(0, length), "cut.json"); }).line();
    EXPECT_THAT(line, AllOf(StartsWith("cut.json: "), Not(HasSubstr("\n")))) << "at " << length;
  }
}

TEST_F(SessionTest, WrongValuesAreRefused) {
  Window window(state(), preset_file());
  const std::string whole = text_of(window.workbench);
  const auto with = [&](const std::string& from, const std::string& to) { return replaced(whole, from, to); };
  EXPECT_THROW(parse_session(with("\"index\":0", "\"index\":7"), ""), Error);
  EXPECT_THROW(parse_session(with("\"index\":0", "\"index\":-1"), ""), Error);
  EXPECT_THROW(parse_session(with("\"saved\":0", "\"saved\":4"), ""), Error);
  EXPECT_THROW(parse_session(with("\"index\":0", "\"index\":1e300"), ""), Error);
  EXPECT_THROW(parse_session(with("\"version\":1", "\"version\":2"), ""), Error);
  EXPECT_THROW(parse_session(with("\"version\":1", "\"version\":4.4e30"), ""), Error);
  EXPECT_THROW(parse_session(with("\"zoom\":1.0", "\"zoom\":1e300"), ""), Error);
  EXPECT_THROW(parse_session(with("\"fov_deg\":40.0", "\"fov_deg\":400.0"), ""), Error) << "no preset may have it";
  EXPECT_THROW(parse_session("[[[[", ""), Error);
  EXPECT_THROW(parse_session("null", ""), Error);
}

TEST_F(SessionTest, AnUnreadableSessionIsKeptUnderAnotherName) {
  Window(state(), preset_file()).settle();
  const fs::path session = fs::directory_iterator(state() / "sessions")->path();
  write_file_whole(session / "session.json", "{\"version\": 1, \"closed\": false, ");
  Window window(state());
  EXPECT_FALSE(window.keeper.killed_session().empty());
  window.keeper.reopen(window.workbench);
  EXPECT_EQ(window.workbench.preset(), nullptr);
  ASSERT_EQ(window.workbench.messages().size(), 1u);
  EXPECT_TRUE(window.workbench.messages()[0].error);
  EXPECT_TRUE(fs::exists(session.string() + ".unreadable/session.json"));
  EXPECT_FALSE(window.keeper.has_earlier());
}

TEST_F(SessionTest, WhereNothingCanBeKeptItIsSaidOnceAndTheWindowGoesOn) {
  Window window(state(), preset_file());
  const fs::path own = fs::directory_iterator(state() / "sessions")->path();
  fs::remove_all(own);
  write_file_whole(own, "a file where the folder was");
  window.settle();
  window.edit([](preset::Preset& preset) { preset.seed = 9; });
  window.settle();
  EXPECT_THAT(only_message(window.workbench), HasSubstr("save the preset elsewhere"));
  EXPECT_EQ(window.workbench.preset()->seed, 9u);
}

TEST_F(SessionTest, SettingsAreThoseOfTheLastWindow) {
  {
    Window window(state(), preset_file());
    window.workbench.apply({command::SetAppearance{Theme::light, 1.21}, command::ShowPanel{"plan", false},
                            command::KeepLayout{"inverse", "[Window][Plan]\nPos=1,2\n"}});
    window.settle();
  }
  Window window(state());
  window.keeper.load_settings(window.workbench);
  EXPECT_EQ(window.workbench.setup().settings().theme, Theme::light);
  EXPECT_EQ(window.workbench.setup().settings().text_size, 1.21);
  EXPECT_EQ(window.workbench.setup().settings().engines.at("spectral").closed, std::set<std::string>{"plan"});
  EXPECT_EQ(window.workbench.setup().settings().engines.at("inverse").ini, "[Window][Plan]\nPos=1,2\n");
}

TEST(Settings, WhatCannotBeIsRefused) {
  WindowSettings settings;
  settings.engines["spectral"] = {"[Docking][Data]\nDockNode ID=0x00000003\n", {"plan"}};
  const std::string text = to_json(settings);
  EXPECT_EQ(parse_settings(text, ""), settings);
  const auto with = [&](const std::string& from, const std::string& to) { return replaced(text, from, to); };
  EXPECT_THROW(parse_settings(with("0x00000003", "0x00000004"), ""), Error) << "Dear ImGui trusts what it reads";
  EXPECT_THROW(parse_settings(with("\"version\": 2", "\"version\": 1"), ""), Error);
  EXPECT_THROW(parse_settings(with("\"text_size\": 1.0", "\"text_size\": 1e9"), ""), Error);
  for (std::size_t length = 0; length < text.size(); length += 3)
    EXPECT_THROW(parse_settings(text.substr(0, length), ""), Error) << length;
  WindowSettings crowded;
  for (int i = 0; i < 100; ++i) crowded.engines["spectral"].closed.insert(std::to_string(i));
  EXPECT_THROW(parse_settings(to_json(crowded), ""), Error);
}

} // namespace nephroid::ui::session_test
