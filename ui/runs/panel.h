// SPDX-License-Identifier: Apache-2.0
// The panel "Runs": the run in hand, each pinned run and each opened picture as a table, with what they cost, how far
// off they are and where their presets differ; buttons to look at one, to take its preset, to pin and unpin, and to
// write the report over all of them. Above it the sweep.
#pragma once
#include "preset/differences.h"
#include "ui/runs/sweep_section.h"
#include "ui/widgets/panel.h"

#include <limits>

namespace nephroid::ui {

struct RunRow {
  std::uint64_t pin = 0; ///< PinnedRun::id; 0: the run in hand
  std::string name = {};
  std::uint32_t colour = 0;     ///< IM_COL32
  std::string engine = "-";     ///< this and all below: "-" where it is not known
  std::string steps = "-";      ///< "20 passes"
  std::string seconds = "-";    ///< "0.04 s": of work
  std::string error = "-";      ///< "0.0123 lab_mean"
  std::string error_kind = "-"; ///< "estimate", "to its reference"
  double seconds_value = std::numeric_limits<double>::quiet_NaN(),
         error_value = std::numeric_limits<double>::quiet_NaN();
  bool has_picture = false;
  std::string file = {};                             ///< an opened picture's, whose seconds are its size; empty: a run
  std::string read_as = {};                          ///< as PinnedRun::read_as
  std::shared_ptr<const preset::Preset> preset = {}; ///< null where it is not known
};

/// The run in hand first, also before it has a picture; then the pinned runs in their order. A preset is open.
std::vector<RunRow> run_rows(const Context& context);

/// Where presets differ from the present one, kept as long as both stay the same.
class PresetDifferences {
public:
  struct Known {
    std::shared_ptr<const preset::Preset> of, present;
    std::string in_short; ///< for a row: "spectral.threshold_deg: 0.1 -> 0.5, 2 more", from the present one's value
    std::string in_full;  ///< a line a difference
  };
  const Known& of(const RunRow& row, const Context& context);

private:
  std::map<std::uint64_t, Known> known_; ///< by RunRow::pin
};

/// A run's preset in place of the present one, as one edit: names of files mean what they meant; it stays in the
/// present file. A run of that same file leaves name and description as they are.
command::Edit taken(const RunRow& row, const preset::Preset& present);

class RunsPanel : public Panel {
public:
  static constexpr const char* title = "Runs";
  void draw(const Context& context) override;

  /// For tests: what was listed last, from the top. Widgets have places: "show 3", "compare 3", "take 3", "unpin 3" of
  /// a pin by its id, "show 0", "compare 0" and "pin" of the run in hand.
  const std::vector<RunRow>& rows() const { return rows_; }
  std::string difference(const RunRow& row, const Context& context) { return differences_.of(row, context).in_short; }
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
