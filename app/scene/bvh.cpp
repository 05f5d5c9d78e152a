// SPDX-License-Identifier: Apache-2.0
// Builds the tree of kernels/tracing/bvh.h: Embree decides how triangles are grouped, this file lays the groups out for
// the kernel.
#include "scene/bvh.h"

#include "base/error.h"
#include "base/parallel.h"
#include "scene/mesh_parts.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

namespace nephroid::scene {
namespace {

constexpr std::size_t primitives_per_leaf = 8;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Box {
  glm::vec3 low{infinity}, high{-infinity};

  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

/// What Embree's callbacks make: a Leaf, or an Inner node with its children.
struct BuildNode {
  bool leaf = false;
  std::uint32_t count = 0; ///< primitives or children
};

struct Inner : BuildNode {
  std::array<const BuildNode*, children_per_node> children;
  std::array<Box, children_per_node> boxes;
};

struct Leaf : BuildNode {
  std::array<std::uint32_t, primitives_per_leaf> primitives;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned int count, void*) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(Inner), alignof(Inner))) Inner;
  node->count = count;
  return static_cast<BuildNode*>(node);
}

void set_children(void* node, void** children, unsigned int count, void*) {
  auto& inner = static_cast<Inner&>(*static_cast<BuildNode*>(node));
  for (unsigned int i = 0; i < count; ++i) inner.children[i] = static_cast<const BuildNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
  auto& inner = static_cast<Inner&>(*static_cast<BuildNode*>(node));
  for (unsigned int i = 0; i < count; ++i) {
    const RTCBounds& b = *bounds[i];
    inner.boxes[i] = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
  }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Leaf), alignof(Leaf))) Leaf;
  leaf->leaf = true;
  leaf->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
  return static_cast<BuildNode*>(leaf);
}

/// Whether the triangle has an area: its doubled area vector is computed without rounding that could hide one.
bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  return n.x != 0 || n.y != 0 || n.z != 0;
}

void check_triangle(const Mesh& mesh, std::size_t index) {
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t vertex = mesh.triangles[index][i];
    const Location where = fmt::format("triangle {}", index);
    if (vertex >= mesh.positions.size())
      throw bad_input(where, fmt::format("has vertex {}, of {}", vertex, mesh.positions.size()));
    if (!is_within_reach(mesh.positions[vertex]))
      throw bad_input(where, "has a vertex beyond 1e18, or that is no number");
  }
}

/// The box of a triangle or, counted on, of an ellipsoid, grown by more than the rounding errors of the traversal that
/// come from its own coordinates (those that come from the ray's origin are the ray's share: bvh_ray in
/// kernels/tracing/bvh.h). A small object beside large ones keeps tight boxes.
Box primitive_box(const Mesh& mesh, std::size_t primitive) {
  Box box;
  if (primitive < mesh.triangles.size()) {
    const glm::uvec3& t = mesh.triangles[primitive];
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    box = {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
  } else {
    const Ellipsoid& ellipsoid = mesh.ellipsoids[primitive - mesh.triangles.size()];
    const glm::vec3 half(half_extent(ellipsoid));
    box = {ellipsoid.centre - half, ellipsoid.centre + half};
  }
  const glm::vec3 largest = glm::max(glm::abs(box.low), glm::abs(box.high));
  const float slack = 0x1p-20f * std::max({largest.x, largest.y, largest.z});
  return {box.low - slack, box.high + slack};
}

/// Boxes of the ellipsoids and of the triangles with an area.
std::vector<RTCBuildPrimitive> primitive_boxes(const Mesh& mesh) {
  std::vector<RTCBuildPrimitive> boxes;
  boxes.reserve(mesh.triangles.size() + mesh.ellipsoids.size());
  for (std::size_t i = 0; i < mesh.triangles.size() + mesh.ellipsoids.size(); ++i) {
    if (i < mesh.triangles.size()) {
      check_triangle(mesh, i);
      const glm::uvec3& t = mesh.triangles[i];
      if (!has_area(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])) continue;
    }
    const auto [low, high] = primitive_box(mesh, i);
    if (!is_within_reach(low) || !is_within_reach(high))
      throw bad_input(fmt::format("ellipsoid {}", i - mesh.triangles.size()), "reaches beyond 1e18, or is no number");
    boxes.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, static_cast<unsigned int>(i)});
  }
  return boxes;
}

/// lane: of the block, its first float. missing: one point stands in its place, the triangle's first vertex.
void set_triangle(float* lane, const Mesh& mesh, std::uint32_t triangle, bool missing) {
  for (int corner = 0; corner < 3; ++corner) {
    const glm::vec3& p = mesh.positions[mesh.triangles[triangle][missing ? 0 : corner]];
    for (int axis = 0; axis < 3; ++axis)
      lane[static_cast<std::size_t>(3 * corner + axis) * triangles_per_block] = p[axis];
  }
  std::memcpy(lane + 9 * triangles_per_block, &triangle, sizeof triangle);
}

void set_ellipsoid(float* place, const Ellipsoid& ellipsoid) {
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::vec3 data[] = {ellipsoid.centre, glm::vec3(rows[0]), glm::vec3(rows[1]), glm::vec3(rows[2])};
  std::memcpy(place, data, sizeof data);
}

void set_box(float* child, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    child[16 * axis] = box.low[static_cast<int>(axis)];
    child[16 * axis + 8] = box.high[static_cast<int>(axis)];
  }
}

Box box_at(const float* child) { return {{child[0], child[16], child[32]}, {child[8], child[24], child[40]}}; }

/// Half its surface.
double area_of(const Box& box) {
  const glm::dvec3 edges = glm::dvec3(box.high) - glm::dvec3(box.low);
  return edges.x * edges.y + edges.y * edges.z + edges.z * edges.x;
}

/// Lays Embree's nodes out in the kernel's format, depth first.
class Layout {
public:
  Layout(const Mesh& mesh, Bvh& bvh) : mesh_(mesh), bvh_(bvh) { bvh.has_ellipsoids = !mesh.ellipsoids.empty(); }

  /// What a parent's child entry holds; adds the subtree's depth and stack entries to those of its ancestors.
  int add(const BuildNode& node, int depth, int stack) {
    bvh_.depth = std::max(bvh_.depth, depth);
    bvh_.stack = std::max(bvh_.stack, stack);
    return node.leaf ? add_leaf(static_cast<const Leaf&>(node))
                     : add_node(static_cast<const Inner&>(node), depth, stack);
  }

private:
  int add_leaf(const Leaf& leaf) {
    std::vector<std::uint32_t> triangles, ellipsoids;
    for (std::uint32_t i = 0; i < leaf.count; ++i)
      (leaf.primitives[i] < mesh_.triangles.size() ? triangles : ellipsoids).push_back(leaf.primitives[i]);
    const std::size_t first = bvh_.blocks.size() / floats_per_block;
    const std::size_t count = (triangles.size() + triangles_per_block - 1) / triangles_per_block;
    add_triangles(triangles, count);
    const std::size_t round_count = (ellipsoids.size() + ellipsoids_per_block - 1) / ellipsoids_per_block;
    add_ellipsoids(ellipsoids, round_count);
    return ~static_cast<int>(first << 4 | round_count << 2 | count);
  }

  void add_triangles(const std::vector<std::uint32_t>& triangles, std::size_t count) {
    const std::size_t first = bvh_.blocks.size() / floats_per_block;
    bvh_.blocks.resize(bvh_.blocks.size() + count * floats_per_block);
    for (std::size_t i = 0; i < count * triangles_per_block; ++i) {
      float* block =
          bvh_.blocks.data() + (first + i / triangles_per_block) * floats_per_block + i % triangles_per_block;
      // A missing triangle is one point: three times the last triangle's first vertex.
      const bool missing = i >= triangles.size();
      set_triangle(block, mesh_, missing ? triangles.back() : triangles[i], missing);
    }
  }

  void add_ellipsoids(const std::vector<std::uint32_t>& ellipsoids, std::size_t count) {
    const std::size_t first = bvh_.blocks.size();
    bvh_.blocks.resize(first + count * floats_per_block);
    for (std::size_t i = 0; i < count * ellipsoids_per_block; ++i) {
      const std::size_t place =
          first + i / ellipsoids_per_block * floats_per_block + i % ellipsoids_per_block * floats_per_ellipsoid;
      const bool missing = i >= ellipsoids.size();
      const std::uint32_t primitive = missing ? ~0u : ellipsoids[i];
      std::memcpy(bvh_.blocks.data() + place + 12, &primitive, sizeof primitive);
      if (missing) continue;
      set_ellipsoid(bvh_.blocks.data() + place, mesh_.ellipsoids[primitive - mesh_.triangles.size()]);
    }
  }

  int add_node(const Inner& node, int depth, int stack) {
    const std::size_t index = bvh_.nodes.size() / floats_per_node;
    bvh_.nodes.resize(bvh_.nodes.size() + floats_per_node);
    for (std::uint32_t i = 0; i < children_per_node; ++i) {
      const bool missing = i >= node.count;
      const Box box = missing ? Box{} : node.boxes[i];
      // While one child is visited, the others may wait; any_hit has one more on its stack.
      const int child = missing ? 0 : add(*node.children[i], depth + 1, stack + static_cast<int>(node.count) - 1);
      float* to = bvh_.nodes.data() + index * floats_per_node + i;
      set_box(to, box);
      std::memcpy(to + 48, &child, sizeof child);
    }
    return static_cast<int>(index);
  }

  const Mesh& mesh_;
  Bvh& bvh_;
};

/// Writes a leaf's primitives where the mesh has them now. Returns their box.
Box refit_leaf(Bvh& bvh, int leaf, const Mesh& mesh) {
  const auto entry = static_cast<std::uint32_t>(~leaf);
  float* block = bvh.blocks.data() + (entry >> 4) * floats_per_block;
  Box box;
  const auto number_at = [](const float* place) { return std::bit_cast<std::uint32_t>(*place); };
  std::uint32_t before = no_primitive;
  for (std::uint32_t b = 0; b < (entry & 3); ++b, block += floats_per_block)
    for (std::size_t i = 0; i < triangles_per_block; ++i) {
      const std::uint32_t triangle = number_at(block + 9 * triangles_per_block + i);
      set_triangle(block + i, mesh, triangle, triangle == before);
      box.add(primitive_box(mesh, triangle));
      before = triangle;
    }
  for (std::uint32_t b = 0; b < (entry >> 2 & 3); ++b, block += floats_per_block)
    for (std::size_t i = 0; i < ellipsoids_per_block; ++i) {
      const std::uint32_t ellipsoid = number_at(block + i * floats_per_ellipsoid + 12);
      if (ellipsoid == no_primitive) continue;
      set_ellipsoid(block + i * floats_per_ellipsoid, mesh.ellipsoids[ellipsoid - mesh.triangles.size()]);
      box.add(primitive_box(mesh, ellipsoid));
    }
  return box;
}

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct BvhRelease {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

} // namespace

std::map<std::string, std::string> tree_defines(const Bvh& bvh) {
  // Ellipsoids in one leaf have kernels of their own; other trees come in few sizes.
  const bool one_leaf = bvh.stack <= 1 && bvh.has_ellipsoids;
  const auto size = [](int least, int step) { return std::to_string(std::max(1, (least + step - 1) / step) * step); };
  return {{"NEPHROID_ELLIPSOIDS", bvh.has_ellipsoids ? "1" : "0"},
          {"NEPHROID_BVH_STACK", one_leaf ? "1" : size(bvh.stack, 32)},
          {"NEPHROID_BVH_DEPTH", size(bvh.depth, 16)}};
}

Bvh build_bvh(const Mesh& mesh) {
  Bvh bvh;
  bvh.stack = 1;
  std::vector<RTCBuildPrimitive> boxes = primitive_boxes(mesh);
  if (boxes.size() > (std::size_t{1} << 27)) // blocks are numbered in 27 bits
    throw bad_input("mesh", fmt::format("{} triangles and ellipsoids", boxes.size()), "at most 134 million");
  if (boxes.empty()) {
    bvh.nodes.resize(floats_per_node);
    bvh.blocks.resize(floats_per_block);
    bvh.root = ~0; // a leaf of no block
    return bvh;
  }
#ifdef __SANITIZE_THREAD__
  // ThreadSanitizer sees neither Embree's nor TBB's synchronisation and would report every callback of the builder.
  const char* const settings = "threads=1";
#else
  const char* const settings = nullptr;
#endif
  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease> device(rtcNewDevice(settings));
  const std::unique_ptr<std::remove_pointer_t<RTCBVH>, BvhRelease> build(device ? rtcNewBVH(device.get()) : nullptr);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = children_per_node;
  arguments.maxDepth = 32;
  arguments.sahBlockSize = triangles_per_block;
  arguments.maxLeafSize = primitives_per_leaf;
  arguments.intersectionCost = 0.5f; // a block of triangles against a node: 5 to 10 % faster than 1 (tests/bench)
  arguments.bvh = build.get();
  arguments.primitives = boxes.data();
  arguments.primitiveCount = boxes.size();
  arguments.primitiveArrayCapacity = boxes.capacity();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  const auto* root = build ? static_cast<const BuildNode*>(rtcBuildBVH(&arguments)) : nullptr;
  if (!root)
    throw failed("mesh", fmt::format("Embree built no tree over {} primitives (error {})", boxes.size(),
                                     int{rtcGetDeviceError(device.get())}));
  boxes = {}; // they take as much as the tree
  bvh.root = Layout(mesh, bvh).add(*root, 0, 1);
  if (bvh.nodes.empty()) bvh.nodes.resize(floats_per_node); // the root is a leaf
  bvh.built_cost = cost_of(bvh);
  return bvh;
}

void refit(Bvh& bvh, const Mesh& mesh) {
  if (bvh.root < 0) refit_leaf(bvh, bvh.root, mesh);
  const std::size_t count = bvh.nodes.size() / floats_per_node;
  const auto child_of = [&](const float* place) { return std::bit_cast<int>(place[48]); }; // 0: none, as the root is
  for_ranges(count, 1024, [&](std::size_t, Range nodes) {
    for (float* to = bvh.nodes.data() + nodes.begin * floats_per_node;
         to < bvh.nodes.data() + nodes.end * floats_per_node; to += floats_per_node)
      for (std::size_t i = 0; i < children_per_node; ++i)
        if (child_of(to + i) < 0) set_box(to + i, refit_leaf(bvh, child_of(to + i), mesh));
  });
  std::vector<Box> boxes(count);
  for (std::size_t node = count; node-- > 0;) // children come after their parents
    for (std::size_t i = 0; i < children_per_node; ++i) {
      float* to = bvh.nodes.data() + node * floats_per_node + i;
      const int child = child_of(to);
      if (child > 0) set_box(to, boxes[static_cast<std::size_t>(child)]);
      if (child != 0) boxes[node].add(box_at(to));
    }
}

double cost_of(const Bvh& bvh) {
  Box whole;
  double sum = 0;
  for (std::size_t node = 0; node < bvh.nodes.size() / floats_per_node; ++node)
    for (std::size_t i = 0; i < children_per_node; ++i) {
      const float* place = bvh.nodes.data() + node * floats_per_node + i;
      if (std::bit_cast<int>(place[48]) == 0) continue;
      const Box box = box_at(place);
      sum += area_of(box);
      if (node == 0) whole.add(box); // the root is the first node
    }
  return sum > 0 ? sum / area_of(whole) : 1;
}

Bvh refitted(const Bvh& before, const Mesh& mesh) {
  Bvh bvh = before;
  refit(bvh, mesh);
  return cost_of(bvh) > 4.0 / 3 * bvh.built_cost ? build_bvh(mesh) : bvh;
}

} // namespace nephroid::scene
