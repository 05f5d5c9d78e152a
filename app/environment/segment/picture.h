// SPDX-License-Identifier: Apache-2.0
// A segmentation as a picture of the map.
#pragma once
#include "environment/segment/segment.h"

#include <vector>

namespace nephroid::environment {

struct SegmentPicture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgba; ///< row 0 at the top
};

/// Reinhard et al. 2002, "Photographic tone reproduction", (1) to (3): of colours above 0 the geometric mean becomes .18, and the brightest
/// stays below 1. linear: any colours, 0 or more.
void make_small_range(std::vector<glm::dvec3>& linear);

/// The map as it is in its file, 1024 x 512, with its range made small enough for a screen; the borders of all regions as lines and the
/// directions of the lights as discs.
SegmentPicture segment_picture(const scene::Environment& map, const Segmentation& segmentation);

} // namespace nephroid::environment
