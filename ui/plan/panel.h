// SPDX-License-Identifier: Apache-2.0
// The panel "Plan": which passes the run has, which are left out and why, seconds and bytes, and a box for each that a field of the
// preset turns on or off.
#pragma once
#include "plan/plan.h"
#include "preset/preset.h"
#include "ui/widgets/panel.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

class PlanPanel : public Panel {
public:
  static constexpr const char* title = "Plan";
  void draw(const Context& context) override;

  /// Where the box of a pass was drawn last (its middle on the screen); nothing where it has none. For tests.
  std::optional<std::array<double, 2>> box_of(const std::string& pass) const;

private:
  struct Box {
    std::string pass;
    std::optional<bool> computed; ///< whether its field says that it is computed; nothing where there is no such field
    std::array<double, 2> middle{0, 0};
  };

  void read_fields(const Context& context);
  void draw_passes(const Context& context);
  void draw_box(const Context& context, const plan::Pass& pass, Box& box) const;

  std::shared_ptr<const plan::Plan> plan_; ///< what boxes_ belong to,
  preset::Preset preset_;                  ///< and the preset that they were read from
  std::vector<Box> boxes_;                 ///< one a pass
};

/// The preset with the boolean at a JSON pointer set. Throws bad_input where there is no such field.
preset::Preset with_field(const preset::Preset& preset, const std::string& pointer, bool value);

} // namespace nephroid::ui
