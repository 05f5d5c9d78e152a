// SPDX-License-Identifier: Apache-2.0
// Which dialog is open, and what waits for its answer: whatever would lose unsaved changes asks first.
#pragma once
#include "ui/state/document.h"

#include <optional>
#include <utility>

namespace nephroid::ui {

class Questions {
public:
  /// Both outlive it.
  Questions(const Document& document, Commands& follow_ups) : document_(document), follow_ups_(follow_ups) {}

  Question question() const { return question_; }
  /// With Question::unsaved: what waits for the answer, an Open, a New, a ReopenSession or a Quit that asks no more.
  /// Else null.
  const Command* waiting() const { return waiting_ ? &*waiting_ : nullptr; }
  bool quitting() const { return quitting_; }
  /// True once after ReopenSession.
  bool take_reopen() { return std::exchange(reopen_, false); }

  /// Whether the command waits for what becomes of unsaved changes. Then it asks no more.
  template <class C>
  bool asks_first(C c) {
    if (std::exchange(c.sure, true) || !document_.modified()) return false;
    waiting_ = std::move(c);
    question_ = Question::unsaved;
    return true;
  }
  /// Without an answer: what waited for one does not come any more.
  void close() {
    question_ = Question::none;
    waiting_.reset();
  }
  /// The changes are saved: what waited for that comes now.
  void go_on() {
    if (waiting_) follow_ups_.push_back(std::move(*waiting_));
    close();
  }
  void carry_out(const command::Ask& c) {
    question_ = c.question;
    if (question_ == Question::none) waiting_.reset(); // answered by "no"
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
