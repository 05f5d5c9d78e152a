// SPDX-License-Identifier: Apache-2.0
// Meshes and rays that kernel tests and benchmarks share.
#pragma once
#include "scene/mesh.h"
#include "tests/support/standard.h"

#include <glm/gtc/constants.hpp>

namespace nephroid::test {

/// A unit sphere about the origin of 2 columns (rows - 1) triangles, closed.
inline scene::Mesh sphere_mesh(std::uint32_t columns, std::uint32_t rows) {
  scene::Mesh mesh;
  mesh.positions.emplace_back(0, 1, 0);
  for (std::uint32_t row = 1; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double theta = glm::pi<double>() * row / rows, phi = glm::two_pi<double>() * column / columns;
      mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    }
  mesh.positions.emplace_back(0, -1, 0);
  const auto vertex = [&](std::uint32_t row, std::uint32_t column) {
    return 1 + (row - 1) * columns + column % columns;
  };
  const auto south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t column = 0; column < columns; ++column) {
    mesh.triangles.emplace_back(0, vertex(1, column + 1), vertex(1, column));
    for (std::uint32_t row = 1; row + 1 < rows; ++row) {
      mesh.triangles.emplace_back(vertex(row, column), vertex(row, column + 1), vertex(row + 1, column));
      mesh.triangles.emplace_back(vertex(row, column + 1), vertex(row + 1, column + 1), vertex(row + 1, column));
    }
    mesh.triangles.emplace_back(south, vertex(rows - 1, column), vertex(rows - 1, column + 1));
  }
  return mesh;
}

/// The cube [-1, 1]^3 of 12 triangles, closed.
inline scene::Mesh box_mesh() {
  scene::Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const glm::uvec4 faces[] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const glm::uvec4& f : faces) {
    mesh.triangles.emplace_back(f.x, f.y, f.z);
    mesh.triangles.emplace_back(f.x, f.z, f.w);
  }
  return mesh;
}

/// The mesh about the origin with its farthest vertex at 1, then scaled and moved.
inline scene::Mesh placed(scene::Mesh mesh, float scale, const glm::vec3& centre) {
  glm::vec3 low = mesh.positions.front(), high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec3 middle = 0.5f * (low + high);
  float radius = 0;
  for (const glm::vec3& p : mesh.positions) radius = std::max(radius, glm::length(p - middle));
  for (glm::vec3& p : mesh.positions) p = (p - middle) * (scale / radius) + centre;
  return mesh;
}

/// Uniform on the unit sphere (Marsaglia 1972).
inline glm::vec3 random_direction(std::mt19937& random) {
  std::uniform_real_distribution<float> uniform(-1, 1);
  while (true) {
    const glm::vec2 p(uniform(random), uniform(random));
    const float s = glm::dot(p, p);
    if (s < 1) return {2 * p.x * std::sqrt(1 - s), 2 * p.y * std::sqrt(1 - s), 1 - 2 * s};
  }
}

/// As data URIs of glTF have it.
inline std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

} // namespace nephroid::test
