// SPDX-License-Identifier: Apache-2.0
// What panels, menus and shortcuts ask for. They never change the workbench themselves: they push commands, which the workbench
// applies once every panel has drawn. That is why a test can read what a click meant.
#pragma once
#include "preset/preset.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace nephroid::ui {

/// How the picture is shown. Nothing here needs a new run.
struct Look {
  double exposure_stops = 0;          ///< -20..20
  bool fit = true;                    ///< the whole picture in the panel; zoom and centre are not used then
  double zoom = 1;                    ///< screen pixels a picture pixel
  std::array<double, 2> centre{0, 0}; ///< the picture's point, in pixels, that is at the panel's middle
  bool operator==(const Look&) const = default;
};

/// What a dialog is open for. unsaved: something waits for it (Workbench::waiting).
enum class Question { none, open, save_preset, save_picture, unsaved };

namespace command {

/// A preset file, or the name of a shipped preset. Asks first where there are unsaved changes, unless sure.
struct Open {
  std::string name;
  bool sure = false;
};
/// The preset as it shall be. Edits of one gesture (same number, not 0) make one entry to undo. live: the gesture still lasts,
/// so that a run may first show a picture before the next one replaces it.
struct Edit {
  std::string label;
  preset::Preset preset;
  std::uint64_t gesture = 0;
  bool live = false;
};
/// The mouse was let go: nothing holds the newest edit's run back any more.
struct EndGesture {};
struct Undo {};
struct Redo {};
struct Restart {};
struct Cancel {};
struct Pause {
  bool on = true;
};
struct SetLook {
  Look look;
};
struct Ask {
  Question question = Question::none;
};
struct SavePreset {
  std::filesystem::path file;
};
/// .png: as shown; .exr: linear, with layers.
struct SavePicture {
  std::filesystem::path file;
};
struct Dismiss {
  std::uint64_t message = 0;
};
struct ShowHelp {
  bool on = true;
};
struct ResetLayout {};
/// From a panel that could not go on: becomes a message.
struct Report {
  std::string line;
};
/// Asks first where there are unsaved changes, unless sure.
struct Quit {
  bool sure = false;
};

} // namespace command

using Command = std::variant<command::Open, command::Edit, command::EndGesture, command::Undo, command::Redo, command::Restart,
                             command::Cancel, command::Pause, command::SetLook, command::Ask, command::SavePreset, command::SavePicture,
                             command::Dismiss, command::ShowHelp, command::ResetLayout, command::Report, command::Quit>;
using Commands = std::vector<Command>;

} // namespace nephroid::ui
