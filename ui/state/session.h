// SPDX-License-Identifier: Apache-2.0
// What the window is at, as a file: the preset with its undo, how it is looked at, the pinned runs. A window that was
// killed is opened again with it. And its settings, as another. ui/state/session_keeper.h writes and finds the files.
#pragma once
#include "ui/state/commands.h"
#include "ui/state/undo.h"
#include "ui/state/view_state.h"

namespace nephroid::ui {

struct Session {
  /// A pinned run: its history and picture are files of their own. Or a picture that was opened, which stays where it
  /// is.
  struct Pin {
    std::string
        folder; ///< in the session's folder: a name that measure reads as a run's; of a picture its file, absolute
    std::string name;
    std::uint32_t colour = 0; ///< IM_COL32
    bool shown = true;
    bool operator==(const Pin&) const = default;
  };
  static constexpr std::size_t most_entries = 100; ///< of undo: those about the current one are kept

  bool closed = false; ///< by a person; else the window ended in some other way
  std::optional<UndoStack::State> edits;
  ViewState view_state;
  std::vector<Pin> pins;
  bool operator==(const Session&) const = default;
};

/// Makes the text of a session. Keeps what it made of each preset, so that the next text costs only what changed.
class SessionText {
public:
  std::string of(const Session& session);

private:
  struct Known;
  std::vector<std::shared_ptr<const Known>> known_;
};

/// What a session's text says of itself, without its presets, which take longer to read.
struct SessionHeader {
  bool closed = false, has_preset = false;
};
/// Throws as parse_session.
SessionHeader parse_session_header(const std::string& text, const std::string& source);

/// Throws bad_input at source where the text is no session, is cut, or holds a preset that cannot be.
Session parse_session(const std::string& text, const std::string& source);

std::string to_json(const Settings& settings);
/// Throws bad_input at source where the text is no settings, or holds a value that the window cannot have.
Settings parse_settings(const std::string& text, const std::string& source);

} // namespace nephroid::ui
