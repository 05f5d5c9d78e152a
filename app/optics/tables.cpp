// SPDX-License-Identifier: Apache-2.0
#include "optics/tables.h"

#include "base/error.h"
#include "base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::optics {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

double number(std::string_view text, std::string_view table) {
  const auto value = number_in<double>(text);
  if (!value)
    throw failed(std::string(table), "the built-in table has a broken number", {},
                 "repair the file in app/optics/data");
  return *value;
}

/// Index i of the interval rows[i]..rows[i + 1], of one or more, that holds nm.
std::size_t interval(const std::vector<Row>& rows, double nm) {
  const auto above =
      std::upper_bound(rows.begin(), rows.end(), nm, [](double x, const Row& row) { return x < row[0]; });
  const auto index = static_cast<std::size_t>(above - rows.begin());
  return std::clamp<std::size_t>(index, 1, rows.size() - 1) - 1;
}

void check_row(const Row& row, const Location& where) {
  if (!std::isfinite(row[0]) || !std::isfinite(row[1]))
    throw bad_input(where, "a row holds a number that is not finite");
  if (!(row[0] > 0))
    throw bad_input(where, fmt::format("a row has the wavelength {} nm", row[0]), "expected a wavelength above 0");
}

} // namespace

std::vector<Row> sorted_rows(std::span<const Row> rows, Duplicates repeats, const Location& where) {
  if (rows.empty())
    throw bad_input(where, "the table is empty", "expected at least one row of (wavelength in nm, value)");
  for (const Row& row : rows) check_row(row, where);
  std::vector<Row> sorted(rows.begin(), rows.end());
  std::ranges::stable_sort(sorted, [](const Row& a, const Row& b) { return a[0] < b[0]; });

  std::vector<Row> unique;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    double sum = 0;
    for (end = begin; end < sorted.size() && sorted[end][0] == sorted[begin][0]; ++end) {
      if (repeats == Duplicates::refuse && sorted[end][1] != sorted[begin][1])
        throw bad_input(where,
                        fmt::format("{} nm is given twice, with the values {} and {}", sorted[end][0], sorted[begin][1],
                                    sorted[end][1]),
                        "expected each wavelength once");
      sum += sorted[end][1];
    }
    const bool once = end - begin == 1;
    unique.push_back({sorted[begin][0], once ? sorted[begin][1] : sum / static_cast<double>(end - begin)});
  }
  return unique;
}

std::optional<std::array<double, 2>> gap_between(std::span<const Row> rows, double low_nm, double high_nm) {
  std::vector<double> steps;
  std::array<double, 2> widest{0, 0};
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double from = rows[i][0], to = rows[i + 1][0];
    if (to <= low_nm || from >= high_nm) continue;
    steps.push_back(to - from);
    if (to - from > widest[1] - widest[0]) widest = {from, to};
  }
  if (steps.size() < 4) return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double inside = std::min(widest[1], high_nm) - std::max(widest[0], low_nm);
  return inside >= 20 && widest[1] - widest[0] >= 5 * *middle ? std::optional(widest) : std::nullopt;
}

double LinearTable::operator()(double nm) const {
  if (nm <= low()) return rows_.front()[1];
  if (nm >= high()) return rows_.back()[1];
  const std::size_t i = interval(rows_, nm);
  const Row &a = rows_[i], &b = rows_[i + 1];
  const double t = (nm - a[0]) / (b[0] - a[0]);
  return a[1] + t * (b[1] - a[1]);
}

std::vector<Row> Table::rows(std::size_t column) const {
  std::vector<Row> result(nm.size());
  for (std::size_t i = 0; i < nm.size(); ++i) result[i] = {nm[i], values[column][i]};
  return result;
}

Table read_table(std::string_view name) {
  const auto& shipped = embedded_tables();
  const auto embedded = std::ranges::find_if(shipped, [&](const EmbeddedTable& t) { return t.name == name; });
  if (embedded == shipped.end()) throw failed(std::string(name), "no such built-in table");

  Table table;
  for (std::string_view line : split(embedded->csv, '\n')) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.empty()) continue;
    const std::vector<std::string_view> fields = split(line, ',');
    if (table.columns.empty()) {
      table.columns.assign(fields.begin() + 1, fields.end());
      table.values.resize(table.columns.size());
      continue;
    }
    if (fields.size() != table.columns.size() + 1)
      throw failed(std::string(name), "the built-in table has a row of another length");
    table.nm.push_back(number(fields[0], name));
    for (std::size_t i = 1; i < fields.size(); ++i) table.values[i - 1].push_back(number(fields[i], name));
  }
  return table;
}

} // namespace nephroid::optics
