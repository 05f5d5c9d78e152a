// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/row_editor.h"

#include "preset/describe_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::ui {
namespace {

/// Why add_row adds nothing.
std::string refusal(const std::vector<Row>& rows, const Row& row, const RowRules& rules)
{
  if (rows.size() >= preset::max_rows) return fmt::format("a preset has at most {} rows", preset::max_rows);
  if (!std::isfinite(row[0]) || !std::isfinite(row[1])) return "its place is not finite";
  const double nm = std::clamp(row[0], preset::wavelength_bounds.low, preset::wavelength_bounds.high);
  return fmt::format("another is less than {} nm from {:.6g} nm", rules.least_gap_nm, nm);
}

} // namespace

void RowEditor::keep(std::size_t rows)
{
  removed_ = false;
  if (marked_ && *marked_ >= rows) marked_.reset();
}

std::optional<RowsEdit> RowEditor::follow(const RowGesture& gesture, std::vector<Row> rows, const RowRules& rules, Commands& commands)
{
  using Kind = RowGesture::Kind;
  switch (gesture.kind) {
  case Kind::none:
    break;
  case Kind::take:
    marked_ = gesture.row;
    gestures_.begin();
    break;
  case Kind::move: {
    if (removed_) break; // else the row would be back
    const std::vector<Row> before = rows;
    move_row(rows, gesture.row, gesture.to, rules);
    if (rows != before) return RowsEdit{fmt::format("move a {}", rules.noun), std::move(rows), gestures_.number(), true};
    break;
  }
  case Kind::let_go:
    commands.push_back(command::EndGesture{});
    break;
  case Kind::add:
    return add(std::move(rows), gesture.to, rules, commands);
  case Kind::remove:
    return remove(std::move(rows), gesture.row, rules, commands);
  }
  return std::nullopt;
}

std::optional<RowsEdit> RowEditor::add(std::vector<Row> rows, const Row& row, const RowRules& rules, Commands& commands)
{
  const auto added = add_row(rows, row, rules);
  if (!added) {
    commands.push_back(command::Report{fmt::format("no {} was added: {}", rules.noun, refusal(rows, row, rules)), false});
    return std::nullopt;
  }
  marked_ = added;
  return RowsEdit{fmt::format("add a {}", rules.noun), std::move(rows)};
}

std::optional<RowsEdit> RowEditor::remove(std::vector<Row> rows, std::size_t index, const RowRules& rules, Commands& commands)
{
  if (!remove_row(rows, index, rules)) {
    commands.push_back(command::Report{fmt::format("no {} was removed: at least {} must stay", rules.noun, rules.fewest), false});
    return std::nullopt;
  }
  marked_.reset();
  removed_ = true;
  return RowsEdit{fmt::format("remove a {}", rules.noun), std::move(rows)};
}

} // namespace nephroid::ui
