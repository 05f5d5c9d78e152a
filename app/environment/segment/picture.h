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

/// The map as in its file, 1024 x 512, with its range reduced to a screen's.
SegmentPicture shown_map(const scene::Environment& map);
/// shown_map() with the borders of all regions as lines and the directions of the lights as discs.
SegmentPicture segment_picture(const scene::Environment& map, const Segmentation& segmentation);

} // namespace nephroid::environment
