// SPDX-License-Identifier: Apache-2.0
// Another engine for a preset: what the new one does not know goes, so that the rest can be rendered by it.
#pragma once
#include "preset/json_text.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace nephroid::preset {

/// Takes out of a preset's JSON, complete or not, what the engine does not know: settings of other engines, also in a
/// reference's recipe; SettingsType::without; swept keys and tracks that lead into any of these. Returns their keys, as
/// --set takes them. Does nothing where there is no such engine.
std::vector<std::string> take_foreign(Json& preset, std::string_view engine);

/// "left out what the engine 'inverse' does not know: spectral, scene.lights".
std::string left_out_note(std::string_view engine, const std::vector<std::string>& keys);

} // namespace nephroid::preset
