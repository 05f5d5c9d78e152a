// SPDX-License-Identifier: Apache-2.0
#include "formats/import/pbrt_mesh.h"

#include "base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::formats {

scene::Mesh pbrt_mesh(const std::string& type, const PbrtParameters& p) {
  const PbrtParameter* points = p.find("P");
  if (!points) throw bad_input(p.where, "has no points \"P\"");
  const auto v = points->numbers();
  if (v.size() % 3 != 0 || v.empty())
    throw bad_input(points->where, fmt::format("\"P\" has {} numbers", v.size()), "expected threes");
  scene::Mesh mesh;
  for (std::size_t i = 0; i < v.size(); i += 3) mesh.positions.emplace_back(v[i], v[i + 1], v[i + 2]);
  const std::size_t corners = type == "trianglemesh" ? 3 : 4;
  std::vector<double> indices{0, 1, 2, 3};
  indices.resize(corners);
  if (p.find("indices")) indices = p.find("indices")->numbers();
  if (indices.empty() || indices.size() % corners != 0)
    throw bad_input(p.where, fmt::format("has {} indices", indices.size()));
  std::vector<std::uint32_t> index;
  for (const double i : indices) {
    if (i < 0 || i >= static_cast<double>(mesh.positions.size()) || i != std::floor(i))
      throw bad_input(p.where, fmt::format("there is no point {} in it", i),
                      fmt::format("expected 0 to {}", mesh.positions.size() - 1));
    index.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t i = 0; i < index.size(); i += corners) {
    mesh.triangles.emplace_back(index[i], index[i + 1], index[i + (corners == 3 ? 2 : 3)]);
    if (corners == 4)
      mesh.triangles.emplace_back(index[i], index[i + 3], index[i + 2]); // a patch's corners are 00, 10, 01, 11
  }
  if (const PbrtParameter* normals = p.find("N")) {
    const auto n = normals->numbers();
    if (n.size() == v.size())
      for (std::size_t i = 0; i < n.size(); i += 3) {
        const glm::dvec3 normal(n[i], n[i + 1], n[i + 2]);
        mesh.normals.emplace_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::dvec3(0, 0, 1));
      }
  }
  return mesh;
}

} // namespace nephroid::formats
