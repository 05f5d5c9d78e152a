// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/status_line.h"

#include "base/counted.h"
#include "job/job.h"
#include "job/pace.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

/// How many there are; the lines themselves in a tooltip.
void draw_notes(const std::vector<std::string>& notes) {
  if (notes.empty()) return;
  ImGui::SameLine(0, em());
  draw_text(colour::note, counted(notes.size(), "note"));
  if (!ImGui::BeginItemTooltip()) return;
  ImGui::PushTextWrapPos(40 * em());
  for (const std::string& note : notes) ImGui::TextUnformatted(note.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// What has run for a moment, of which the window says nothing elsewhere; all of it, and how to end it, behind the
/// button.
void draw_tasks(TaskQueue& tasks) {
  constexpr std::chrono::milliseconds worth_a_word{300};
  const std::vector<TaskView> running = tasks.running(worth_a_word);
  const auto text_of = [](const TaskView& task) {
    return task.progress < 0 ? task.name : fmt::format("{}: {:.0f} %", task.name, 100 * task.progress);
  };
  if (running.empty() && !ImGui::IsPopupOpen("tasks")) return;
  ImGui::SameLine(0, em());
  const std::string word = running.size() == 1 ? text_of(running.front()) : counted(running.size(), "task");
  if (ImGui::SmallButton((word + "###tasks").c_str())) ImGui::OpenPopup("tasks");
  if (!ImGui::BeginPopup("tasks")) return;
  for (const TaskView& task : running) {
    ImGui::PushID(static_cast<int>(task.id));
    ImGui::BeginDisabled(!task.can_cancel);
    if (ImGui::SmallButton("Cancel")) tasks.cancel(task.id);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextUnformatted(text_of(task).c_str());
    ImGui::PopID();
  }
  if (running.empty()) ImGui::TextDisabled("Nothing runs any more");
  ImGui::EndPopup();
}

constexpr std::size_t most_shown = 4; ///< the newest; the others come up when these are dismissed

std::span<const Message> shown(std::span<const Message> all) { return all.last(std::min(all.size(), most_shown)); }

/// Room at the right for the buttons.
float text_width(float width) { return std::max(width - 12 * em(), 10 * em()); }

float line_height(const Message& message, float width) {
  return std::max(ImGui::CalcTextSize(message.line.c_str(), nullptr, false, text_width(width)).y,
                  ImGui::GetFrameHeight()) +
         ImGui::GetStyle().ItemSpacing.y;
}

} // namespace

const char* name_of(job::State state) {
  using enum job::State;
  static const std::map<job::State, const char*> names{
      {idle, "no run"},       {preparing, "preparing"}, {running, "running"}, {paused, "paused"},
      {finished, "finished"}, {cancelled, "cancelled"}, {failed, "failed"}};
  return names.at(state);
}

std::string duration_text(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

void draw_status_line(const Context& context, const std::vector<std::string>& notes) {
  const job::Status& status = context.run.status();
  const job::Progress& progress = status.progress;
  const bool paused = status.state == job::State::paused;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name_of(status.state));
  ImGui::SameLine(em() * 6);
  ImGui::ProgressBar(static_cast<float>(progress.fraction), {std::min(em() * 14, ImGui::GetWindowWidth() / 5), 0},
                     fmt::format("{:.0f} %", 100 * progress.fraction).c_str());
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
  std::string text = context.sweep.active() ? "sweep: " + context.sweep.summary() + "    " : "";
  text += context.run.preparation();
  if (pace.work_per_second > 0) text += job::rate_text(pace, progress.units);
  const double left = pace.seconds_left;
  if (left > 0 && (status.state == job::State::running || paused)) text += "    " + duration_text(left) + " left";
  if (progress.work_seconds > 0) text += fmt::format("    {} of work", duration_text(progress.work_seconds));
  ImGui::SameLine(0, em());
  ImGui::TextUnformatted(text.c_str());
  draw_tasks(context.tasks);
  draw_notes(notes);
  const char* help = "Mouse and keys: F1";
  const float right = ImGui::GetWindowWidth() - ImGui::CalcTextSize(help).x - em();
  if (right < ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + em()) return;
  ImGui::SameLine(right);
  ImGui::TextDisabled("%s", help);
}

float errors_height(std::span<const Message> errors, float width) {
  if (errors.empty()) return 0;
  float height = 2 * ImGui::GetStyle().WindowPadding.y;
  for (const Message& error : shown(errors)) height += line_height(error, width);
  return errors.size() > 1 ? height + ImGui::GetFrameHeight() : height;
}

void draw_errors(std::span<const Message> errors, const Context& context) {
  const float width = ImGui::GetWindowWidth();
  for (const Message& error : shown(errors)) {
    ImGui::PushID(static_cast<int>(error.id));
    const float top = ImGui::GetCursorPosY();
    ImGui::AlignTextToFramePadding();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + text_width(width));
    draw_text(colour::error, error.line);
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPos({width - em() * 10.5f, top});
    action_button("Open...", context);
    ImGui::SameLine();
    if (ImGui::Button("Dismiss")) context.push(command::Dismiss{error.id});
    ImGui::SetCursorPosY(top + line_height(error, width) - ImGui::GetStyle().ItemSpacing.y);
    ImGui::Dummy({0, 0}); // the spacing follows it
    ImGui::PopID();
  }
  if (errors.size() < 2) return;
  ImGui::SetCursorPosX(width - em() * 7);
  if (ImGui::Button("Dismiss all", {em() * 6.5f, 0}))
    for (const Message& error : shown(errors)) context.push(command::Dismiss{error.id});
}

void draw_note_lines(std::span<const Message> notes, float width) {
  ImGui::PushTextWrapPos(width - ImGui::GetStyle().WindowPadding.x);
  for (const Message& note : shown(notes)) ImGui::TextUnformatted(note.line.c_str());
  ImGui::PopTextWrapPos();
}

} // namespace nephroid::ui
