// SPDX-License-Identifier: Apache-2.0
// The map on the screen: its picture with regions, the lights' directions as discs, where the scene's front is, and what the mouse does
// with it.
#pragma once
#include "ui/environment/model.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::ui {

struct MapContents {
  const ShownMap& shown;                     ///< whose picture may still be of another layout, which is not drawn
  const std::vector<RegionFigures>& figures; ///< of shown.cut; empty: no lights
  MapLayout layout = MapLayout::latitude_longitude;
  double rotate_deg = 0;
  std::optional<std::size_t> marked; ///< a region to be outlined
};

/// A drag with the left button, in this frame.
struct MapDrag {
  bool taken = false, moved = false, let_go = false;
  double across = 0; ///< widths of the picture to the right since it was taken
};

class MapView {
public:
  /// In the window's free width, at most `most_height` pixels high.
  MapDrag draw(const MapContents& contents, float most_height);
  /// The region under the mouse, of MapContents::figures.
  const std::optional<std::size_t>& hovered() const { return hovered_; }
  /// Pixels of the picture as it should be made.
  MapPictureSize wanted_size() const { return wanted_; }

  /// For tests: x, y, width and height on the screen as drawn last, and the pixels shown.
  const std::array<double, 4>& area() const { return area_; }
  const PictureTexture& texture() const { return texture_; }
  /// Where on the screen a direction of the map lies.
  std::array<double, 2> to_screen(const MapContents& contents, const glm::dvec3& direction) const;

private:
  void draw_picture(const MapContents& contents);
  void draw_lights(const MapContents& contents) const;
  void draw_front(const MapContents& contents) const;
  void draw_outline(const MapContents& contents, const environment::Region& region) const;
  std::optional<std::size_t> region_at(const MapContents& contents, const std::array<double, 2>& mouse) const;

  std::array<double, 4> area_{};
  MapPictureSize wanted_{MapLayout::latitude_longitude, 512};
  std::shared_ptr<const MapPicture> in_texture_;
  PictureTexture texture_;
  std::optional<std::size_t> hovered_;
  double taken_x_ = 0;
};

/// Light `index` of a segmentation, or where there are no more lights the dropped region that follows them.
const environment::Region& region_of(const environment::Segmentation& segmentation, std::size_t index);

} // namespace nephroid::ui
