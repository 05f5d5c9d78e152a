// SPDX-License-Identifier: Apache-2.0
// Rows of a wavelength and a value, by rising wavelength, that a person moves, adds and removes: the control points of
// a dispersion, the rows of a light's spectrum. What becomes of them is here; a panel puts it into its preset. And the
// rows as points of a plot.
#pragma once
#include "preset/field.h"
#include "ui/state/commands.h"
#include "ui/widgets/widgets.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

using Row = std::array<double, 2>; ///< (nm, value)

/// What a preset may have, and a person wants to have, in one kind of rows.
struct RowRules {
  const char* noun = "row"; ///< "control point", for labels and messages
  preset::Bounds value;     ///< of the second number
  double least_gap_nm = 0;  ///< the least distance of neighbours, in nm, so that no wavelength gets two values
  std::size_t fewest = 0;   ///< so many stay
  Row (*readable)(const Row&) = nullptr; ///< in figures that a person reads; null: as it is
};

std::vector<Row> sorted_rows(std::vector<Row> rows);
/// One row to a new place: between its neighbours, and its value inside of the rules. A place that is not finite
/// changes nothing; where neighbours leave no room the wavelength stays.
void move_row(std::vector<Row>& rows, std::size_t index, const Row& to, const RowRules& rules);
/// The new row's index; nothing, and no change, where another is nearer than the least gap, the place is not finite, or
/// there are as many as a preset may have.
std::optional<std::size_t> add_row(std::vector<Row>& rows, Row row, const RowRules& rules);
/// False, and no change, where only the fewest are left.
bool remove_row(std::vector<Row>& rows, std::size_t index, const RowRules& rules);
/// The middle of the widest gap between neighbouring rows within 380..780 nm, whose ends count as rows.
double middle_of_widest_gap(const std::vector<Row>& rows);

/// What the mouse, a button or a key does with a row in this frame.
struct RowGesture {
  enum class Kind { none, take, move, let_go, add, remove };
  Kind kind = Kind::none;
  std::size_t row = 0; ///< but for add
  Row to{};            ///< of move and add, in the rows' units
};

/// The rows as they shall be, and what command::Edit says of it.
struct RowsEdit {
  std::string label;
  std::vector<Row> rows;
  std::uint64_t gesture = 0;
  bool live = false;
};

class RowEditor {
public:
  /// gestures: of the panel; outlives the editor.
  explicit RowEditor(Gestures& gestures) : gestures_(gestures) {}

  /// The row that is marked; one of the rows that keep() was told of last.
  const std::optional<std::size_t>& marked() const { return marked_; }
  void unmark() { marked_.reset(); }
  /// Once a frame: the rows may have become fewer, by undo or by another edit.
  void keep(std::size_t rows);
  /// Nothing where nothing changes. Why a row cannot be added or removed is reported; the end of a drag is a command
  /// too.
  std::optional<RowsEdit> follow(const RowGesture& gesture, std::vector<Row> rows, const RowRules& rules,
                                 Commands& commands);

private:
  Gestures& gestures_;
  std::optional<std::size_t> marked_;
  bool removed_ = false; ///< a row, in this frame: what the mouse does is about rows as they were
};

struct RowStyle {
  std::uint32_t colour = 0, marked = 0;      ///< IM_COL32
  std::string (*text)(const Row&) = nullptr; ///< what is said of a row under the mouse
  double unit = 1;                           ///< of a row's value: what is 1 on the plot's y axis
};

/// Rows as points of an ImPlot plot that the mouse takes hold of: drag one, click the right button on one, double click
/// beside them. A row that is dragged cannot be clicked; where rows come or go meanwhile, the drag ends.
class RowHandles {
public:
  /// In the plot in hand; rows out of its sight are not drawn.
  RowGesture draw(const std::vector<Row>& rows, const std::optional<std::size_t>& marked, const RowStyle& look);
  /// Where the plot has no rows to take.
  void leave() { *this = {}; }

  /// A row is dragged: axes should stay as they are.
  bool held() const { return held_.has_value(); }
  /// The mouse is on a row, or drags one.
  bool over_row() const { return over_row_; }

private:
  std::optional<std::size_t> held_;
  std::size_t rows_at_take_ = 0; ///< how many rows there were when the held one was taken
  bool waits_ = false;           ///< what was held is gone: the mouse holds nothing until its button is let go
  bool over_row_ = false;
};

/// Buttons that add this row and remove the marked one; Delete removes it too. Their places are noted as "add" and
/// "remove".
RowGesture draw_row_buttons(const Row& added, const std::optional<std::size_t>& marked, WidgetPlaces& places);

} // namespace nephroid::ui
