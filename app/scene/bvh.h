// SPDX-License-Identifier: Apache-2.0
// The bounding volume hierarchy that kernels/tracing/bvh.h traces: 8 children a node, boxes as float8, triangles in structure-of-arrays
// blocks of 4, ellipsoids in blocks of 3. Built by Embree's builder; traced by our kernel.
#pragma once
#include "scene/mesh.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nephroid::scene {

// The layout of kernels/tracing/bvh.h.
inline constexpr std::size_t children_per_node = 8, triangles_per_block = 4, ellipsoids_per_block = 3, floats_per_node = 64,
                             floats_per_block = 40, floats_per_ellipsoid = 13;

/// Layout is fixed by kernels/tracing/bvh.h, which has the description.
struct Bvh {
  std::vector<float> nodes;                    ///< 64 floats a node; at least one node
  std::vector<float> blocks;                   ///< 40 floats a block
  std::vector<std::uint32_t> ellipsoid_places; ///< of each ellipsoid's first float in blocks
  int root = 0;                                ///< node index, or ~leaf
  int depth = 0;                               ///< nodes on the longest way from the root to a leaf
  int stack = 0;                               ///< what -DNEPHROID_BVH_STACK must be at least: entries that a traversal can need at once
};

/// The -D flags of kernels that go through it.
std::map<std::string, std::string> tree_defines(const Bvh& bvh);

/// Triangles without area are left out: nothing hits them. An empty mesh gives a tree that nothing hits.
/// Throws failed where Embree has no memory, bad_input for a triangle with a missing or non-finite vertex.
Bvh build_bvh(const Mesh& mesh);

} // namespace nephroid::scene
