// SPDX-License-Identifier: Apache-2.0
#include "ui/parameters/form.h"

#include "base/files.h"
#include "base/lower_case.h"
#include "base/numbers.h"
#include "optics/spectrum.h"
#include "preset/change_engine.h"
#include "preset/field.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;
using preset::Outline;
using Kind = Outline::Kind;

float gap() { return ImGui::GetStyle().ItemInnerSpacing.x; }

/// What is no number stays a text, of which the reader of presets says what is wrong.
Json number_from(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  if (first == std::string::npos) return text;
  const std::string_view number = std::string_view(text).substr(first, last + 1 - first);
  if (const auto natural = typed_number<std::uint64_t>(number)) return *natural;
  if (const auto integer = typed_number<std::int64_t>(number)) return *integer;
  const auto real = typed_number<double>(number);
  return real && std::isfinite(*real) ? Json(*real) : Json(text);
}

/// A pixel of a drag: a hundredth of the number's power of ten.
double step_of(double value, bool whole) {
  const double step = value == 0 ? 0.01 : std::pow(10, std::floor(std::log10(std::fabs(value)))) / 100;
  return whole ? std::max(step, 1.0) : ImGui::GetIO().KeyAlt ? step / 100 : step;
}

double rounded(double value, double step) {
  return step < 1 ? std::round(value * std::round(1 / step)) / std::round(1 / step) : std::round(value / step) * step;
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

} // namespace

const Json& part(const Json& object, const Outline& o) {
  static const Json none;
  const auto found = object.find(o.field.name);
  return found == object.end() ? none : *found;
}

bool is_changed(const Outline& o, const Json& value) {
  if (o.kind != Kind::object || o.optional) return !o.field.required && value != o.standard;
  const auto fields = o.fields(value);
  return std::any_of(fields.begin(), fields.end(), [&](const Outline& f) { return is_changed(f, part(value, f)); });
}

void Form::push_edits(const Context& context) {
  for (PendingEdit& asked : std::exchange(asked_, {})) {
    if (auto edited = draft.edit(asked.pointer, std::move(asked.value)))
      context.push(command::Edit{.label = std::move(asked.label),
                                 .preset = *std::move(edited),
                                 .gesture = asked.live ? gestures.number() : 0,
                                 .live = asked.live,
                                 .was_read = true});
    else if (!asked.live)
      for (const auto& [edit, problem] : draft.problems())
        if (is_inside(asked.pointer, edit)) reveal = shown_at(problem);
  }
  if (std::exchange(gesture_ended_, false)) context.push(command::EndGesture{});
}

const std::string& shown_at(const Problem& problem) {
  return is_inside(problem.place, problem.pointer) ? problem.place : problem.pointer;
}

bool Form::wants(const Outline& o, const Json& value, const std::string& pointer) const {
  if (o.is_engine_settings && draft.value()["engine"] != o.field.name) return false;
  if (!searching()) return true;
  if (only_changed && !is_changed(o, value)) return false;
  if (has_words(fmt::format("{} {} {}", dotted(pointer), o.field.sentence, o.field.unit), search)) return true;
  if (!o.object && lower_case(search).starts_with(lower_case(dotted(pointer)) + ".")) return true; // a number of it
  if (value.is_null() || !o.object) return false;
  if (o.kind == Kind::object) return wants_any(o, value, pointer);
  const auto items = value.items();
  return std::any_of(items.begin(), items.end(),
                     [&](const auto& item) { return wants_any(o, item.value(), child_of(pointer, item.key())); });
}

bool Form::finds_any() const {
  const auto fields = preset::outline(draft.value());
  return std::any_of(fields.begin(), fields.end(),
                     [&](const Outline& f) { return wants(f, part(draft.value(), f), child_of("", f.field.name)); });
}

bool Form::wants_any(const Outline& o, const Json& object, const std::string& pointer) const {
  const auto fields = o.fields(object);
  return std::any_of(fields.begin(), fields.end(),
                     [&](const Outline& f) { return wants(f, part(object, f), child_of(pointer, f.field.name)); });
}

std::string ValueWidgets::unit_of(const preset::Field& field) const {
  return field.unit == preset::length_unit ? form_.draft.value().value("unit", "") : std::string(field.unit);
}

void ValueWidgets::draw_value(const Outline& o, const Json& value, const std::string& pointer) {
  const std::string unit = unit_of(o.field);
  const float after = (unit.empty() ? 0 : ImGui::CalcTextSize(unit.c_str()).x + gap()) + ImGui::GetFrameHeight() +
                      ImGui::GetStyle().ItemSpacing.x;
  const float width = std::max(ImGui::GetContentRegionAvail().x - after, 4 * em());
  const auto set = [&](std::string_view word) { form_.ask(dotted(pointer) + ": " + std::string(word), pointer, word); };
  switch (o.kind) {
  case Kind::boolean: {
    bool on = value == true;
    if (ImGui::Checkbox(("##" + pointer).c_str(), &on)) form_.ask(dotted(pointer), pointer, on);
    form_.note(pointer);
    break;
  }
  case Kind::word:
    draw_choice(pointer, text_of(value), o.words,
                o.chooses ? std::function<void(std::string_view)>([&](std::string_view word) {
                  Json without = form_.draft.value();
                  preset::take_foreign(without, word);
                  form_.ask(dotted(pointer), "", preset::as_type(without, preset::outline, o, word));
                })
                          : set,
                width);
    break;
  case Kind::integer:
  case Kind::number: {
    const std::string word(o.field.none_word);
    const float button =
        word.empty() ? 0 : ImGui::CalcTextSize(word.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x + gap();
    draw_number({o.field.bounds, o.whole, width - button}, value, pointer);
    if (word.empty()) break;
    ImGui::SameLine(0, gap());
    if (ImGui::Button((word + "##" + pointer).c_str())) set(word);
    form_.note(pointer + ":" + word, std::string(o.field.sentence));
    break;
  }
  case Kind::numbers: {
    const auto count = static_cast<float>(o.size);
    for (std::size_t i = 0; i < o.size; ++i) {
      if (i > 0) ImGui::SameLine(0, gap());
      draw_number({o.field.bounds, o.whole, (width - (count - 1) * gap()) / count}, value.at(i),
                  child_of(pointer, std::to_string(i)));
    }
    break;
  }
  default: {
    const preset::Names names = o.field.names;
    const bool file = o.field.text == preset::Text::file;
    if (names != preset::Names::nothing && !file) {
      std::vector<std::string> choices;
      if (names == preset::Names::material)
        for (const auto& [name, material] : form_.draft.value()["scene"]["materials"].items()) choices.push_back(name);
      else if (names == preset::Names::object) {
        for (const Json& object : form_.draft.value()["scene"]["objects"])
          if (const std::string name = object.value("name", ""); !name.empty()) choices.push_back(name);
      } else
        choices = names == preset::Names::illuminant ? optics::illuminant_names() : optics::colorchecker_names();
      std::vector<Outline::Word> words;
      for (const std::string& name : choices) words.push_back({name, {}});
      draw_choice(pointer, text_of(value), words, set, width);
      break;
    }
    const float buttons = file && names != preset::Names::nothing ? 2 : file ? 1 : 0;
    draw_text(pointer, value, std::max(width - buttons * (ImGui::GetFrameHeight() + gap()), 3 * em()),
              [](const std::string& text) { return Json(text); });
    if (file && names != preset::Names::nothing) draw_shipped_choice(names, value, pointer);
    if (file) draw_file_choice(pointer);
    break;
  }
  }
  if (unit.empty()) return;
  ImGui::SameLine(0, gap());
  ImGui::TextDisabled("%s", unit.c_str());
}

void ValueWidgets::draw_number(const Number& number, const Json& value, const std::string& pointer) {
  const double now = value.is_number() ? value.get<double>() : 0;
  const bool possible = value.is_number() && number.bounds.contain(now) && (!number.whole || std::trunc(now) == now);
  if (!possible || number_typed_ == pointer) {
    if (number_typed_ == pointer && !number_focused_) ImGui::SetKeyboardFocusHere();
    draw_text(pointer, value, number.width, number_from);
    if (number_typed_ != pointer) return;
    if (ImGui::IsItemActive())
      number_focused_ = true;
    else if (number_focused_)
      number_typed_.clear();
    return;
  }
  ImGui::SetNextItemWidth(number.width);
  ImGui::PushItemFlag(ImGuiItemFlags_NoTabStop, false);
  ImGui::PushItemFlag(ImGuiItemFlags_Inputable, true); // so that Tab activates it
  constexpr ImGuiSliderFlags flags = ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat;
  const std::string label = "##" + pointer;
  const double step = step_of(now, number.whole);
  const double low = number.bounds.low, high = number.bounds.high;
  Json dragged;
  if (number.whole && low >= 0) { // a seed has 64 bits, which no double has
    const auto least = static_cast<std::uint64_t>(low),
               most = high < 18446744073709551615.0 ? static_cast<std::uint64_t>(high) : UINT64_MAX;
    const auto pixel = static_cast<std::uint64_t>(step);
    auto to = value.get<std::uint64_t>();
    if (ImGui::DragScalar(label.c_str(), ImGuiDataType_U64, &to, static_cast<float>(step), &least, &most, nullptr,
                          flags))
      dragged = std::max(to / pixel * pixel, least);
  } else {
    double to = now;
    if (ImGui::DragScalar(label.c_str(), ImGuiDataType_Double, &to, static_cast<float>(step), &low, &high, "%.9g",
                          flags))
      dragged = number.whole ? Json(std::llround(rounded(to, step))) : Json(rounded(to, step));
  }
  ImGui::PopItemFlag();
  ImGui::PopItemFlag();
  form_.note(pointer);
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const auto type_it = [&] {
    number_typed_ = pointer;
    number_focused_ = false;
  };
  if (ImGui::IsItemActivated()) {
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) return type_it(); // by Tab or Enter
    form_.gestures.begin();
  }
  if (!dragged.is_null() && number.bounds.contain(dragged.get<double>()))
    form_.ask(dotted(pointer), pointer, dragged, true);
  if (!ImGui::IsItemDeactivated()) return;
  if (ImGui::IsItemDeactivatedAfterEdit()) return form_.end_gesture();
  type_it();
}

std::optional<std::string>
ValueWidgets::type_text(const std::string& id, const std::string& before, float width,
                        const std::function<std::optional<Problem>(const std::string&)>& problem) {
  std::string text = before;
  ImGui::SetNextItemWidth(width);
  ImGui::PushItemFlag(ImGuiItemFlags_NoTabStop, false);
  ImGui::InputTextWithHint(("##text" + id).c_str(), "", &text, ImGuiInputTextFlags_AutoSelectAll);
  ImGui::PopItemFlag();
  form_.note(id);
  if (ImGui::IsItemActive() && ImGui::IsKeyPressed(ImGuiKey_Tab)) { // which may lead back here, or above
    ImGui::ClearActiveID();
    typed_at_.clear();
    if (text != before) return text;
  } else if (ImGui::IsItemActive()) {
    if (typed_at_ == id && typed_ == text) return std::nullopt;
    typed_at_ = id;
    typed_ = text;
    wrong_ = text == before ? std::nullopt : problem(text);
  } else if (typed_at_ == id) {
    typed_at_.clear();
    if (text != before) return text;
  }
  return std::nullopt;
}

void ValueWidgets::draw_text(const std::string& pointer, const Json& value, float width,
                             Json (*read)(const std::string&)) {
  const auto problem = [&](const std::string& text) { return form_.draft.trial(pointer, read(text)); };
  if (const auto typed = type_text(pointer, text_of(value), width, problem))
    form_.ask(dotted(pointer), pointer, read(*typed));
}

void ValueWidgets::draw_choice(const std::string& pointer, const std::string& now,
                               const std::vector<Outline::Word>& words,
                               const std::function<void(std::string_view)>& choose, float width) {
  ImGui::SetNextItemWidth(width);
  Combo list(("##" + pointer).c_str(), now, &form_.places(), pointer);
  for (const Outline::Word& word : words)
    if (list.entry(std::string(word.name), word.name == now, std::string(word.sentence)) && word.name != now)
      choose(word.name);
}

void ValueWidgets::draw_type(const Outline& o, const Json& object, const std::string& pointer) {
  const std::vector<Outline> all = o.fields(object);
  const auto chooser = std::find_if(all.begin(), all.end(), [](const Outline& field) { return field.chooses; });
  if (chooser == all.end()) return ImGui::Dummy({0, ImGui::GetFrameHeight()});
  const std::string key(chooser->field.name), at = child_of(pointer, key);
  const auto choose = [&](std::string_view word) {
    const auto fields = [&](const Json& other) { return o.fields(other); };
    form_.ask(dotted(at) + ": " + std::string(word), pointer, preset::as_type(object, fields, *chooser, word));
  };
  draw_choice(at, object.value(key, ""), chooser->words, choose, 8 * em());
}

/// A button in the line of what was drawn last, for a list of the shipped materials.
void ValueWidgets::draw_shipped_choice(preset::Names names, const Json& value, const std::string& pointer) {
  ImGui::SameLine(0, gap());
  const auto kind = names == preset::Names::metal ? MaterialChoice::Kind::metal : MaterialChoice::Kind::glass;
  if (const auto chosen = shipped_.draw(pointer, kind, text_of(value), *form_.tasks, form_.places()))
    form_.ask(dotted(pointer) + ": " + *chosen, pointer, *chosen);
}

/// A button in the line of what was drawn last, for a list of the files beside the preset.
void ValueWidgets::draw_file_choice(const std::string& pointer) {
  const std::string popup = "files" + pointer;
  std::error_code ignored;
  const fs::path folder = fs::path(form_.draft.source()).parent_path();
  const fs::path beside = folder.empty() ? fs::current_path(ignored) : fs::absolute(folder, ignored);
  ImGui::SameLine(0, gap());
  if (ImGui::Button(("...##" + pointer).c_str(), {ImGui::GetFrameHeight(), 0})) {
    files_.begin(beside, {}, *form_.tasks);
    ImGui::OpenPopup(popup.c_str());
  }
  form_.note(pointer + ":files", "Choose a file");
  if (!ImGui::BeginPopup(popup.c_str())) return;
  if (ImGui::Button("Beside the preset")) files_.begin(beside, {}, *form_.tasks);
  ImGui::SameLine();
  if (ImGui::Button("Shipped")) files_.begin(presets_folder(), {}, *form_.tasks);
  if (files_.draw(34 * em(), 16 * em()) != FileList::Picked::nothing) {
    // As a preset names it: beside itself, else among the shipped files.
    fs::path name = files_.picked();
    for (const fs::path& place : {presets_folder(), beside})
      if (const fs::path near = files_.picked().lexically_relative(place); !near.empty() && *near.begin() != "..")
        if (place == beside || !is_there(beside / near)) name = near;
    form_.ask(dotted(pointer), pointer, name.string());
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

} // namespace nephroid::ui
