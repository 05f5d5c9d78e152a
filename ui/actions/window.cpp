// SPDX-License-Identifier: Apache-2.0
// The menu "Window": which panels there are and where, and how the window looks.
#include "ui/actions/table.h"
#include "ui/shell/panels.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

/// Opens the panel or brings it to the front; closes it where it is seen.
Action panel_action(const PanelEntry& entry)
{
  const auto pressed = [entry](C c) {
    c.push(command::ShowPanel{std::string(entry.name), !can_close(entry) || !is_open(entry, c) || !is_seen(entry)});
  };
  const auto serves_it = [entry](C c) { return c.preset() && serves(entry, *c.preset()); };
  return {"Window",
          fmt::format("Panel: {}", entry.title),
          0,
          false,
          can_close(entry) ? "Open this panel or bring it to the front; close it where it is seen" : "Bring the picture to the front",
          serves_it,
          pressed,
          [](C c) { return std::string(c.preset() ? "it has nothing to show of this preset" : "no preset is open"); },
          nullptr,
          [serves_it, entry](C c) { return serves_it(c) && is_open(entry, c); }};
}

constexpr double text_step = 1.1;

void look(C c, Theme theme, double text_size) { c.push(command::SetAppearance{theme, text_size}); }
bool is_light(C c) { return c.settings.theme == Theme::light; }

} // namespace

std::vector<Action> window_actions()
{
  const char* menu = "Window";
  std::vector<Action> all;
  for (const PanelEntry& entry : panel_table()) all.push_back(panel_action(entry));
  all.insert(all.end(),
             {{menu, "Reset layout", 0, false, "Every panel of this engine back to its place, all of them open", has_preset,
               push<command::ResetLayout>},
              {menu, "Light theme", 0, false, "Dark words on light panels, or the other way round; pictures stay on a dark ground", always,
               [](C c) { look(c, is_light(c) ? Theme::dark : Theme::light, c.settings.text_size); }, nullptr, nullptr, is_light},
              {menu, "Larger text", ctrl | ImGuiKey_Equal, true, "Everything in the window a tenth larger", always,
               [](C c) { look(c, c.settings.theme, c.settings.text_size * text_step); }},
              {menu, "Smaller text", ctrl | ImGuiKey_Minus, true, "Everything in the window a tenth smaller", always,
               [](C c) { look(c, c.settings.theme, c.settings.text_size / text_step); }},
              {menu, "Text as the display has it", ctrl | ImGuiKey_0, false, "The size of text that the display asks for", always,
               [](C c) { look(c, c.settings.theme, 1); }}});
  return all;
}

} // namespace nephroid::ui
