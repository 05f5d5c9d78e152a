// SPDX-License-Identifier: Apache-2.0
// What the program has to say to a person: errors stay until they are dismissed, notes go by themselves.
#pragma once
#include "base/error.h"

#include <chrono>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace nephroid::ui {

struct Message {
  std::uint64_t id = 0; ///< from 1, rising
  bool error = true;
  std::string line;
  std::chrono::steady_clock::time_point since;
  ErrorKind kind = ErrorKind::failed; ///< of an error
};

class Messages {
public:
  using Clock = std::chrono::steady_clock;

  const std::vector<Message>& all() const { return messages_; }
  /// Of the newest that was said; 0 before the first.
  std::uint64_t newest() const { return newest_; }
  void note(std::string line) { say(false, std::move(line), ErrorKind::failed); }
  void error(std::string line, ErrorKind kind = ErrorKind::failed) { say(true, std::move(line), kind); }
  void error(const std::exception& error);
  void dismiss(std::uint64_t id);
  /// Errors up to this one, which what was opened since makes void.
  void dismiss_errors_until(std::uint64_t id);
  /// Once a frame: notes that were there for long enough go.
  void expire(Clock::time_point now);

private:
  /// The same thing again (a panel that fails every frame) is one message.
  void say(bool error, std::string line, ErrorKind kind);

  std::uint64_t newest_ = 0;
  std::vector<Message> messages_;
};

} // namespace nephroid::ui
