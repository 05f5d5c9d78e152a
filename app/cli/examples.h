// SPDX-License-Identifier: Apache-2.0
// Examples in a help text. tests/docs runs each of them as it stands, one after the other.
#pragma once
#include <initializer_list>
#include <string>

namespace nephroid::cli {

struct Example {
  const char* command; ///< with "nephroid"
  const char* says;    ///< may be empty
};

/// "Examples:", then a line each: what says is a comment, so that a line can be pasted into a shell.
std::string examples(std::initializer_list<Example> list);

} // namespace nephroid::cli
