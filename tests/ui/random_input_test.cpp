// SPDX-License-Identifier: Apache-2.0
// Whatever a hand does to mouse and keyboard, the window stays: random clicks, drags, keys, values out of range and
// dropped files, in presets of all engines, on fake jobs. NEPHROID_RANDOM_SECONDS=600 plays for ten minutes what was
// not played before; under ./test.sh asan it looks for what nobody sees. And keys and clicks with modifiers that all
// arrive between two frames.
#include "tests/support/process_state.h"
#include "ui/shell/glfw_window.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::ui::random_input_test {

class RandomInput : public test::WindowFixture {
protected:
  RandomInput() {
    for (const char* name : {"first-light", "spectral/prism", "environment/ball", "inverse/shapes"}) copy_preset(name);
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"cut.json", R"({"scene": {)"},
             {"nothing.exr", "v/1"},
             {"picture.png", "\x89PNG\r\n"},
             {"triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
             {"bad.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\n"},
             {"scene.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"children": [0]}]})"},
             {"glass.yml", "DATA:\n  - type: formula 1\n    coefficients: 0 1 0.1\n"}})
      files_.push_back(folder.write(name, text));
    files_.push_back((folder.path() / "gone.json").string());
  }

  /// A shipped preset, beside the materials that it names, to be saved over.
  void copy_preset(const std::string& name) {
    files_.push_back(folder.write(fs::path(name).filename().string() + ".json",
                                  preset::to_json(preset::read_preset(name), folder.path())));
  }

  double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  void some_text() {
    std::istringstream texts(
        "nan|-1|1e999|inf|0|1e-320|999999999999999999999|\xc3\xa9\xe2\x82\xac|%s%n%d|../../x|a||.5|-0|0x10|glass|first|"
        "\t|\xff\xfe");
    std::string text;
    for (auto skip = random_() % 19; std::getline(texts, text, '|') && skip > 0;) --skip;
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
  }
  void some_key() {
    const auto key = static_cast<ImGuiKey>(
        ImGuiKey_NamedKey_BEGIN + static_cast<int>(random_() % (ImGuiKey_GamepadStart - ImGuiKey_NamedKey_BEGIN)));
    if (key >= ImGuiKey_MouseLeft && key <= ImGuiKey_MouseWheelY) return;
    constexpr ImGuiKey modifiers[] = {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt};
    const ImGuiKey modifier = random_() % 2 ? modifiers[random_() % 3] : ImGuiKey_None;
    if (modifier) imgui.key(modifier, true);
    imgui.key(key, true);
    frame();
    imgui.key(key, false);
    if (modifier) imgui.key(modifier, false);
  }
  void some_event() {
    const auto kind = random_() % 16;
    if (kind < 4)
      imgui.move(draw(-20, 1020), draw(-20, 720));
    else if (kind < 9)
      imgui.button(static_cast<int>(random_() % 3), kind < 6);
    else if (kind == 9)
      imgui.wheel(draw(-3, 3));
    else if (kind < 12)
      some_key();
    else if (kind == 12)
      some_text();
    else if (kind == 13) // a click somewhere, twice
      for (const bool down : {true, false, true, false}) {
        imgui.button(0, down);
        frame();
      }
    else if (kind == 14) { // an action, as the palette runs it
      if (const Action& action = actions()[random_() % actions().size()]; action.enabled(context())) {
        Commands commands;
        action.run(workbench.context(commands));
        workbench.apply(commands);
      }
    } else {
      if (random_() % 10 == 0) workbench.apply({command::Open{files_[random_() % files_.size()], random_() % 2 == 0}});
      if (random_() % 40 == 0) resize({static_cast<int>(draw(1, 2000)), static_cast<int>(draw(1, 1500))});
    }
    ++events_;
  }

  void play() {
    ImGui::GetIO().DisplaySize = {1000, 700};
    for (int i = 0; i < 200; ++i) {
      some_event();
      frame();
      if (workbench.questions().question() != Question::none && random_() % 20 == 0)
        workbench.apply({command::Ask{Question::none}});
    }
  }

  /// What the window has is a preset, whatever was done to it.
  static void is_whole(const preset::Preset& preset) {
    const std::string text = preset::to_json(preset);
    EXPECT_EQ(preset::to_json(preset::parse_preset(text, preset.source)), text);
  }

  std::vector<std::string> files_;
  std::mt19937 random_;
  std::uint64_t events_ = 0;
  test::CurrentFolder here_{folder.path()}; // where a name without a folder is saved
};

TEST_F(RandomInput, TheWindowStays) {
  runs.steps = 30;
  measured();
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  const char* asked = std::getenv("NEPHROID_RANDOM_SECONDS");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(asked ? std::atof(asked) : 0);
  const unsigned first = asked ? std::random_device{}() : 0;
  unsigned seeds = 0, presets = 0;
  for (; seeds < 50 || std::chrono::steady_clock::now() < end; ++seeds) {
    random_.seed(first + seeds);
    try {
      play();
      if (workbench.preset()) ++presets, is_whole(*workbench.preset());
    } catch (const std::exception& error) {
      FAIL() << "at seed " << first + seeds << " of those from " << first << ": " << error.what();
    }
    for (const Message& message : workbench.messages()) {
      ASSERT_EQ(message.line.find('\n'), std::string::npos) << message.line;
      workbench.apply({command::Dismiss{message.id}});
    }
  }
  EXPECT_GT(presets, 0u);
  fmt::print("{} events, {} seeds from {}, {} times a preset was there\n", events_, seeds, first, presets);
}

class InputEventsTest : public testing::Test {
protected:
  InputEventsTest() { ImGui::GetIO().ConfigInputTrickleEventQueue = true; } // as in the window
  void key(ImGuiKey which, ImGuiKey modifier, bool down) {
    imgui_.key(modifier, down);
    imgui_.key(which, down);
  }
  void ctrl(bool down) { key(ImGuiKey_LeftCtrl, static_cast<ImGuiKey>(ImGuiMod_Ctrl), down); }
  /// In how many frames of some more it was so.
  static int frames_with(const std::function<bool()>& condition) {
    int found = 0;
    for (int i = 0; i < 6; ++i) {
      new_frame();
      found += condition();
      ImGui::Render();
    }
    return found;
  }
  test::Headless imgui_;
};

TEST_F(InputEventsTest, AChordIsSeenThoughItsModifierWasLetGoFirst) {
  for (const bool in_one_frame : {true, false}) {
    ctrl(true);
    if (!in_one_frame) frames_with([] { return false; });
    imgui_.key(ImGuiKey_Z, true);
    ctrl(false);
    imgui_.key(ImGuiKey_Z, false);
    EXPECT_EQ(frames_with([] { return ImGui::IsKeyChordPressed(ImGuiMod_Ctrl | ImGuiKey_Z); }), 1);
    EXPECT_EQ(ImGui::GetIO().KeyMods, ImGuiMod_None);
    EXPECT_FALSE(ImGui::IsKeyDown(ImGuiKey_Z));
  }
}

TEST_F(InputEventsTest, AModifierThatIsPressedAgainAtOnceStaysPressed) {
  ctrl(true);
  frames_with([] { return false; });
  imgui_.key(ImGuiKey_Z, true);
  ctrl(false);
  new_frame();
  ImGui::Render();
  ctrl(true);
  frames_with([] { return false; });
  EXPECT_EQ(ImGui::GetIO().KeyMods, ImGuiMod_Ctrl);
}

TEST_F(InputEventsTest, ATurnOfTheWheelHasTheModifierThatWasHeld) {
  ctrl(true);
  frames_with([] { return false; });
  imgui_.wheel(1);
  ctrl(false);
  EXPECT_EQ(frames_with([] { return ImGui::GetIO().MouseWheel != 0 && ImGui::GetIO().KeyCtrl; }), 1);
}

TEST_F(InputEventsTest, AClickHasTheModifierThatWasHeld) {
  ctrl(true);
  frames_with([] { return false; });
  imgui_.button(0, true);
  ctrl(false);
  imgui_.button(0, false);
  EXPECT_EQ(frames_with([] { return ImGui::IsMouseClicked(0) && ImGui::GetIO().KeyCtrl; }), 1);
}

TEST_F(InputEventsTest, ATabHearsAClickThatCameWithTheMouseWithinOneFrame) {
  std::array<bool, 2> shown{};
  std::array<ImVec2, 2> tabs{};
  const auto frame = [&] {
    new_frame();
    ImGui::SetNextWindowSize({400, 200});
    ImGui::Begin("tabs");
    ImGui::BeginTabBar("bar");
    for (const std::size_t i : {0, 1}) {
      shown.at(i) = ImGui::BeginTabItem(i == 0 ? "first" : "second");
      const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
      tabs.at(i) = {(low.x + high.x) / 2, (low.y + high.y) / 2};
      if (shown.at(i)) ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
    ImGui::End();
    ImGui::Render();
  };
  for (int i = 0; i < 4; ++i) frame();
  for (const std::size_t tab : {1, 0, 1}) {
    ASSERT_FALSE(shown.at(tab));
    imgui_.move(500, 600);
    for (int i = 0; i < 3; ++i) frame();
    imgui_.move(tabs.at(tab).x, tabs.at(tab).y);
    imgui_.button(0, true);
    imgui_.button(0, false);
    for (int i = 0; i < 6; ++i) frame();
    EXPECT_TRUE(shown.at(tab)) << "tab " << tab;
  }
}

} // namespace nephroid::ui::random_input_test
