// SPDX-License-Identifier: Apache-2.0
// Rows of (wavelength in nm, value): put in order, and straight lines between them; and the colour tables that are
// built into the program (app/optics/data, embedded by EmbedFiles.cmake), as columns of numbers.
#pragma once
#include "base/location.h"
#include "optics/dispersion.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::optics {

using Row = std::array<double, 2>;

/// What to do with a wavelength that is given twice with different values.
enum class Duplicates { refuse, mean };

/// The rows by rising wavelength, each wavelength once. Throws bad_input at `where` for no rows, a number that is not
/// finite, a wavelength that is not positive, or a repeat that is refused.
std::vector<Row> sorted_rows(std::span<const Row> rows, Duplicates repeats, const Location& where);

/// The widest step between neighbouring rows that reaches into low..high, where it is a hole in the data and not their
/// usual step: 20 nm of it lie there, and it is five times the median of four or more steps there. rows: sorted.
std::optional<std::array<double, 2>> gap_between(std::span<const Row> rows, double low_nm, double high_nm);

/// Straight lines between sorted rows; the end values are held outside.
class LinearTable {
public:
  explicit LinearTable(std::vector<Row> sorted) : rows_(std::move(sorted)) {}
  double operator()(double nm) const;
  double low() const { return rows_.front()[0]; }
  double high() const { return rows_.back()[0]; }
  std::span<const Row> rows() const { return rows_; }

private:
  std::vector<Row> rows_;
};

/// A table as a curve of n or k, with its range and its gap.
Curve curve_of(LinearTable table);

struct EmbeddedTable {
  std::string_view name; ///< the file's stem, e.g. "illuminants"
  std::string_view csv;
};
/// Generated at build time.
const std::vector<EmbeddedTable>& embedded_tables();

struct Table {
  std::vector<std::string> columns;        ///< without the first, the wavelength
  std::vector<double> nm;                  ///< rising
  std::vector<std::vector<double>> values; ///< one vector a column

  /// (nm, value) of one column.
  std::vector<Row> rows(std::size_t column) const;
};
/// Throws failed where the program carries no such table or its text is broken.
Table read_table(std::string_view name);

} // namespace nephroid::optics
