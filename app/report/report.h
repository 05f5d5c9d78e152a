// SPDX-License-Identifier: Apache-2.0
// The report over finished runs: one HTML page that opens without a network.
#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace nephroid::report {

/// The page over the runs in these folders. Throws bad_input for a folder that is no run or holds an unfinished or damaged one.
std::string report_html(std::span<const std::filesystem::path> run_folders);

} // namespace nephroid::report
