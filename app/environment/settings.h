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
  std::vector<std::string> objects{}; ///< names of the objects baked together; empty: all glass and mirrors
  int directions = 26;                ///< how many directions light is baked from: 26, 98 or 386
  int spheres = 16;                   ///< how many spheres are about the objects
  Radii radii = Radii::quadratic;     ///< how the radii grow
  double reach = 4;                   ///< the largest radius, in largest sides of the box about the object
  int resolution = 360;               ///< texels across and down the map of a sphere: 360 are as many as 512 x 256
  int photons = 160000;               ///< photons from each direction
  int weight_steps = 4;               ///< of a state's weight from 0 to 1: at them it is baked; 0: at each weight
  int lights = 24;                    ///< q: how many lights the map is cut into
  SegmentMethod segmentation = SegmentMethod::variance;
  SegmentWeights weights = SegmentWeights::solid_angle; ///< how much a texel counts where the map is cut
  enum class Occlusion { surface, thesis };
  Occlusion occlusion = Occlusion::surface; ///< from where it is seen what hides a light, and what that changes
  double threshold = 1e-7;                  ///< a region with no more than this part of the map's light is no light
  bool refine = true;                       ///< photons follow the spheres
  bool cast = true;                         ///< caustics on surfaces
  enum class Phase { henyey_greenstein, rayleigh };
  double extinction = 0;                  ///< the extinction of the medium around the object, 1 / unit; 0: no medium
  double albedo = 1;                      ///< the part of the extinction that is scattering, 0..1
  Phase phase = Phase::henyey_greenstein; ///< the directions of scattered light
  double anisotropy = 0;                  ///< henyey_greenstein: the mean cosine, -.95 to .95
  bool operator==(const Settings&) const = default;
};

const preset::SettingsType& settings_type();

inline Settings& settings(preset::Preset& preset) { return preset.settings.as<Settings>(); }
inline const Settings& settings(const preset::Preset& preset) { return preset.settings.as<Settings>(); }

} // namespace nephroid::environment
