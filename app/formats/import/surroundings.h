// SPDX-License-Identifier: Apache-2.0
// Pictures of all directions, as files of other programs place them.
#pragma once
#include "formats/import/description.h"
#include "image/image.h"

namespace nephroid::formats {

/// The map as a preset's environment has it, without a turn: latitude and longitude, the centre column along -z, the
/// top row along +y. to_preset: from the map's directions, as DescribedSurroundings has them; it may mirror. Throws
/// what reading it throws.
image::Image map_in_preset(const DescribedSurroundings& surroundings, const glm::dmat3& to_preset);

/// The mean of a map over all directions, linear sRGB. Throws what reading it throws.
glm::dvec3 mean_of_map(const std::filesystem::path& file, bool is_equal_area);

} // namespace nephroid::formats
