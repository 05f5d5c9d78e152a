// SPDX-License-Identifier: Apache-2.0
// The menu "Select": what of the scene is selected, and how it is moved.
#include "ui/actions/table.h"
#include "ui/state/additions.h"
#include "ui/view/gizmo_edits.h"
#include "ui/widgets/rows.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

using Tool = Handles::Tool;

constexpr double nudge_gesture_s = 0.6; ///< a longer rest starts a new entry to undo

bool has_selection(C c) { return c.selection() != Selection{}; }
std::string nothing_selected(C) { return "nothing is selected"; }

/// Selects the next of all that can be selected, cyclically.
template <int step>
void select_next(C c) {
  const std::vector<Selection> all = selectable(*c.preset());
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  const auto now = std::ranges::find(all, c.selection());
  const std::ptrdiff_t index =
      now == all.end() ? (step > 0 ? 0 : count - 1) : (now - all.begin() + step + count) % count;
  c.push(command::Select{all[static_cast<std::size_t>(index)]});
}

bool can_delete(C c) {
  return has_selection(c) && c.selection().kind != Selection::Kind::camera && !row_takes_delete();
}

void delete_selected(C c) {
  c.push(command::Edit{"delete " + name_of(*c.preset(), c.selection()), without_thing(*c.preset(), c.selection())});
  c.push(command::Select{});
}

template <class Change>
void set_handles(C c, Change change) {
  Handles handles = c.view_state.handles;
  change(handles);
  c.push(command::SetHandles{handles});
}

Action tool_action(const char* name, ImGuiKey key, const char* help, Tool tool) {
  return switching({name, key, help, has_things, [tool](C c) { set_handles(c, [&](Handles& h) { h.tool = tool; }); }},
                   [tool](C c) { return c.view_state.handles.tool == tool; });
}

Action handles_action(const char* name, ImGuiKey key, const char* help, bool Handles::*member) {
  return switching(
      {name, key, help, has_things, [member](C c) { set_handles(c, [&](Handles& h) { h.*member = !(h.*member); }); }},
      [member](C c) { return c.view_state.handles.*member; });
}

std::optional<preset::Camera> camera_at_selected(C c) {
  if (!has_selection(c)) return std::nullopt;
  return looking_at(*c.preset(), c.selection(), c.run.scene_facts().view.get());
}
bool can_look_at(C c) { return camera_at_selected(c).has_value(); }
std::string why_not_look_at(C c) { return has_selection(c) ? "the camera cannot look there" : nothing_selected(c); }

void look_at(C c) {
  if (const auto camera = camera_at_selected(c))
    c.edit("look at " + name_of(*c.preset(), c.selection()), [&](preset::Preset& p) { p.scene.camera = *camera; });
}

/// Presses in quick succession, and a key that is held, are one gesture.
void nudge(C c, Nudge direction) {
  const Selection selection = c.selection();
  auto edited = nudged(*c.preset(), selection, c.view_state.handles, c.run.scene_facts().view.get(), direction);
  if (!edited || edited->scene == c.preset()->scene) return;
  const double now = ImGui::GetTime();
  command::Nudged newest = c.view_state.nudged;
  if (newest.gesture == 0) newest.gesture = Gestures("nudge").begin() - 1;
  if (now - newest.at_s > nudge_gesture_s) ++newest.gesture;
  newest.at_s = now;
  c.push(newest);
  c.push(command::Edit{"nudge " + name_of(*edited, selection), std::move(*edited), newest.gesture, true});
}

/// Called when a held key is released.
void end_nudge(C c) {
  if (c.view_state.nudged.gesture != 0) c.push(command::EndGesture{});
}

Action nudge_action(const char* name, ImGuiKey key, Nudge direction) {
  return repeating({name, key, "Move, turn or scale what is selected a little; snapping, by a step", has_selection,
                    [direction](C c) { nudge(c, direction); }, nullptr, end_nudge});
}

} // namespace

std::vector<Action> select_actions() {
  return {
      repeating({"Select the next", ImGuiKey_Period, "The next object or light, or the camera's target", has_things,
                 select_next<1>}),
      repeating({"Select the one before", ImGuiKey_Comma, "The other way round", has_things, select_next<-1>}),
      {"Deselect", ImGuiKey_Escape, "Select nothing", has_selection, push<command::Select>},
      {"Delete", ImGuiKey_Delete, "Remove what is selected", can_delete, delete_selected},
      {"Look at the selected", ImGuiKey_A, "It becomes the camera's target", can_look_at, look_at, why_not_look_at},
      tool_action("Move", ImGuiKey_M, "Arrows that move what is selected", Tool::move),
      tool_action("Turn", ImGuiKey_U, "Circles that turn an object or aim a light", Tool::turn),
      tool_action("Scale", ImGuiKey_S, "Handles that scale an object or an area light", Tool::scale),
      handles_action("Own axes", ImGuiKey_W, "Along its own axes, or along those of the world", &Handles::own_axes),
      handles_action("Snap", ImGuiKey_G,
                     "In steps: round lengths, 15 degrees, tenths. Ctrl in a drag does the opposite", &Handles::snap),
      handles_action("Icons and handles", ImGuiKey_H,
                     "Show lights and handles over the picture; without them a click selects nothing", &Handles::shown),
      nudge_action("Nudge to the left", ImGuiKey_LeftArrow, Nudge::left),
      nudge_action("Nudge to the right", ImGuiKey_RightArrow, Nudge::right),
      nudge_action("Nudge up", ImGuiKey_UpArrow, Nudge::up),
      nudge_action("Nudge down", ImGuiKey_DownArrow, Nudge::down),
      nudge_action("Nudge away", ImGuiKey_PageUp, Nudge::away),
      nudge_action("Nudge nearer", ImGuiKey_PageDown, Nudge::nearer),
  };
}

} // namespace nephroid::ui
