// SPDX-License-Identifier: Apache-2.0
// The object that is baked: alone, in its own coordinates, where it is neither turned nor moved. So a bake stays right when the preset
// turns or moves the object.
#pragma once
#include "environment/settings.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::environment {

struct Caster {
  std::string name;
  std::vector<std::size_t> objects; ///< their indices in the preset and in its scene, ascending
  scene::Scene scene;               ///< the object and one light, white; the middle of the box about the object is at (0, 0, 0)
  double size = 1;                  ///< largest side of that box, here and below in units of the preset
  double nearest = 0;               ///< from the middle to the nearest point of the surface
  double farthest = 1;              ///< and to the farthest
  bool middle_inside = true;        ///< whether the object encloses its middle
};

/// The index into preset.scene.objects. Throws bad_input at FILE#/environment/object, with the candidates, where environment.object names
/// no object of glass and no mirror, or names none and there is not just one.
std::size_t caster_index(const preset::Preset& preset);

/// Reads the object again. Throws bad_input as caster_index and scene::load_scene, and for an object without a surface.
Caster make_caster(const preset::Preset& preset);

/// Radii of the spheres, ascending: by (3.1) of the thesis, or all as far apart. The smallest is just beyond the surface where that is
/// nearest to the middle, so spheres may cut the object: what stands beneath or in the hole of an object is nearer than its farthest point.
/// It is at least a twentieth of Caster::size. Throws bad_input at FILE#/environment/reach where the largest does not enclose the object.
std::vector<double> sphere_radii(const Settings& settings, const Caster& caster, const std::string& source);

/// Of all that the photons of a bake depend on but the program: geometry, material, settings, seed.
std::uint64_t bake_key(const preset::Preset& preset, const Caster& caster);

} // namespace nephroid::environment
