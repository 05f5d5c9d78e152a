// SPDX-License-Identifier: Apache-2.0
// A meter's map where the View's picture shows its cells.
#pragma once
#include "ui/state/context.h"
#include "ui/view/placement.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::meters {
struct Reading;
struct Shown;
} // namespace nephroid::meters

namespace nephroid::scene {
struct MeterSurface;
}

namespace nephroid::run {
struct LoadedScene;
}

namespace nephroid::ui {

class MapOnPicture {
public:
  /// Once a frame, before the others: follows the settings' meter, and its newest reading.
  void refresh(const Context& context);
  bool is_shown() const { return is_shown_; }
  /// Over the run's picture.
  void draw(const Placement& placement) const;
  const std::string& unit() const { return unit_; } ///< "kW/m^2"
  double high() const { return high_; }             ///< the end of the colours
  const PictureTexture& texture() const { return texture_; }

private:
  /// Which cells the picture shows.
  struct Seen {
    std::shared_ptr<const run::LoadedScene> loaded;
    std::shared_ptr<const scene::MeterSurface> surface;
    std::vector<int> cells; ///< [pixel]; -1: none
  };
  void colour(const meters::Shown& shown, const Seen& seen);

  NewestResult<Seen> seen_;
  std::shared_ptr<const Seen> coloured_seen_; ///< of the texture, as the reading
  std::shared_ptr<const meters::Reading> coloured_reading_;
  PictureTexture texture_;
  std::array<int, 2> size_{1, 1};
  bool is_shown_ = false;
  std::string unit_;
  double high_ = 1;
};

} // namespace nephroid::ui
