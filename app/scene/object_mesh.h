// SPDX-License-Identifier: Apache-2.0
// One object's mesh into the scene: transformed in double, rounded once, then checked. Private to scene/.
#pragma once
#include "base/location.h"
#include "preset/preset.h"
#include "scene/scene.h"

namespace nephroid::scene {

/// Beyond this a squared area no longer fits into single precision. In the preset's unit, from Scene::origin.
inline constexpr double max_coordinate = 1e9;

/// p -> linear p + offset, from the mesh's positions to the preset's coordinates.
struct Placement {
  glm::dmat3 linear{1};
  glm::dvec3 offset{0};
};

/// What is wrong with a dielectric's mesh, so that inside and outside are not clear; without the object's name.
struct Damage {
  std::string what;
  std::string done; ///< what is done about it where the scene is rendered all the same; may be empty
};

struct PlacedMesh {
  Mesh mesh; ///< with normals, without degenerate or duplicated triangles
  Sphere bounds;
  bool closed = true;
  bool has_own_normals = false;      ///< from where the mesh comes
  std::vector<std::string> warnings; ///< without the object's name
  std::vector<Damage> damages;
};

/// mesh: its positions are relative to its middle, which goes into the offset in double.
Placement make_placement(const preset::Transform& transform, const Mesh& mesh);
/// In the preset's coordinates. Throws bad_input at where: they leave single precision.
Bounds placed_bounds(const Mesh& mesh, const Placement& placement, const Location& where);

/// bounds: placed_bounds. origin: the scene's, in the preset's coordinates. dielectric: closedness and orientation
/// matter then. crease_deg: of the normals that are made where the mesh has none. Throws bad_input at where: too large,
/// too small or too far away for single precision.
PlacedMesh place(const Mesh& mesh, const Placement& placement, const Bounds& bounds, const glm::dvec3& origin,
                 bool dielectric, double crease_deg, const Location& where);

/// The largest distance of a side from a coordinate plane.
double largest_coordinate(const Bounds& bounds);

/// How far objects reach, in units, from the middle of the scene's coordinates.
double scene_radius(const Scene& scene);

} // namespace nephroid::scene
