// SPDX-License-Identifier: Apache-2.0
// Messages to the person: errors stay until they are dismissed, notes disappear by themselves.
#pragma once
#include "base/error.h"
#include "ui/state/commands.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace nephroid::ui {

struct Message {
  std::uint64_t id = 0; ///< rises from 1
  bool error = true;
  std::string line;
  std::chrono::steady_clock::time_point since;
  ErrorKind kind = ErrorKind::failed; ///< the kind, where it is an error
  std::uint64_t said = 0;             ///< rises from 1, each time that any message is said
};

class Messages {
public:
  using Clock = std::chrono::steady_clock;

  const std::vector<Message>& all() const { return messages_; }
  /// The id of the newest message; 0 before the first.
  std::uint64_t newest() const { return newest_; }
  void note(std::string line) { say(false, std::move(line), ErrorKind::failed); }
  void error(std::string line, ErrorKind kind = ErrorKind::failed) { say(true, std::move(line), kind); }
  void error(const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    say(true, error.what(), known ? known->kind() : ErrorKind::failed);
  }
  void carry_out(const command::Dismiss& c) { dismiss(c.message); }
  void carry_out(const command::Report& c) { c.error ? error(c.line) : note(c.line); }
  void dismiss(std::uint64_t id) {
    std::erase_if(messages_, [&](const Message& m) { return m.id == id; });
  }
  /// Dismisses the errors up to this one: a preset opened since makes them void.
  void dismiss_errors_until(std::uint64_t id) {
    std::erase_if(messages_, [&](const Message& m) { return m.error && m.id <= id; });
  }
  /// Called once a frame: removes notes that were shown for long enough.
  void expire(Clock::time_point now) {
    constexpr std::chrono::seconds lifetime{6};
    std::erase_if(messages_, [&](const Message& m) { return !m.error && now - m.since > lifetime; });
  }

private:
  /// A repeated message (of a panel that fails every frame) appears once.
  void say(bool error, std::string line, ErrorKind kind) {
    const auto same =
        std::ranges::find_if(messages_, [&](const Message& m) { return m.line == line && m.error == error; });
    ++said_;
    if (same != messages_.end())
      same->said = said_;
    else
      messages_.push_back({++newest_, error, std::move(line), Clock::now(), kind, said_});
  }

  std::uint64_t newest_ = 0, said_ = 0;
  std::vector<Message> messages_;
};

} // namespace nephroid::ui
