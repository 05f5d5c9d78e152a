// SPDX-License-Identifier: Apache-2.0
// Rows as points of an ImPlot plot that the mouse takes hold of: drag one, click the right button on one, double click beside them.
// A row that is dragged cannot be clicked; where rows come or go meanwhile, the drag ends. And buttons that do the same.
#pragma once
#include "ui/widgets/rows.h"
#include "ui/widgets/widgets.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

struct RowLook {
  std::uint32_t colour = 0, marked = 0;      ///< IM_COL32
  std::string (*text)(const Row&) = nullptr; ///< what is said of a row under the mouse
  double unit = 1;                           ///< of a row's value: what is 1 on the plot's y axis
};

class RowHandles {
public:
  /// In the plot in hand; rows out of its sight are not drawn.
  RowGesture draw(const std::vector<Row>& rows, const std::optional<std::size_t>& marked, const RowLook& look);
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

/// Buttons that add this row and remove the marked one; Delete removes it too. Their places are noted as "add" and "remove".
RowGesture draw_row_buttons(const Row& added, const std::optional<std::size_t>& marked, WidgetPlaces& places);

} // namespace nephroid::ui
