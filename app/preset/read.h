// SPDX-License-Identifier: Apache-2.0
// Presets in and out: strict reading with inheritance, overrides and sweeps; writing.
#pragma once
#include "base/location.h"
#include "preset/json_text.h"
#include "preset/preset.h"

#include <filesystem>
#include <functional>

namespace nephroid::preset {

/// "a.b.0.c=value": value as JSON, else as a bare string.
using Overrides = std::vector<std::string>;

/// A preset file's name without its folder and ending, which is ".json" or ".nephroid.json".
std::string stem_of(const std::filesystem::path& file);
/// Reads a preset file: "parent" chain, overrides, strict check of every key, type and range, sweep.
/// name: a path, or the name of a shipped preset ("first-light", "spectral/prism"), each also without ".json". One
/// preset without "sweep", else one a run, each with its own name ("NAME,seed=2"), the first swept key outermost.
/// Throws bad_input at FILE#/json/pointer (or FILE:LINE:COLUMN for broken JSON, --set TEXT for an override) with the
/// nearest known key; an inherited value names the file it stands in, and what is wrong in one run of a sweep that run
/// (origins.h).
std::vector<Preset> read_presets(const std::string& name, const Overrides& overrides = {});
/// The same for a preset that must not have a sweep.
Preset read_preset(const std::string& name, const Overrides& overrides = {});
/// From text, for tests and the editor; source names it in messages.
Preset parse_preset(const std::string& json, const std::string& source, const Overrides& overrides = {});

/// Complete: reading it again gives an equal preset, and every field is there, in the order of describe.
Json as_json(const Preset& preset);
/// The preset of such a value, which may have been changed since. Throws as parse_preset.
Preset read_json(Json value, const std::string& source);
/// The preset with what overrides set. It is read again: whatever no preset may be is refused, as by parse_preset.
Preset with_overrides(const Preset& preset, const Overrides& overrides);
/// as_json() as indented text, without a newline at the end.
std::string to_json(const Preset& preset);
/// The same for a file in another folder than the preset's source: a file name that would mean another file there (or
/// none) becomes absolute, so that preset.json beside a run's pictures can be run again.
std::string to_json(const Preset& preset, const std::filesystem::path& folder);
/// The preset with each name of a file as `renamed` gives it, in the order of the file.
Preset with_file_names(Preset preset, const std::function<std::string(const std::string& name)>& renamed);
/// Each name of a file in the preset, and the JSON pointer of where it stands, in the order of the file.
std::vector<std::pair<std::string, std::string>> file_names(const Preset& preset);
/// The files that a preset names, as far as they are there, and its own.
std::vector<std::filesystem::path> files_of(const Preset& preset);

struct ShippedPreset {
  std::string name; ///< e.g. "first-light"
  std::string description;
  std::filesystem::path file;
};
/// Every preset under presets_folder(), sorted by name.
std::vector<ShippedPreset> shipped_presets();

/// JSON Schema (2020-12) of a preset file, from the descriptions that reading goes by.
std::string schema();

/// Throws bad_input at where(pointer) of the first contradiction that no field can say alone.
void check(const Preset& preset, const std::function<Location(const std::string& pointer)>& where);

// A preset's sweep as data, for who edits it: which fields take which values. read_presets gives the runs at once.

struct SweptField {
  std::string key;                 ///< as for --set: "spectral.threshold_deg"
  std::vector<std::string> values; ///< at least one, each as JSON
  bool operator==(const SweptField&) const = default;
};

/// Every combination is one run, the first field outermost. Empty: there is no sweep.
using Sweep = std::vector<SweptField>;

/// A preset, and the sweep of its file.
struct WithSweep {
  /// What the file says of a swept field. Where the file would be refused without the sweep, its first run, named as
  /// the file.
  Preset preset;
  Sweep sweep;
};

/// As read_preset and parse_preset. A swept field that an override sets is not swept.
WithSweep read_with_sweep(const std::string& name, const Overrides& overrides = {});
WithSweep parse_with_sweep(const std::string& json, const std::string& source);

/// The first run of a file's sweep, named as the file; the preset itself where it has none.
Preset parse_first_run(const std::string& json, const std::string& source);

/// How many runs it gives, also where they are too many to be made; 1 without a sweep. A double, because it may be any
/// number.
double count_runs(const Sweep& sweep);

/// One of a sweep's runs.
struct SweptRun {
  std::string name;             ///< the preset's with this run's values: "lens,threshold_deg=0.1,seed=2"
  std::optional<Preset> preset; ///< nothing where it is refused
  std::string why_not;          ///< the line that says why
};
/// As read_presets gives them, but that each run is refused alone. Throws bad_input as read_presets for a sweep that
/// gives no runs: a field's name that is none, one field inside of another, no value, more than 10000 runs.
std::vector<SweptRun> swept_runs(const Preset& preset, const Sweep& sweep);

} // namespace nephroid::preset
