// SPDX-License-Identifier: Apache-2.0
// What the panel "Environment" shows of a preset: its map, read once, as a cube and as a picture; the lights that it is
// cut into; how well as many lights as one likes would do. Made beside the frames, what is seen first. And what a
// person reads of the lights. No Dear ImGui.
#pragma once
#include "environment/segment/picture.h"
#include "job/job.h"
#include "preset/preset.h"
#include "ui/state/tasks.h"

namespace nephroid::ui {

/// The environment as a flat picture, in the map's own frame, not turned by rotate_deg.
/// latitude_longitude: -z in the middle, +x to the right of it, +y at the top. cube: the same as a cross of 4 x 3 faces
/// seen from inside; -x, -z, +x, +z from left to right, +y above and -y below -z.
enum class MapLayout { latitude_longitude, cube };

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

/// The colour of each pixel, row 0 at the top; black beside the cross. map: in latitude and longitude, as
/// environment::shown_map makes it.
std::vector<Colour> colours_under(const MapPictureSize& size, const environment::SegmentPicture& map);
/// The texel of the cube under each pixel's middle; -1 beside the cross. cube_size: as CubeMap::size.
std::vector<int> texels_under(const MapPictureSize& size, int cube_size);
/// The region index of each texel of the cube: first the lights, then the dropped regions.
std::vector<int> regions_of_texels(const environment::Segmentation& segmentation);
/// 4 bytes a pixel; transparent beside the cross. Of the first two, and with lines between the regions of the third;
/// empty: without.
std::vector<unsigned char> drawn(const MapPictureSize& size, const std::vector<Colour>& colours,
                                 const std::vector<int>& texels, const std::vector<int>& regions);

/// How many lights the plot of quality has points of.
inline constexpr std::array quality_lights{6, 8, 12, 16, 24, 32, 48, 64, 128, 256};

/// Where a map comes from. How bright it is and how it is turned change nothing that is made of it.
struct MapSource {
  preset::Environment environment; ///< with radiance 1, not turned
  std::string preset;              ///< the preset's file: maps are looked for beside it
  bool operator==(const MapSource&) const = default;
};

struct WantedMap {
  MapSource source;
  std::optional<environment::SegmentSettings> segments; ///< nothing: the engine does not cut it
  MapPictureSize picture;
  bool operator==(const WantedMap&) const = default;
};

/// What the panel needs for a preset, which must have an environment.
WantedMap wanted_map(const preset::Preset& preset, const MapPictureSize& picture);

struct ReadMap {
  int width = 0, height = 0;           ///< texels of the file
  environment::CubeMap cube;           ///< with radiance 1
  environment::SegmentPicture picture; ///< in latitude and longitude
  std::vector<std::string> warnings;   ///< a sentence each
};

struct CutMap {
  environment::SegmentSettings settings;
  environment::Segmentation segmentation;
  std::vector<int> region_of_texel;
};

struct PixelsOfMap {
  std::vector<Colour> colours;
  std::vector<int> texels;
};

struct MapPicture {
  MapPictureSize size;
  std::shared_ptr<const PixelsOfMap> under;
  std::shared_ptr<const CutMap> cut; ///< whose regions it shows; null: none
  std::vector<unsigned char> rgba;
};

/// Irradiance errors of the first of quality_lights, as far as they are known.
using Quality = std::vector<double>;

/// What is there so far. All of it is of one map.
struct ShownMap {
  std::optional<MapSource> source; ///< nothing before the first map was read or refused
  std::string error;               ///< why something of what was wanted is missing: one line; else empty
  std::shared_ptr<const ReadMap> map;
  std::shared_ptr<const CutMap> cut;
  std::optional<double> cut_error; ///< relative error of cut's irradiance over normals
  std::shared_ptr<const MapPicture> picture;
  std::shared_ptr<const std::vector<glm::dvec3>> truth; ///< irradiance of the whole map
  std::array<Quality, 2> quality;                       ///< by SegmentMethod, with the default threshold
};

class EnvironmentModel {
public:
  /// Once a frame, returns at once: begins what is missing, one thing after the other. What is in the making for
  /// something else is finished and dropped.
  void want(const WantedMap& wanted, TaskQueue& tasks);
  const ShownMap& shown() const { return shown_; }
  /// Whether nothing of what is wanted is missing, but for what an error says.
  bool rests() const { return next() == Step::none; }
  /// How often a map was read, and cut for the panel; for tests.
  int maps_read() const { return maps_read_; }
  int cuts_made() const { return cuts_made_; }

private:
  enum class Step { none, read, cut, draw, truth, error, quality };
  Step next() const;
  static ShownMap take_step(Step step, const WantedMap& wanted, ShownMap shown);

  std::optional<WantedMap> wanted_;
  std::optional<WantedMap> refused_; ///< what failed last
  ShownMap shown_;
  int maps_read_ = 0, cuts_made_ = 0;
  TaskKey steps_;
};

/// In the scene's frame.
struct RegionFigures {
  double flux = 0;          ///< W/m^2 of Y on a plane that faces it
  double share = 0;         ///< the part of all lights' flux, 0..1
  double azimuth_deg = 0;   ///< from -z to the right (+x), -180..180,
  double elevation_deg = 0; ///< and above the horizon; both in the scene
  double solid_angle_sr = 0;
  Colour colour{};                ///< for a screen, its largest channel 255; black where there is no light
  std::optional<double> occluded; ///< 0..1, where a run says so
};

/// One each of the lights, then of the dropped regions, whose flux is counted in a light's. radiance: what the
/// segmentation's flux, of a map of radiance 1, is multiplied by. visible: as visible_shares gives it.
std::vector<RegionFigures> figures_of(const environment::Segmentation& segmentation, double radiance, double rotate_deg,
                                      const std::vector<double>& visible);

/// The column "visible" of a run's curve "lights": the part of each light that no occluder hides, 0..1, in the order of
/// the segmentation. Empty where the snapshot has no such curve of so many lights, or a value is out of range.
std::vector<double> visible_shares(const job::Snapshot& snapshot, std::size_t lights);

/// rotate_deg, -180..180 and in tenths, after the mouse went `across` widths of the picture to the right. In latitude
/// and longitude the map goes with the mouse. In the cube, which lies still, the mark of the scene's front does.
double dragged_rotation(double start_deg, double across, MapLayout layout);

} // namespace nephroid::ui
