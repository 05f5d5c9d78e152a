// SPDX-License-Identifier: Apache-2.0
// Which fields of a preset can be swept in the window, and the values that a person gives them: a range, or a list that is typed. No Dear
// ImGui here.
#pragma once
#include "preset/field.h"
#include "preset/preset.h"

#include <string>
#include <vector>

namespace nephroid::ui {

/// A field that holds a number.
struct NumberField {
  std::string key; ///< as for --set
  bool whole = false;
  preset::Bounds bounds;
  std::string sentence; ///< for a person
  std::string expected; ///< "a number from 0 to 1 W"
  double value = 0;     ///< now; of a field that is left out the lowest it may be, or 0
};

/// Every field of the preset that holds one number and that --set can name, in the order of the file.
std::vector<NumberField> number_fields(const preset::Preset& preset);

struct SweepRange {
  double from = 0, to = 1;
  int count = 5; ///< values, both ends among them
  bool logarithmic = false;
};

/// Each as JSON. Throws bad_input at the field's key: no value or more than 10000, an end that the field may not have or that is no number,
/// ends that a logarithm has not, values that are equal.
std::vector<std::string> range_values(const NumberField& field, const SweepRange& range);
/// Of numbers with commas or spaces between, typed as for --set. Throws as range_values.
std::vector<std::string> typed_values(const NumberField& field, const std::string& text);

} // namespace nephroid::ui
