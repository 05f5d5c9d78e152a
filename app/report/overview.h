// SPDX-License-Identifier: Apache-2.0
// What was compared: the runs' names, where their presets differ, how far off they ended.
#pragma once
#include "report/run_folder.h"

namespace nephroid::report {

/// Names that tell the runs apart: the preset's, with the folder where two have one name; of a sweep's runs the part that differs.
std::vector<std::string> labels_of(std::span<const RunFolder> runs);
std::string title_of(std::span<const RunFolder> runs);
/// [{"key", "values": [a run each: the value as JSON, null where it has none]}]: the settings that not every run has with one value,
/// but for names and descriptions.
Json differing_settings(std::span<const RunFolder> runs);
/// [{"column", "values": [a run each, or null], "floors": [...]}]: the last row of every history.
Json final_errors(std::span<const RunFolder> runs);

} // namespace nephroid::report
