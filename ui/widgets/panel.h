// SPDX-License-Identifier: Apache-2.0
// A panel of the window reads its context, draws with Dear ImGui and pushes commands. Drawing needs no back end.
#pragma once
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

namespace nephroid::run {
struct LoadedScene;
}

namespace nephroid::ui {

class WavelengthAxis;

class Panel : public Placed {
public:
  virtual ~Panel() = default;
  /// Draws inside of the panel's window. A preset is open, but for the panel Presets. An exception becomes a message.
  virtual void draw(const Context& context) = 0;

protected:
  /// A number of the preset that is dragged, or typed after Ctrl and a click.
  struct Dragged {
    std::string widget, label; ///< the name of its place; the edit's label
    double value, low, high;
    double step;        ///< the change per pixel of the mouse
    const char* format; ///< a format of printf
    const char* help;
    ImGuiSliderFlags flags = ImGuiSliderFlags_None; ///< added to AlwaysClamp
  };
  /// Edits by change(preset, value). A drag is one gesture.
  template <class Change>
  void draw_dragged(const Context& context, Gestures& gestures, const Dragged& d, Change change) {
    double value = d.value;
    const bool changed =
        ImGui::DragScalar(("##" + d.widget).c_str(), ImGuiDataType_Double, &value, static_cast<float>(d.step), &d.low,
                          &d.high, d.format, ImGuiSliderFlags_AlwaysClamp | d.flags);
    follow_item(context, gestures, d.widget, changed, d.label, [&](preset::Preset& p) { change(p, value); });
    tooltip(d.help);
  }
  /// Edits the preset by the item drawn last; a drag is one gesture. Its place is noted as `widget`.
  template <class Change>
  void follow_item(const Context& context, Gestures& gestures, const std::string& widget, bool changed,
                   const std::string& label, Change change) {
    places_.note(widget);
    if (ImGui::IsItemActivated()) gestures.begin();
    if (changed) context.edit(label, change, gestures.number(), true);
    if (ImGui::IsItemDeactivated()) context.push(command::EndGesture{});
  }
};

/// A panel's line in the table. shell/panels.cpp lists the panels for every engine; ui/ENGINE those of one.
struct PanelEntry {
  std::string_view name;        ///< the name in layouts and of the panel's folder
  const char* title;            ///< the tab's title
  std::string_view engine = ""; ///< the engine of its presets; empty: every engine
  /// wavelengths: the axis that several panels' plots share; outlives the panel.
  std::unique_ptr<Panel> (*make)(WavelengthAxis& wavelengths) = nullptr;
  /// Takes the panel's facts from a loaded scene, on the thread that prepared the run. Null: it needs none.
  void (*take_facts)(const preset::Preset&, const std::shared_ptr<const run::LoadedScene>&, SceneFacts&) = nullptr;
  /// Whether the panel is for this preset. Null: the engine alone decides.
  bool (*serves)(const preset::Preset&) = nullptr;
  /// Presets of this engine open with this tab in front; empty: none.
  std::string_view front_for = "";
};

template <class P>
std::unique_ptr<Panel> make_panel([[maybe_unused]] WavelengthAxis& wavelengths) {
  if constexpr (std::is_constructible_v<P, WavelengthAxis&>)
    return std::make_unique<P>(wavelengths);
  else
    return std::make_unique<P>();
}

// The panels of each engine, defined in its folder: in panels.cpp where there are several, else beside the only one.
std::vector<PanelEntry> spectral_panels();
std::vector<PanelEntry> environment_panels();
std::vector<PanelEntry> inverse_panels();

} // namespace nephroid::ui
