// SPDX-License-Identifier: Apache-2.0
// The one kind of error of the whole program: what went wrong, where, and what to do, as one line.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace nephroid {

/// The values are the exit codes of the command line (contract.md).
enum class ErrorKind { failed = 1, bad_input = 2, no_device = 3, interrupted = 130 };

/// Thrown everywhere; caught at the edge (a verb, the worker, a panel) and shown as line().
class Error : public std::runtime_error {
public:
  /// where: a file, FILE:LINE, FILE#/json/pointer, a command line option, a kernel or a call; may be empty.
  /// what: what is wrong. expected, remedy: what is expected, what to do; either may be empty.
  Error(ErrorKind kind, std::string where, std::string what, std::string expected = {}, std::string remedy = {});

  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }
  const std::string& where() const { return where_; }
  /// "WHERE: what is wrong; what is expected; what to do", always one line, without the program's name.
  std::string line() const { return what(); }
  /// The line without "WHERE: ".
  std::string text() const { return line().substr(where_.empty() ? 0 : where_.size() + 2); }

  /// The same error at another place.
  Error at(std::string where) const { return Error(kind_, std::move(where), text()); }
  /// The same error with one more thing said at the end of its line.
  Error noting(std::string note) const { return Error(kind_, where_, text(), std::move(note)); }

private:
  ErrorKind kind_;
  std::string where_;
};

inline Error bad_input(std::string where, std::string what, std::string expected = {}, std::string remedy = {})
{
  return Error(ErrorKind::bad_input, std::move(where), std::move(what), std::move(expected), std::move(remedy));
}

inline Error failed(std::string where, std::string what, std::string expected = {}, std::string remedy = {})
{
  return Error(ErrorKind::failed, std::move(where), std::move(what), std::move(expected), std::move(remedy));
}

} // namespace nephroid
