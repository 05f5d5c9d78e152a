// SPDX-License-Identifier: Apache-2.0
// JSON that the program writes.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include <string>

namespace nephroid {

/// The value as text, on one line or, with indent >= 0, on many. JSON is UTF-8 and file names may hold any bytes: what
/// is no UTF-8 becomes U+FFFD, and nothing is thrown.
std::string json_text(const nlohmann::ordered_json& value, int indent = -1);

} // namespace nephroid
