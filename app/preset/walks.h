// SPDX-License-Identifier: Apache-2.0
// What is done with a value by walking over its description. Private to preset/.
#pragma once
#include "preset/json_text.h"
#include "preset/origins.h"
#include "preset/value.h"

namespace nephroid::preset {

class Document;
struct Preset;

/// Strictly: every key must be known, of the right type and in range. Throws bad_input.
void read(const Document& document, Preset& preset);

/// Complete, in the order of describe.
Json as_json(const Value& value);
/// The same of a field's value, where there may be a word for none.
Json as_json(const Member& member);

/// What a field of this type wants, in words: "a number from 0 to 1", "a list of 1 to 16 items, each a string".
std::string expected(const Field& field, const ValueType& type);
std::string expected_number(const Field& field);
/// "1 to 16 items", "at most 2 items"
std::string expected_count(const Count& count);

/// The name that means from `folder` what `name` means from `own_folder`: name itself where both find the same file (or
/// neither finds any), else an absolute path.
std::string name_from(const std::filesystem::path& folder, const std::string& name,
                      const std::filesystem::path& own_folder);

/// The name that means to `main`, a preset's file, what `name` means where it was given: a typed one in the current
/// folder, unless there is no such file.
std::string name_given(const Origin& main, const std::string& name, const Origin& origin);

/// The preset as it reads from another folder.
Preset moved_to(Preset preset, const std::filesystem::path& folder);

} // namespace nephroid::preset
