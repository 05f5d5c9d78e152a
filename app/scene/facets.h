// SPDX-License-Identifier: Apache-2.0
// How shapes.cpp and brilliant.cpp put flat facets together.
#pragma once
#include "scene/mesh.h"

#include <span>

namespace nephroid::scene {

/// Adds a flat convex polygon, counter-clockwise seen from outside, as a fan with vertices and one normal of its own.
void add_facet(Mesh& mesh, std::span<const glm::dvec3> corners);

/// The round brilliant of unit girdle radius.
Mesh make_brilliant();

} // namespace nephroid::scene
