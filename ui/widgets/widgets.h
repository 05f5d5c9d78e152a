// SPDX-License-Identifier: Apache-2.0
// Small widgets that several panels and dialogs have.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct ImVec2;

namespace nephroid::ui {

/// A text field of any length; `flags` are ImGuiInputTextFlags. Returns what ImGui::InputText does.
bool input_text(const char* label, const char* hint, std::string& text, int flags = 0);
/// Text in a colour (IM_COL32); and wrapped at the window's edge.
void draw_text(std::uint32_t colour, const std::string& text);
void draw_wrapped(std::uint32_t colour, const std::string& text);
/// Text before a widget, in its line.
void draw_label(const char* text);
/// What is said of the widget drawn last, under the mouse.
void tooltip(const std::string& text);
/// A sentence in the middle of an area of the window, wrapped at nine tenths of its width.
void draw_hint(std::uint32_t colour, const ImVec2& corner, const ImVec2& size, const std::string& hint);

/// The next cell of a table, with a text; as a heading, with help under the mouse.
void cell(const std::string& text);
void heading_cell(const char* text, const char* help);

/// Whether each of the words is in the text, in whatever case: for what is typed to search by.
bool has_words(const std::string& text, const std::string& words);
/// Whether Delete is pressed in the window in hand and not in a text field.
bool delete_pressed();

/// Bars of widgets, as many in a row as fit.
class BarRows {
public:
  /// Before the first bar of a frame.
  void begin() { next_ = 0; }
  /// Draws a bar beside the one before, where it fits as wide as it was in the frame before, else below it.
  void bar(const std::function<void()>& draw);

private:
  std::size_t next_ = 0;
  float right_ = 0;           ///< edge of the bar before, on the screen
  std::vector<float> widths_; ///< of the bars
};

/// Where widgets were drawn, for tests that click on them.
class WidgetPlaces {
public:
  /// Of the widget drawn last, and its tooltip.
  void note(const std::string& widget, const std::string& help = {});
  /// What Dear ImGui has by these names, noted as `widget`.
  bool button(const char* label, const std::string& widget, const std::string& help = {});
  bool small_button(const char* label, const std::string& widget, const std::string& help = {});
  bool checkbox(const char* label, bool* on, const std::string& widget, const std::string& help = {});
  void clear() { places_.clear(); }
  /// Its middle on the screen; nothing where there is no such widget.
  std::optional<std::array<double, 2>> of(const std::string& widget) const;

private:
  std::map<std::string, std::array<double, 2>> places_;
};

/// A list to choose from, open or not; as long as it lives its entries are drawn.
class Combo {
public:
  /// shown: what is chosen now. widget: its name among places, where that is not null; entries are noted as
  /// "WIDGET:TEXT".
  Combo(const char* label, const std::string& shown, WidgetPlaces* places = nullptr, std::string widget = {});
  ~Combo();
  Combo(const Combo&) = delete;
  Combo& operator=(const Combo&) = delete;
  /// True where it is chosen in this frame. is_now: it was chosen before. help: of the entry; while the list is closed,
  /// of the present one.
  bool entry(const std::string& text, bool is_now, const std::string& help = {});

private:
  WidgetPlaces* places_;
  std::string widget_;
  bool open_ = false;
  int entries_ = 0; ///< so far: two may have one text
};

/// What notes where its widgets are.
class Placed {
public:
  /// For tests: the middle of a widget on the screen, by the name that its owner gives it; nothing where it was not
  /// drawn last.
  std::optional<std::array<double, 2>> place_of(const std::string& widget) const { return places_.of(widget); }

protected:
  WidgetPlaces places_;
};

/// Numbers for the gestures of one panel. UndoStack makes one entry of the edits that have one number, so no two panels
/// may have the same.
class Gestures {
public:
  /// panel: its name, which is no other panel's.
  explicit Gestures(std::string_view panel) : number_(std::uint64_t{std::hash<std::string_view>{}(panel)} << 32) {}
  /// A new gesture; returns its number, which is not 0.
  std::uint64_t begin() { return ++number_; }
  /// Of the newest one.
  std::uint64_t number() const { return number_; }

private:
  std::uint64_t number_; ///< the panel above, the count below
};

} // namespace nephroid::ui
