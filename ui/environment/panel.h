// SPDX-License-Identifier: Apache-2.0
// The panel "Environment": the preset's surroundings as a picture that is turned with the mouse; for engine 2 the
// lights that they are cut into, with their flux and what a run found to be hidden of them, how well as many lights do,
// and switches for caustics.
#pragma once
#include "ui/environment/model.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/picture_texture.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

/// The map on the screen: its picture with regions, the lights' directions as discs, where the scene's front is, and
/// what the mouse does with it.
struct MapContents {
  const ShownMap& shown;                     ///< whose picture may still be of another layout, which is not drawn
  const std::vector<RegionFigures>& figures; ///< shown.cut's; empty: no lights
  MapLayout layout = MapLayout::latitude_longitude;
  double rotate_deg = 0;
  std::optional<std::size_t> marked; ///< a region to be outlined
};

/// A drag with the left button, in this frame.
struct MapDrag {
  bool taken = false, moved = false, ended = false;
  double across = 0; ///< widths of the picture to the right since it was taken
};

class MapView {
public:
  /// In the window's free width, at most `most_height` pixels high.
  MapDrag draw(const MapContents& contents, float most_height);
  /// The region under the mouse, of MapContents::figures.
  const std::optional<std::size_t>& hovered() const { return hovered_; }
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

/// How well lights replace the map: irradiance error over how many there are, on logarithmic axes, by both methods.
class QualityPlot {
public:
  /// In the window's free width; height in pixels.
  void draw(const ShownMap& shown, float height);
  const PlotArea& area() const { return area_; } ///< as drawn last, ends of the axes in lights and %; for tests

private:
  PlotArea area_;
};

/// Where something of each error is to be seen on a logarithmic axis: in %, from below the least that is above 0 to
/// above the largest. A decade below 10 % where there is none.
std::array<double, 2> error_range(const ShownMap& shown);

class EnvironmentPanel : public Panel {
public:
  static constexpr const char* title = "Environment";
  /// Engine 2's presets, and others that have an environment.
  static bool serves(const preset::Preset& preset);
  void draw(const Context& context) override;

  /// For tests: what was drawn last, and where.
  const EnvironmentModel& model() const { return model_; }
  const ShownMap& shown() const { return shown_; }
  const MapView& map() const { return map_; }
  const QualityPlot& plot() const { return plot_; }
  const std::vector<RegionFigures>& figures() const { return figures_; }
  std::array<double, 2> place_on_map(const glm::dvec3& direction) const;

private:
  void follow(const Context& context);
  void make_figures(const Context& context);
  void draw_toolbar(const Context& context);
  void draw_segmentation_row(const Context& context);
  void draw_radiance_row(const Context& context);
  void draw_caustics_row(const Context& context);
  void draw_map(const Context& context);
  void draw_summary() const;
  void draw_table();
  MapContents contents() const;

  MapLayout layout_ = MapLayout::latitude_longitude;
  EnvironmentModel model_;
  ShownMap shown_;
  preset::Environment environment_; ///< this frame's
  bool cuts_ = false;               ///< the preset's engine cuts the map
  std::vector<RegionFigures> figures_;
  std::vector<std::size_t> by_flux_; ///< the lights among figures_, the brightest first
  struct FiguresOf {
    std::shared_ptr<const CutMap> cut;
    double radiance = 0, rotate_deg = 0;
    std::vector<double> visible;
    bool operator==(const FiguresOf&) const = default;
  } figures_of_;
  std::optional<std::size_t> row_; ///< the region whose row the mouse is on
  MapView map_;
  QualityPlot plot_;
  Gestures gestures_{title};
  double taken_deg_ = 0; ///< rotate_deg when the picture was taken
};

} // namespace nephroid::ui
