// SPDX-License-Identifier: Apache-2.0
// What a verb prints with --json where it prints an object a line.
#pragma once
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::test {

/// Throws nlohmann::json::parse_error for a line that is no JSON.
inline std::vector<nlohmann::json> json_lines(const std::string& text)
{
  std::vector<nlohmann::json> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(nlohmann::json::parse(line));
  return all;
}

} // namespace nephroid::test
