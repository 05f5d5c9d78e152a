// SPDX-License-Identifier: Apache-2.0
// File names that a preset holds: what they mean in the folder they came from, said so that they mean the same in another one.
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

/// The name that means to `main`, a preset's file, what `name` means where it was given. What was typed is looked for in the current folder
/// first, as everything else on a command line is; where nothing has the name there, as if it stood in the file.
std::string name_given(const Origin& main, const std::string& name, const Origin& origin);

/// The preset as it reads from another folder.
Preset moved_to(Preset preset, const std::filesystem::path& folder);

} // namespace nephroid::preset
