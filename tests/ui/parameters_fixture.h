// SPDX-License-Identifier: Apache-2.0
// The panel "Parameters" in a window without a display, so tall that every row is in sight: fields are found by the
// search and edited by mouse and keys.
#pragma once
#include "window_fixture.h"

namespace nephroid::test {

using Json = preset::Json;

class ParametersFixture : public WindowFixture {
protected:
  ParametersFixture() : WindowFixture("parameters") {
    ImGui::GetIO().DisplaySize = {1000, 4000};
    runs.steps = 1000000;
  }

  const ui::ParametersPanel& panel() const { return workspace.panel<ui::ParametersPanel>(); }
  const std::map<std::string, ui::Problem>& problems() const { return panel().draft().problems(); }
  std::string text() const { return preset::to_json(*workbench.preset()); }
  /// Of the preset, not of the draft.
  Json at(const std::string& pointer) const { return Json::parse(text()).at(Json::json_pointer(pointer)); }

  using WindowFixture::click;
  void click(const std::string& widget, int button = 0) { click_in(panel(), widget, 1, button); }
  void search(const std::string& words) {
    click("search");
    retype(words);
    press(ImGuiKey_Enter);
  }
  /// Finds a field and types into it, without Enter.
  void begin_typing(const std::string& pointer, const std::string& typed) {
    search(ui::dotted(pointer));
    click(pointer);
    frames(2);
    retype(typed);
  }
  void enter(const std::string& pointer, const std::string& typed) {
    begin_typing(pointer, typed);
    press(ImGuiKey_Enter);
  }
  void choose(const std::string& pointer, const std::string& word) {
    click(pointer);
    click(pointer + ":" + word);
  }
  void undo() { press(ImGuiKey_Z, ImGuiMod_Ctrl); }
};

} // namespace nephroid::test
