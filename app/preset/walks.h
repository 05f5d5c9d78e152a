// SPDX-License-Identifier: Apache-2.0
// What is done with a value by walking over its description. Private to preset/.
#pragma once
#include "preset/json_text.h"
#include "preset/value.h"

#include <string>
#include <string_view>
#include <vector>

namespace nephroid::preset {

class Document;
struct Preset;

/// Strictly: every key must be known, of the right type and in range. Throws bad_input.
void read(const Document& document, Preset& preset);

/// Complete, in the order of describe.
Json as_json(const Value& value);

/// What a field of this type wants, in words: "a number from 0 to 1", "a list of 1 to 16 items, each a string".
std::string expected(const Field& field, const ValueType& type);
std::string expected_number(const Bounds& bounds, std::string_view unit);
/// "1 to 16 items", "at most 2 items"
std::string expected_count(const Count& count);

} // namespace nephroid::preset
