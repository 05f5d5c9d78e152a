// SPDX-License-Identifier: Apache-2.0
// The files of a run.
#pragma once
#include "compute/compute.h"
#include "image/image.h"
#include "job/job.h"
#include "measure/measured_job.h"
#include "run/prepare.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace nephroid::run {

/// Writes image.exr, image.png, history.csv, preset.json, plan.json and run.json into folder (made if missing), each
/// whole, as far as the snapshot has them. reference: what the run was measured against, or null.
void write_run(const std::filesystem::path& folder, const Prepared& prepared, const compute::DeviceInfo& device,
               const job::Snapshot& snapshot, const measure::Reference* reference, bool finished);

/// Channels R, G, B (the sum), then NAME.R, NAME.G, NAME.B of each layer; no attributes yet.
image::Image with_layers(const job::Picture& picture);

/// STEM.exr with layers, and as attributes what made it; and STEM.png as shown.
void write_picture(const std::filesystem::path& stem, const preset::Preset& preset, const compute::DeviceInfo& device,
                   const job::Picture& picture);

inline constexpr const char* pictures_file = "pictures.json";

/// Errors by the names of a history's columns; what is undefined is null.
nlohmann::ordered_json by_column(const std::vector<std::string>& columns, const std::vector<double>& values);

/// The list of pictures at chosen times, in the folder's pictures.json: {"seconds": as asked for, "work_seconds": when
/// it was made, "picture": its file, "errors": by column}; empty where there is none.
nlohmann::ordered_json pictures_at(const std::filesystem::path& folder);

/// Writes at-0010s.png and .exr and adds them to the list. Returns what it added; the errors are those of the newest
/// row of the history where that is of `seconds` or later.
nlohmann::ordered_json write_picture_at(const std::filesystem::path& folder, double seconds, const Prepared& prepared,
                                        const compute::DeviceInfo& device, const job::Snapshot& snapshot);

/// Removes those of later than work_seconds: of work that a resumed run does again, or all (-1).
void remove_pictures_after(const std::filesystem::path& folder, double work_seconds);

/// The PNGs of a finished run again, from its EXRs, with the preset's `display`; preset.json, run.json and a report say
/// so. Throws bad_input for an EXR that is damaged, and failed where the files cannot be written.
void show_anew(const std::filesystem::path& folder, const preset::Preset& preset);

/// report.html of a run whose other files are written. Throws as report::report_html does.
void write_report(const std::filesystem::path& folder);
/// history.csv alone, while the run goes on.
void write_history(const std::filesystem::path& folder, const job::History& history);

} // namespace nephroid::run
