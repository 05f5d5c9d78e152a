// SPDX-License-Identifier: Apache-2.0
// Presets in and out: strict reading with inheritance, overrides and sweeps; writing; the JSON schema.
#pragma once
#include "base/place.h"
#include "preset/preset.h"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::preset {

/// "a.b.0.c=value": value as JSON, else as a bare string.
using Overrides = std::vector<std::string>;

/// Reads a preset file: "parent" chain, overrides, strict check of every key, type and range, sweep.
/// name: a path, or the name of a shipped preset ("first-light", "spectral/prism"), each also without ".json". One preset without
/// "sweep", else one a run, each with its own name ("NAME,seed=2"), the first swept key outermost.
/// Throws bad_input at FILE#/json/pointer (or FILE:LINE:COLUMN for broken JSON, --set TEXT for an override) with the nearest
/// known key; an inherited value names the file it stands in, and what is wrong in one run of a sweep that run (origins.h).
std::vector<Preset> read_presets(const std::string& name, const Overrides& overrides = {});
/// The same for a preset that must not have a sweep.
Preset read_preset(const std::string& name, const Overrides& overrides = {});
/// From text, for tests and the editor; source names it in messages.
Preset parse_preset(const std::string& json, const std::string& source, const Overrides& overrides = {});

/// Complete: reading it again gives an equal preset, and every field is there. Indented JSON, keys in the order of describe,
/// without a newline at the end.
std::string to_json(const Preset& preset);
/// The same for a file in another folder than the preset's source: a file name that would mean another file there (or none)
/// becomes absolute, so that preset.json beside a run's pictures can be run again.
std::string to_json(const Preset& preset, const std::filesystem::path& folder);
/// JSON Schema (2020-12) of a preset file, from the same descriptions.
std::string schema();

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

/// Throws bad_input at where(pointer) of the first contradiction.
void check(const Preset& preset, const std::function<Place(const std::string& pointer)>& where);

} // namespace nephroid::preset
