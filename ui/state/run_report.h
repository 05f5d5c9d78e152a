// SPDX-License-Identifier: Apache-2.0
// The report of `nephroid report` over runs of the window: what is in no folder yet is written to one first.
#pragma once
#include "ui/state/pinned_runs.h"

#include <filesystem>
#include <span>
#include <string>

namespace nephroid::ui {

/// Writes the page over the runs, in their order. Runs that were read from folders which are still the same are taken from there; the
/// others are written to numbered folders in a new folder FILE-runs beside the page, which stays, as `nephroid report` can use it again.
/// Says what was written, and which runs are left out and why. Throws bad_input at `file` where its name does not end in .html or no run is
/// left, and as report::report_html and run::write_run; the folders are removed again then. Takes as long as the disk does.
std::string write_report(const std::filesystem::path& file, std::span<const PinnedRun> runs);

} // namespace nephroid::ui
