// SPDX-License-Identifier: Apache-2.0
// What panels, menus and shortcuts ask for. They never change the workbench themselves: they push commands, which the
// workbench applies once every panel has drawn. That is why a test can read what a click meant.
#pragma once
#include "measure/difference.h"
#include "preset/preset.h"
#include "preset/read.h"
#include "ui/state/selection.h"

#include <set>
#include <variant>

namespace nephroid::ui {

/// The luminance at the two ends of false colour.
struct LuminanceRange {
  double low = 0, high = 0; ///< W/m^2/sr, 0 < low < high
  bool operator==(const LuminanceRange&) const = default;
};

/// How the picture is shown, beside what the preset's `display` says. Nothing here needs a new run.
struct ViewSettings {
  double exposure_stops = 0; ///< -20..20
  bool false_colour = false; ///< the logarithm of the luminance in colours; exposure and `display` play no part
  std::optional<LuminanceRange> range = {}; ///< of false colour; nothing: automatic_range of the shown picture
  bool fit = true;                          ///< the whole picture is in the panel; zoom and centre are not used then
  double zoom = 1;                          ///< screen pixels a picture pixel
  std::array<double, 2> centre{0, 0};       ///< the picture's point, in pixels, at the panel's middle
  std::string meter;                        ///< the one whose map lies over the run's picture; empty or unknown: none
  bool operator==(const ViewSettings&) const = default;
};

/// How the View shows two pictures. split: both lie in one place, cut at a line that can be dragged.
enum class Arrangement { single, split, side_by_side };

/// What the View shows, what that is compared with, and how. Nothing here needs a new run.
struct Comparison {
  static constexpr std::uint64_t run_in_hand = ~std::uint64_t{0};

  std::uint64_t shown = 0; ///< a pinned run or picture (PinnedRun::id); 0: the run in hand
  std::uint64_t pin = 0;   ///< the one to compare with: a pin, run_in_hand, or 0: the reference
  Arrangement arrangement = Arrangement::single;
  double split = 0.5;      ///< where the line is, as a part of the picture's area in the panel, 0..1
  bool flip = false;       ///< the other picture is shown in place of the first
  bool difference = false; ///< a map of their difference is shown, unless flip is on
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0;  ///< the value at the end of the map's colours; 0: measure::colour_scale
  std::string layer; ///< the layer of both pictures; empty: all of their light
  bool operator==(const Comparison&) const = default;
  /// Whether the distance between the two is to be measured.
  bool measures() const { return shown != 0 || difference || arrangement != Arrangement::single; }
};

/// The end is not part of it.
struct PixelRegion {
  std::array<int, 2> from{0, 0}, to{0, 0};
  bool operator==(const PixelRegion&) const = default;
};

// How a person set up the window. One file keeps it between runs of the program.
enum class Theme { dark, light };

struct EngineLayout {
  std::string ini;              ///< where the panels are, in Dear ImGui's format; empty: the engine's initial layout
  std::set<std::string> closed; ///< names of panels (shell/panels.h)
  bool operator==(const EngineLayout&) const = default;
};

struct WindowSettings {
  static constexpr double smallest_text = 0.6, largest_text = 3;

  Theme theme = Theme::dark;
  double text_size = 1;                        ///< a factor on the display's own scale; smallest_text..largest_text
  std::map<std::string, EngineLayout> engines; ///< keyed by the engine's name
  bool operator==(const WindowSettings&) const = default;
};

/// What a dialog is open for. unsaved: a command waits for the answer (Questions::waiting).
enum class Question {
  none,
  open,
  open_history,
  open_pictures,
  open_map,
  add_mesh,
  save_preset,
  save_picture,
  unsaved,
  command,
  save_report,
  record
};

namespace command {

/// Opens a preset file or a shipped preset by its name. Asks first where there are unsaved changes, unless sure. A
/// run's folder or a table (.csv) is pinned as by PinFile, and the run's preset opens where none is open. Dispersion
/// data (.yml, .agf) is loaded as by LoadDispersion. A map (.exr, .hdr) becomes the environment. A picture goes to the
/// engine, or is pinned where the engine takes none. A mesh becomes an object, glTF a preset of its own.
struct Open {
  std::string name;
  bool sure = false;
};
/// Makes a latitude-longitude picture the environment, in one edit.
struct OpenMap {
  std::string file;
};
/// Makes a mesh an object of the scene, once it is read in the background.
struct AddMesh {
  std::string file;
};
/// Opens a scene to begin with, which has no file yet. Asks first as Open does.
struct New {
  std::string preset; ///< as JSON
  bool sure = false;
};
/// Sets the preset. Where the edit changes a field that the animation has a track of, that has a key in the shown frame
/// then (preset::with_keys). Edits of one gesture (same number, not 0) make one entry to undo. live: the gesture still
/// lasts, so a run may first show a picture before the next one replaces it.
struct Edit {
  std::string label;
  preset::Preset preset;
  std::uint64_t gesture = 0;
  bool live = false;
  bool was_read = false; ///< the reader of presets has made it: nothing is left to refuse, and keys are in its tracks
};
/// Sets the sweep. It can be undone; the run goes on, as its preset is the same.
struct SetSweep {
  std::string label;
  preset::Sweep sweep;
};
/// Shows another frame of the animation, the nearest that there is. live: as Edit has it.
struct ShowFrame {
  int frame = 0;
  bool live = false;
};
/// Shows frame after frame at the animation's pace, from the shown one on, round and round.
struct Play {
  bool on = true;
};
/// Renders all frames into a folder, as `nephroid run --resume` does, or ends that.
struct RecordFilm {
  std::filesystem::path folder;
};
struct StopFilm {};
/// Starts or stops the sweep's runs, which take the place of the run in hand one after the other (sweep_queue.h).
struct StartSweep {};
struct StopSweep {};
/// The mouse button was released: the newest edit's run need not wait any more.
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
/// Each part of the Comparison has its own command: two keys in one frame must not undo each other.
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
/// Chooses the layer of both pictures: a name of job::Picture::layers; empty: all of the light.
struct ShowLayer {
  std::string layer;
};
/// Chooses the pixel (column, row) that the panel Inspector shows. It may lie outside of the picture.
struct InspectPixel {
  std::optional<std::array<int, 2>> pixel;
};
/// Chooses the pixels that the panel Inspector has statistics of; none, or an empty region: no statistics.
struct SelectRegion {
  std::optional<PixelRegion> region;
};
/// Draws lines over the View's picture, from point to point, in the preset's coordinates.
struct ShowLines {
  std::vector<std::vector<preset::Vec3>> lines;
};
struct PinRun {};
struct ChangePin {
  std::uint64_t pin = 0;
  std::string name;         ///< empty: the name stays
  std::uint32_t colour = 0; ///< IM_COL32
  bool shown = true;        ///< the plot shows it
};
/// Pins a picture or the history of an earlier run: history.csv, or its folder, whose image.exr is then kept too. It is
/// read in the background.
struct PinFile {
  std::filesystem::path path;
  bool show = false;                  ///< the View then shows the picture
  std::optional<ChangePin> like = {}; ///< name, colour and visibility in an earlier session
};
struct Unpin {
  std::uint64_t pin = 0;
};
/// Chooses the error that the plot shows: a name of measure/metrics.h, with "masked_" for that of the mask.
struct ChooseMetric {
  std::string metric;
};
/// Chooses the dielectric that the panel "Dispersion" shows, by its name among the materials.
struct ChooseMaterial {
  std::string material;
};
/// Loads a refractiveindex.info file (a path, or the name of a shipped material) into the shown dielectric.
struct LoadDispersion {
  std::string file;
};
struct Select {
  Selection selection;
};
struct SetHandles {
  Handles handles;
};
/// Notes that the newest edit was a nudge: one that follows soon goes into the same entry to undo.
struct Nudged {
  double at_s = -1e9;        ///< a time of ImGui::GetTime
  std::uint64_t gesture = 0; ///< the gesture's number; 0: there was none
  bool operator==(const Nudged&) const = default;
};
/// Replaces the bookmarks of cameras. Going to one is an edit.
struct SetBookmarks {
  std::vector<Bookmark> bookmarks;
};
struct Ask {
  Question question = Question::none;
};
struct SavePreset {
  std::filesystem::path file;
  bool keep_parent = true; ///< writes only what differs from the parent (parent_to_keep), where there is one
};
/// Saves the View's picture: .png as shown, .exr linear with layers.
struct SavePicture {
  std::filesystem::path file;
};
/// Writes the files that a run made (job::Snapshot::files) into a new folder, in the background. Then it opens the
/// preset among them that shows the result (engine::ResultView).
struct OpenResult {
  std::string file; ///< the preset's file name
};
/// Writes the report over the pinned runs and the present one (run_record.h), in the background.
struct WriteReport {
  std::filesystem::path file;
};
struct Dismiss {
  std::uint64_t message = 0;
};
/// Restores the session of the window that was closed or killed last. Asks first as Open does.
struct ReopenSession {
  bool sure = false;
};
/// Reads the preset's file again, as an edit.
struct ReloadPreset {};
struct ToggleHelp {};
/// Opens all panels of the engine in hand, in their initial places.
struct ResetLayout {};
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
  double text_size = 1; ///< WindowSettings::smallest_text..largest_text; clamped
};
/// Becomes a message: an error from a panel that could not go on, or a note that disappears by itself.
struct Report {
  std::string line;
  bool error = true;
};
/// Ends the program. Asks first as Open does.
struct Quit {
  bool sure = false;
};

} // namespace command

using Command =
    std::variant<command::Open, command::OpenMap, command::AddMesh, command::New, command::Edit, command::SetSweep,
                 command::ShowFrame, command::Play, command::RecordFilm, command::StopFilm, command::StartSweep,
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
