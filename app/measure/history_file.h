// SPDX-License-Identifier: Apache-2.0
// history.csv: `seconds,wall_seconds,step,work,` then a column a metric, one row a measurement. Numbers round-trip; an
// undefined error is an empty cell. Noise floor, error column and measuring time are in run.json, not here.
#pragma once
#include "job/history.h"

#include <filesystem>

namespace nephroid::measure {

std::string to_csv(const job::History& history);
/// The columns and the rows, nothing else of History. Throws bad_input at FILE:LINE: empty, another first line, a column that is there
/// twice, a row with too few or too many cells or a last line without a line feed (a cut file), a cell that is no number, seconds that
/// fall.
job::History read_history(const std::filesystem::path& file);

} // namespace nephroid::measure
