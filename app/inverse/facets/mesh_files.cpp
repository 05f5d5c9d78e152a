// SPDX-License-Identifier: Apache-2.0
// The solid as files that mesh tools read.
#include "inverse/facets/solid.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <iterator>

namespace nephroid::inverse {

std::string to_obj(const scene::Mesh& mesh)
{
  std::string text = "# millimetres\n";
  for (const glm::vec3& p : mesh.positions) fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) fmt::format_to(std::back_inserter(text), "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

/// 80 bytes of title, the number of triangles, then for each its normal, its corners and two empty bytes; little-endian.
std::string to_stl(const scene::Mesh& mesh)
{
  std::string bytes(80, ' ');
  const std::string_view title = "Nephroid: inverse caustics, millimetres";
  bytes.replace(0, title.size(), title);
  const auto append = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(&count, sizeof count);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    for (const glm::vec3& v :
         {glm::vec3(glm::normalize(glm::cross(b - a, c - a))), mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]})
      append(&v, sizeof v);
    bytes.append(2, '\0');
  }
  return bytes;
}

} // namespace nephroid::inverse
