// SPDX-License-Identifier: Apache-2.0
// Whatever a hand does to mouse and keyboard, the window stays: random clicks, drags, keys, values out of range and dropped files, in
// presets of all engines, on fake jobs. NEPHROID_RANDOM_SECONDS=600 plays for ten minutes what was not played before; under ./test.sh asan
// it looks for what nobody sees.
#include "preset/read.h"
#include "window_fixture.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <chrono>
#include <cstdlib>
#include <random>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;

class RandomInput : public test::WindowFixture {
protected:
  RandomInput()
  {
    for (const char* name : {"first-light", "spectral/prism", "environment/ball", "inverse/shapes"}) copy_preset(name);
    files_.push_back(folder.write("cut.json", R"({"scene": {)"));
    files_.push_back(folder.write("nothing.exr", "v/1"));
    files_.push_back(folder.write("picture.png", "\x89PNG\r\n"));
    files_.push_back(folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    files_.push_back(folder.write("bad.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\n"));
    files_.push_back(folder.write("scene.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"children": [0]}]})"));
    files_.push_back(folder.write("glass.yml", "DATA:\n  - type: formula 1\n    coefficients: 0 1 0.1\n"));
    files_.push_back((folder.path() / "gone.json").string());
    fs::current_path(folder.path()); // where a name without a folder is saved
  }
  ~RandomInput() override { fs::current_path("/"); }

  /// A shipped preset, beside the materials that it names, to be saved over.
  void copy_preset(const std::string& name)
  {
    files_.push_back(folder.write(fs::path(name).filename().string() + ".json", preset::to_json(preset::read_preset(name), folder.path())));
  }

  template <class T>
  const T& one_of(const std::vector<T>& all)
  {
    return all[random_() % all.size()];
  }
  double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  void some_text()
  {
    static const std::vector<std::string> texts{"nan",
                                                "-1",
                                                "1e999",
                                                "inf",
                                                "0",
                                                "1e-320",
                                                "999999999999999999999",
                                                "\xc3\xa9\xe2\x82\xac",
                                                "%s%n%d",
                                                "../../x",
                                                "a",
                                                "",
                                                ".5",
                                                "-0",
                                                "0x10",
                                                "glass",
                                                "first",
                                                "\t",
                                                "\xff\xfe"};
    ImGui::GetIO().AddInputCharactersUTF8(one_of(texts).c_str());
  }
  void some_key()
  {
    const auto key =
        static_cast<ImGuiKey>(ImGuiKey_NamedKey_BEGIN + static_cast<int>(random_() % (ImGuiKey_GamepadStart - ImGuiKey_NamedKey_BEGIN)));
    if (key >= ImGuiKey_MouseLeft && key <= ImGuiKey_MouseWheelY) return;
    static const std::vector<ImGuiKey> modifiers{ImGuiKey_None,
                                                 ImGuiKey_None,
                                                 ImGuiKey_None,
                                                 static_cast<ImGuiKey>(ImGuiMod_Ctrl),
                                                 static_cast<ImGuiKey>(ImGuiMod_Shift),
                                                 static_cast<ImGuiKey>(ImGuiMod_Alt)};
    const ImGuiKey modifier = one_of(modifiers);
    if (modifier) imgui.key(modifier, true);
    imgui.key(key, true);
    frame();
    imgui.key(key, false);
    if (modifier) imgui.key(modifier, false);
  }
  void some_event()
  {
    switch (random_() % 16) {
    case 0:
    case 1:
    case 2:
    case 3:
      imgui.move(draw(-20, 1020), draw(-20, 720));
      break;
    case 4:
    case 5:
      imgui.button(static_cast<int>(random_() % 3), true);
      break;
    case 6:
    case 7:
    case 8:
      imgui.button(static_cast<int>(random_() % 3), false);
      break;
    case 9:
      imgui.wheel(draw(-3, 3));
      break;
    case 10:
    case 11:
      some_key();
      break;
    case 12:
      some_text();
      break;
    case 13: // a click somewhere, twice
      for (const bool down : {true, false, true, false}) {
        imgui.button(0, down);
        frame();
      }
      break;
    case 14: // an action, as the palette runs it
      if (const Action& action = actions()[random_() % actions().size()]; action.enabled(context())) {
        Commands commands;
        action.run(workbench.context(commands));
        workbench.apply(commands);
      }
      break;
    default:
      if (random_() % 10 == 0) workbench.apply({command::Open{one_of(files_), random_() % 2 == 0}});
      if (random_() % 40 == 0) ImGui::GetIO().DisplaySize = {static_cast<float>(draw(1, 2000)), static_cast<float>(draw(1, 1500))};
    }
    ++events_;
  }

  void play()
  {
    ImGui::GetIO().DisplaySize = {1000, 700};
    for (int i = 0; i < 200; ++i) {
      some_event();
      frame();
      if (workbench.question() != Question::none && random_() % 20 == 0) workbench.apply({command::Ask{Question::none}});
    }
  }

  /// What the window has is a preset, whatever was done to it.
  static void is_whole(const preset::Preset& preset)
  {
    const std::string text = preset::to_json(preset);
    EXPECT_EQ(preset::to_json(preset::parse_preset(text, preset.source)), text);
  }

  std::vector<std::string> files_;
  std::mt19937 random_;
  std::uint64_t events_ = 0;
};

TEST_F(RandomInput, TheWindowStays)
{
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

} // namespace
} // namespace nephroid::ui
