// SPDX-License-Identifier: Apache-2.0
// The command palette: every action and every shipped preset in one list, found by some of the letters of its name. The keyboard alone is
// enough: type, up and down, Enter.
#pragma once
#include "ui/state/context.h"
#include "ui/widgets/action.h"

#include <functional>
#include <string>
#include <vector>

namespace nephroid::ui {

class Palette {
public:
  struct Entry {
    std::string name, help, keys;
    const Action* action = nullptr; ///< null: run does it, always
    std::function<void(const Context&)> run;
  };

  /// shown: whether it is open (Question::command).
  void draw(const Context& context, bool shown);
  /// Those that fit what is typed, the best first; for tests.
  const std::vector<const Entry*>& matches() const { return matches_; }

private:
  void begin();
  void search();
  void draw_entries(const Context& context);
  void choose(const Entry& entry, const Context& context) const;

  bool shown_ = false;
  std::string typed_;
  std::vector<Entry> entries_; ///< made when it opens
  std::vector<const Entry*> matches_;
  std::size_t selected_ = 0; ///< of matches_
};

} // namespace nephroid::ui
