// SPDX-License-Identifier: Apache-2.0
// Runs another program: no shell, text in and out, a time limit.
#pragma once
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::measure {

/// What the program (found on PATH) writes to its standard output when it reads `input`. Throws failed naming it: it is not installed,
/// a signal ended it, it failed (with the first line of its standard error) or was still at work after `limit` and was killed.
std::string run_program(const std::vector<std::string>& command, std::string_view input, std::chrono::milliseconds limit);

} // namespace nephroid::measure
