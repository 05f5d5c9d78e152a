// SPDX-License-Identifier: Apache-2.0
// JSON as text: strict parsing with the place of every error, and printing that people can read. Private to preset/,
// but for Json.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace nephroid::preset {

/// Keeps the order of keys: it is the order of a sweep's runs and of a written preset.
using Json = nlohmann::ordered_json;

/// Limits that keep hostile files harmless: reading stays fast and nothing recurses deeply.
inline constexpr std::size_t max_file_bytes = 8 << 20;
inline constexpr std::size_t max_depth = 64;
inline constexpr std::size_t max_keys = 1000;

/// Parses one JSON value. Throws bad_input: broken JSON, text that is not UTF-8 and numbers beyond a double at
/// SOURCE:LINE:COLUMN; a key given twice, too many keys or too deep nesting at SOURCE#/pointer.
Json parse_json(std::string_view text, const std::string& source);

/// The text with numbers as people type them (".02", "+3", "5.") as JSON writes them ("0.02", "3", "5"); all else,
/// strings too, as it is.
std::string with_json_numbers(std::string_view text);

bool is_utf8(std::string_view text);

/// Indented by two; lists of plain values and of pairs of numbers stay on one line each. Numbers read back exactly.
std::string pretty(const Json& value);

/// A JSON value as it reads in a message: short, one line, printable.
std::string shown(const Json& value);
/// Text of a user in single quotes: short, one line, printable.
std::string in_quotes(std::string_view text);

/// pointer/key, with the key printable, short and escaped (pointer_key).
std::string child(const std::string& pointer, std::string_view key);
std::string child(const std::string& pointer, std::size_t index);

} // namespace nephroid::preset
