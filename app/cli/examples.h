// SPDX-License-Identifier: Apache-2.0
// Examples in a help text. tests/docs runs each of them as it stands, one after the other.
#pragma once
#include <string>
#include <vector>

namespace nephroid::cli {

struct Example {
  std::string command; ///< with "nephroid"
  std::string says;    ///< may be empty
};

/// "Examples:", then a line each: what says is a comment, so that a line can be pasted into a shell.
std::string examples(const std::vector<Example>& list);

} // namespace nephroid::cli
