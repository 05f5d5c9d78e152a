// SPDX-License-Identifier: Apache-2.0
// The environment as a flat picture: where a direction lies in it and back, its pixels, and the regions of a segmentation as lines. All
// of it is in the map's own frame, not turned by rotate_deg. No Dear ImGui.
#pragma once
#include "environment/segment/segment.h"

namespace nephroid::ui {

/// latitude_longitude: -z in the middle, +x to the right of it, +y at the top. cube: the same as a cross of 4 x 3 faces seen from inside;
/// -x, -z, +x, +z from left to right, +y above and -y below -z.
enum class MapLayout { latitude_longitude, cube };

/// Width over height.
inline double aspect(MapLayout layout) { return layout == MapLayout::cube ? 4.0 / 3 : 2.0; }

struct MapPictureSize {
  MapLayout layout = MapLayout::latitude_longitude;
  int width = 0; ///< pixels
  int height() const;
  bool operator==(const MapPictureSize&) const = default;
};

/// at: 0..1 to the right and downwards. Nothing beside the cross.
std::optional<environment::CubePoint> cube_point(MapLayout layout, const glm::dvec2& at);
/// Where a direction of any length but 0 lies in the picture, 0..1 to the right and downwards.
glm::dvec2 place_of(MapLayout layout, const glm::dvec3& direction);

using Colour = std::array<unsigned char, 3>;

/// Of each pixel, row 0 at the top; black beside the cross. map: in latitude and longitude, as environment::shown_map makes it.
std::vector<Colour> colours_under(const MapPictureSize& size, const environment::SegmentPicture& map);
/// The texel of the cube under each pixel's middle; -1 beside the cross. cube_size: as CubeMap::size.
std::vector<int> texels_under(const MapPictureSize& size, int cube_size);
/// Of each texel of the cube the index of its region: first the lights, then those that were dropped.
std::vector<int> regions_of_texels(const environment::Segmentation& segmentation);
/// 4 bytes a pixel; transparent beside the cross. Of the first two, and with lines between the regions of the third; empty: without.
std::vector<unsigned char> drawn(const MapPictureSize& size, const std::vector<Colour>& colours, const std::vector<int>& texels,
                                 const std::vector<int>& regions);

} // namespace nephroid::ui
