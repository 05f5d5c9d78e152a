// SPDX-License-Identifier: Apache-2.0
// What a stone looks like from above, as files.
#pragma once
#include "gems/light.h"

#include <filesystem>

namespace nephroid::gems {

/// Writes into a folder that is there, replacing files: iso.png, cos.png and head.png, where the zenith's radiance of
/// ISO is white; colour.png, the stone in the head's sky of D65; and where `spreads` fire.png, the angle between C and
/// F in degrees as false colours with their scale. Throws failed as image::write_png does.
void write_pictures(const std::filesystem::path& folder, const GemPictures& pictures, bool spreads);

} // namespace nephroid::gems
