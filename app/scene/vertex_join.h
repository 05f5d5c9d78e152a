// SPDX-License-Identifier: Apache-2.0
// Which vertices of a mesh are one and the same. Used by mesh.cpp and mesh_file.cpp only.
#pragma once
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace nephroid::scene {

/// For each vertex the first vertex with exactly the same position (0 and -0 are the same), or with the same position and normal.
std::vector<std::uint32_t> first_equal_vertex(const Mesh& mesh, bool compare_normals);

/// The angle-weighted mean normal of the triangles at each vertex, unit; vertices with the same entry in `same` share one mean.
/// (0, 0, 0) where no triangle with an area meets.
std::vector<glm::vec3> mean_normals(const Mesh& mesh, const std::vector<std::uint32_t>& same);

} // namespace nephroid::scene
