// SPDX-License-Identifier: Apache-2.0
// The bounding volume hierarchy that kernels/bvh.h traces: 8 children a node, boxes as float8, triangles in structure-of-arrays
// blocks of 4. Built by Embree's builder; traced by our kernel.
#pragma once
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace nephroid::scene {

/// Layout is fixed by kernels/bvh.h, which has the description.
struct Bvh {
  std::vector<float> nodes;    ///< 64 floats a node
  std::vector<float> blocks;   ///< 40 floats a block of 4 triangles
  int root = 0;                ///< node index, or ~leaf
  int depth = 0;
};

/// Throws failed where Embree has no memory; an empty mesh gives a tree that nothing hits.
Bvh build_bvh(const Mesh& mesh);

} // namespace nephroid::scene
