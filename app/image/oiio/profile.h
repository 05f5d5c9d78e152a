// SPDX-License-Identifier: Apache-2.0
// Colour profiles that pictures hold (ICC.1), by Little CMS. Of the module alone.
#pragma once
#include <string>
#include <vector>

namespace nephroid::image {

/// What a picture's integers become by a profile: as by sRGB's own curve, other colours, or it is none of such a
/// picture.
enum class ProfileUse { srgb, other, none };
/// grey: the picture has one channel. A profile of grey is none of a picture in colour, one of inks is none of both.
ProfileUse profile_use(const std::string& profile, bool grey);

/// Encoded colours, 0..1, three values each, become linear sRGB. Relative colorimetric: the profile's white becomes
/// (1, 1, 1). Colours that sRGB does not have are below 0 or above 1. The profile's use is `other`.
void apply_profile(const std::string& profile, std::vector<float>& rgb);

} // namespace nephroid::image
