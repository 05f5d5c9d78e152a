// SPDX-License-Identifier: Apache-2.0
// Numbers of things in sentences.
#pragma once
#include <concepts>
#include <string>

namespace nephroid {

/// "1 pass", "2 passes", "0 passes". `many` is the plural if it is not `one` with an s.
template <std::integral Number>
std::string counted(Number count, const std::string& one, const std::string& many = {}) {
  return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

} // namespace nephroid
