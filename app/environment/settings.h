// SPDX-License-Identifier: Apache-2.0
// The settings of engine 2: the section "environment" of a preset.
#pragma once
#include "environment/segment/segment.h"
#include "preset/preset.h"

#include <string>
#include <vector>

namespace nephroid::environment {

struct Settings {
  enum class Radii { quadratic, uniform };
  std::vector<std::string> objects{}; ///< that are baked together; empty: all of glass and all mirrors
  int directions = 26;                ///< that light is baked from: 26, 98 or 386
  int spheres = 16;                   ///< about the objects
  Radii radii = Radii::quadratic;     ///< how they grow
  double reach = 4;                   ///< radius of the largest, in largest sides of the box about the object
  int resolution = 360;               ///< texels across and down the map of a sphere: 360 are as many as 512 x 256
  int photons = 160000;               ///< that are sent from each direction
  int lights = 24;                    ///< q: how many lights the map is cut into
  SegmentMethod segmentation = SegmentMethod::variance;
  double threshold = 1e-7; ///< a region with no more than this part of the map's light is no light
  bool refine = true;      ///< photons join the spheres
  bool cast = true;        ///< caustics on surfaces
  enum class Phase { henyey_greenstein, rayleigh };
  double extinction = 0;                  ///< of the medium around the object, 1 / unit; 0: there is none
  double albedo = 1;                      ///< which part of what is taken is scattered, 0..1
  Phase phase = Phase::henyey_greenstein; ///< where that goes
  double anisotropy = 0;                  ///< henyey_greenstein: the mean cosine, -.95 to .95
  bool operator==(const Settings&) const = default;
};

/// The settings of this engine, as a preset knows them.
const preset::SettingsType& settings_type();

/// Of a preset of this engine.
inline Settings& settings(preset::Preset& preset) { return preset.settings.as<Settings>(); }
inline const Settings& settings(const preset::Preset& preset) { return preset.settings.as<Settings>(); }

} // namespace nephroid::environment
