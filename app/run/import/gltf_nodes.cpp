// SPDX-License-Identifier: Apache-2.0
#include "run/import/gltf_nodes.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::run {
namespace {

constexpr double degrees = 57.29577951308232;

/// Of a unit quaternion (x, y, z, w).
glm::dmat3 rotation_of(std::array<double, 4> q)
{
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0)) return glm::dmat3(1);
  for (double& part : q) part /= length;
  const auto [x, y, z, w] = q;
  // glm's matrices are lists of columns.
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

glm::dmat4 local_matrix(const GltfValue& node)
{
  if (node.has("matrix")) {
    const auto m = node.numbers<16>("matrix", {});
    glm::dmat4 matrix(1);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) matrix[column][row] = m[4 * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)];
    return matrix;
  }
  const auto t = node.numbers<3>("translation", {0, 0, 0}), s = node.numbers<3>("scale", {1, 1, 1});
  const glm::dmat3 r = rotation_of(node.numbers<4>("rotation", {0, 0, 0, 1}));
  return {glm::dvec4(r[0] * s[0], 0), glm::dvec4(r[1] * s[1], 0), glm::dvec4(r[2] * s[2], 0), glm::dvec4(t[0], t[1], t[2], 1)};
}

std::vector<std::size_t> roots_of(const GltfValue& root, std::size_t count)
{
  const std::vector<GltfValue> scenes = root.list("scenes");
  if (scenes.empty()) throw bad_input(root.where(), "has no scene", "expected nodes to import");
  return root.item("scenes", root.has("scene") ? root.index("scene", scenes.size(), "scenes") : 0).indices("nodes", count, "nodes");
}

} // namespace

std::vector<GltfNode> nodes_of(const GltfFile& file)
{
  const GltfValue root(file.json, file.where());
  const std::vector<GltfValue> all = root.list("nodes");
  std::vector<bool> seen(all.size());
  std::vector<GltfNode> nodes;
  struct Task {
    std::size_t index;
    glm::dmat4 parent;
  };
  // A list of tasks and no recursion: a file may nest its nodes as deep as it likes.
  std::vector<Task> tasks;
  const auto add = [&](const std::vector<std::size_t>& indices, const glm::dmat4& parent) {
    for (auto index = indices.rbegin(); index != indices.rend(); ++index) tasks.push_back({*index, parent});
  };
  add(roots_of(root, all.size()), glm::dmat4(1));
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const GltfValue& node = all[task.index];
    if (seen[task.index]) throw bad_input(node.where(), "the node has two parents, or nodes go round in a circle", "expected a tree");
    seen[task.index] = true;
    nodes.push_back({node, task.parent * local_matrix(node)});
    add(node.indices("children", all.size(), "nodes"), nodes.back().to_world);
  }
  return nodes;
}

std::optional<preset::Transform> transform_of(const glm::dmat4& matrix)
{
  glm::dmat3 axes(matrix);
  glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (std::min({scale.x, scale.y, scale.z}) < 1e-6 || std::max({scale.x, scale.y, scale.z}) > 1e6) return std::nullopt;
  if (glm::determinant(axes) < 0) scale.x = -scale.x; // a mirror
  for (int i = 0; i < 3; ++i) axes[i] /= scale[i];
  for (int i = 0; i < 3; ++i)
    if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > 1e-6) return std::nullopt;
  // R = Rz Ry Rx, so its third row is (-sin y, cos y sin x, cos y cos x) and its first column (cos y cos z, cos y sin z, -sin y).
  const double sin_y = std::clamp(-axes[0][2], -1.0, 1.0), y = std::asin(sin_y);
  const bool pole = std::abs(sin_y) > 1 - 1e-12; // x and z turn about one axis: all of it is x
  const double x = pole ? std::atan2(-axes[2][1], axes[1][1]) : std::atan2(axes[1][2], axes[2][2]);
  const double z = pole ? 0 : std::atan2(axes[0][1], axes[0][0]);
  preset::Transform transform;
  for (std::size_t i = 0; i < 3; ++i) {
    transform.scale[i] = scale[static_cast<int>(i)];
    transform.translate[i] = matrix[3][static_cast<int>(i)];
    if (!std::isfinite(transform.translate[i]) || std::abs(transform.translate[i]) > 1e7) return std::nullopt;
  }
  transform.rotate_deg = {x * degrees, y * degrees, z * degrees};
  return transform;
}

} // namespace nephroid::run
