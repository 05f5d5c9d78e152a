// SPDX-License-Identifier: Apache-2.0
// What every test uses: GoogleTest and the names of its matchers, fmt, the standard library, the names of tests/support
// without `test::`; what a call refuses with, a folder of a test's own, waiting for others.
#pragma once
#include "base/error.h"
#include "base/files.h"
#include "tests/support/standard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace nephroid::test {

/// The error that call throws; the test fails where it throws none.
template <class Call>
Error error_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error was thrown";
  return failed("", "");
}

/// The line of the error, which must be of bad input.
template <class Call>
std::string refusal_of(Call call) {
  const Error error = error_of(call);
  EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.line();
  return error.line();
}

/// Gone when the test ends.
class TemporaryFolder {
public:
  TemporaryFolder() {
    static int count = 0;
    path_ =
        fs::path(testing::TempDir()) / ("nephroid-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    fs::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }
  /// Writes a file into it, or into a folder below it, and hands back the file's path.
  std::string write(const std::string& name, std::string_view bytes) const {
    fs::create_directories((path_ / name).parent_path());
    write_file_whole(path_ / name, bytes);
    return (path_ / name).string();
  }

private:
  fs::path path_;
};

/// Waits for what another thread or process does, until it is seen and not for a time that a slow machine would need:
/// calls step() and rests for a moment in turn until done(); says whether it was done before five minutes were over,
/// which no machine needs.
template <class Step, class Done>
bool eventually(Step step, Done done) {
  using namespace std::chrono;
  const auto end = steady_clock::now() + minutes(5);
  while (!done()) {
    if (steady_clock::now() > end) return false;
    step();
    std::this_thread::sleep_for(microseconds(200));
  }
  return true;
}

/// The same where there is nothing to do but wait.
template <class Done>
bool eventually(Done done) {
  return eventually([] {}, done);
}

} // namespace nephroid::test

namespace nephroid {

using namespace test;
using testing::AllOf, testing::AnyOf, testing::Contains, testing::DoubleNear, testing::Each, testing::ElementsAre,
    testing::ElementsAreArray, testing::EndsWith, testing::FloatNear, testing::Ge, testing::Gt, testing::HasSubstr,
    testing::IsEmpty, testing::IsSupersetOf, testing::Le, testing::Lt, testing::Not, testing::Optional,
    testing::Pointwise, testing::SizeIs, testing::StartsWith, testing::UnorderedElementsAre;

} // namespace nephroid
