// SPDX-License-Identifier: Apache-2.0
// The files of a run read back: JSON, with the place of what is missing or of another type, and its error history.
#pragma once
#include "job/history.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace nephroid::measure {

class RunDocument {
public:
  enum class Type { text, number, whole, flag, list, object, numbers };

  /// Throws bad_input naming the file: missing, empty, cut, no JSON, no object, nested too deep.
  explicit RunDocument(const std::filesystem::path& file);

  const nlohmann::ordered_json& json() const { return json_; }
  bool has(const std::string& pointer) const { return json_.contains(nlohmann::ordered_json::json_pointer(pointer)); }
  /// The member at a JSON pointer. `whole`: from 0. `numbers`: an object of numbers, null where one is undefined.
  /// Throws bad_input at FILE#POINTER where it is missing or is none of its type.
  const nlohmann::ordered_json& at(const std::string& pointer, Type type) const;

private:
  std::string place_;
  nlohmann::ordered_json json_;
};

/// The folder's history.csv (read_history), with what its run.json, where there is one, says of the reference:
/// noise_floor and error_column. Throws bad_input as both do.
job::History read_run_history(const std::filesystem::path& folder);

/// history.csv: `seconds,wall_seconds,step,work,` then a column a metric, one row a measurement. Numbers round-trip; an
/// undefined error is an empty cell. Noise floor, error column and measuring time are in run.json, not here.
std::string to_csv(const job::History& history);
/// The columns and the rows, nothing else of History. Throws bad_input at FILE:LINE: empty, another first line, a
/// column that is there twice, a row with too few or too many cells or a last line without a line feed (a cut file), a
/// cell that is no number, seconds that fall.
job::History read_history(const std::filesystem::path& file);

} // namespace nephroid::measure
