// SPDX-License-Identifier: Apache-2.0
#include "ui/runs/panel.h"

#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

enum Column { name_column, work_column, error_column, buttons_column };

/// Whether a comes before b: by the column that a person clicked on. What has no number comes last.
bool is_before(const RunRow& a, const RunRow& b, const ImGuiTableColumnSortSpecs& by)
{
  const bool down = by.SortDirection == ImGuiSortDirection_Descending;
  if (by.ColumnIndex == name_column) return down ? b.name < a.name : a.name < b.name;
  const double left = by.ColumnIndex == work_column ? a.seconds_value : a.error_value;
  const double right = by.ColumnIndex == work_column ? b.seconds_value : b.error_value;
  if (!(left == left) || !(right == right)) return left == left && !(right == right);
  return down ? right < left : left < right;
}

/// Two lines of a cell.
void draw_cell(const std::string& above, const std::string& below)
{
  ImGui::TextUnformatted(above.c_str());
  draw_text(colour::quiet_text, below);
}

} // namespace

void RunsPanel::draw(const Context& context)
{
  places_.clear();
  differences_.begin_frame();
  rows_ = run_rows(context);
  action_button("Write a report...", context);
  places_.note("report");
  ImGui::SameLine();
  action_button("Pin this run", context);
  ImGui::SameLine();
  action_button("Open history...", context);
  sweep_.draw(context, places_);
  if (rows_.empty()) {
    draw_wrapped(colour::quiet_text,
                 "Open a preset: its run is listed here, and each run that is pinned. Or open the history of an earlier run.");
    return;
  }
  draw_table(context);
}

void RunsPanel::draw_table(const Context& context)
{
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_ScrollY |
                                    ImGuiTableFlags_Resizable | ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate |
                                    ImGuiTableFlags_NoSavedSettings;
  if (!ImGui::BeginTable("runs", 4, flags)) return;
  const float em = ImGui::GetFontSize();
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Run", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Work", ImGuiTableColumnFlags_WidthFixed, 5.5f * em);
  ImGui::TableSetupColumn("Error", ImGuiTableColumnFlags_WidthFixed, 7.5f * em);
  ImGui::TableSetupColumn("##buttons", ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_NoSort, 6.5f * em);
  ImGui::TableHeadersRow();
  if (const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs && specs->SpecsCount > 0)
    std::stable_sort(rows_.begin(), rows_.end(), [&](const RunRow& a, const RunRow& b) { return is_before(a, b, specs->Specs[0]); });
  const float high = 3 * ImGui::GetTextLineHeightWithSpacing() + 2 * ImGui::GetStyle().CellPadding.y;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows_.size()), high);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::TableNextRow(0, high);
      ImGui::PushID(static_cast<int>(rows_[static_cast<std::size_t>(i)].pin));
      draw_row(context, rows_[static_cast<std::size_t>(i)]);
      ImGui::PopID();
    }
  ImGui::EndTable();
}

void RunsPanel::draw_row(const Context& context, const RunRow& row)
{
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float em = ImGui::GetFontSize(), box = 0.7f * em, inset = box + 0.4f * em;
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y + 0.15f * em}, {corner.x + box, corner.y + 0.15f * em + box}, row.colour);
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
  draw_difference(context, row, {corner.x + inset, corner.y + 2 * ImGui::GetTextLineHeightWithSpacing()}, end - corner.x - inset);
}

void RunsPanel::draw_buttons(const Context& context, const RunRow& row)
{
  const auto button = [&](const char* label, const std::string& place, bool enabled, const char* help) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::SmallButton(label);
    ImGui::EndDisabled();
    places_.note(place);
    ImGui::SetItemTooltip("%s", help);
    return pressed;
  };
  const Comparison& comparison = context.comparing.comparison();
  const bool shown = row.pin == 0 ? !comparison.flip && !comparison.difference : comparison.flip && comparison.pin == row.pin;
  if (shown) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  const bool show = button("Show", fmt::format("show {}", row.pin), row.has_picture,
                           row.has_picture ? "This run's picture in the View; again: back to the run in hand" : "It has no picture");
  if (shown) ImGui::PopStyleColor();
  if (show && row.pin == 0)
    context.push(command::ShowDifference{false, comparison.metric, comparison.scale});
  else if (show)
    context.push(command::CompareWith{row.pin});
  if (show) context.push(command::Flip{row.pin != 0 && !shown});
  ImGui::SameLine();
  if (row.pin == 0) {
    if (button("Pin", "pin", row.has_picture, "Keep its history and its picture, to compare later runs with"))
      context.push(command::PinRun{});
    return;
  }
  if (button("Unpin", fmt::format("unpin {}", row.pin), true, "Forget this run")) context.push(command::Unpin{row.pin});
  if (button("Take preset", fmt::format("take {}", row.pin), row.preset && context.preset(),
             row.preset ? "Its preset in place of the present one, as an edit that can be undone" : "Its preset is not known"))
    context.push(taken(row, *context.preset()));
}

/// The third line of the row, across all columns, from its upper left corner on. Under the mouse: all of it.
void RunsPanel::draw_difference(const Context& context, const RunRow& row, const ImVec2& corner, float width)
{
  const std::string& text = differences_.in_short(row, context);
  const ImVec2 low = corner, high{low.x + width, low.y + ImGui::GetTextLineHeight()};
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 seen_low = ImGui::GetWindowPos(), seen = ImGui::GetWindowSize();
  list->PushClipRect({std::max(low.x, seen_low.x), std::max(low.y, seen_low.y + ImGui::GetFrameHeight())},
                     {std::min(high.x, seen_low.x + seen.x), std::min(high.y, seen_low.y + seen.y)});
  list->AddText(low, colour::quiet_text, text.c_str());
  list->PopClipRect();
  if (const std::string& all = differences_.in_full(row, context);
      !all.empty() && ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high, false))
    ImGui::SetTooltip("%s", all.c_str());
}

} // namespace nephroid::ui
