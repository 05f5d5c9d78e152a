// SPDX-License-Identifier: Apache-2.0
// The objects that are baked, alone, in coordinates in which the first of them is neither turned nor moved. So a bake
// stays right when the preset turns or moves all of them together. Moving them against each other needs another bake.
#pragma once
#include "environment/settings.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::environment {

/// The distances of a baked scene's surface from (0, 0, 0), the middle of its spheres.
struct Extent {
  double nearest = 0;        ///< the least distance of the surface that touches air, where light may leave
  double farthest = 0;       ///< the greatest distance of any surface
  bool middle_inside = true; ///< whether an object encloses the middle
};

struct Caster {
  std::string name;                 ///< the objects' names, for messages
  std::vector<std::size_t> objects; ///< their indices in the preset and in its scene, ascending
  scene::Scene scene;               ///< these objects and one white light; the middle of their box is (0, 0, 0)
  double size = 1;                  ///< the largest side of that box; lengths are in units of the preset
  Extent extent;
};

bool casts(const preset::Preset& preset, const preset::Object& object);

/// The indices into preset.scene.objects, ascending. Throws bad_input at FILE#/environment/objects for a name that is
/// no glass object or mirror or comes twice, and where there is nothing to bake.
std::vector<std::size_t> caster_objects(const preset::Preset& preset);

/// Throws bad_input as caster_objects and scene::load_scene do, and for an object without a surface.
Caster make_caster(const preset::Preset& preset);

/// The spheres' radii, ascending: by (3.1) of the thesis, or evenly spaced. The smallest is just beyond the nearest
/// point of the surface, at least a twentieth of Caster::size: spheres reach what stands beneath an object or in its
/// hole, and may cut it. Throws bad_input at FILE#/environment/reach where the largest does not enclose the objects.
std::vector<double> sphere_radii(const Settings& settings, const Caster& caster, const std::string& source);

/// A hash of what a bake's photons depend on, the program apart: geometry, material, settings, seed.
std::uint64_t bake_key(const preset::Preset& preset, const Caster& caster);

/// A shape that is baked.
struct BakedShape {
  preset::Preset preset; ///< with the weights of states at which the shape is baked
  double weight = 1;     ///< how much its spheres count, above 0
};

/// The shapes between which the baked objects are by the weights of their states: the corners of a cell of the grid of
/// Settings::weight_steps, with multilinear weights, which sum to 1. It is the preset's own shape alone where its
/// weights are on the grid, and where there is none. Throws bad_input at FILE#/environment/weight_steps for more than 8
/// corners.
std::vector<BakedShape> baked_shapes(const preset::Preset& preset);

/// Whether the caster's spheres are mixed of the same bakes in both presets, which differ at most in weights of states.
bool mixes_alike(const preset::Preset& a, const preset::Preset& b);

/// Where the baked spheres stand in the scene: from the bake's coordinates (Caster::scene and Bake, with (0, 0, 0) in
/// the middle of the spheres) to the scene's (scene::Scene::origin), both in units of the preset.
struct Placement {
  glm::dmat3 turn{1};   ///< a rotation; its transpose leads back
  glm::dvec3 middle{0}; ///< the spheres' middle in the scene's coordinates
};

/// scene: the preset's. caster: of a preset that differs at most in where objects, lights and cameras are.
Placement placement(const preset::Preset& preset, const Caster& caster, const scene::Scene& scene);

/// What lies inside another glass object, like liquid in its glass, is not part of the surface. Where a triangle or an
/// ellipsoid lies inside only in part, a few of its points decide. For an ellipsoid that is no sphere and is off the
/// middle, `nearest` is a lower bound and `farthest` an upper one.
Extent extent_of(const scene::Scene& scene);

} // namespace nephroid::environment
