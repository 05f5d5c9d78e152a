// SPDX-License-Identifier: Apache-2.0
#include "preset/writer.h"

#include "preset/files.h"
#include "preset/read.h"

namespace nephroid::preset {

std::string to_json(const Preset& preset) { return pretty(Writer::json(preset)); }

std::string to_json(const Preset& preset, const std::filesystem::path& folder) { return to_json(moved_to(preset, folder)); }

} // namespace nephroid::preset
