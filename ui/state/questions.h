// SPDX-License-Identifier: Apache-2.0
// Which dialog is open, and which command waits for its answer. Commands that would lose unsaved changes ask first.
#pragma once
#include "ui/state/document.h"

#include <optional>
#include <utility>

namespace nephroid::ui {

class Questions {
public:
  /// document and follow_ups outlive the object.
  Questions(const Document& document, Commands& follow_ups) : document_(document), follow_ups_(follow_ups) {}

  Question question() const { return question_; }
  /// The command that waits with Question::unsaved: an Open, a New, a ReopenSession or a Quit, which asks no more. Else
  /// null.
  const Command* waiting() const { return waiting_ ? &*waiting_ : nullptr; }
  bool quitting() const { return quitting_; }
  /// True once after ReopenSession.
  bool take_reopen() { return std::exchange(reopen_, false); }

  /// Holds the command back until unsaved changes are settled; returns whether it did. The command asks no more then.
  template <class C>
  bool asks_first(C c) {
    if (std::exchange(c.sure, true) || !document_.modified()) return false;
    waiting_ = std::move(c);
    question_ = Question::unsaved;
    return true;
  }
  /// Closes the dialog without an answer; the waiting command is dropped.
  void close() {
    question_ = Question::none;
    waiting_.reset();
  }
  /// The changes are saved: the waiting command is carried out.
  void go_on() {
    if (waiting_) follow_ups_.push_back(std::move(*waiting_));
    close();
  }
  void carry_out(const command::Ask& c) {
    question_ = c.question;
    if (question_ == Question::none) waiting_.reset(); // the answer was "no"
  }
  void carry_out(const command::ReopenSession& c) { reopen_ |= !asks_first(c); }
  void carry_out(const command::Quit& c) { quitting_ |= !asks_first(c); }

private:
  const Document& document_;
  Commands& follow_ups_;
  Question question_ = Question::none;
  std::optional<Command> waiting_;
  bool quitting_ = false, reopen_ = false;
};

} // namespace nephroid::ui
