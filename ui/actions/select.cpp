// SPDX-License-Identifier: Apache-2.0
// The menu "Select": what of the scene is selected, and how it is moved.
#include "ui/actions/table.h"
#include "ui/view/gizmo_edits.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace nephroid::ui {
namespace {

using Tool = Handles::Tool;

constexpr double nudge_gesture_s = 0.6; ///< a longer rest starts a new entry to undo

bool has_things(C c) { return c.preset() && has_scene(*c.preset()); }
bool has_selection(C c) { return c.selection() != Selection{}; }
std::string nothing_selected(C) { return "nothing is selected"; }

void deselect(C c) { c.push(command::Select{}); }

/// Of all that can be selected, and round again.
template <int step>
void select_next(C c)
{
  const std::vector<Selection> all = selectable(*c.preset());
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  const auto now = std::ranges::find(all, c.selection());
  const std::ptrdiff_t index = now == all.end() ? (step > 0 ? 0 : count - 1) : (now - all.begin() + step + count) % count;
  c.push(command::Select{all[static_cast<std::size_t>(index)]});
}

template <class Change>
void set_handles(C c, Change change)
{
  Handles handles = c.chosen.handles;
  change(handles);
  c.push(command::SetHandles{handles});
}

template <Tool tool>
void use(C c)
{
  set_handles(c, [](Handles& h) { h.tool = tool; });
}

template <Tool tool>
bool uses(C c)
{
  return c.chosen.handles.tool == tool;
}

template <bool Handles::*member>
void toggle(C c)
{
  set_handles(c, [](Handles& h) { h.*member = !(h.*member); });
}

template <bool Handles::*member>
bool is_on(C c)
{
  return c.chosen.handles.*member;
}

std::optional<preset::Camera> camera_at_selected(C c)
{
  if (!has_selection(c)) return std::nullopt;
  return looking_at(*c.preset(), c.selection(), c.run.seen<SeenScene>().get());
}
bool can_look_at(C c) { return camera_at_selected(c).has_value(); }
std::string why_not_look_at(C c) { return has_selection(c) ? "the camera cannot look there" : nothing_selected(c); }

void look_at(C c)
{
  if (const auto camera = camera_at_selected(c))
    c.edit("look at " + name_of(*c.preset(), c.selection()), [&](preset::Preset& p) { p.scene.camera = *camera; });
}

/// Presses in quick succession, and a key that is held, are one gesture.
template <Nudge direction>
void nudge(C c)
{
  const Selection selection = c.selection();
  auto edited = nudged(*c.preset(), selection, c.chosen.handles, c.run.seen<SeenScene>().get(), direction);
  if (!edited || edited->scene == c.preset()->scene) return;
  const double now = ImGui::GetTime();
  command::Nudged newest = c.chosen.nudged;
  if (newest.gesture == 0) newest.gesture = Gestures("nudge").begin() - 1;
  if (now - newest.at_s > nudge_gesture_s) ++newest.gesture;
  newest.at_s = now;
  c.push(newest);
  c.push(command::Edit{"nudge " + name_of(*edited, selection), std::move(*edited), newest.gesture, true});
}

/// A key that was held went up.
void end_nudge(C c)
{
  if (c.chosen.nudged.gesture != 0) c.push(command::EndGesture{});
}

template <Nudge direction>
Action nudge_action(const char* name, ImGuiKey key)
{
  return {"Select",         name,    key,      true, "Move, turn or scale what is selected a little; snapping, by a step", has_selection,
          nudge<direction>, nullptr, end_nudge};
}

} // namespace

std::vector<Action> select_actions()
{
  const char* menu = "Select";
  return {
      {menu, "Select the next", ImGuiKey_Period, true, "The next object or light, or the camera's target", has_things, select_next<1>},
      {menu, "Select the one before", ImGuiKey_Comma, true, "The other way round", has_things, select_next<-1>},
      {menu, "Deselect", ImGuiKey_Escape, false, "Select nothing", has_selection, deselect},
      {menu, "Look at the selected", ImGuiKey_A, false, "It becomes the camera's target", can_look_at, look_at, why_not_look_at},
      {menu, "Move", ImGuiKey_M, false, "Arrows that move what is selected", has_things, use<Tool::move>, nullptr, nullptr,
       uses<Tool::move>},
      {menu, "Turn", ImGuiKey_U, false, "Circles that turn an object or aim a light", has_things, use<Tool::turn>, nullptr, nullptr,
       uses<Tool::turn>},
      {menu, "Scale", ImGuiKey_S, false, "Handles that scale an object or an area light", has_things, use<Tool::scale>, nullptr, nullptr,
       uses<Tool::scale>},
      {menu, "Own axes", ImGuiKey_W, false, "Along its own axes, or along those of the world", has_things, toggle<&Handles::own_axes>,
       nullptr, nullptr, is_on<&Handles::own_axes>},
      {menu, "Snap", ImGuiKey_G, false, "In steps: round lengths, 15 degrees, tenths. Ctrl, held in a drag, does the opposite", has_things,
       toggle<&Handles::snap>, nullptr, nullptr, is_on<&Handles::snap>},
      {menu, "Icons and handles", ImGuiKey_H, false, "Show lights and handles over the picture; without them a click selects nothing",
       has_things, toggle<&Handles::shown>, nullptr, nullptr, is_on<&Handles::shown>},
      nudge_action<Nudge::left>("Nudge to the left", ImGuiKey_LeftArrow),
      nudge_action<Nudge::right>("Nudge to the right", ImGuiKey_RightArrow),
      nudge_action<Nudge::up>("Nudge up", ImGuiKey_UpArrow),
      nudge_action<Nudge::down>("Nudge down", ImGuiKey_DownArrow),
      nudge_action<Nudge::away>("Nudge away", ImGuiKey_PageUp),
      nudge_action<Nudge::nearer>("Nudge nearer", ImGuiKey_PageDown),
  };
}

} // namespace nephroid::ui
