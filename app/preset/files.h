// SPDX-License-Identifier: Apache-2.0
// File names that a preset holds: a name that means one thing in its own folder, written so that it means the same in another.
// Private to preset/.
#pragma once
#include "preset/origins.h"
#include "preset/preset.h"

#include <filesystem>
#include <string>

namespace nephroid::preset {

/// The name that means from `folder` what `name` means from `own_folder`: name itself where both find the same file (or
/// neither finds any), else an absolute path.
std::string name_from(const std::filesystem::path& folder, const std::string& name, const std::filesystem::path& own_folder);

/// The name that means to `main`, a preset's file, what `name` means where it was given. A typed name is looked for in the current folder
/// first, as everything else on a command line is. Where there is no such file, it is looked for as if the name stood in the preset's file.
std::string name_given(const Origin& main, const std::string& name, const Origin& origin);

/// The preset as it reads from another folder.
Preset moved_to(Preset preset, const std::filesystem::path& folder);

} // namespace nephroid::preset
