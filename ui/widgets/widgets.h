// SPDX-License-Identifier: Apache-2.0
// Small widgets that several panels and dialogs have.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

struct ImVec2;

namespace nephroid::ui {

/// A text field of any length; `flags` are ImGuiInputTextFlags. Returns what ImGui::InputText does.
bool input_text(const char* label, const char* hint, std::string& text, int flags = 0);
/// Text in a colour (IM_COL32), wrapped at the window's edge.
void draw_wrapped(std::uint32_t colour, const std::string& text);
/// A quiet sentence in the middle of an area of the window, wrapped at nine tenths of its width.
void draw_hint(const ImVec2& corner, const ImVec2& size, const std::string& hint);

/// Whether Delete is pressed in the window in hand and not in a text field.
bool delete_pressed();

/// Where widgets were drawn, for tests that click on them.
class WidgetPlaces {
public:
  /// Of the widget drawn last.
  void note(const std::string& widget);
  void clear() { places_.clear(); }
  /// Its middle on the screen; nothing where there is no such widget.
  std::optional<std::array<double, 2>> of(const std::string& widget) const;

private:
  std::map<std::string, std::array<double, 2>> places_;
};

} // namespace nephroid::ui
