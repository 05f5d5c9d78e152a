// SPDX-License-Identifier: Apache-2.0
#include "ui/runs/sweep_section.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/lower_case.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace nephroid::ui {
namespace {

using State = SweepQueue::State;

const preset::Sweep& sweep_of(const Context& context)
{
  static const preset::Sweep none;
  return context.edits ? context.edits->sweep() : none;
}

std::string heading(const Context& context)
{
  const preset::Sweep& sweep = sweep_of(context);
  if (context.sweep.active()) return "Sweep: " + context.sweep.summary();
  if (sweep.empty()) return "Sweep";
  return fmt::format("Sweep: {:.0f} runs of {}", preset::count_runs(sweep), counted(sweep.size(), "field"));
}

std::string state_text(const SweepQueue::Run& run)
{
  switch (run.state) {
  case State::waiting:
    return "waiting";
  case State::running:
    return fmt::format("{:.0f} %", 100 * run.part);
  case State::done:
    return "done";
  case State::failed:
    return "failed";
  case State::stopped:
    return "stopped";
  }
  return {};
}

bool has_letters(const std::string& key, const std::string& filter)
{
  return lower_case(key).find(lower_case(filter)) != std::string::npos;
}

} // namespace

const NumberField* SweepSection::chosen() const
{
  const auto found = std::ranges::find(fields_, key_, &NumberField::key);
  return found == fields_.end() ? nullptr : &*found;
}

void SweepSection::follow(const Context& context)
{
  const UndoStack::State& edits = context.edits->state();
  if (const auto& now = edits.entries[edits.index].preset; std::exchange(of_, now) != now) fields_ = number_fields(*now);
}

void SweepSection::choose(const NumberField& field)
{
  key_ = field.key;
  problem_.clear();
  text_.clear();
  range_.from = field.value;
  range_.to = field.value == 0 ? 1 : 2 * field.value;
  if (!field.bounds.contain(range_.to)) std::tie(range_.from, range_.to) = std::pair(field.value / 2, field.value);
}

void SweepSection::draw(const Context& context, WidgetPlaces& places)
{
  if (!context.edits) return;
  const bool empty = sweep_of(context).empty() && context.sweep.runs().empty();
  if (std::exchange(was_empty_, empty) && !empty) ImGui::SetNextItemOpen(true);
  const bool open = ImGui::CollapsingHeader((heading(context) + "###sweep").c_str());
  places.note("sweep");
  if (!open) return;
  follow(context);
  draw_fields(context, places);
  draw_choice(places);
  draw_values(context, places);
  if (!problem_.empty()) draw_wrapped(colour::error, problem_);
  const char* const run = context.sweep.active() ? "Stop the sweep" : "Start the sweep";
  action_button(run, context);
  places.note("sweep run");
  if (!context.sweep.runs().empty()) {
    ImGui::SameLine();
    ImGui::TextUnformatted(context.sweep.summary().c_str());
    draw_queue(context);
  }
  ImGui::Separator();
}

/// What is swept, a line each.
void SweepSection::draw_fields(const Context& context, WidgetPlaces& places)
{
  const preset::Sweep& sweep = sweep_of(context);
  if (sweep.empty())
    draw_wrapped(colour::quiet_text, "A sweep runs the preset with several values of a field, or of several fields with each other.");
  for (const preset::SweptField& field : sweep) {
    ImGui::PushID(field.key.c_str());
    const auto known = std::ranges::find(fields_, field.key, &NumberField::key);
    if (ImGui::SmallButton("x")) {
      preset::Sweep without = sweep;
      std::erase_if(without, [&](const preset::SweptField& swept) { return swept.key == field.key; });
      context.push(command::SetSweep{"sweep " + field.key + " no more", std::move(without)});
    }
    places.note("remove " + field.key);
    ImGui::SetItemTooltip("Sweep it no more");
    ImGui::SameLine();
    ImGui::BeginDisabled(known == fields_.end());
    if (ImGui::SmallButton("Edit")) {
      choose(*known);
      typed_ = true;
      text_ = fmt::format("{}", fmt::join(field.values, ", "));
    }
    ImGui::EndDisabled();
    places.note("edit " + field.key);
    ImGui::SameLine();
    constexpr std::size_t most = 100;
    const auto last = field.values.begin() + static_cast<std::ptrdiff_t>(std::min(most, field.values.size()));
    const std::string values = fmt::format("{}{}", fmt::join(field.values.begin(), last, ", "), field.values.size() > most ? ", ..." : "");
    ImGui::TextUnformatted(fmt::format("{}: {}", field.key, values).c_str());
    ImGui::SetItemTooltip("%s", counted(field.values.size(), "value").c_str());
    ImGui::PopID();
  }
}

void SweepSection::draw_choice(WidgetPlaces& places)
{
  ImGui::SetNextItemWidth(-1);
  const bool open = ImGui::BeginCombo("##field", key_.empty() ? "Choose a field" : key_.c_str(), ImGuiComboFlags_HeightLarge);
  places.note("sweep field");
  if (!open) return;
  if (ImGui::IsWindowAppearing()) {
    filter_.clear();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1);
  const bool entered = input_text("##filter", "letters of its name", filter_, ImGuiInputTextFlags_EnterReturnsTrue);
  bool first = true;
  for (const NumberField& field : fields_) {
    if (!has_letters(field.key, filter_)) continue;
    if (ImGui::Selectable(field.key.c_str(), field.key == key_) || (entered && first)) {
      choose(field);
      ImGui::CloseCurrentPopup();
    }
    places.note("field " + field.key);
    ImGui::SetItemTooltip("%s\n%s", field.sentence.c_str(), field.expected.c_str());
    first = false;
  }
  if (first) draw_text(colour::quiet_text, "No field that is one number has these letters");
  ImGui::EndCombo();
}

void SweepSection::draw_values(const Context& context, WidgetPlaces& places)
{
  const NumberField* field = chosen();
  if (!field) return;
  const float em = ImGui::GetFontSize();
  if (ImGui::RadioButton("Range", !typed_)) typed_ = false;
  places.note("sweep range");
  ImGui::SameLine();
  if (ImGui::RadioButton("List", typed_)) typed_ = true;
  places.note("sweep list");
  ImGui::SameLine();
  const bool asked = ImGui::Button("Set");
  places.note("sweep set");
  ImGui::SetItemTooltip("These values are swept: an edit that can be undone");
  bool entered = false;
  if (typed_) {
    ImGui::SetNextItemWidth(-1);
    entered = input_text("##values", "0.5, 0.1, 0.05", text_, ImGuiInputTextFlags_EnterReturnsTrue);
    places.note("sweep values");
  } else {
    const auto words = [&](const char* text) {
      ImGui::SameLine();
      ImGui::TextUnformatted(text);
      ImGui::SameLine();
    };
    const auto number = [&](const char* place, double& value) {
      ImGui::SetNextItemWidth(5 * em);
      ImGui::InputDouble(fmt::format("##{}", place).c_str(), &value, 0, 0, "%.6g");
      places.note(place);
    };
    number("sweep from", range_.from);
    words("to");
    number("sweep to", range_.to);
    words("in");
    ImGui::SetNextItemWidth(3 * em);
    ImGui::InputInt("##count", &range_.count, 0);
    places.note("sweep count");
    words("values");
    ImGui::Checkbox("log", &range_.logarithmic);
    places.note("sweep log");
    ImGui::SetItemTooltip("Each value as many times the one before");
  }
  draw_wrapped(colour::quiet_text, field->expected);
  if (asked || entered) set(context);
}

void SweepSection::set(const Context& context)
{
  const NumberField& field = *chosen();
  try {
    preset::SweptField swept{field.key, typed_ ? typed_values(field, text_) : range_values(field, range_)};
    preset::Sweep sweep = sweep_of(context);
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
void SweepSection::draw_queue(const Context& context)
{
  const std::vector<SweepQueue::Run>& runs = context.sweep.runs();
  const float line = ImGui::GetTextLineHeightWithSpacing(), em = ImGui::GetFontSize();
  constexpr std::size_t most_lines = 6;
  if (ImGui::BeginChild("queue", {0, line * (static_cast<float>(std::min(most_lines, runs.size())) + 0.5f)}, ImGuiChildFlags_Borders)) {
    for (const SweepQueue::Run& run : runs) {
      ImGui::TextUnformatted(state_text(run).c_str());
      if (run.state == State::running && std::exchange(in_sight_, run.name) != run.name) ImGui::SetScrollHereY();
      ImGui::SameLine(4 * em);
      draw_text(run.state == State::failed ? colour::error : colour::text, run.why.empty() ? run.name : run.name + ": " + run.why);
      if (!run.why.empty()) ImGui::SetItemTooltip("%s", run.why.c_str());
    }
  }
  ImGui::EndChild();
}

} // namespace nephroid::ui
