// SPDX-License-Identifier: Apache-2.0
// The one kind of error of the whole program: what went wrong, where, and what to do, as one line.
#pragma once
#include "base/location.h"

#include <stdexcept>

namespace nephroid {

/// The values are the exit codes of the command line.
enum class ErrorKind { failed = 1, bad_input = 2, no_device = 3, interrupted = 130 };

/// Every failure throws this. It is caught at the edge (a verb, the worker, a panel) and shown as line().
class Error : public std::runtime_error {
public:
  /// what: what is wrong. expected, remedy: what is expected and what to do; either may be empty.
  Error(ErrorKind kind, Location location, std::string what, std::string expected = {}, std::string remedy = {});

  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }
  const Location& location() const { return location_; }
  /// "PLACE: what is wrong; what is expected; what to do", always one line, without the program's name.
  std::string line() const { return what(); }
  /// The line without "PLACE: ".
  const std::string& text() const { return text_; }

  Error at(Location location) const { return Error(kind_, std::move(location), text_); }
  /// The same error with a note at the end of its line.
  Error noting(std::string note) const { return Error(kind_, location_, text_, std::move(note)); }

private:
  ErrorKind kind_;
  Location location_;
  std::string text_;
};

inline Error bad_input(Location location, std::string what, std::string expected = {}, std::string remedy = {}) {
  return Error(ErrorKind::bad_input, std::move(location), std::move(what), std::move(expected), std::move(remedy));
}

inline Error failed(Location location, std::string what, std::string expected = {}, std::string remedy = {}) {
  return Error(ErrorKind::failed, std::move(location), std::move(what), std::move(expected), std::move(remedy));
}

} // namespace nephroid
