// SPDX-License-Identifier: Apache-2.0
// What meters show, as files and as JSON.
#pragma once
#include "meters/shown.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace nephroid::run {

/// "W/m^2", "lx"; of a goniometer "W/sr", "cd".
const char* unit_of(const scene::MeterSurface& surface, meters::Quantity quantity);

/// {"preset", "wavelengths", "confidence", "meters": [...]}, of the meters that have a reading.
nlohmann::ordered_json to_json(const std::string& preset_name, const meters::Readings& readings);

/// Writes measure.json, and of each meter that has a reading NAME.csv, NAME.exr and NAME.png, of a goniometer NAME.ies
/// and NAME.ldt, into the folder (made if missing), each whole. Returns their names.
std::vector<std::string> write_meters(const std::filesystem::path& folder, const std::string& preset_name,
                                      const meters::Readings& readings);

/// A line a meter: its name, mean and peak with their intervals.
std::vector<std::string> summary(const meters::Readings& readings);

} // namespace nephroid::run
