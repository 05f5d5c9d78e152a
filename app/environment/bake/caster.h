// SPDX-License-Identifier: Apache-2.0
// The objects that are baked: alone, in coordinates of their own, where the first of them is neither turned nor moved.
// So a bake stays right when the preset turns or moves all of them together, and is another one where it moves them
// against each other.
#pragma once
#include "environment/settings.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::environment {

/// How near and how far the surface of a baked scene is, as seen from (0, 0, 0), the middle of its spheres.
struct Extent {
  double nearest = 0;        ///< of the surface that air touches, which light may leave
  double farthest = 0;       ///< of all of it
  bool middle_inside = true; ///< whether an object encloses the middle
};

struct Caster {
  std::string name;                 ///< of the objects, for messages
  std::vector<std::size_t> objects; ///< their indices in the preset and in its scene, ascending
  scene::Scene scene;               ///< these and one light, white; the middle of the box about them is at (0, 0, 0)
  double size = 1;                  ///< largest side of that box, here and below in units of the preset
  Extent extent;                    ///< of their surface
};

/// Whether an object is of glass or a mirror.
bool casts(const preset::Preset& preset, const preset::Object& object);

/// The indices into preset.scene.objects, ascending. Throws bad_input at FILE#/environment/objects, with the
/// candidates, where a name there is of no object of glass and no mirror, or is named twice, and where there is nothing
/// to bake.
std::vector<std::size_t> caster_objects(const preset::Preset& preset);

/// Reads the objects again. Throws bad_input as caster_objects and scene::load_scene, and for an object without a
/// surface.
Caster make_caster(const preset::Preset& preset);

/// Radii of the spheres, ascending: by (3.1) of the thesis, or all as far apart. The smallest is just beyond the
/// surface where that is nearest to the middle, so spheres may cut the objects: what stands beneath or in the hole of
/// one is nearer than its farthest point. It is at least a twentieth of Caster::size. Throws bad_input at
/// FILE#/environment/reach where the largest does not enclose the objects.
std::vector<double> sphere_radii(const Settings& settings, const Caster& caster, const std::string& source);

/// Of all that the photons of a bake depend on but the program: geometry, material, settings, seed.
std::uint64_t bake_key(const preset::Preset& preset, const Caster& caster);

/// Where the baked spheres stand in the scene: from the bake's coordinates (those of Caster::scene and Bake, whose
/// spheres are about (0, 0, 0)) to the scene's (of scene::Scene::origin). Both are in units of the preset. Directions,
/// of light too, are turned alone.
struct Placement {
  glm::dmat3 turn{1};   ///< a rotation; its transpose leads back
  glm::dvec3 middle{0}; ///< of the spheres, in the scene's coordinates
};

/// scene: of the preset. caster: of the preset, or of another one in which only objects, lights and cameras are turned
/// and moved.
Placement placement(const preset::Preset& preset, const Caster& caster, const scene::Scene& scene);

/// What lies inside another object of glass is not the surface: liquid behind the wall of its glass. Of a triangle or
/// an ellipsoid that does so in part, a few points tell. `nearest` is a lower bound where an ellipsoid that is no
/// sphere is off the middle, `farthest` an upper one.
Extent extent_of(const scene::Scene& scene);

} // namespace nephroid::environment
