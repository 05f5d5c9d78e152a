// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/row_handles.h"

#include "ui/widgets/theme.h"

#include <imgui.h>
#include <implot.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

constexpr float point_radius = 5, grab_radius = 9; ///< pixels at scale 1: what can be grabbed is wider than what is seen
constexpr std::ptrdiff_t most_in_sight = 400;      ///< more would lie on each other

void draw_point(const Row& at, float radius, std::uint32_t colour)
{
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  const ImVec2 middle = ImPlot::PlotToPixels(at[0], at[1]);
  ImPlot::PushPlotClipRect();
  list.AddCircleFilled(middle, radius + 2 * scale(), colour::outline);
  list.AddCircleFilled(middle, radius, colour);
  ImPlot::PopPlotClipRect();
}

bool mouse_moves()
{
  const ImVec2 step = ImGui::GetIO().MouseDelta;
  return step.x != 0 || step.y != 0;
}

} // namespace

RowGesture RowHandles::draw(const std::vector<Row>& rows, const std::optional<std::size_t>& marked, const RowLook& look)
{
  using Kind = RowGesture::Kind;
  RowGesture gesture;
  const ImPlotPoint mouse = ImPlot::GetPlotMousePos();
  const Row under_mouse{mouse.x, mouse.y * look.unit};
  const ImPlotRange nm = ImPlot::GetPlotLimits().X;
  const bool few = std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return nm.Contains(row[0]); }) <= most_in_sight;
  waits_ = waits_ && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (held_ && rows.size() != rows_at_take_) { // removed, or its addition undone: the row of that index is another one now
    gesture = {Kind::let_go, *held_, {}};
    held_.reset();
    waits_ = true;
  }
  over_row_ = false;
  for (std::size_t i = 0; i < rows.size() && few; ++i) {
    if (held_ != i && !nm.Contains(rows[i][0])) continue;
    double x = rows[i][0], y = rows[i][1] / look.unit;
    bool hovered = false, held = false;
    const bool moved = ImPlot::DragPoint(static_cast<int>(i), &x, &y, {0, 0, 0, 0}, grab_radius * scale(),
                                         ImPlotDragToolFlags_NoFit | ImPlotDragToolFlags_Delayed, nullptr, &hovered, &held);
    draw_point({rows[i][0], rows[i][1] / look.unit}, point_radius * (hovered || held ? 1.3f : 1) * scale(),
               marked == i ? look.marked : look.colour);
    over_row_ |= hovered || held;
    if (held && !held_ && !waits_) {
      held_ = i;
      rows_at_take_ = rows.size();
      gesture = {Kind::take, i, {}};
    } else if (held && held_ == i && moved && mouse_moves()) // where the mouse rests, what was undone meanwhile stays undone
      gesture = {Kind::move, i, under_mouse};
    if (hovered && !held_ && !waits_ && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) gesture = {Kind::remove, i, {}};
    if (hovered || held) ImGui::SetTooltip("%s", look.text(rows[i]).c_str());
  }
  if (held_ && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    gesture = {Kind::let_go, *held_, {}};
    held_.reset();
  } else if (!held_ && !waits_ && !over_row_ && ImPlot::IsPlotHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    gesture = {Kind::add, 0, under_mouse};
  return gesture;
}

RowGesture draw_row_buttons(const Row& added, const std::optional<std::size_t>& marked, WidgetPlaces& places)
{
  RowGesture gesture;
  if (ImGui::Button("Add")) gesture = {RowGesture::Kind::add, 0, added};
  places.note("add");
  ImGui::SetItemTooltip("One more in the widest gap; a double click on the plot adds one at the mouse");
  ImGui::SameLine();
  ImGui::BeginDisabled(!marked);
  if (ImGui::Button("Remove") || (marked && delete_pressed())) gesture = {RowGesture::Kind::remove, *marked, {}};
  places.note("remove");
  ImGui::EndDisabled();
  ImGui::SetItemTooltip("The point that was clicked last; Delete, or a right click on a point, does the same");
  return gesture;
}

} // namespace nephroid::ui
