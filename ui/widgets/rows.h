// SPDX-License-Identifier: Apache-2.0
// Rows of a wavelength and a value, by rising wavelength, that a person moves, adds and removes: the control points of
// a dispersion, or the rows of a light's spectrum. This code draws and changes them; a panel puts them into its preset.
#pragma once
#include "preset/field.h"
#include "ui/state/commands.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

using Row = std::array<double, 2>; ///< (nm, value)

/// The rules for one kind of rows: what a preset accepts, and what is practical.
struct RowRules {
  const char* noun = "row";              ///< "control point", for labels and messages
  preset::Bounds value;                  ///< bounds of the second number
  double least_gap_nm = 0;               ///< the least distance of neighbours, so that no wavelength gets two values
  std::size_t fewest = 0;                ///< the number of rows that must stay
  Row (*readable)(const Row&) = nullptr; ///< rounds a row to readable figures; null: leaves it
};

std::vector<Row> sorted_rows(std::vector<Row> rows);
/// The row stays between its neighbours, and its value within the rules. A target that is not finite changes nothing;
/// where neighbours leave no room the wavelength stays.
void move_row(std::vector<Row>& rows, std::size_t index, const Row& to, const RowRules& rules);
/// Returns the new row's index. Adds nothing where a row is nearer than the least gap, the row is not finite, or there
/// are as many as a preset may have.
std::optional<std::size_t> add_row(std::vector<Row>& rows, Row row, const RowRules& rules);
/// Returns false, and removes nothing, where only the fewest are left.
bool remove_row(std::vector<Row>& rows, std::size_t index, const RowRules& rules);
/// The middle of the widest gap between neighbours in 380..780 nm; both ends count as rows.
double middle_of_widest_gap(const std::vector<Row>& rows);

/// What the mouse, a button or a key does with a row in this frame.
struct RowGesture {
  enum class Kind { none, take, move, let_go, add, remove };
  Kind kind = Kind::none;
  std::size_t row = 0; ///< unused by add
  Row to{};            ///< the target of move and add
};

/// The changed rows, and the label for command::Edit.
struct RowsEdit {
  std::string label;
  std::vector<Row> rows;
  std::uint64_t gesture = 0;
  bool live = false;
};

class RowEditor {
public:
  /// gestures: the panel's; outlives the editor.
  explicit RowEditor(Gestures& gestures) : gestures_(gestures) {}

  /// The marked row, below the number that keep() had last.
  const std::optional<std::size_t>& marked() const { return marked_; }
  void unmark() { marked_.reset(); }
  /// Called once a frame with the number of rows, which undo or another edit may have reduced.
  void keep(std::size_t rows);
  /// Nothing where nothing changes. A refusal to add or remove a row is reported; the end of a drag is also a command.
  std::optional<RowsEdit> follow(const RowGesture& gesture, std::vector<Row> rows, const RowRules& rules,
                                 Commands& commands);

private:
  Gestures& gestures_;
  std::optional<std::size_t> marked_;
  bool removed_ = false; ///< a row was removed in this frame: the mouse's gesture is about the rows before
};

struct RowStyle {
  std::uint32_t colour = 0, marked = 0;      ///< IM_COL32
  std::string (*text)(const Row&) = nullptr; ///< the tooltip of a row
  double unit = 1;                           ///< the row value at 1 on the plot's y axis
};

/// Rows as points of an ImPlot plot: drag one, click the right button on one, or double click beside them. A dragged
/// row cannot be clicked; the drag ends where rows are added or removed meanwhile.
class RowHandles {
public:
  RowGesture draw(const std::vector<Row>& rows, const std::optional<std::size_t>& marked, const RowStyle& look);
  /// Called where the plot has no rows to edit.
  void leave() { *this = {}; }

  /// Whether a row is dragged: axes should stay as they are.
  bool held() const { return held_.has_value(); }
  /// Whether the mouse is on a row, or drags one.
  bool over_row() const { return over_row_; }

private:
  std::optional<std::size_t> held_;
  std::size_t rows_at_take_ = 0; ///< the number of rows when the drag began
  bool waits_ = false;           ///< the held row is gone: the mouse holds nothing until its button is released
  bool over_row_ = false;
};

/// Whether Delete is for a marked row of the focused plot, in this frame or the one before.
bool row_takes_delete();

/// Buttons that add this row and remove the marked one; Delete removes it too. Their places are noted as "add" and
/// "remove".
RowGesture draw_row_buttons(const Row& added, const std::optional<std::size_t>& marked, WidgetPlaces& places);

} // namespace nephroid::ui
