// SPDX-License-Identifier: Apache-2.0
// The nodes of a glTF scene with their places in the world, and a place as a preset says it.
#pragma once
#include "preset/preset.h"
#include "run/import/gltf_file.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace nephroid::run {

inline preset::Vec3 vec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

struct GltfNode {
  GltfValue value;
  glm::dmat4 to_world;
};

/// Of the file's scene, parents before children, in the order of the file. Throws bad_input where nodes go round in a circle, one has two
/// parents, or there is no scene.
std::vector<GltfNode> nodes_of(const GltfFile& file);

/// The same as scale, turn and shift; nothing where the matrix shears or flattens.
std::optional<preset::Transform> transform_of(const glm::dmat4& matrix);

} // namespace nephroid::run
