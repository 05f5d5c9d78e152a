// SPDX-License-Identifier: Apache-2.0
// Surfaces that the program makes itself. Flat facets have vertices of their own, so their normals are exact; curved sides share
// theirs.
#pragma once
#include "preset/preset.h"
#include "scene/mesh.h"

#include <span>

namespace nephroid::scene {

/// A shape of preset.h, centred by its bounds on the origin, y up, with normals:
/// quad: open, size x by z in the plane y = 0, facing +y. box, plate: size x, y, z.
/// sphere: an exact one, not of triangles.
/// cylinder: about the y axis, flat ends, a sharp rim.
/// prism: stands along y; the apex edge at +z, the third side at -z, facing -z.
/// brilliant: the round brilliant cut, table up: 57 facets and 16 of the girdle (brilliant.cpp).
Mesh make_shape(const preset::Shape& shape);

/// Adds a flat convex polygon, counter-clockwise seen from outside, as a fan with vertices and one normal of its own.
void add_facet(Mesh& mesh, std::span<const glm::dvec3> corners);

/// The round brilliant of unit girdle radius.
Mesh make_brilliant(); // brilliant.cpp

} // namespace nephroid::scene
