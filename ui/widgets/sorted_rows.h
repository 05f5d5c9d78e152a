// SPDX-License-Identifier: Apache-2.0
// Rows of a wavelength and a value, by rising wavelength, that a person moves, adds and removes: the control points of a dispersion, the
// rows of a light's spectrum. No Dear ImGui here.
#pragma once
#include "preset/field.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace nephroid::ui {

using Row = std::array<double, 2>; ///< (nm, value)

/// What a preset may have, and a person wants to have, in one kind of rows.
struct RowRules {
  const char* noun = "row"; ///< "control point", for labels and messages
  preset::Bounds value;     ///< of the second number
  double least_gap_nm = 0;  ///< the least distance of neighbours, in nm, so that no wavelength gets two values
  std::size_t fewest = 0;   ///< so many stay
};

std::vector<Row> sorted_rows(std::vector<Row> rows);
/// One row to a new place: between its neighbours, and its value inside of the rules. A place that is not finite changes nothing; where
/// neighbours leave no room the wavelength stays.
void move_row(std::vector<Row>& rows, std::size_t index, const Row& to, const RowRules& rules);
/// The new row's index; nothing, and no change, where another is nearer than the least gap, the place is not finite, or there are as
/// many as a preset may have.
std::optional<std::size_t> add_row(std::vector<Row>& rows, Row row, const RowRules& rules);
/// False, and no change, where only the fewest are left.
bool remove_row(std::vector<Row>& rows, std::size_t index, const RowRules& rules);
/// The middle of the widest gap between neighbouring rows within 380..780 nm, whose ends count as rows.
double middle_of_widest_gap(const std::vector<Row>& rows);

} // namespace nephroid::ui
