// SPDX-License-Identifier: Apache-2.0
#include "ui/plan/panel.h"

#include "preset/read.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// "a.b.c" of "/a/b/c", as --set takes it. Names of fields hold no '/', '~' or '.'.
std::string path_of(const std::string& pointer) {
  std::string path = pointer.substr(std::min<std::size_t>(1, pointer.size()));
  std::replace(path.begin(), path.end(), '/', '.');
  return path;
}

std::optional<double> seconds_of(const job::Snapshot* snapshot, const std::string& decision) {
  if (!snapshot) return std::nullopt;
  for (const auto& [phase, seconds] : snapshot->phases)
    if (phase == decision) return seconds;
  return std::nullopt;
}

void heading(const char* text) {
  ImGui::Spacing();
  ImGui::SeparatorText(text);
}

void seconds_cell(std::optional<double> seconds) {
  ImGui::TableNextColumn();
  if (seconds) ImGui::Text("%.3g s", *seconds);
}

/// Seconds that are none of the plan's decisions: other phases, and measuring, which is not in the work's time.
void draw_other_seconds(const Context& context, const plan::Plan& plan) {
  const auto row = [](const std::string& name, double seconds, const char* why) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(1);
    ImGui::TextUnformatted(name.c_str());
    seconds_cell(seconds);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", why);
  };
  if (!context.run.snapshot()) return;
  for (const auto& [phase, seconds] : context.run.snapshot()->phases)
    if (std::none_of(plan.decisions.begin(), plan.decisions.end(),
                     [&, name = phase](const plan::Decision& decision) { return decision.name == name; }))
      row(phase, seconds, "");
  if (const auto history = context.run.error_history())
    row("measuring", history->measuring_seconds, "not counted as work");
}

void draw_buffers(const plan::Plan& plan) {
  std::uint64_t total = 0;
  for (const plan::PlannedBuffer& buffer : plan.buffers) total += buffer.bytes;
  heading(fmt::format("Memory: {}###memory", plan::readable_bytes(total)).c_str());
  if (!ImGui::BeginTable("buffers", 2, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("buffer", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("bytes", ImGuiTableColumnFlags_WidthFixed);
  for (const plan::PlannedBuffer& buffer : plan.buffers) {
    ImGui::TableNextRow();
    cell(buffer.name);
    cell(plan::readable_bytes(buffer.bytes));
    tooltip(fmt::format("{} bytes", buffer.bytes));
  }
  ImGui::EndTable();
}

} // namespace

preset::Preset with_field(const preset::Preset& preset, const std::string& pointer, bool value) {
  preset::Preset edited = preset::with_overrides(preset, {path_of(pointer) + (value ? "=true" : "=false")});
  edited.source = preset.source;
  return edited;
}

void PlanPanel::draw(const Context& context) {
  const plan::Plan* plan = context.run.plan().get();
  if (!plan) {
    draw_hint(colour::quiet_text, ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail(),
              "The plan is being made");
    return;
  }
  read_fields(context);
  places_.clear();
  ImGui::AlignTextToFramePadding();
  const auto left_out = std::count_if(plan->decisions.begin(), plan->decisions.end(),
                                      [](const plan::Decision& decision) { return !decision.runs; });
  ImGui::TextUnformatted(
      fmt::format("Engine {}: {} left out of {}", plan->engine, left_out, plan->decisions.size()).c_str());
  ImGui::SameLine(std::max(ImGui::GetContentRegionAvail().x - 8 * em(), 14 * em()));
  action_button("Copy plan as JSON", context);
  if (ImGui::BeginChild("plan")) {
    draw_decisions(context);
    draw_buffers(*plan);
    if (!plan->defines.empty()) heading("Kernels are built with");
    for (const auto& [name, value] : plan->defines)
      draw_wrapped(colour::quiet_text, fmt::format("-D {}{}{}", name, value.empty() ? "" : "=", value));
    if (!plan->notes.empty()) heading("Notes");
    for (const std::string& note : plan->notes) draw_wrapped(colour::note, note);
    if (!plan->not_imported.empty()) heading("Not imported");
    for (const std::string& line : plan->not_imported) draw_wrapped(colour::note, line);
  }
  ImGui::EndChild();
}

/// What the fields say now: from the preset's JSON, in which the plan's pointers point. Only where plan or preset
/// changed.
void PlanPanel::read_fields(const Context& context) {
  if (plan_ == context.run.plan() && preset_ == *context.preset()) return;
  plan_ = context.run.plan();
  preset_ = *context.preset();
  computed_.clear();
  const nlohmann::json fields = preset::as_json(preset_);
  for (const plan::Decision& decision : plan_->decisions) {
    std::optional<bool>& computed = computed_.emplace_back();
    const nlohmann::json::json_pointer pointer(decision.field);
    if (decision.field.empty() || !fields.contains(pointer)) continue;
    if (fields[pointer].is_boolean()) computed = fields[pointer] == decision.run_value;
    if (fields[pointer].is_null()) computed = decision.runs; // the scene decides
  }
}

void PlanPanel::draw_decisions(const Context& context) {
  if (!ImGui::BeginTable("decisions", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX)) return;
  for (const char* column : {"Always", "Decision", "Time"})
    ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableSetupColumn("Why", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < plan_->decisions.size(); ++i) {
    const plan::Decision& decision = plan_->decisions[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(i));
    if (computed_[i]) draw_box(context, decision, *computed_[i]);
    ImGui::PopID();
    ImGui::TableNextColumn();
    draw_text(decision.runs ? colour::text : colour::quiet_text, decision.name);
    seconds_cell(seconds_of(context.run.snapshot().get(), decision.name));
    ImGui::TableNextColumn();
    draw_wrapped(colour::quiet_text, (decision.runs ? "runs: " : "left out: ") + decision.reason);
  }
  draw_other_seconds(context, *plan_);
  ImGui::EndTable();
}

void PlanPanel::draw_box(const Context& context, const plan::Decision& decision, bool computed) {
  if (ImGui::Checkbox("##computed", &computed)) {
    const std::string label = (computed ? "compute " : "leave out ") + decision.name;
    context.push(command::Edit{
        .label = label,
        .preset = with_field(*context.preset(), decision.field, computed ? decision.run_value : !decision.run_value),
        .was_read = true});
  }
  places_.note(decision.name,
               fmt::format("Computed whatever the scene needs: {} = {}. Without the check the scene decides.",
                           path_of(decision.field), decision.run_value));
}

} // namespace nephroid::ui
