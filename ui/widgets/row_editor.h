// SPDX-License-Identifier: Apache-2.0
// What becomes of sorted rows (ui/widgets/sorted_rows.h) when the mouse or a button asks for something: which row is marked, the edit that
// is meant, one entry to undo a drag. A panel puts the edit into its preset. No Dear ImGui here.
#pragma once
#include "ui/state/commands.h"
#include "ui/widgets/gestures.h"
#include "ui/widgets/sorted_rows.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

/// What the mouse does with a row in this frame.
struct RowGesture {
  enum class Kind { none, take, move, let_go, add, remove };
  Kind kind = Kind::none;
  std::size_t row = 0; ///< but for add
  Row to{};            ///< of move and add: where the mouse is, in the rows' units
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

  /// Nothing where nothing changes. Why a row cannot be added or removed is reported; the end of a drag is a command too.
  std::optional<RowsEdit> follow(const RowGesture& gesture, std::vector<Row> rows, const RowRules& rules, Commands& commands);
  std::optional<RowsEdit> add(std::vector<Row> rows, const Row& row, const RowRules& rules, Commands& commands);
  std::optional<RowsEdit> remove(std::vector<Row> rows, std::size_t index, const RowRules& rules, Commands& commands);

private:
  Gestures& gestures_;
  std::optional<std::size_t> marked_;
  bool removed_ = false; ///< a row, in this frame: what the mouse does is about rows as they were
};

} // namespace nephroid::ui
