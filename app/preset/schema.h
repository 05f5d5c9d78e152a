// SPDX-License-Identifier: Apache-2.0
// The JSON schema of presets, for editors.
#pragma once
#include <string>

namespace nephroid::preset {

/// JSON Schema (2020-12) of a preset file, from the descriptions that reading goes by.
std::string schema();

} // namespace nephroid::preset
