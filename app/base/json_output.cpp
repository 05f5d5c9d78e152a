// SPDX-License-Identifier: Apache-2.0
#include "base/json_output.h"

#include <nlohmann/json.hpp>

namespace nephroid {

std::string json_text(const nlohmann::ordered_json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace nephroid
