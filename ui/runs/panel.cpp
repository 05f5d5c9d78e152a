// SPDX-License-Identifier: Apache-2.0
#include "ui/runs/panel.h"

#include "base/error.h"
#include "preset/json_text.h"
#include "ui/state/run_record.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::ui {
namespace {

RunRow row_of(const PinnedRun& run) {
  RunRow row{.pin = run.id, .name = run.name, .colour = run.colour};
  row.has_picture = run.picture != nullptr;
  if (!run.is_run()) {
    row.file = run.file.string();
    row.read_as = run.read_as;
    row.engine = "picture";
    row.seconds = fmt::format("{} x {}", run.picture->width, run.picture->height);
    row.steps = "pixels";
    return row;
  }
  if (const auto& record = run.record) {
    if (!record->engine.empty()) row.engine = record->engine;
    if (record->steps)
      row.steps = fmt::format("{} {}{}", *record->steps, record->steps_name, record->finished ? "" : "...");
    if (record->work_seconds) row.seconds_value = *record->work_seconds;
    row.preset = record->preset;
  } else if (!run.history->rows.empty()) // a table alone has the time of its last row
    row.seconds_value = run.history->rows.back().seconds;
  if (row.seconds_value == row.seconds_value) row.seconds = fmt::format("{:.3g} s", row.seconds_value);
  if (const auto error = known_error(*run.history)) {
    row.error_value = error->value;
    row.error = fmt::format("{:.3g} {}", error->value, error->metric);
    row.error_kind = error->is_estimate ? "estimate" : "to its reference";
  }
  return row;
}

std::string short_value(const std::string& text) {
  constexpr std::size_t longest = 24;
  if (text == "null") return "none";
  if (text.size() <= longest) return text;
  const preset::Json value = preset::Json::parse(text, nullptr, false);
  if (value.is_array()) return fmt::format("[{} items]", value.size());
  if (value.is_object())
    return value.contains("type") && value["type"].is_string() ? value["type"].get<std::string>() + " {...}" : "{...}";
  return text.substr(0, longest) + "...";
}

std::string line_of(const preset::Difference& d) {
  return fmt::format("{}: {} -> {}", d.path, short_value(d.before), short_value(d.after));
}

std::string all_lines(const std::vector<preset::Difference>& differences) {
  constexpr std::size_t most = 40;
  std::string text = "From the present preset to this one:";
  for (std::size_t i = 0; i < std::min(most, differences.size()); ++i) text += '\n' + line_of(differences[i]);
  if (differences.size() > most) text += fmt::format("\n{} more", differences.size() - most);
  return text;
}

enum Column { name_column, work_column, error_column, buttons_column };

/// Whether a comes before b: by the column that a person clicked on. What has no number comes last.
bool is_before(const RunRow& a, const RunRow& b, const ImGuiTableColumnSortSpecs& by) {
  const bool down = by.SortDirection == ImGuiSortDirection_Descending;
  if (by.ColumnIndex == name_column) return down ? b.name < a.name : a.name < b.name;
  const double left = by.ColumnIndex == work_column ? a.seconds_value : a.error_value;
  const double right = by.ColumnIndex == work_column ? b.seconds_value : b.error_value;
  if (!(left == left) || !(right == right)) return left == left && !(right == right);
  return down ? right < left : left < right;
}

/// Two lines of a cell.
void draw_cell(const std::string& above, const std::string& below) {
  ImGui::TextUnformatted(above.c_str());
  draw_text(colour::quiet_text, below);
}

} // namespace

std::vector<RunRow> run_rows(const Context& context) {
  std::vector<RunRow> rows;
  if (context.run.snapshot()) {
    rows.push_back(row_of(look_at_run(context.run)));
    rows.back().name = "this run";
  } else
    rows.push_back({.name = "this run", .engine = context.engine()});
  rows.back().colour = colour::on_dark; // as in the panel Error
  for (const PinnedRun& run : context.comparing.pinned().all()) rows.push_back(row_of(run));
  return rows;
}

const PresetDifferences::Known& PresetDifferences::of(const RunRow& row, const Context& context) {
  std::erase_if(known_,
                [&](const auto& entry) { return entry.first != 0 && !context.comparing.pinned().find(entry.first); });
  Known& known = known_[row.pin];
  const auto present = context.edits->shared();
  if (known.of == row.preset && known.present == present && !known.in_short.empty()) return known;
  known = {row.preset, present, {}, {}};
  if (!row.preset && row.pin != 0)
    known.in_short = row.file.empty() ? "its preset is not known" : row.read_as + "; " + row.file;
  if (!row.preset) return known;
  try {
    const std::vector<preset::Difference> differences = preset::differences(*present, *row.preset);
    known.in_short = differences.empty() ? "as the present preset" : line_of(differences.front());
    if (differences.size() > 1) known.in_short += fmt::format(", {} more", differences.size() - 1);
    if (!differences.empty()) known.in_full = all_lines(differences);
  } catch (const Error& error) {
    known.in_short = error.line();
  }
  return known;
}

command::Edit taken(const RunRow& row, const preset::Preset& present) {
  preset::Preset edited = preset::moved_to_file(*row.preset, present.source);
  if (row.preset->source == present.source) {
    edited.name = present.name;
    edited.description = present.description;
  }
  return {"take the preset of " + row.name, std::move(edited)};
}

void RunsPanel::draw(const Context& context) {
  places_.clear();
  rows_ = run_rows(context);
  action_button("Write a report...", context);
  places_.note("report");
  ImGui::SameLine();
  action_button("Pin this run", context);
  ImGui::SameLine();
  action_button("Open history...", context);
  ImGui::SameLine();
  action_button("Open pictures...", context);
  sweep_.draw(context, places_);
  draw_table(context);
}

void RunsPanel::draw_table(const Context& context) {
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_ScrollY |
                                    ImGuiTableFlags_Resizable | ImGuiTableFlags_Sortable |
                                    ImGuiTableFlags_SortTristate | ImGuiTableFlags_NoSavedSettings;
  if (!ImGui::BeginTable("runs", 4, flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Run", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Work", ImGuiTableColumnFlags_WidthFixed, 5.5f * em());
  ImGui::TableSetupColumn("Error", ImGuiTableColumnFlags_WidthFixed, 7.5f * em());
  ImGui::TableSetupColumn("##buttons", ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_NoSort, 7.5f * em());
  ImGui::TableHeadersRow();
  if (const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs && specs->SpecsCount > 0)
    std::stable_sort(rows_.begin(), rows_.end(),
                     [&](const RunRow& a, const RunRow& b) { return is_before(a, b, specs->Specs[0]); });
  const float high = 3 * ImGui::GetTextLineHeightWithSpacing() + 2 * ImGui::GetStyle().CellPadding.y;
  draw_rows_in_sight(
      rows_.size(),
      [&](std::size_t i) {
        ImGui::TableNextRow(0, high);
        ImGui::PushID(static_cast<int>(rows_[i].pin));
        draw_row(context, rows_[i]);
        ImGui::PopID();
      },
      high);
  ImGui::EndTable();
}

void RunsPanel::draw_row(const Context& context, const RunRow& row) {
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float box = 0.7f * em(), inset = box + 0.4f * em();
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y + 0.15f * em()},
                                            {corner.x + box, corner.y + 0.15f * em() + box}, row.colour);
  ImGui::Indent(inset);
  draw_cell(row.name, row.engine);
  ImGui::Unindent(inset);
  ImGui::TableNextColumn();
  draw_cell(row.seconds, row.steps);
  ImGui::TableNextColumn();
  draw_cell(row.error, row.error_kind);
  ImGui::TableNextColumn();
  draw_buttons(context, row);
  const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  draw_difference(context, row, {corner.x + inset, corner.y + 2 * ImGui::GetTextLineHeightWithSpacing()},
                  end - corner.x - inset);
}

void RunsPanel::draw_buttons(const Context& context, const RunRow& row) {
  const auto button = [&](const char* label, const std::string& place, bool enabled, const char* help) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = places_.small_button(label, place, help);
    ImGui::EndDisabled();
    return pressed;
  };
  const auto toggle = [&](const char* label, const std::string& place, bool on, const char* help) {
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = button(label, place, row.has_picture, row.has_picture ? help : "It has no picture");
    if (on) ImGui::PopStyleColor();
    return pressed;
  };
  const Comparison& comparison = context.comparing.comparison();
  const std::uint64_t as_other = row.pin == 0 ? Comparison::run_in_hand : row.pin;
  const bool shown = comparison.shown == row.pin, compared = comparison.pin == as_other;
  if (toggle("Show", fmt::format("show {}", row.pin), shown, "Its picture in the View; again: back to the run in hand"))
    context.push(command::ShowPicture{shown ? 0 : row.pin});
  ImGui::SameLine();
  const bool is_run = row.file.empty();
  if (row.pin == 0) {
    if (button("Pin", "pin", row.has_picture, "Keep its history and its picture, to compare later runs with"))
      context.push(command::PinRun{});
  } else if (button(is_run ? "Unpin" : "Close", fmt::format("unpin {}", row.pin), true,
                    is_run ? "Forget this run" : "Forget this picture; its file stays"))
    context.push(command::Unpin{row.pin});
  if (toggle("Compare", fmt::format("compare {}", row.pin), compared,
             "What the View shows is compared with it; again: with the preset's reference"))
    context.push(command::CompareWith{compared ? 0 : as_other});
  if (row.pin == 0 || !is_run) return;
  ImGui::SameLine();
  if (button("Take", fmt::format("take {}", row.pin), row.preset != nullptr,
             row.preset ? "Its preset in place of the present one, as an edit that can be undone"
                        : "Its preset is not known"))
    context.push(taken(row, *context.preset()));
}

/// The third line of the row, across all columns, from its upper left corner on. Under the mouse: all of it.
void RunsPanel::draw_difference(const Context& context, const RunRow& row, const ImVec2& corner, float width) {
  const auto& known = differences_.of(row, context);
  const ImVec2 low = corner, high{low.x + width, low.y + ImGui::GetTextLineHeight()};
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 seen_low = ImGui::GetWindowPos(), seen = ImGui::GetWindowSize();
  list->PushClipRect({std::max(low.x, seen_low.x), std::max(low.y, seen_low.y + ImGui::GetFrameHeight())},
                     {std::min(high.x, seen_low.x + seen.x), std::min(high.y, seen_low.y + seen.y)});
  list->AddText(low, colour::quiet_text, known.in_short.c_str());
  list->PopClipRect();
  if (!known.in_full.empty() && ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high, false))
    ImGui::SetTooltip("%s", known.in_full.c_str());
}

} // namespace nephroid::ui
