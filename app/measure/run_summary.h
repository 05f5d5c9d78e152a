// SPDX-License-Identifier: Apache-2.0
// A finished run read back from its folder, but for its picture: what a report says about it.
#pragma once
#include "job/history.h"
#include "plan/plan.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::measure {

struct RunReference {
  std::string origin;                        ///< the picture's file
  std::map<std::string, double> noise_floor; ///< by column, what is known of it
};

struct RunSummary {
  std::filesystem::path folder;
  // run.json
  std::string name, engine, version, commit, compiler;
  std::uint64_t seed = 0, photons = 0;
  std::int64_t passes = 0;
  double work_seconds = 0;
  std::optional<double> wall_seconds, measuring_seconds;   ///< of the whole run; not known of runs of older versions
  std::vector<std::pair<std::string, std::string>> device; ///< "name", "driver", ...: as the file has them
  std::vector<std::pair<std::string, double>> phase_seconds;
  std::vector<std::pair<std::string, double>> energy_w; ///< "emitted", ...: the entries of "energy" in watts
  std::optional<RunReference> reference;
  std::map<std::string, double> errors; ///< at the end, by column
  std::string error_column;             ///< what the run itself is judged by; may be empty
  // preset.json: every value by its key as --set takes it ("scene.lights.0.power_w"), as JSON
  std::map<std::string, std::string> settings;
  plan::Plan plan;
  std::optional<job::History> history; ///< none where there is no history.csv
};

/// The runs in these folders: a folder with a run.json is one, a sweep's folder stands for the runs in its own folders, by name.
/// Throws bad_input for a folder that is neither or is named twice, an unfinished run and more runs than max_reported_runs.
std::vector<std::filesystem::path> find_runs(std::span<const std::filesystem::path> folders);

inline constexpr std::size_t max_reported_runs = 64;

/// Throws bad_input at FILE or FILE#/pointer: an unfinished run, a file that is missing, cut or of other types than a run writes.
/// history.csv may be missing, and of run.json what older versions did not write.
RunSummary read_run(const std::filesystem::path& folder);

/// What run.json says the run is measured against, of an unfinished run too; none where it says nothing or is not there. Throws bad_input
/// for a damaged file.
std::optional<RunReference> read_run_reference(const std::filesystem::path& folder);

} // namespace nephroid::measure
