// SPDX-License-Identifier: Apache-2.0
// checkpoint.bin: a run that goes on later with the same bits.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "run/prepare.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::run {

/// Written whole; bound to all that other bits may come of: the engine and its state's version, settings and contents
/// of files, the device, the kernels and the program's version.
void write_checkpoint(const std::filesystem::path& folder, const Prepared& prepared, const compute::Context& context,
                      job::Job& job);
/// What another process has to have alike so that it computes the same bits, each with a name for a message.
std::vector<std::pair<std::string, std::string>> bit_dependencies(const Prepared& prepared,
                                                                  const compute::Context& context);
/// Loads it into a job that was just made. False where there is none. Throws bad_input where it is bound to something
/// else, which it names, or is cut.
bool load_checkpoint(const std::filesystem::path& folder, const Prepared& prepared, const compute::Context& context,
                     job::Job& job);

} // namespace nephroid::run
