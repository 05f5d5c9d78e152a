// SPDX-License-Identifier: Apache-2.0
// The bounding volume hierarchy that kernels/tracing/bvh.h traces: 8 children a node, boxes as float8, triangles in
// structure-of-arrays blocks of 4, ellipsoids in blocks of 3. Built by Embree's builder; traced by our kernel.
#pragma once
#include "scene/mesh.h"

#include <map>
#include <string>

namespace nephroid::scene {

// The layout of kernels/tracing/bvh.h.
inline constexpr std::size_t children_per_node = 8, triangles_per_block = 4, ellipsoids_per_block = 3,
                             floats_per_node = 64, floats_per_block = 40, floats_per_ellipsoid = 13;
inline constexpr std::uint32_t no_primitive = ~0u; ///< an empty place of a block, or a ray that leaves none

/// Layout is fixed by kernels/tracing/bvh.h, which has the description.
struct Bvh {
  std::vector<float> nodes; ///< at least one node
  std::vector<float> blocks;
  bool has_ellipsoids = false;
  int root = 0;  ///< node index, or ~leaf
  int depth = 0; ///< nodes on the longest way from the root to a leaf: -DNEPHROID_BVH_DEPTH must be at least that
  int stack = 0; ///< what -DNEPHROID_BVH_STACK must be at least: entries that a traversal can need at once
  double built_cost = 0; ///< cost_of() when it was built
};

/// The -D flags of kernels that go through it. An object that moves changes the tree, but hardly ever these: a kernel
/// takes a second to compile.
std::map<std::string, std::string> tree_defines(const Bvh& bvh);

/// Triangles without area are left out: nothing hits them. An empty mesh gives a tree that nothing hits.
/// Throws failed where Embree has no memory, bad_input for a triangle with a missing or non-finite vertex.
Bvh build_bvh(const Mesh& mesh);

/// Fits a tree to where its mesh's vertices and ellipsoids are now: a tenth of the time of building one. Rays meet the
/// same as with a new tree, later the more the shapes have changed. Triangles that have an area now had one when the
/// tree was built.
void refit(Bvh& bvh, const Mesh& mesh);

/// The boxes that a ray through the tree's own box meets, on average over all such rays (MacDonald and Booth 1990,
/// "Heuristics for ray tracing using space subdivision").
double cost_of(const Bvh& bvh);

/// The tree of a mesh whose triangles are those of a tree that there is, elsewhere: that one refitted, or where its
/// cost has grown by more than a third since it was built, a new one.
Bvh refitted(const Bvh& before, const Mesh& mesh);

} // namespace nephroid::scene
