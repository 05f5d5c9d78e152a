// SPDX-License-Identifier: Apache-2.0
// JSON that the program writes.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include <string>

namespace nephroid {

/// The value as text, on one line, or on many with indent >= 0. JSON is UTF-8, but file names may hold any bytes:
/// invalid UTF-8 becomes U+FFFD, and nothing is thrown.
std::string json_text(const nlohmann::ordered_json& value, int indent = -1);

} // namespace nephroid
