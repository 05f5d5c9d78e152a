// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/rows.h"

#include "optics/wavelength.h"
#include "preset/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::ui {
namespace {

bool is_finite(const Row& row) { return std::isfinite(row[0]) && std::isfinite(row[1]); }

double inside(double value, const preset::Bounds& bounds) { return std::clamp(value, bounds.low, bounds.high); }

/// A sum or difference as a person writes it, not with 17 figures: 500.3 + 0.1 is 500.40000000000003, 500.4 - 500.3 is less than 0.1.
double readable_nm(double nm) { return std::round(1e6 * nm) / 1e6; }

bool before(const Row& a, const Row& b) { return a[0] < b[0]; }

/// Why add_row adds nothing.
std::string refusal(const std::vector<Row>& rows, const Row& row, const RowRules& rules)
{
  if (rows.size() >= preset::max_rows) return fmt::format("a preset has at most {} rows", preset::max_rows);
  if (!std::isfinite(row[0]) || !std::isfinite(row[1])) return "its place is not finite";
  const double nm = std::clamp(row[0], preset::wavelength_bounds.low, preset::wavelength_bounds.high);
  return fmt::format("another is less than {} nm from {:.6g} nm", rules.least_gap_nm, nm);
}

} // namespace

std::vector<Row> sorted_rows(std::vector<Row> rows)
{
  std::stable_sort(rows.begin(), rows.end(), before);
  return rows;
}

void move_row(std::vector<Row>& rows, std::size_t index, const Row& to, const RowRules& rules)
{
  if (index >= rows.size() || !is_finite(to)) return;
  rows[index][1] = inside(to[1], rules.value);
  const double low = index > 0 ? readable_nm(rows[index - 1][0] + rules.least_gap_nm) : preset::wavelength_bounds.low;
  const double high = index + 1 < rows.size() ? readable_nm(rows[index + 1][0] - rules.least_gap_nm) : preset::wavelength_bounds.high;
  if (low <= high) rows[index][0] = std::clamp(to[0], low, high); // neighbours of a file may be nearer than that: then it stays
}

std::optional<std::size_t> add_row(std::vector<Row>& rows, Row row, const RowRules& rules)
{
  if (!is_finite(row) || rows.size() >= preset::max_rows) return std::nullopt;
  row = {inside(row[0], preset::wavelength_bounds), inside(row[1], rules.value)};
  const auto right = std::upper_bound(rows.begin(), rows.end(), row, before);
  const auto too_near = [&](const Row& a, const Row& b) { return readable_nm(b[0] - a[0]) < rules.least_gap_nm; };
  if (right != rows.begin() && too_near(*std::prev(right), row)) return std::nullopt;
  if (right != rows.end() && too_near(row, *right)) return std::nullopt;
  const auto added = rows.insert(right, row);
  return static_cast<std::size_t>(added - rows.begin());
}

bool remove_row(std::vector<Row>& rows, std::size_t index, const RowRules& rules)
{
  if (rows.size() <= rules.fewest || index >= rows.size()) return false;
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(index));
  return true;
}

double middle_of_widest_gap(const std::vector<Row>& rows)
{
  double from = optics::first_nm, widest = 0, middle = from;
  const auto look = [&](double to) {
    if (to - from > widest) {
      widest = to - from;
      middle = (from + to) / 2;
    }
    from = to;
  };
  for (const Row& row : rows)
    if (row[0] > optics::first_nm && row[0] < optics::last_nm) look(row[0]);
  look(optics::last_nm);
  return middle;
}

void RowEditor::keep(std::size_t rows)
{
  removed_ = false;
  if (marked_ && *marked_ >= rows) marked_.reset();
}

std::optional<RowsEdit> RowEditor::follow(const RowGesture& gesture, std::vector<Row> rows, const RowRules& rules, Commands& commands)
{
  using Kind = RowGesture::Kind;
  const Row to = rules.readable ? rules.readable(gesture.to) : gesture.to;
  const auto refuse = [&](const char* what, const std::string& why) {
    commands.push_back(command::Report{fmt::format("no {} was {}: {}", rules.noun, what, why), false});
  };
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
    move_row(rows, gesture.row, to, rules);
    if (rows != before) return RowsEdit{fmt::format("move a {}", rules.noun), std::move(rows), gestures_.number(), true};
    break;
  }
  case Kind::let_go:
    commands.push_back(command::EndGesture{});
    break;
  case Kind::add:
    if (const auto added = add_row(rows, to, rules)) {
      marked_ = added;
      return RowsEdit{fmt::format("add a {}", rules.noun), std::move(rows)};
    }
    refuse("added", refusal(rows, to, rules));
    break;
  case Kind::remove:
    if (remove_row(rows, gesture.row, rules)) {
      marked_.reset();
      removed_ = true;
      return RowsEdit{fmt::format("remove a {}", rules.noun), std::move(rows)};
    }
    refuse("removed", fmt::format("at least {} must stay", rules.fewest));
    break;
  }
  return std::nullopt;
}

} // namespace nephroid::ui
