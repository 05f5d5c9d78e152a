// SPDX-License-Identifier: Apache-2.0
#include "ui/runs/sweep_section.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/lower_case.h"
#include "base/numbers.h"
#include "preset/outline.h"
#include "preset/read.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nephroid::ui {
namespace {

using preset::Json;
using preset::Outline;
using Kind = Outline::Kind;

constexpr std::size_t most_values = 10000; ///< that a sweep of a preset may have

/// Whether --set takes the name between two dots.
bool is_sayable(const std::string& key) {
  return !key.empty() && key.find_first_of(".=[") == std::string::npos &&
         std::ranges::none_of(key, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

void collect(const std::vector<Outline>& outline, const Json& object, const std::string& before,
             std::vector<NumberField>& all) {
  for (const Outline& o : outline) {
    const std::string name(o.field.name);
    const std::string key = before + name;
    const Json value = object.contains(name) ? object[name] : Json();
    if (o.kind == Kind::number || o.kind == Kind::integer) {
      const double low = std::isfinite(o.field.bounds.low) ? o.field.bounds.low : 0;
      all.push_back({key, o.kind == Kind::integer, o.field.bounds, std::string(o.field.sentence), o.expected,
                     value.is_number() ? value.get<double>() : low});
    } else if (o.kind == Kind::object && value.is_object())
      collect(o.fields(value), value, key + '.', all);
    else if (o.kind == Kind::list || o.kind == Kind::map)
      for (const auto& item : value.items())
        if (is_sayable(item.key())) collect(o.fields(item.value()), item.value(), key + '.' + item.key() + '.', all);
  }
}

std::string text_of(const NumberField& field, double value) {
  return field.whole ? fmt::format("{:.0f}", value) : Json(*number_in<double>(fmt::format("{:.12g}", value))).dump();
}

/// Throws where the field may not have it.
void check_value(const NumberField& field, double value, const std::string& shown) {
  if (std::isfinite(value) && field.bounds.contain(value) && (!field.whole || value == std::trunc(value))) return;
  throw bad_input(field.key, fmt::format("{} is out of its range", shown), "expected " + field.expected);
}

std::string typed_value(const NumberField& field, const std::string& word) {
  const auto value = typed_number<double>(word);
  if (!value) throw bad_input(field.key, "a value is no number", "expected numbers with commas between");
  check_value(field, *value, fmt::format("{:g}", *value));
  // Whole numbers beyond those of a double stay as they were typed.
  if (const auto natural = typed_number<std::uint64_t>(word); field.whole && natural) return std::to_string(*natural);
  return text_of(field, *value);
}

const std::vector<std::string>& all_different(const NumberField& field, const std::vector<std::string>& values) {
  for (std::set<std::string> seen; const std::string& value : values)
    if (!seen.insert(value).second)
      throw bad_input(field.key, fmt::format("the value {} is there twice", value), "expected different values");
  return values;
}

using State = SweepQueue::State;

std::string heading(const Context& context) {
  const preset::Sweep& sweep = context.edits->sweep();
  if (context.sweep.active()) return "Sweep: " + context.sweep.summary();
  if (sweep.empty()) return "Sweep";
  return fmt::format("Sweep: {:.0f} runs of {}", preset::count_runs(sweep), counted(sweep.size(), "field"));
}

std::string state_text(const SweepQueue::QueuedRun& run) {
  if (run.state == State::running) return fmt::format("{:.0f} %", 100 * run.part);
  static const std::map<State, const char*> names{
      {State::waiting, "waiting"}, {State::done, "done"}, {State::failed, "failed"}, {State::stopped, "stopped"}};
  return names.at(run.state);
}

} // namespace

std::vector<NumberField> number_fields(const preset::Preset& preset) {
  std::vector<NumberField> all;
  const Json json = preset::as_json(preset);
  collect(preset::outline(json), json, "", all);
  return all;
}

std::vector<std::string> range_values(const NumberField& field, const SweepRange& range) {
  if (range.count < 1 || static_cast<std::size_t>(range.count) > most_values)
    throw bad_input(field.key, fmt::format("{} values", range.count), fmt::format("expected 1 to {}", most_values));
  for (const double end : {range.from, range.to}) check_value(field, end, fmt::format("{:g}", end));
  if (range.logarithmic && !(range.from > 0 && range.to > 0))
    throw bad_input(field.key, "a logarithmic range has both ends above 0", "", "make it linear, or give other ends");
  std::vector<std::string> values;
  for (int i = 0; i < range.count; ++i) {
    const double part = range.count == 1 ? 0 : static_cast<double>(i) / (range.count - 1);
    double value = range.logarithmic ? range.from * std::pow(range.to / range.from, part)
                                     : range.from + part * (range.to - range.from);
    if (i == range.count - 1 && i > 0) value = range.to; // exactly
    values.push_back(text_of(field, field.whole ? std::round(value) : value));
  }
  return all_different(field, values);
}

std::vector<std::string> typed_values(const NumberField& field, const std::string& text) {
  constexpr const char* between = ", ;\t\r\n";
  std::vector<std::string> values;
  for (std::size_t at = text.find_first_not_of(between); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    values.push_back(typed_value(field, text.substr(at, end - at)));
    if (values.size() > most_values)
      throw bad_input(field.key, "there are too many values", fmt::format("expected at most {}", most_values));
    at = text.find_first_not_of(between, end);
  }
  if (values.empty()) throw bad_input(field.key, "there is no value", "expected numbers with commas between");
  return all_different(field, values);
}

const NumberField* SweepSection::chosen() const {
  const auto found = std::ranges::find(fields_, key_, &NumberField::key);
  return found == fields_.end() ? nullptr : &*found;
}

void SweepSection::choose(const NumberField& field) {
  key_ = field.key;
  problem_.clear();
  text_.clear();
  range_.from = field.value;
  range_.to = field.value == 0 ? 1 : 2 * field.value;
  if (!field.bounds.contain(range_.to)) std::tie(range_.from, range_.to) = std::pair(field.value / 2, field.value);
}

void SweepSection::draw(const Context& context, WidgetPlaces& places) {
  const bool empty = context.edits->sweep().empty() && context.sweep.runs().empty();
  if (std::exchange(was_empty_, empty) && !empty) ImGui::SetNextItemOpen(true);
  const bool open = ImGui::CollapsingHeader((heading(context) + "###sweep").c_str());
  places.note("sweep");
  if (!open) return;
  if (const auto& now = context.edits->in_file(); std::exchange(of_, now) != now) fields_ = number_fields(*now);
  draw_fields(context, places);
  draw_choice(places);
  draw_values(context, places);
  if (!problem_.empty()) draw_wrapped(colour::error, problem_);
  action_button(context.sweep.active() ? "Stop the sweep" : "Start the sweep", context);
  places.note("sweep run");
  if (!context.sweep.runs().empty()) {
    ImGui::SameLine();
    ImGui::TextUnformatted(context.sweep.summary().c_str());
    draw_queue(context);
  }
  ImGui::Separator();
}

void SweepSection::draw_fields(const Context& context, WidgetPlaces& places) {
  const preset::Sweep& sweep = context.edits->sweep();
  if (sweep.empty())
    draw_wrapped(colour::quiet_text,
                 "A sweep runs the preset with several values of a field, or of several fields with each other.");
  for (const preset::SweptField& field : sweep) {
    ImGui::PushID(field.key.c_str());
    const auto known = std::ranges::find(fields_, field.key, &NumberField::key);
    if (places.small_button("x", "remove " + field.key, "Sweep it no more")) {
      preset::Sweep without = sweep;
      std::erase_if(without, [&](const preset::SweptField& swept) { return swept.key == field.key; });
      context.push(command::SetSweep{"sweep " + field.key + " no more", std::move(without)});
    }
    ImGui::SameLine();
    ImGui::BeginDisabled(known == fields_.end());
    if (places.small_button("Edit", "edit " + field.key)) {
      choose(*known);
      typed_ = true;
      text_ = fmt::format("{}", fmt::join(field.values, ", "));
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    constexpr std::size_t most = 100;
    const auto last = field.values.begin() + static_cast<std::ptrdiff_t>(std::min(most, field.values.size()));
    const std::string values =
        fmt::format("{}{}", fmt::join(field.values.begin(), last, ", "), field.values.size() > most ? ", ..." : "");
    ImGui::TextUnformatted(fmt::format("{}: {}", field.key, values).c_str());
    tooltip(counted(field.values.size(), "value"));
    ImGui::PopID();
  }
}

void SweepSection::draw_choice(WidgetPlaces& places) {
  ImGui::SetNextItemWidth(-1);
  const bool open =
      ImGui::BeginCombo("##field", key_.empty() ? "Choose a field" : key_.c_str(), ImGuiComboFlags_HeightLarge);
  places.note("sweep field");
  if (!open) return;
  if (ImGui::IsWindowAppearing()) {
    filter_.clear();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      ImGui::InputTextWithHint("##filter", "letters of its name", &filter_, ImGuiInputTextFlags_EnterReturnsTrue);
  bool first = true;
  for (const NumberField& field : fields_) {
    if (lower_case(field.key).find(lower_case(filter_)) == std::string::npos) continue;
    if (ImGui::Selectable(field.key.c_str(), field.key == key_) || (entered && first)) {
      choose(field);
      ImGui::CloseCurrentPopup();
    }
    places.note("field " + field.key, field.sentence + '\n' + field.expected);
    first = false;
  }
  if (first) draw_text(colour::quiet_text, "No field that is one number has these letters");
  ImGui::EndCombo();
}

void SweepSection::draw_values(const Context& context, WidgetPlaces& places) {
  const NumberField* field = chosen();
  if (!field) return;
  if (ImGui::RadioButton("Range", !typed_)) typed_ = false;
  places.note("sweep range");
  ImGui::SameLine();
  if (ImGui::RadioButton("List", typed_)) typed_ = true;
  places.note("sweep list");
  ImGui::SameLine();
  const bool asked = places.button("Set", "sweep set", "These values are swept: an edit that can be undone");
  bool entered = false;
  if (typed_) {
    ImGui::SetNextItemWidth(-1);
    entered = ImGui::InputTextWithHint("##values", "0.5, 0.1, 0.05", &text_, ImGuiInputTextFlags_EnterReturnsTrue);
    places.note("sweep values");
  } else {
    const auto words = [](const char* text) {
      ImGui::SameLine();
      draw_label(text);
    };
    const auto number = [&](const char* place, double& value) {
      ImGui::SetNextItemWidth(5 * em());
      ImGui::InputDouble(fmt::format("##{}", place).c_str(), &value, 0, 0, "%.6g");
      places.note(place);
    };
    number("sweep from", range_.from);
    words("to");
    number("sweep to", range_.to);
    words("in");
    ImGui::SetNextItemWidth(3 * em());
    ImGui::InputInt("##count", &range_.count, 0);
    places.note("sweep count");
    words("values");
    places.checkbox("log", &range_.logarithmic, "sweep log", "Each value as many times the one before");
  }
  draw_wrapped(colour::quiet_text, field->expected);
  if (asked || entered) set(context);
}

void SweepSection::set(const Context& context) {
  const NumberField& field = *chosen();
  try {
    preset::SweptField swept{field.key, typed_ ? typed_values(field, text_) : range_values(field, range_)};
    preset::Sweep sweep = context.edits->sweep();
    if (const auto there = std::ranges::find(sweep, field.key, &preset::SweptField::key); there != sweep.end())
      *there = std::move(swept);
    else
      sweep.push_back(std::move(swept));
    problem_.clear();
    context.push(command::SetSweep{"sweep " + field.key, std::move(sweep)});
  } catch (const Error& error) {
    problem_ = error.line();
  }
}

/// The runs with their states; the one that begins comes into sight.
void SweepSection::draw_queue(const Context& context) {
  const std::vector<SweepQueue::QueuedRun>& runs = context.sweep.runs();
  const float line = ImGui::GetTextLineHeightWithSpacing();
  constexpr std::size_t most_lines = 6;
  if (ImGui::BeginChild("queue", {0, line * (static_cast<float>(std::min(most_lines, runs.size())) + 0.5f)},
                        ImGuiChildFlags_Borders)) {
    for (const SweepQueue::QueuedRun& run : runs) {
      ImGui::TextUnformatted(state_text(run).c_str());
      if (run.state == State::running && std::exchange(in_sight_, run.name) != run.name) ImGui::SetScrollHereY();
      ImGui::SameLine(4 * em());
      draw_text(run.state == State::failed ? colour::error : colour::text,
                run.why.empty() ? run.name : run.name + ": " + run.why);
      if (!run.why.empty()) tooltip(run.why);
    }
  }
  ImGui::EndChild();
}

} // namespace nephroid::ui
