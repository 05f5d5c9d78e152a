// SPDX-License-Identifier: Apache-2.0
// What the panel "Environment" shows of a preset: its map, read once, as a cube and as a picture; the lights that it is cut into; how well
// as many lights as one likes would do. Made beside the frames, what is seen first. No Dear ImGui.
#pragma once
#include "environment/segment/segment.h"
#include "preset/preset.h"
#include "ui/environment/picture.h"
#include "ui/state/tasks.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

/// How many lights the plot of quality has points of.
inline constexpr std::array quality_lights{6, 8, 12, 16, 24, 32, 48, 64, 128, 256};

/// Where a map comes from. How bright it is and how it is turned change nothing that is made of it.
struct MapSource {
  preset::Environment environment; ///< of radiance 1 and not turned
  std::string preset;              ///< the preset's file: maps are looked for beside it
  bool operator==(const MapSource&) const = default;
};

struct WantedMap {
  MapSource source;
  std::optional<environment::SegmentSettings> segments; ///< nothing: the engine does not cut it
  MapPictureSize picture;
  bool operator==(const WantedMap&) const = default;
};

/// Of a preset that has an environment.
WantedMap wanted_map(const preset::Preset& preset, const MapPictureSize& picture);

struct ReadMap {
  int width = 0, height = 0;           ///< texels of the file
  environment::CubeMap cube;           ///< of radiance 1
  environment::SegmentPicture picture; ///< in latitude and longitude
  std::vector<std::string> warnings;   ///< a sentence each
};

struct CutMap {
  environment::SegmentSettings settings;
  environment::Segmentation segmentation;
  std::vector<int> region_of_texel;
};

struct MapPicture {
  MapPictureSize size;
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
  std::optional<double> cut_error; ///< of cut: relative error of the irradiance over normals
  std::shared_ptr<const MapPicture> picture;
  std::array<Quality, 2> quality; ///< by SegmentMethod, with the default threshold
};

class EnvironmentModel {
public:
  /// Once a frame, returns at once: begins what is missing, one thing after the other. What is in the making for something else is finished
  /// and dropped.
  void want(const WantedMap& wanted, TaskQueue& tasks);
  const ShownMap& shown() const { return shown_; }
  /// Whether nothing of what is wanted is missing, but for what an error says.
  bool rests() const { return next() == Step::none; }
  /// How often a map was read, and cut for the panel; for tests.
  int maps_read() const { return maps_read_; }
  int cuts_made() const { return cuts_made_; }

private:
  enum class Step { none, read, cut, draw, truth, error, quality };
  struct Known;
  struct Result;
  Step next() const;
  static Result take_step(Step step, const WantedMap& wanted, ShownMap shown, Known& known);

  std::optional<WantedMap> wanted_;
  std::optional<WantedMap> refused_; ///< what failed last
  ShownMap shown_;
  bool has_truth_ = false; ///< known_ has the truth of shown_.map
  int maps_read_ = 0, cuts_made_ = 0;
  std::shared_ptr<Known> known_; ///< of the step that is taken, else nobody's
  TaskKey steps_;
};

} // namespace nephroid::ui
