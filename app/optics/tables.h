// SPDX-License-Identifier: Apache-2.0
// The colour tables that are built into the program (app/optics/data, embedded by EmbedFiles.cmake), as columns of numbers.
#pragma once
#include "optics/interpolation.h"

#include <string>
#include <string_view>
#include <vector>

namespace nephroid::optics {

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
