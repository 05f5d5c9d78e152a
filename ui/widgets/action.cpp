// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/action.h"

#include "base/error.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

void tooltip_of(const Action& action, bool enabled, const Context& context, bool with_keys) {
  std::string text = action.help;
  if (with_keys && action.shortcut) text += fmt::format(": {}", keys_of(action));
  if (!enabled && action.why_not) text += fmt::format(". Not now: {}.", action.why_not(context));
  tooltip(text);
}

} // namespace

const Action& action(const char* name) {
  const auto all = actions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Action& a) { return a.name == name; });
  if (found == all.end()) throw failed("actions", std::string("there is no action \"") + name + "\"");
  return *found;
}

const char* keys_of(const Action& action) { return action.shortcut ? ImGui::GetKeyChordName(action.shortcut) : ""; }

void action_button(const char* name, const Context& context) {
  const Action& meant = action(name);
  const bool enabled = meant.enabled(context);
  ImGui::BeginDisabled(!enabled);
  if (ImGui::Button(name)) meant.run(context);
  ImGui::EndDisabled();
  tooltip_of(meant, enabled, context, true);
}

void action_item(const Action& action, const Context& context) {
  const bool enabled = action.enabled(context);
  if (ImGui::MenuItem(action.name.c_str(), keys_of(action), action.checked && action.checked(context), enabled))
    action.run(context);
  tooltip_of(action, enabled, context, false);
}

} // namespace nephroid::ui
