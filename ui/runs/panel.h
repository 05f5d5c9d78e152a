// SPDX-License-Identifier: Apache-2.0
// The panel "Runs": the run in hand and each pinned run as a table, with what they cost, how far off they are and where their presets
// differ; buttons to look at one, to take its preset, to pin and unpin, and to write the report over all of them. Above it the sweep.
#pragma once
#include "ui/runs/rows.h"
#include "ui/runs/sweep_section.h"
#include "ui/widgets/panel.h"

#include <string>
#include <vector>

struct ImVec2;

namespace nephroid::ui {

class RunsPanel : public Panel {
public:
  static constexpr const char* title = "Runs";
  void draw(const Context& context) override;

  /// For tests: what was listed last, from the top; the middle of a widget on the screen: "show 3", "take 3", "unpin 3" of a pin by its id,
  /// "show 0" and "pin" of the run in hand. Nothing where it is not drawn.
  const std::vector<RunRow>& rows() const { return rows_; }
  std::string difference(const RunRow& row, const Context& context) { return differences_.in_short(row, context); }
  const SweepSection& sweep() const { return sweep_; }

private:
  void draw_table(const Context& context);
  void draw_row(const Context& context, const RunRow& row);
  void draw_buttons(const Context& context, const RunRow& row);
  void draw_difference(const Context& context, const RunRow& row, const ImVec2& corner, float width);

  std::vector<RunRow> rows_;
  PresetDifferences differences_;
  SweepSection sweep_;
};

} // namespace nephroid::ui
