// SPDX-License-Identifier: Apache-2.0
// What a call refuses with.
#pragma once
#include "base/error.h"
#include "tests/support/test.h"

namespace nephroid::test {

/// The error that call throws; the test fails where it throws none.
template <class Call>
Error error_of(Call call)
{
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
std::string refusal_of(Call call)
{
  const Error error = error_of(call);
  EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.line();
  return error.line();
}

} // namespace nephroid::test
