// SPDX-License-Identifier: Apache-2.0
// Small widgets that several panels and dialogs use.
#pragma once
#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::ui {

/// The size of the font in pixels, in which widgets measure their lengths.
inline float em() { return ImGui::GetFontSize(); }
/// Draws text in a colour (IM_COL32), or wraps it at the window's edge.
void draw_text(std::uint32_t colour, const std::string& text);
void draw_wrapped(std::uint32_t colour, const std::string& text);
/// Draws text before a widget, in its line.
void draw_label(const char* text);
/// Sets the tooltip of the widget drawn last.
void tooltip(const std::string& text);
/// Draws a sentence in the middle of an area of the window, wrapped at nine tenths of its width.
void draw_hint(std::uint32_t colour, const ImVec2& corner, const ImVec2& size, const std::string& hint);

/// Draws a text in the next cell of a table; a heading has help under the mouse.
void cell(const std::string& text);
void heading_cell(const char* text, const char* help);

/// Whether the text contains each of the words, in any case; used to search.
bool has_words(const std::string& text, const std::string& words);
/// Goes on in the line of the last widget where `width` still fits in it.
void same_line_if_room(float width);
/// Calls draw_row(index) for the rows of `count` that are in sight; height: that of a row, by default as it is drawn.
void draw_rows_in_sight(std::size_t count, const std::function<void(std::size_t)>& draw_row, float height = -1);

/// Bars of widgets, as many in a row as fit.
class BarRows {
public:
  void begin() { next_ = 0; }
  /// Draws a bar beside the one before where it fits with its width of the last frame; else below it.
  void bar(const std::function<void()>& draw);

private:
  std::size_t next_ = 0;
  float right_ = 0; ///< the right edge of the bar before, on the screen
  std::vector<float> widths_;
};

/// Where widgets were drawn; tests click on them.
class WidgetPlaces {
public:
  /// Notes the widget drawn last; help: its tooltip.
  void note(const std::string& widget, const std::string& help = {});
  /// Draws Dear ImGui's widgets of these names and notes them as `widget`.
  bool button(const char* label, const std::string& widget, const std::string& help = {}) {
    return noted(ImGui::Button(label), widget, help);
  }
  bool small_button(const char* label, const std::string& widget, const std::string& help = {}) {
    return noted(ImGui::SmallButton(label), widget, help);
  }
  bool checkbox(const char* label, bool* on, const std::string& widget, const std::string& help = {}) {
    return noted(ImGui::Checkbox(label, on), widget, help);
  }
  void clear() { places_.clear(); }
  std::optional<std::array<double, 2>> of(const std::string& widget) const;

private:
  bool noted(bool used, const std::string& widget, const std::string& help) {
    note(widget, help);
    return used;
  }

  std::map<std::string, std::array<double, 2>> places_;
};

/// A list to choose from. Its entries are drawn during its lifetime, whether it is open or not.
class Combo {
public:
  /// shown: the present choice. widget: the list's name in places, which may be null; entries are noted as
  /// "WIDGET:TEXT".
  Combo(const char* label, const std::string& shown, WidgetPlaces* places = nullptr, std::string widget = {});
  ~Combo();
  Combo(const Combo&) = delete;
  Combo& operator=(const Combo&) = delete;
  /// True where the entry is chosen in this frame. is_now: it is the present choice. help: the entry's tooltip; that of
  /// the present choice is also the closed list's.
  bool entry(const std::string& text, bool is_now, const std::string& help = {});

private:
  WidgetPlaces* places_;
  std::string widget_;
  bool open_ = false;
  int entries_ = 0; ///< so far: two may have one text
};

/// Base of classes that note the places of their widgets.
class Placed {
public:
  /// For tests: the middle of a widget on the screen; nothing where it was not drawn last.
  std::optional<std::array<double, 2>> place_of(const std::string& widget) const { return places_.of(widget); }

protected:
  WidgetPlaces places_;
};

/// Numbers the gestures of one panel. UndoStack makes one entry of edits with the same number, so all panels' numbers
/// differ.
class Gestures {
public:
  explicit Gestures(std::string_view panel) : number_(std::uint64_t{std::hash<std::string_view>{}(panel)} << 32) {}
  /// Returns the new gesture's number, which is not 0.
  std::uint64_t begin() { return ++number_; }
  std::uint64_t number() const { return number_; }

private:
  std::uint64_t number_; ///< the panel in the upper bits, the count in the lower
};

} // namespace nephroid::ui
