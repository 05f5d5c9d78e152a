// SPDX-License-Identifier: Apache-2.0
// The bar of an animation: a slider over its frames with a mark at each key, the frame as a number, play and record.
#include "ui/view/bars.h"
#include "ui/widgets/action.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace nephroid::ui {
namespace {

/// A mark below the slider's track for each frame that has a key.
void draw_keys(const preset::Animation& animation) {
  std::set<int> frames;
  for (const preset::Track& track : animation.tracks)
    for (const preset::Key& key : track.keys)
      if (key.frame < animation.frames) frames.insert(key.frame);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  // As the slider has its grab: its middle goes from half of its width behind one end to as far before the other.
  const float grab =
      std::max((high.x - low.x - 4) / static_cast<float>(animation.frames), ImGui::GetStyle().GrabMinSize);
  const float first = low.x + 2 + grab / 2, last = high.x - 2 - grab / 2;
  for (const int frame : frames) {
    const float part = static_cast<float>(frame) / static_cast<float>(std::max(animation.frames - 1, 1));
    const float x = first + part * (last - first);
    ImGui::GetWindowDrawList()->AddLine({x, high.y - 0.25f * em()}, {x, high.y}, colour::accent, 2 * scale());
  }
}

} // namespace

void draw_time_bar(const Context& context, WidgetPlaces& places) {
  const auto& animation = context.preset()->animation;
  if (!animation) return;
  const bool playing = context.playback.playing();
  if (playing) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  action_button("Play", context);
  if (playing) ImGui::PopStyleColor();
  places.note("play");
  ImGui::SameLine();
  int frame = context.edits->frame();
  ImGui::BeginDisabled(context.sweep.active());
  ImGui::SetNextItemWidth(16 * em());
  if (ImGui::SliderInt("##frame", &frame, 0, animation->frames - 1, "", ImGuiSliderFlags_AlwaysClamp))
    context.push(command::ShowFrame{frame, ImGui::IsItemActive()});
  if (ImGui::IsItemDeactivated()) context.push(command::EndGesture{});
  places.note("frame", "The frame that is shown; marks are keys. An edit of what moves is a key in this frame.");
  draw_keys(*animation);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(3.5f * em());
  if (ImGui::InputInt("##number", &frame, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue))
    context.push(command::ShowFrame{frame});
  places.note("frame number", fmt::format("From 0 to {}", animation->frames - 1));
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::TextDisabled("%s", fmt::format("of {}   {:.2f} s", animation->frames, frame / animation->fps).c_str());
  ImGui::SameLine(0, em());
  action_button(context.film.active() ? "Stop recording" : "Record the film...", context);
  places.note("record");
  if (!context.film.active()) return;
  ImGui::SameLine();
  ImGui::TextUnformatted(context.film.summary().c_str());
}

} // namespace nephroid::ui
