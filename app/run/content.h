// SPDX-License-Identifier: Apache-2.0
// What a run is made of: the files that its preset names. Checkpoints, finished runs and references are bound to them.
#pragma once
#include "plan/plan.h"
#include "preset/preset.h"

#include <filesystem>

namespace nephroid::run {

/// The files that a preset names, each once, in its order, and what they hold now. known: of presets in the same
/// folder; its files are not read again.
std::vector<plan::Input> read_inputs(const preset::Preset& preset, const std::vector<plan::Input>& known = {});

/// "the file 'a.obj' has changed since the run began", of the first that holds something else `now`, by its name; empty
/// where none does.
std::string changed_input(const std::vector<plan::Input>& before, const std::vector<plan::Input>& now);
/// The same since the run in the folder began, by its plan.json; empty also where that is damaged.
std::string changed_input(const std::filesystem::path& folder, const std::vector<plan::Input>& now);

/// A hash of the engine, its state's version, the settings that a picture's sums depend on (not: names, stop,
/// reference, mask) and the contents of the files that they name, which `inputs` has, whatever these are called.
std::uint64_t content_hash(const preset::Preset& preset, const std::vector<plan::Input>& inputs);

} // namespace nephroid::run
