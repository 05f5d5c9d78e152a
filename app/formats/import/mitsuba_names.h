// SPDX-License-Identifier: Apache-2.0
// Names in Mitsuba's scenes.
#pragma once
#include <map>
#include <string>

namespace nephroid::formats {

/// Mitsuba's own figures of the indices of refraction that it names.
const std::map<std::string, double>& mitsuba_iors();

/// A name of version 0.6 as it is since version 2: "toWorld" is "to_world".
std::string mitsuba_name(const std::string& name);

} // namespace nephroid::formats
