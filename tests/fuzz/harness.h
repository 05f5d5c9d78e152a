// SPDX-License-Identifier: Apache-2.0
// What the fuzzing harnesses share. A harness is one file: it reads an input, and says what good input looks like.
#pragma once
#include "base/error.h"
#include "tests/support/standard.h"

namespace nephroid::fuzz {

/// Of a harness. An Error of bad input, whose line is one line, is as good as an answer. Any other exception is a
/// finding; so are more than five seconds of processor time, which slow machines stay below.
void read(std::string_view input);
/// Of a harness: good inputs to begin with.
std::vector<std::string> seeds();

/// Ends the program; libFuzzer keeps the input.
[[noreturn]] void finding(const std::string& what);
/// A finding where the refusal is not as it should be.
void judge(const Error& refusal);

/// Whether the call ends without a refusal.
template <class Call>
bool accepts(Call call) {
  try {
    call();
    return true;
  } catch (const Error& refusal) {
    judge(refusal);
    return false;
  }
}

/// A folder of this process's own. What is in it is there for the next input, too.
const fs::path& folder();
/// A file in it.
fs::path write(const std::string& name, std::string_view bytes);

/// An input of several parts: they are joined by a line of this.
inline constexpr std::string_view between = "\n====\n";
std::vector<std::string> parts_of(std::string_view input);

/// What the files with this extension hold, of presets_folder()/NAME and the folders in it.
std::vector<std::string> shipped(const std::string& name, const std::string& extension);

} // namespace nephroid::fuzz
