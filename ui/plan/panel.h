// SPDX-License-Identifier: Apache-2.0
// The panel "Plan": what the run computes, what is left out and why, seconds and bytes, and a box for each that a
// field of the preset turns on or off.
#pragma once
#include "plan/plan.h"
#include "preset/preset.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

class PlanPanel : public Panel {
public:
  static constexpr const char* title = "Plan";
  void draw(const Context& context) override;

private:
  void read_fields(const Context& context);
  void draw_decisions(const Context& context);
  void draw_box(const Context& context, const plan::Decision& decision, bool computed);

  std::shared_ptr<const plan::Plan> plan_;    ///< what computed_ belongs to,
  preset::Preset preset_;                     ///< and the preset that it was read from
  std::vector<std::optional<bool>> computed_; ///< by decision: whether its field says so; nothing without such a field
};

/// The preset with the boolean at a JSON pointer set. Throws bad_input where there is no such field.
preset::Preset with_field(const preset::Preset& preset, const std::string& pointer, bool value);

} // namespace nephroid::ui
