// SPDX-License-Identifier: Apache-2.0
// Pictures of Radiance (.hdr, .pic), whose header OpenImageIO leaves half unread. Not for others: include
// image/image.h.
#pragma once
#include "image/image.h"

namespace nephroid::image {

bool is_radiance(const std::filesystem::path& file);

/// RGBE and XYZE, flat or run-length encoded, in each of the eight orders of pixels. Values are divided by every
/// EXPOSURE and COLORCORR; PRIMARIES and PIXASPECT are passed on. Format: Ward, "Real Pixels" (Graphics Gems II, 1991),
/// and "Radiance File Formats" (1997). Throws Refused (seam.h).
void read_radiance(const std::filesystem::path& file, const std::function<void(const Band&)>& use);

} // namespace nephroid::image
