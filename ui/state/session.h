// SPDX-License-Identifier: Apache-2.0
// The state of the window as a file: the preset with its undo, how it is viewed, the pinned runs. A killed window is
// reopened with it. The settings are another file. ui/state/session_keeper.h writes and finds the files.
#pragma once
#include "ui/state/undo.h"
#include "ui/state/view_state.h"

namespace nephroid::ui {

struct Session {
  /// A pinned run, whose history and picture are separate files; or an opened picture, which stays where it is.
  struct Pin {
    std::string folder; ///< a run's, in the session's folder; or an opened picture's absolute path
    std::string name;
    std::uint32_t colour = 0; ///< IM_COL32
    bool shown = true;
    bool operator==(const Pin&) const = default;
  };
  static constexpr std::size_t most_entries = 100; ///< of undo; those around the current one are kept

  bool closed = false; ///< a person closed the window; else it ended in some other way
  std::optional<UndoStack::State> edits;
  ViewState view_state;
  std::vector<Pin> pins;
  bool operator==(const Session&) const = default;
};

/// Makes the text of a session. It keeps the text of each preset, so that the next one costs only what changed.
class SessionText {
public:
  std::string of(const Session& session);

private:
  struct Known;
  std::vector<std::shared_ptr<const Known>> known_;
};

/// The head of a session's text. The presets take longer to read.
struct SessionHeader {
  bool closed = false, has_preset = false;
};
/// Throws as parse_session.
SessionHeader parse_session_header(const std::string& text, const std::string& source);

/// Throws bad_input at source where the text is no session, is cut, or holds an invalid preset.
Session parse_session(const std::string& text, const std::string& source);

std::string to_json(const WindowSettings& settings);
/// Throws bad_input at source where the text is no settings, or holds an invalid value.
WindowSettings parse_settings(const std::string& text, const std::string& source);

} // namespace nephroid::ui
