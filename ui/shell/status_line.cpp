// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/status_line.h"

#include "base/counted.h"
#include "job/pace.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

namespace nephroid::ui {
namespace {

/// How many there are; the lines themselves in a tooltip.
void draw_notes(const std::vector<std::string>& notes)
{
  if (notes.empty()) return;
  ImGui::SameLine(0, ImGui::GetFontSize());
  ImGui::PushStyleColor(ImGuiCol_Text, colour::note);
  ImGui::TextUnformatted(counted(notes.size(), "note").c_str());
  ImGui::PopStyleColor();
  if (!ImGui::BeginItemTooltip()) return;
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 40);
  for (const std::string& note : notes) ImGui::TextUnformatted(note.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

} // namespace

const char* name_of(job::State state)
{
  constexpr const char* names[] = {"no run", "preparing", "running", "paused", "finished", "cancelled", "failed"}; // in the order of State
  return names[static_cast<std::size_t>(state)];
}

const char* state_word(const RunInHand& run) { return run.compiling() ? "compiling" : name_of(run.status().state); }

std::string duration_text(double seconds)
{
  const auto whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

void draw_status_line(const Context& context, const std::vector<std::string>& notes)
{
  const job::Status& status = context.run.status();
  const job::Progress& progress = status.progress;
  const bool paused = status.state == job::State::paused;
  const float em = ImGui::GetFontSize();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(state_word(context.run));
  ImGui::SameLine(em * 6);
  ImGui::ProgressBar(static_cast<float>(progress.fraction), {em * 14, 0}, fmt::format("{:.0f} %", 100 * progress.fraction).c_str());
  ImGui::SameLine();
  if (paused) {
    // The same action under the name that says what it does now.
    if (ImGui::Button("Go on")) context.push(command::Pause{false});
  } else
    action_button("Pause", context);
  ImGui::SameLine();
  action_button("Cancel", context);
  ImGui::SameLine();
  action_button("Start again", context);
  const job::Pace pace = job::pace_between({}, progress);
  std::string text = pace.work_per_second > 0 ? job::rate_text(pace, progress.units) : "";
  const double left = pace.seconds_left;
  if (left > 0 && (status.state == job::State::running || paused)) text += "    " + duration_text(left) + " left";
  if (progress.work_seconds > 0) text += fmt::format("    {} of work", duration_text(progress.work_seconds));
  ImGui::SameLine(0, em);
  ImGui::TextUnformatted(text.c_str());
  draw_notes(notes);
  const char* help = "Mouse and keys: F1";
  const float right = ImGui::GetWindowWidth() - ImGui::CalcTextSize(help).x - em;
  if (right < ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + em) return;
  ImGui::SameLine(right);
  ImGui::TextDisabled("%s", help);
}

} // namespace nephroid::ui
