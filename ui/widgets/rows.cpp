// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/rows.h"

#include "optics/wavelength.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

bool is_finite(const Row& row) { return std::isfinite(row[0]) && std::isfinite(row[1]); }

/// Rounds a sum or difference to what a person would write: 500.3 + 0.1 is 500.40000000000003, and 500.4 - 500.3 is
/// less than 0.1.
double readable_nm(double nm) { return std::round(1e6 * nm) / 1e6; }

bool before(const Row& a, const Row& b) { return a[0] < b[0]; }

/// Why add_row refuses the row.
std::string refusal(const std::vector<Row>& rows, const Row& row, const RowRules& rules) {
  if (rows.size() >= preset::max_rows) return fmt::format("a preset has at most {} rows", preset::max_rows);
  if (!is_finite(row)) return "its place is not finite";
  const double nm = std::clamp(row[0], preset::wavelength_bounds.low, preset::wavelength_bounds.high);
  return fmt::format("another is less than {} nm from {:.6g} nm", rules.least_gap_nm, nm);
}

constexpr float point_radius = 5, grab_radius = 9; ///< pixels at scale 1
constexpr std::ptrdiff_t most_in_sight = 400;      ///< more points would lie on each other

void draw_point(const Row& at, float radius, std::uint32_t colour) {
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  const ImVec2 middle = ImPlot::PlotToPixels(at[0], at[1]);
  ImPlot::PushPlotClipRect();
  list.AddCircleFilled(middle, radius + 2 * scale(), colour::outline);
  list.AddCircleFilled(middle, radius, colour);
  ImPlot::PopPlotClipRect();
}

} // namespace

std::vector<Row> sorted_rows(std::vector<Row> rows) {
  std::stable_sort(rows.begin(), rows.end(), before);
  return rows;
}

void move_row(std::vector<Row>& rows, std::size_t index, const Row& to, const RowRules& rules) {
  if (index >= rows.size() || !is_finite(to)) return;
  rows[index][1] = std::clamp(to[1], rules.value.low, rules.value.high);
  const double low = index > 0 ? readable_nm(rows[index - 1][0] + rules.least_gap_nm) : preset::wavelength_bounds.low;
  const double high =
      index + 1 < rows.size() ? readable_nm(rows[index + 1][0] - rules.least_gap_nm) : preset::wavelength_bounds.high;
  if (low <= high) rows[index][0] = std::clamp(to[0], low, high); // neighbours in a file may be nearer
}

std::optional<std::size_t> add_row(std::vector<Row>& rows, Row row, const RowRules& rules) {
  if (!is_finite(row) || rows.size() >= preset::max_rows) return std::nullopt;
  row = {std::clamp(row[0], preset::wavelength_bounds.low, preset::wavelength_bounds.high),
         std::clamp(row[1], rules.value.low, rules.value.high)};
  const auto right = std::upper_bound(rows.begin(), rows.end(), row, before);
  const auto too_near = [&](const Row& a, const Row& b) { return readable_nm(b[0] - a[0]) < rules.least_gap_nm; };
  if (right != rows.begin() && too_near(*std::prev(right), row)) return std::nullopt;
  if (right != rows.end() && too_near(row, *right)) return std::nullopt;
  const auto added = rows.insert(right, row); // before begin(), which it may move
  return static_cast<std::size_t>(added - rows.begin());
}

bool remove_row(std::vector<Row>& rows, std::size_t index, const RowRules& rules) {
  if (rows.size() <= rules.fewest || index >= rows.size()) return false;
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(index));
  return true;
}

double middle_of_widest_gap(const std::vector<Row>& rows) {
  double from = optics::first_nm, widest = 0, middle = from;
  const auto look = [&](double to) {
    if (to - from > widest) {
      widest = to - from;
      middle = (from + to) / 2;
    }
    from = to;
  };
  for (const Row& row : rows)
    if (row[0] > optics::first_nm && row[0] < optics::last_nm) look(row[0]);
  look(optics::last_nm);
  return middle;
}

void RowEditor::keep(std::size_t rows) {
  removed_ = false;
  if (marked_ && *marked_ >= rows) marked_.reset();
}

std::optional<RowsEdit> RowEditor::follow(const RowGesture& gesture, std::vector<Row> rows, const RowRules& rules,
                                          Commands& commands) {
  using Kind = RowGesture::Kind;
  const Row to = rules.readable ? rules.readable(gesture.to) : gesture.to;
  const auto refuse = [&](const char* what, const std::string& why) {
    commands.push_back(command::Report{fmt::format("no {} was {}: {}", rules.noun, what, why), false});
  };
  switch (gesture.kind) {
  case Kind::none: break;
  case Kind::take:
    marked_ = gesture.row;
    gestures_.begin();
    break;
  case Kind::move: {
    if (removed_) break; // else the removed row would come back
    const std::vector<Row> before = rows;
    move_row(rows, gesture.row, to, rules);
    if (rows != before)
      return RowsEdit{fmt::format("move a {}", rules.noun), std::move(rows), gestures_.number(), true};
    break;
  }
  case Kind::let_go: commands.push_back(command::EndGesture{}); break;
  case Kind::add:
    if (const auto added = add_row(rows, to, rules)) {
      marked_ = added;
      return RowsEdit{fmt::format("add a {}", rules.noun), std::move(rows)};
    }
    refuse("added", refusal(rows, to, rules));
    break;
  case Kind::remove:
    if (remove_row(rows, gesture.row, rules)) {
      marked_.reset();
      removed_ = true;
      return RowsEdit{fmt::format("remove a {}", rules.noun), std::move(rows)};
    }
    refuse("removed", fmt::format("at least {} must stay", rules.fewest));
    break;
  }
  return std::nullopt;
}

RowGesture RowHandles::draw(const std::vector<Row>& rows, const std::optional<std::size_t>& marked,
                            const RowStyle& look) {
  using Kind = RowGesture::Kind;
  RowGesture gesture;
  const ImPlotPoint mouse = ImPlot::GetPlotMousePos();
  const Row under_mouse{mouse.x, mouse.y * look.unit};
  const ImPlotRange nm = ImPlot::GetPlotLimits().X;
  const bool few =
      std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return nm.Contains(row[0]); }) <= most_in_sight;
  const ImVec2 step = ImGui::GetIO().MouseDelta;
  waits_ = waits_ && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (held_ && rows.size() != rows_at_take_) { // removed, or its addition undone: the index now means another row
    gesture = {Kind::let_go, *held_, {}};
    held_.reset();
    waits_ = true;
  }
  over_row_ = false;
  for (std::size_t i = 0; i < rows.size() && few; ++i) {
    if (held_ != i && !nm.Contains(rows[i][0])) continue;
    double x = rows[i][0], y = rows[i][1] / look.unit;
    bool hovered = false, held = false;
    const bool moved =
        ImPlot::DragPoint(static_cast<int>(i), &x, &y, {0, 0, 0, 0}, grab_radius * scale(),
                          ImPlotDragToolFlags_NoFit | ImPlotDragToolFlags_Delayed, nullptr, &hovered, &held);
    draw_point({rows[i][0], rows[i][1] / look.unit}, point_radius * (hovered || held ? 1.3f : 1) * scale(),
               marked == i ? look.marked : look.colour);
    over_row_ |= hovered || held;
    if (held && !held_ && !waits_) {
      held_ = i;
      rows_at_take_ = rows.size();
      gesture = {Kind::take, i, {}};
    } else if (held && held_ == i && moved &&
               (step.x != 0 || step.y != 0)) // while the mouse rests, an undo in the meantime stays
      gesture = {Kind::move, i, under_mouse};
    if (hovered && !held_ && !waits_ && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) gesture = {Kind::remove, i, {}};
    if (hovered || held) ImGui::SetTooltip("%s", look.text(rows[i]).c_str());
  }
  if (held_ && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    gesture = {Kind::let_go, *held_, {}};
    held_.reset();
  } else if (!held_ && !waits_ && !over_row_ && ImPlot::IsPlotHovered() &&
             ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    gesture = {Kind::add, 0, under_mouse};
  return gesture;
}

namespace {
/// Of one window: there is no other.
int delete_taken_at = -2; ///< the newest frame in which a marked row of a focused plot had the key
} // namespace

bool row_takes_delete() { return std::abs(ImGui::GetFrameCount() - delete_taken_at) <= 1; }

RowGesture draw_row_buttons(const Row& added, const std::optional<std::size_t>& marked, WidgetPlaces& places) {
  RowGesture gesture;
  if (places.button("Add", "add", "One more in the widest gap; a double click on the plot adds one at the mouse"))
    gesture = {RowGesture::Kind::add, 0, added};
  ImGui::SameLine();
  ImGui::BeginDisabled(!marked);
  const bool has_key = marked && ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
  if (has_key) delete_taken_at = ImGui::GetFrameCount();
  const bool delete_pressed = has_key && !ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(ImGuiKey_Delete, false);
  if (places.button("Remove", "remove",
                    "The point that was clicked last; Delete, or a right click on a point, does the same") ||
      delete_pressed)
    gesture = {RowGesture::Kind::remove, *marked, {}};
  ImGui::EndDisabled();
  return gesture;
}

} // namespace nephroid::ui
