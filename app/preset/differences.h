// SPDX-License-Identifier: Apache-2.0
// What a preset has that its file on disk has not: said as a command line, or as a file with a parent. Both are read
// back before they are handed out, so that what they say is the preset.
#pragma once
#include "preset/read.h"

namespace nephroid::preset {

/// The preset file's own "parent", as it stands there; empty where it has none or cannot be read.
std::string own_parent(const std::filesystem::path& file);

/// The name by which a shipped preset is opened ("spectral/prism"); empty where the file is none.
std::string shipped_name(const std::filesystem::path& file);

/// What read_preset needs to make a preset again.
struct Recipe {
  std::string name; ///< a shipped name or an absolute path
  Overrides overrides;
};

/// The preset from its file as that is on disk now: an override for each field that differs. Throws bad_input where
/// there is no such file or no overrides make the preset of it, with what to do.
Recipe recipe_of(const Preset& preset);

/// "nephroid run NAME --set a.b=c ...", as a POSIX shell takes it. Throws as recipe_of, also where a terminal would cut
/// the line.
std::string command_line(const Preset& preset);

/// One word for a POSIX shell.
std::string shell_word(const std::string& word);

/// The text of a preset file.
struct FileText {
  std::string json;
  bool has_parent = false;
  std::string note = {}; ///< why it has no parent although one was asked for
};

/// For `file`, which need not be there: what differs from the parent, or everything where that cannot be said as a file
/// with this parent. parent: as it stands in preset.source, or a shipped name; empty: everything. File names are those
/// that mean the same from file's folder. Values of a swept field are written as they are.
FileText file_text(const Preset& preset, const std::string& parent, const std::filesystem::path& file,
                   const Sweep& sweep = {});

/// A field that two presets have differently: its way as --set takes it, and both values as JSON; "none" where one
/// preset has no such field.
struct Difference {
  std::string path; ///< "scene.lights.0.power_w"
  std::string before, after;
  bool operator==(const Difference&) const = default;
};

/// In the order of the file, without what presets are called and where they lie. Names of files mean what they mean to
/// `before`. Objects of different types, and lists of different lengths, are one difference.
std::vector<Difference> differences(const Preset& before, const Preset& after);

/// The preset as it reads from another file: names of files mean from there what they meant before.
Preset moved_to_file(Preset preset, const std::filesystem::path& file);

} // namespace nephroid::preset
