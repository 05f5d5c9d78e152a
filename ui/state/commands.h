// SPDX-License-Identifier: Apache-2.0
// What panels, menus and shortcuts ask for. They never change the workbench themselves: they push commands, which the workbench
// applies once every panel has drawn. That is why a test can read what a click meant.
#pragma once
#include "measure/difference.h"
#include "preset/preset.h"
#include "ui/state/settings.h"

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

/// What the View holds the run's picture against, and how. Nothing here needs a new run.
struct Comparison {
  std::uint64_t pin = 0;   ///< a pinned run (PinnedRun::id); 0: the reference
  bool flip = false;       ///< the other picture is shown in place of the run's
  bool difference = false; ///< a map of their difference is shown; flip goes before it
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0; ///< the value at the end of the map's colours; 0: measure::colour_scale
  bool operator==(const Comparison&) const = default;
};

/// What a dialog is open for. unsaved: something waits for it (Workbench::waiting).
enum class Question { none, open, open_history, save_preset, save_picture, unsaved, command };

namespace command {

/// A preset file, or the name of a shipped preset: asks first where there are unsaved changes, unless sure. A run's folder or a table
/// (.csv) is pinned as PinFile does; dispersion data (.yml) is loaded as LoadDispersion does.
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
/// Parts of the Comparison, one command each: two keys in one frame must not undo each other.
struct Flip {
  bool on = true;
};
struct CompareWith {
  std::uint64_t pin = 0; ///< as Comparison::pin
};
struct ShowDifference {
  bool on = true;
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0; ///< as Comparison::scale
};
/// Keeps the history and the picture of the run as they are now.
struct PinRun {};
/// The history of an earlier run: history.csv, or its folder, whose image.exr is then kept too. Read in the background.
struct PinFile {
  std::filesystem::path path;
};
struct ChangePin {
  std::uint64_t pin = 0;
  std::string name;         ///< empty: stays as it was
  std::uint32_t colour = 0; ///< IM_COL32
  bool shown = true;        ///< in the plot
};
struct Unpin {
  std::uint64_t pin = 0;
};
/// Which error the plot of error against time shows: a name of measure/metrics.h, with "masked_" for that of the mask.
struct ChooseMetric {
  std::string metric;
};
/// Which dielectric of the preset the panel "Dispersion" shows; its name among the materials.
struct ChooseMaterial {
  std::string material;
};
/// Loads a refractiveindex.info file (a path, or the name of a shipped material) into the dielectric that is shown: one edit.
struct LoadDispersion {
  std::string file;
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
/// Writes the files that the run made (job::Snapshot::files) into a folder, in the background, and then opens one of them.
struct SaveFiles {
  std::filesystem::path folder;
  std::string open; ///< a preset's name among them
};
struct Dismiss {
  std::uint64_t message = 0;
};
/// What the window was at that was closed, or killed, last: asks first where there are unsaved changes, unless sure.
struct ReopenSession {
  bool sure = false;
};
struct ToggleHelp {};
/// The panels of the engine in hand where they were at first, all of them open.
struct ResetLayout {};
/// What a person made of the layout for the presets of an engine.
struct KeepLayout {
  std::string engine;
  Layout layout;
};
/// Opens a panel and brings it to the front, or closes it.
struct ShowPanel {
  std::string name; ///< shell/panels.h
  bool on = true;
};
struct SetAppearance {
  Theme theme = Theme::dark;
  double text_size = 1; ///< Settings::smallest_text..largest_text; beyond it stays at the end
};
/// Becomes a message: an error from a panel that could not go on, or a note that goes by itself.
struct Report {
  std::string line;
  bool error = true;
};
/// Asks first where there are unsaved changes, unless sure.
struct Quit {
  bool sure = false;
};

} // namespace command

using Command =
    std::variant<command::Open, command::Edit, command::EndGesture, command::Undo, command::Redo, command::Restart, command::Cancel,
                 command::Pause, command::SetLook, command::Flip, command::CompareWith, command::ShowDifference, command::PinRun,
                 command::PinFile, command::ChangePin, command::Unpin, command::ChooseMetric, command::ChooseMaterial,
                 command::LoadDispersion, command::Ask, command::SavePreset, command::SavePicture, command::SaveFiles, command::Dismiss,
                 command::ReopenSession, command::ToggleHelp, command::ResetLayout, command::KeepLayout, command::ShowPanel,
                 command::SetAppearance, command::Report, command::Quit>;
using Commands = std::vector<Command>;

} // namespace nephroid::ui
