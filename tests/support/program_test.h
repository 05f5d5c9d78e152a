// SPDX-License-Identifier: Apache-2.0
// A test that runs the program in an empty folder, and what every refusal of it has in common.
#pragma once
#include "tests/support/child.h"

#include <nlohmann/json.hpp>

namespace nephroid::test {

class ProgramTest : public testing::Test {
protected:
  ProgramTest() { fs::create_directory(folder); }

  TemporaryFolder scratch;
  fs::path folder = scratch.path() / "here", logs = scratch.path();

  Ended run(const std::vector<std::string>& arguments, const Environment& environment = {}) const {
    return nephroid(arguments, folder, logs, environment);
  }
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  std::string bytes(const std::string& file) const { return read_file(folder / file); }
  nlohmann::json of(const std::string& file) const { return nlohmann::json::parse(bytes(file)); }
};

/// What a verb prints with --json where it prints an object a line. Throws nlohmann::json::parse_error for a line that
/// is no JSON.
inline std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

/// What a run says on standard error, but for its progress: a line every three seconds, so that their number hangs on
/// the machine.
inline std::vector<std::string> messages_of(const Ended& ended) {
  static const std::regex progress(R"(.*\] +\d+ %  .*)");
  std::vector<std::string> lines;
  std::istringstream stream(ended.err);
  for (std::string line; std::getline(stream, line);)
    if (!std::regex_match(line, progress)) lines.push_back(line);
  return lines;
}

/// A command line that is refused.
struct Wrong {
  std::vector<std::string> arguments;
  std::string says; ///< part of the line
  int exit_code = 2;
};

/// One line on standard error, nothing on standard output.
inline void expect_one_line(const Ended& ended) {
  EXPECT_THAT(ended.err, StartsWith("nephroid: "));
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(ended.out, "");
}

/// ended: of wrong.arguments.
inline void expect_refused(const Ended& ended, const Wrong& wrong) {
  std::string line = wrong.says + ":";
  for (const std::string& argument : wrong.arguments) line += " '" + argument + "'";
  SCOPED_TRACE(line);
  EXPECT_EQ(ended.exit_code, wrong.exit_code) << ended.err;
  expect_one_line(ended);
  EXPECT_THAT(ended.err, HasSubstr(wrong.says));
}

} // namespace nephroid::test
