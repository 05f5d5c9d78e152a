// SPDX-License-Identifier: Apache-2.0
#include "ui/meters/panel.h"

#include "meters/intervals.h"
#include "preset/choices.h"
#include "preset/meters.h"
#include "ui/widgets/colour_scale.h"
#include "ui/widgets/plots.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using meters::Interval;
using meters::LayerReading;

/// The units that a meter's numbers can be in.
std::vector<preset::Meter::Unit> units_of(const scene::MeterSurface& surface) {
  std::vector<preset::Meter::Unit> units;
  for (const auto& choice : preset::choices<preset::Meter::Unit>)
    if (preset::is_intensity(choice.value) == surface.is_goniometer()) units.push_back(choice.value);
  return units;
}

void number_row(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  cell(name);
  cell(value);
}

std::string percent_of(const Interval& share) {
  return fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100 * share.value, 100 * share.low, 100 * share.high);
}

/// A line within a band.
void plot_interval(const char* name, ImU32 colour, const std::vector<double>& seconds,
                   const std::vector<Interval>& intervals, double unit) {
  std::vector<double> value, low, high;
  for (const Interval& interval : intervals) {
    value.push_back(interval.value / unit);
    low.push_back(interval.low / unit);
    high.push_back(interval.high / unit);
  }
  const int count = static_cast<int>(seconds.size());
  ImPlotSpec band = line_spec(colour, 1);
  band.FillColor = ImGui::ColorConvertU32ToFloat4(colour);
  band.FillAlpha = 0.25f;
  ImPlot::PlotShaded(name, seconds.data(), low.data(), high.data(), count, band);
  ImPlotSpec line = line_spec(colour, 1.5f);
  line.Marker = ImPlotMarker_Circle;
  line.MarkerSize = 2 * scale();
  ImPlot::PlotLine(name, seconds.data(), value.data(), count, line);
}

} // namespace

void MetersPanel::draw(const Context& context) {
  places_.clear();
  shown_.reset();
  preset_unit_ = preset::word(context.preset()->unit);
  const auto& snapshot = context.run.snapshot();
  const meters::Readings* readings = snapshot && context.run.snapshot_is_current() ? snapshot->meters.get() : nullptr;
  draw_choices(context);
  if (readings)
    for (const meters::Shown& meter : readings->meters)
      if (meter.meter.name == name_ && meter.reading) shown_ = meter;
  if (!shown_) {
    ImGui::TextDisabled("%s", readings ? "Its first reading is on its way." : "Meters begin after the first pass.");
    return;
  }
  const auto units = units_of(*shown_->surface);
  unit_now_ = unit_ && std::ranges::count(units, *unit_) > 0 ? *unit_ : preset::unit_of(shown_->meter);
  draw_numbers();
  draw_map(context);
  draw_history();
  for (const std::string& note : readings->notes) draw_wrapped(colour::quiet_text, note);
}

void MetersPanel::draw_choices(const Context& context) {
  const std::vector<preset::Meter>& meters = context.preset()->scene.meters;
  const auto in_hand = std::ranges::find(meters, name_, &preset::Meter::name);
  if (in_hand == meters.end()) name_ = meters.front().name;
  ViewSettings view = context.view_settings();
  ImGui::SetNextItemWidth(12 * em());
  {
    Combo names("##meter", name_, &places_, "meter");
    for (const preset::Meter& meter : meters)
      if (names.entry(meter.name, meter.name == name_)) {
        name_ = meter.name;
        cell_.reset();
        if (!view.meter.empty()) {
          view.meter = name_;
          context.push(command::SetViewSettings{view});
        }
      }
  }
  bool on = view.meter == name_;
  ImGui::SameLine();
  if (places_.checkbox("On the picture", &on, "on the picture",
                       "Shows the map where the View's picture has its cells")) {
    view.meter = on ? name_ : std::string();
    context.push(command::SetViewSettings{view});
  }
  const auto& snapshot = context.run.snapshot();
  const meters::Shown* meter = nullptr;
  if (snapshot && snapshot->meters)
    for (const meters::Shown& m : snapshot->meters->meters)
      if (m.meter.name == name_ && m.reading) meter = &m;
  if (meter) {
    ImGui::SetNextItemWidth(7 * em());
    {
      Combo units("##unit", std::string(preset::word(unit_now_)), &places_, "unit");
      for (const preset::Meter::Unit unit : units_of(*meter->surface))
        if (units.entry(std::string(preset::word(unit)), unit == unit_now_)) unit_ = unit;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(8 * em());
    Combo layers("##layer", layer_, &places_, "layer");
    for (const LayerReading& layer : meter->reading->layers)
      if (layers.entry(layer.name, layer.name == layer_)) layer_ = layer.name;
  }
}

const LayerReading& MetersPanel::layer() const {
  const auto& layers = shown_->reading->layers;
  const auto found = std::ranges::find(layers, layer_, &LayerReading::name);
  return found == layers.end() ? layers.front() : *found;
}

void MetersPanel::draw_numbers() {
  const double unit = preset::size_of(unit_now_);
  const std::string word(preset::word(unit_now_));
  const meters::Numbers& numbers = layer().numbers(meters::quantity_of(unit_now_));
  const bool has_cells = shown_->surface->count() > 1;
  if (!ImGui::BeginTable("numbers", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
  number_row(("mean, " + word).c_str(), text_of(numbers.mean, unit));
  if (has_cells) {
    number_row(("peak, " + word).c_str(), text_of(numbers.peak, unit));
    number_row(("least, " + word).c_str(), text_of(numbers.least, unit));
    number_row("uniformity (least / mean)", text_of(numbers.uniformity));
  }
  number_row(preset::is_luminous(unit_now_) ? "total, lm" : "total, W", text_of(numbers.total));
  if (shown_->reading->share_above && layer().name == "all")
    number_row(("above " + *shown_->meter.threshold).c_str(), percent_of(*shown_->reading->share_above));
  ImGui::EndTable();
  ImGui::TextDisabled("%s", fmt::format("{} cells, {:.3g} million photons, {:.1f} s of work; 95 % intervals",
                                        shown_->surface->count(), 1e-6 * static_cast<double>(shown_->photons),
                                        shown_->seconds)
                                .c_str());
  if (shown_->refused > 0)
    draw_wrapped(
        colour::error,
        fmt::format("{} contributions were too bright for the film and are not in these numbers", shown_->refused));
  if (shown_->lost_share > 1e-4)
    draw_wrapped(colour::note, fmt::format("{:.2g} % of the photons' power met too many surfaces and is not in these "
                                           "numbers",
                                           100 * shown_->lost_share));
}

std::string MetersPanel::cell_text(std::size_t cell) const {
  const scene::MeterSurface& surface = *shown_->surface;
  const double unit = preset::size_of(unit_now_);
  std::string text;
  if (surface.is_goniometer()) {
    const scene::GammaC way = scene::direction_of(surface, cell);
    text = fmt::format("gamma {:.1f}, C {:.1f} degrees", way.gamma_deg, way.c_deg);
  } else {
    const glm::dvec3 p = surface.centres[cell] + shown_->origin;
    text = fmt::format("({:.4g}, {:.4g}, {:.4g}) {}", p.x, p.y, p.z, preset_unit_);
  }
  for (const LayerReading& layer : shown_->reading->layers)
    text += fmt::format("\n{} {} {}", layer.name,
                        text_of(layer.cells[static_cast<std::size_t>(meters::quantity_of(unit_now_))][cell], unit),
                        preset::word(unit_now_));
  return text;
}

void MetersPanel::draw_map(const Context&) {
  if (shown_->surface->count() < 2) return;
  const Colours now{shown_->reading, layer().name, unit_now_};
  if (now != coloured_) {
    std::vector<float> values;
    for (const Interval& cell : layer().cells[static_cast<std::size_t>(meters::quantity_of(unit_now_))])
      values.push_back(static_cast<float>(cell.value / preset::size_of(unit_now_)));
    map_ = meters::map_of(*shown_->surface);
    const auto threshold = preset::threshold_in(shown_->meter, unit_now_);
    high_ = meters::map_scale(values, threshold);
    const meters::ColouredMap picture = meters::coloured(*shown_->surface, values, high_, threshold, 640);
    zoom_ = picture.zoom;
    std::ranges::copy(picture.bitmap.rgba, texture_.edit(picture.bitmap.width, picture.bitmap.height).begin());
    coloured_ = now;
  }
  const auto width = static_cast<float>(map_.width * zoom_), height = static_cast<float>(map_.height * zoom_);
  const float scaled = std::min(ImGui::GetContentRegionAvail().x / width, 24 * em() / height);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size(width * scaled, height * scaled);
  ImGui::InvisibleButton("map", size);
  places_.note("map");
  texture_.draw(corner, corner + size, scaled * static_cast<float>(zoom_) >= 3);
  draw_linear_scale(corner, {ImGui::GetContentRegionAvail().x, size.y}, std::string(preset::word(unit_now_)), high_);
  if (ImGui::IsItemHovered()) {
    const ImVec2 at = (ImGui::GetIO().MousePos - corner) / scaled;
    const int column = std::clamp(static_cast<int>(at.x) / zoom_, 0, map_.width - 1),
              row = std::clamp(static_cast<int>(at.y) / zoom_, 0, map_.height - 1);
    if (const int cell = map_.cells[map_.place(row, column)]; cell >= 0) {
      ImGui::SetTooltip("%s", cell_text(static_cast<std::size_t>(cell)).c_str());
      if (ImGui::IsItemClicked()) cell_ = static_cast<std::size_t>(cell);
    }
  }
  if (cell_ && *cell_ < shown_->surface->count()) draw_cell(*cell_);
}

/// Marks the chosen cell and says what it has.
void MetersPanel::draw_cell(std::size_t cell) {
  const auto place = static_cast<int>(std::ranges::find(map_.cells, static_cast<int>(cell)) - map_.cells.begin());
  const int rows_above = place / map_.width;
  const auto column = static_cast<float>(place % map_.width), row = static_cast<float>(rows_above);
  const ImVec2 low = ImGui::GetItemRectMin(),
               step((ImGui::GetItemRectMax().x - low.x) / static_cast<float>(map_.width),
                    (ImGui::GetItemRectMax().y - low.y) / static_cast<float>(map_.height));
  const ImVec2 from(low.x + column * step.x - 1, low.y + row * step.y - 1), to = from + step + ImVec2(2, 2);
  ImGui::GetWindowDrawList()->AddRect(from - ImVec2(1, 1), to + ImVec2(1, 1), colour::outline);
  ImGui::GetWindowDrawList()->AddRect(from, to, colour::on_dark);
  ImGui::TextUnformatted(cell_text(cell).c_str());
}

/// Mean and peak of all light, and how their intervals close.
void MetersPanel::draw_history() {
  if (!begin_plot("##history of a meter", 12 * em())) return;
  std::vector<double> seconds;
  std::vector<Interval> means, peaks;
  for (const meters::HistoryRow& row : shown_->history) {
    seconds.push_back(row.seconds);
    means.push_back(row.mean);
    peaks.push_back(row.peak);
  }
  const preset::Meter::Unit unit = preset::unit_of(shown_->meter);
  double most = 0;
  for (const std::vector<Interval>& intervals : {means, peaks})
    for (const Interval& interval : intervals) most = std::max(most, interval.high / preset::size_of(unit));
  const std::string label = fmt::format("{}, all light", preset::word(unit));
  set_up_fixed_axis(ImAxis_X1, "seconds of the meter's work", 0, std::max(1.05 * seconds.back(), 1e-3),
                    ImPlotAxisFlags_None);
  set_up_fixed_axis(ImAxis_Y1, label.c_str(), 0, most > 0 ? 1.1 * most : 1, ImPlotAxisFlags_None);
  ImPlot::SetupLegend(ImPlotLocation_NorthEast);
  plot_interval("mean", colour::accent, seconds, means, preset::size_of(unit));
  if (shown_->surface->count() > 1) plot_interval("peak", colour::note_on_dark, seconds, peaks, preset::size_of(unit));
  ImPlot::EndPlot();
}

} // namespace nephroid::ui
