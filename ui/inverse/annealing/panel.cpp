// SPDX-License-Identifier: Apache-2.0
#include "ui/inverse/annealing/panel.h"

#include "base/error.h"
#include "inverse/report.h"
#include "ui/state/files.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : std::string("-"); }

/// Width and height of a picture with a side of `longest` pixels.
ImVec2 fitted(const glm::dvec2& size, float longest) {
  const double most = std::max(size.x, size.y);
  return {static_cast<float>(longest * size.x / most), static_cast<float>(longest * size.y / most)};
}

void frame(const ImVec2& low, const ImVec2& high) {
  ImGui::GetWindowDrawList()->AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, colour::frame);
}

std::string name_of(const std::string& kind, std::size_t receiver) { return fmt::format("{}_{}", kind, receiver + 1); }

} // namespace

void AnnealingPanel::draw(const Context& context) {
  places_.clear();
  areas_.clear();
  follow(context);
  draw_toolbar(context);
  draw_histories();
  if (snapshot_) draw_figures(*snapshot_);
  if (!why_no_layout_.empty()) draw_wrapped(colour::error, why_no_layout_);
  draw_facets();
  draw_receivers(context);
}

/// Takes over what the preset says and what the run has.
void AnnealingPanel::follow(const Context& context) {
  const preset::Preset& preset = *context.preset();
  const inverse::Settings& settings = inverse::settings(preset);
  if (preset.source != source_ || settings != settings_ || (!layout_ && why_no_layout_.empty())) {
    source_ = preset.source;
    settings_ = settings;
    why_no_layout_.clear();
    layout_.reset();
    try {
      layout_ = inverse::make_layout(preset);
    } catch (const Error& error) {
      why_no_layout_ = error.line();
    }
  }
  snapshot_ = context.run.snapshot();
  pictures_.follow(snapshot_);
  const job::Picture* slopes = pictures_.find("slopes");
  beam_.reset();
  if (facet_ && layout_ && slopes) beam_ = facet_beam(*slopes, *layout_, *facet_);
  auto lines = beam_ ? lines_of(*beam_, *layout_) : std::vector<std::vector<preset::Vec3>>();
  if (lines != context.view_state.lines) context.push(command::ShowLines{std::move(lines)});
}

void AnnealingPanel::draw_toolbar(const Context& context) {
  places_.checkbox("log", &look_.log, "log", "Logarithmic values; else linear ones");
  ImGui::SameLine();
  places_.checkbox(
      "over seconds", &look_.seconds, "over seconds",
      "Over seconds of work; else over what the search counts. A click on a name in the plot hides its line.");
  ImGui::SameLine();
  action_button("Show as glass", context);
  places_.note("show as glass");
}

void AnnealingPanel::draw_histories() {
  histories_.clear();
  if (snapshot_)
    for (const job::Curve& curve : snapshot_->curves)
      if (curve.columns.front() ==
          snapshot_->progress.units.step) // others, as the frames' distances, are not of the search
        histories_.push_back(history_lines(curve, look_));
  for (HistoryLines& lines : histories_) // what the judge says stands after the last step
    if (const double judged = job::scalar(*snapshot_, "judged", lines.name);
        std::isfinite(judged) && !lines.lines.front().x.empty())
      lines.lines.push_back({"judged", {lines.lines.front().x.back()}, {judged}});
  const float height = std::max(8 * em(), 0.19f * ImGui::GetWindowHeight());
  if (histories_.empty()) {
    draw_hint(colour::quiet_text, ImGui::GetCursorScreenPos(), {ImGui::GetContentRegionAvail().x, height},
              "The search has not begun");
    ImGui::Dummy({0, height});
  }
  for (const HistoryLines& lines : histories_) plots_[lines.name].draw(lines, look_.log, height);
}

/// The cost as the search believes it, and of the finished solid.
void AnnealingPanel::draw_figures(const job::Snapshot& snapshot) const {
  if (!ImGui::BeginTable("figures", 5, ImGuiTableFlags_SizingStretchSame)) return;
  const std::array<std::array<const char*, 3>, 4> figures{
      {{"cost", "cost",
        "Root mean square of what is wanted less what is there, both over their largest, where either is above 1 %"},
       {"cost_all", "all cells", "The same over all cells"},
       {"rel_l2", "relative", "The difference's length over that of what is wanted, both of the same energy"},
       {"missed", "missed", "Part of the light that is beside the receivers"}}};
  ImGui::TableNextColumn();
  for (const auto& [name, label, help] : figures) heading_cell(label, help);
  for (const char* group : {"believed", "judged"}) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", group);
    for (const auto& figure : figures) cell(number(job::scalar(snapshot, group, figure[0])));
  }
  ImGui::EndTable();
}

/// A column each: its fields, what is wanted, what is there, the difference, and about the facet's beam.
void AnnealingPanel::draw_receivers(const Context& context) {
  const std::size_t count = settings_.receivers.size();
  const float gap = ImGui::GetStyle().CellPadding.x * 2, free = ImGui::GetContentRegionAvail().x, least = 5 * em();
  const float column = std::max(std::floor(free / static_cast<float>(count)) - gap, least);
  const glm::dvec2 shape = layout_ ? layout_->receiver : glm::dvec2(1);
  const ImVec2 size = fitted(shape, std::min(column, std::max(least, 0.1f * ImGui::GetWindowHeight())));
  const std::array<const char*, 4> kinds{"target", "best", "receiver", "difference"};
  const float line = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().CellPadding.y,
              row = size.y + 2 * ImGui::GetStyle().CellPadding.y;
  const float height =
      2 * line + row * (beam_ ? 5 : 4) + ImGui::GetTextLineHeight() + ImGui::GetStyle().ScrollbarSize + gap;
  if (!ImGui::BeginTable("receivers", static_cast<int>(count),
                         ImGuiTableFlags_ScrollX | ImGuiTableFlags_SizingFixedSame, {0, height}))
    return;
  for (std::size_t j = 0; j < count; ++j)
    ImGui::TableSetupColumn(fmt::format("{}", j).c_str(), ImGuiTableColumnFlags_WidthFixed, column);
  for (const auto field : {&AnnealingPanel::draw_distance, &AnnealingPanel::draw_weight}) {
    ImGui::TableNextRow();
    for (std::size_t j = 0; j < count; ++j) {
      ImGui::TableNextColumn();
      (this->*field)(context, j);
    }
  }
  for (const char* kind : kinds) {
    ImGui::TableNextRow();
    for (std::size_t j = 0; j < count; ++j) {
      ImGui::TableNextColumn();
      draw_receiver_picture(kind, j, size);
    }
  }
  if (beam_) draw_beam_row(size);
  ImGui::EndTable();
}

/// Between its neighbours.
void AnnealingPanel::draw_distance(const Context& context, std::size_t receiver) {
  if (settings_.far) return ImGui::TextUnformatted("far away");
  const auto& receivers = settings_.receivers;
  constexpr double apart = 0.1; // millimetres
  const double low = receiver > 0 ? receivers[receiver - 1].distance_mm + apart : apart,
               now = receivers[receiver].distance_mm;
  const double high = receiver + 1 < receivers.size() ? receivers[receiver + 1].distance_mm - apart : 1e6;
  ImGui::SetNextItemWidth(-1);
  draw_dragged(
      context, gestures_,
      {name_of("distance", receiver), fmt::format("distance of receiver {}", receiver + 1), now, low, high, 0.005 * now,
       "%.4g mm",
       "Distance from the facets: drag it, or type with Ctrl and a click. The search goes on from where it is."},
      [&](preset::Preset& p, double value) { inverse::settings(p).receivers.at(receiver).distance_mm = value; });
}

void AnnealingPanel::draw_weight(const Context& context, std::size_t receiver) {
  if (settings_.far) return;
  const double now = settings_.receivers[receiver].weight;
  ImGui::SetNextItemWidth(-1);
  draw_dragged(context, gestures_,
               {name_of("weight", receiver), fmt::format("weight of receiver {}", receiver + 1), now, 0.01, 100,
                0.005 * now, "weight %.3g",
                "How much this picture counts beside the others: drag it, or type with Ctrl and a click."},
               [&](preset::Preset& p, double value) { inverse::settings(p).receivers.at(receiver).weight = value; });
}

void AnnealingPanel::draw_receiver_picture(const std::string& kind, std::size_t receiver, const ImVec2& size) {
  const std::string name = name_of(kind, receiver);
  const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + size.x, low.y + size.y};
  ImGui::Dummy(size);
  ImGui::GetWindowDrawList()->AddRectFilled(low, high, colour::surround);
  pictures_.draw(name, low, high);
  if (beam_) draw_beam_frame(beam_->prints.at(receiver), layout_->cells, low, high);
  frame(low, high);
  areas_[name] = {low.x, low.y, size.x, size.y};
  if (!snapshot_) return;
  const bool judged = std::isfinite(job::scalar(*snapshot_, "judged", "cost"));
  const auto figure = [&](const std::string& what) {
    return number(job::scalar(*snapshot_, inverse::receiver_group(receiver), (judged ? "" : "believed_") + what));
  };
  if (kind == "target")
    ImGui::SetItemTooltip("What receiver %zu shall show", receiver + 1);
  else if (kind == "best")
    ImGui::SetItemTooltip("The closest that facets of this size could cast on receiver %zu, were it the only one",
                          receiver + 1);
  else if (kind == "receiver")
    tooltip(fmt::format("What receiver {} shows, {}\ncost {}, relative {}", receiver + 1,
                        judged ? "judged" : "believed", figure("cost"), figure("rel_l2")));
  else
    tooltip("Red: too much light; blue: too little");
}

void AnnealingPanel::draw_beam_row(const ImVec2& size) {
  ImGui::TableNextRow();
  for (std::size_t j = 0; j < beam_->prints.size(); ++j) {
    ImGui::TableNextColumn();
    const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + size.x, low.y + size.y};
    ImGui::Dummy(size);
    if (const job::Picture* picture = pictures_.find(name_of("receiver", j)))
      draw_beam_cells(beam_->prints[j], *picture, low, high);
    frame(low, high);
    tooltip(fmt::format("The facet's beam on receiver {}: {:.3g} % of it, in {} x {} cells", j + 1,
                        100 * part_on(beam_->prints[j]), beam_->prints[j].columns, beam_->prints[j].rows));
  }
}

/// The facets as the light sees them; a click chooses one.
void AnnealingPanel::draw_facets() {
  const job::Picture* slopes = pictures_.find("slopes");
  if (!slopes || !layout_) return;
  const float longest =
      std::min(ImGui::GetContentRegionAvail().x / 3, std::max(8 * em(), 0.16f * ImGui::GetWindowHeight()));
  const ImVec2 size = fitted(layout_->size, longest);
  draw_facet_map("slopes", size);
  tooltip(
      "Facets: red is how far light goes to the right, green how far up. A click shows where a facet's light goes.");
  if (pictures_.find("conflict")) {
    ImGui::SameLine();
    draw_facet_map("conflict", size);
    tooltip("Conflict: where facets find no slope that serves all pictures");
  }
  ImGui::SameLine();
  ImGui::BeginGroup();
  draw_facet_text();
  ImGui::EndGroup();
}

void AnnealingPanel::draw_facet_map(const std::string& picture, const ImVec2& size) {
  const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + size.x, low.y + size.y};
  ImGui::InvisibleButton(picture.c_str(), size);
  const glm::dvec2 cell{size.x / layout_->facets.x, size.y / layout_->facets.y};
  if (ImGui::IsItemActive()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::ivec2 at{static_cast<int>(std::floor((mouse.x - low.x) / cell.x)),
                        static_cast<int>(std::floor((mouse.y - low.y) / cell.y))};
    facet_ = glm::clamp(at, glm::ivec2(0), layout_->facets - 1);
  }
  pictures_.draw(picture, low, high, picture == "slopes");
  frame(low, high);
  areas_[picture] = {low.x, low.y, size.x, size.y};
  if (!facet_) return;
  const float x = low.x + static_cast<float>((facet_->x + 0.5) * cell.x),
              y = low.y + static_cast<float>((facet_->y + 0.5) * cell.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddCircle({x, y}, 6 * scale(), colour::outline, 0, 4 * scale());
  list.AddCircle({x, y}, 6 * scale(), IM_COL32_WHITE, 0, 1.5f * scale());
}

void AnnealingPanel::draw_facet_text() const {
  if (!beam_) {
    draw_wrapped(colour::quiet_text, "Click on a facet to see its beam on every receiver");
    return;
  }
  std::string text = fmt::format(
      "Facet {}, {}\nslope {:.3f} to the right, {:.3f} up\nheight {:.3g} mm\nlight {:.3g} of a flat facet's",
      beam_->facet.x + 1, beam_->facet.y + 1, beam_->slope.x, beam_->slope.y, beam_->height, beam_->power);
  for (std::size_t j = 0; j < beam_->prints.size(); ++j)
    if (!box_of(beam_->prints[j])) text += fmt::format("\nmisses receiver {}", j + 1);
  draw_wrapped(colour::quiet_text, text);
}

std::array<double, 4> AnnealingPanel::area_of(const std::string& picture) const {
  const auto found = areas_.find(picture);
  return found == areas_.end() ? std::array<double, 4>{} : found->second;
}

std::vector<PanelEntry> inverse_panels() {
  return {{.name = "annealing",
           .title = AnnealingPanel::title,
           .engine = "inverse",
           .make = make_panel<AnnealingPanel>,
           .front_for = "inverse"}};
}

} // namespace nephroid::ui
