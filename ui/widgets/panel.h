// SPDX-License-Identifier: Apache-2.0
// A panel of the window: reads what it needs of its context, draws with Dear ImGui, pushes commands. It needs no back
// end to be drawn. A new one is a folder with its class, and a line in the table of panels.
#pragma once
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

#include <imgui.h>

#include <string_view>

namespace nephroid::run {
struct LoadedScene;
}

namespace nephroid::ui {

class WavelengthAxis;

class Panel : public Placed {
public:
  virtual ~Panel() = default;
  /// Inside of the panel's window. What it throws becomes a message.
  virtual void draw(const Context& context) = 0;

protected:
  /// A number of the preset that is dragged, or typed with Ctrl and a click.
  struct Dragged {
    std::string widget; ///< its place's name
    std::string label;  ///< of the edit
    double value, low, high;
    double step;        ///< a pixel of the mouse
    const char* format; ///< as printf's
    const char* help;
    ImGuiSliderFlags flags = ImGuiSliderFlags_None; ///< beside AlwaysClamp
  };
  /// change(preset, value): one gesture from taking hold of it to letting go.
  template <class Change>
  void draw_dragged(const Context& context, Gestures& gestures, const Dragged& d, Change change) {
    double value = d.value;
    const bool changed =
        ImGui::DragScalar(("##" + d.widget).c_str(), ImGuiDataType_Double, &value, static_cast<float>(d.step), &d.low,
                          &d.high, d.format, ImGuiSliderFlags_AlwaysClamp | d.flags);
    follow_item(context, gestures, d.widget, changed, d.label, [&](preset::Preset& p) { change(p, value); });
    tooltip(d.help);
  }
  /// What the item drawn last changes of the preset, from taking hold of it to letting go one gesture. Its place is
  /// noted as `widget`.
  template <class Change>
  void follow_item(const Context& context, Gestures& gestures, const std::string& widget, bool changed,
                   const std::string& label, Change change) {
    places_.note(widget);
    if (ImGui::IsItemActivated()) gestures.begin();
    if (changed) context.edit(label, change, gestures.number(), true);
    if (ImGui::IsItemDeactivated()) context.push(command::EndGesture{});
  }
};

/// A panel's line in the table: shell/panels.cpp has those for every engine; those of one are listed in ui/ENGINE.
struct PanelEntry {
  std::string_view name;        ///< of the layout that has it in front; its folder's
  const char* title;            ///< of its tab
  std::string_view engine = ""; ///< whose presets it is for; empty: every preset
  /// wavelengths: the axis that plots of several panels share; outlives the panel.
  std::unique_ptr<Panel> (*make)(WavelengthAxis& wavelengths) = nullptr;
  /// Takes what the panel keeps of a loaded scene, on the thread that made the run ready. Null: it keeps nothing.
  void (*take_facts)(const preset::Preset&, const std::shared_ptr<const run::LoadedScene>&, SceneFacts&) = nullptr;
  /// Whether it is for a preset, where the engine does not decide on that. Null: it does.
  bool (*serves)(const preset::Preset&) = nullptr;
  /// The engine whose presets are opened with this tab in front; empty: none.
  std::string_view front_for = "";
};

/// The entry's `make` of a panel.
template <class P>
std::unique_ptr<Panel> make_panel([[maybe_unused]] WavelengthAxis& wavelengths) {
  if constexpr (std::is_constructible_v<P, WavelengthAxis&>)
    return std::make_unique<P>(wavelengths);
  else
    return std::make_unique<P>();
}

// The panels of each engine, in its folder: panels.cpp where there are several, else beside the one.
std::vector<PanelEntry> spectral_panels();
std::vector<PanelEntry> environment_panels();
std::vector<PanelEntry> inverse_panels();

} // namespace nephroid::ui
