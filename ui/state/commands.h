// SPDX-License-Identifier: Apache-2.0
// What panels, menus and shortcuts ask for. They never change the workbench themselves: they push commands, which the
// workbench applies once every panel has drawn. That is why a test can read what a click meant.
#pragma once
#include "measure/difference.h"
#include "preset/preset.h"
#include "preset/read.h"
#include "ui/state/selection.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace nephroid::ui {

/// How linear values become what a display shows. standard: as image.png. filmic: for a wide range (state/tone.h).
/// false_colour: of the luminance, logarithmic; exposure plays no part.
enum class ToneCurve { standard, filmic, false_colour };
inline constexpr int tone_curves = 3;

/// The luminance at the two ends of false colour.
struct LuminanceRange {
  double low = 0, high = 0; ///< W/m^2/sr, 0 < low < high
  bool operator==(const LuminanceRange&) const = default;
};

/// How the picture is shown. Nothing here needs a new run.
struct ViewSettings {
  double exposure_stops = 0; ///< -20..20
  ToneCurve tone = ToneCurve::standard;
  std::optional<LuminanceRange> false_colour = {}; ///< nothing: automatic_range of what is shown
  bool fit = true;                    ///< the whole picture in the panel; zoom and centre are not used then
  double zoom = 1;                    ///< screen pixels a picture pixel
  std::array<double, 2> centre{0, 0}; ///< the picture's point, in pixels, that is at the panel's middle
  bool operator==(const ViewSettings&) const = default;
};

/// How the View shows two pictures. split: both in one place, cut at a line that is dragged.
enum class Arrangement { single, split, side_by_side };

/// What the View shows, what it holds that against, and how. Nothing here needs a new run.
struct Comparison {
  static constexpr std::uint64_t run_in_hand = ~std::uint64_t{0};

  std::uint64_t shown = 0; ///< a pinned run or picture (PinnedRun::id); 0: the run in hand
  std::uint64_t pin = 0;   ///< what that is compared with: the same, or run_in_hand; 0: the reference
  Arrangement arrangement = Arrangement::single;
  double split = 0.5;      ///< where the line is, in parts of the picture's area of the panel, 0..1
  bool flip = false;       ///< the other picture is shown in place of the first
  bool difference = false; ///< a map of their difference is shown; flip goes before it
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0;  ///< the value at the end of the map's colours; 0: measure::colour_scale
  std::string layer; ///< of both pictures; empty: all of their light
  bool operator==(const Comparison&) const = default;
  /// Whether the distance of the two is wanted.
  bool measures() const { return shown != 0 || difference || arrangement != Arrangement::single; }
};

/// Pixels of the picture: from a column and row to before another.
struct PixelRegion {
  std::array<int, 2> from{0, 0}, to{0, 0};
  bool operator==(const PixelRegion&) const = default;
};

// How a person set up the window: kept between runs of the program in one file.
enum class Theme { dark, light };

/// For the presets of one engine.
struct EngineLayout {
  std::string ini; ///< where the panels are, in Dear ImGui's words; empty: where the engine begins with them
  std::set<std::string> closed; ///< names of panels (shell/panels.h)
  bool operator==(const EngineLayout&) const = default;
};

struct Settings {
  static constexpr double smallest_text = 0.6, largest_text = 3;

  Theme theme = Theme::dark;
  double text_size = 1;                        ///< times the display's own scale; smallest_text..largest_text
  std::map<std::string, EngineLayout> engines; ///< by an engine's name
  bool operator==(const Settings&) const = default;
};

/// What a dialog is open for. unsaved: something waits for it (Workbench::waiting).
enum class Question {
  none,
  open,
  open_history,
  open_pictures,
  open_map,
  save_preset,
  save_picture,
  unsaved,
  command,
  save_report
};

namespace command {

/// A preset file, or the name of a shipped preset: asks first where there are unsaved changes, unless sure. A run's
/// folder or a table
/// (.csv) is pinned as PinFile does; dispersion data (.yml) is loaded as LoadDispersion does. A map (.exr, .hdr)
/// becomes the environment, a picture what the engine makes of it, else it is opened as PinFile does; a mesh an object,
/// glTF a preset of its own.
struct Open {
  std::string name;
  bool sure = false;
};
/// A latitude-longitude picture becomes the environment: one edit.
struct OpenMap {
  std::string file;
};
/// A scene to begin with, in no file; asks first as Open does.
struct New {
  std::string preset; ///< as JSON
  bool sure = false;
};
/// The preset as it shall be. Edits of one gesture (same number, not 0) make one entry to undo. live: the gesture still
/// lasts, so that a run may first show a picture before the next one replaces it.
struct Edit {
  std::string label;
  preset::Preset preset;
  std::uint64_t gesture = 0;
  bool live = false;
  bool was_read = false; ///< by the reader of presets: it has nothing to refuse
};
/// The sweep as it shall be: which fields take which values. An edit to undo; the run goes on, as its preset is the
/// same.
struct SetSweep {
  std::string label;
  preset::Sweep sweep;
};
/// The sweep's runs one after the other in place of the run in hand (sweep_queue.h), and an end of that.
struct StartSweep {};
struct StopSweep {};
/// The mouse was let go: nothing holds the newest edit's run back any more.
struct EndGesture {};
struct Undo {};
struct Redo {};
struct Restart {};
struct Cancel {};
struct Pause {
  bool on = true;
};
struct SetViewSettings {
  ViewSettings view_settings;
};
/// Parts of the Comparison, one command each: two keys in one frame must not undo each other.
struct Flip {
  bool on = true;
};
struct CompareWith {
  std::uint64_t pin = 0; ///< as Comparison::pin
};
struct ShowPicture {
  std::uint64_t pin = 0; ///< as Comparison::shown
};
struct Arrange {
  Arrangement arrangement = Arrangement::single;
};
struct MoveSplit {
  double to = 0.5; ///< as Comparison::split
};
struct ShowDifference {
  bool on = true;
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0; ///< as Comparison::scale
};
/// Which layer of the pictures is shown and compared: a name of job::Picture::layers; empty: all of their light.
struct ShowLayer {
  std::string layer;
};
/// The pixel (column, row) that the panel Inspector shows; nothing: none. It need not be in the picture, whose size may
/// change.
struct InspectPixel {
  std::optional<std::array<int, 2>> pixel;
};
/// The pixels that the panel Inspector has statistics of; nothing, or none in it: no statistics.
struct SelectRegion {
  std::optional<PixelRegion> region;
};
/// What a panel shows in the View's picture: lines from point to point, in the preset's coordinates.
struct ShowLines {
  std::vector<std::vector<preset::Vec3>> lines;
};
/// Keeps the history and the picture of the run as they are now.
struct PinRun {};
struct ChangePin {
  std::uint64_t pin = 0;
  std::string name;         ///< empty: stays as it was
  std::uint32_t colour = 0; ///< IM_COL32
  bool shown = true;        ///< in the plot
};
/// A picture, or the history of an earlier run: history.csv, or its folder, whose image.exr is then kept too. Read in
/// the background.
struct PinFile {
  std::filesystem::path path;
  bool show = false;                  ///< a picture is then shown in the View
  std::optional<ChangePin> like = {}; ///< the name, colour and visibility that it had in an earlier session
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
/// Loads a refractiveindex.info file (a path, or the name of a shipped material) into the dielectric that is shown: one
/// edit.
struct LoadDispersion {
  std::string file;
};
/// What is selected, to be moved; and how it is moved.
struct Select {
  Selection selection;
};
struct SetHandles {
  Handles handles;
};
/// The newest edit was a nudge: one that follows soon goes into the same entry to undo.
struct Nudged {
  double at_s = -1e9;        ///< ImGui::GetTime
  std::uint64_t gesture = 0; ///< its number; 0: there was none
  bool operator==(const Nudged&) const = default;
};
/// Of cameras. Going to one is an edit.
struct SetBookmarks {
  std::vector<Bookmark> bookmarks;
};
struct Ask {
  Question question = Question::none;
};
struct SavePreset {
  std::filesystem::path file;
  bool keep_parent = true; ///< where the preset has one (parent_to_keep): only what differs from it is written
};
/// .png: as shown; .exr: linear, with layers.
struct SavePicture {
  std::filesystem::path file;
};
/// Writes the files that a run made (job::Snapshot::files) into a new folder, in the background, and then opens the
/// preset among them that shows what was found (engine::ResultView).
struct OpenResult {
  std::string file; ///< its name
};
/// The report over the pinned runs and the present one (run_record.h), in the background.
struct WriteReport {
  std::filesystem::path file;
};
struct Dismiss {
  std::uint64_t message = 0;
};
/// What the window was at that was closed, or killed, last: asks first where there are unsaved changes, unless sure.
struct ReopenSession {
  bool sure = false;
};
/// The preset as its file has it now, as an edit.
struct ReloadPreset {};
struct ToggleHelp {};
/// The panels of the engine in hand where they were at first, all of them open.
struct ResetLayout {};
/// What a person made of the layout for the presets of an engine.
struct KeepLayout {
  std::string engine;
  std::string ini; ///< EngineLayout::ini
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
    std::variant<command::Open, command::OpenMap, command::New, command::Edit, command::SetSweep, command::StartSweep,
                 command::StopSweep, command::EndGesture, command::Undo, command::Redo, command::Restart,
                 command::Cancel, command::Pause, command::SetViewSettings, command::Flip, command::CompareWith,
                 command::ShowPicture, command::Arrange, command::MoveSplit, command::ShowDifference,
                 command::ShowLayer, command::InspectPixel, command::SelectRegion, command::ShowLines, command::PinRun,
                 command::PinFile, command::ChangePin, command::Unpin, command::ChooseMetric, command::ChooseMaterial,
                 command::LoadDispersion, command::Select, command::SetHandles, command::Nudged, command::SetBookmarks,
                 command::Ask, command::SavePreset, command::SavePicture, command::OpenResult, command::WriteReport,
                 command::Dismiss, command::ReopenSession, command::ReloadPreset, command::ToggleHelp,
                 command::ResetLayout, command::KeepLayout, command::ShowPanel, command::SetAppearance, command::Report,
                 command::Quit>;
using Commands = std::vector<Command>;

} // namespace nephroid::ui
