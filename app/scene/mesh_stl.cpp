// SPDX-License-Identifier: Apache-2.0
// STL as text, of any number of solids, or as bytes. Its normals are a facet's and are not meant to be smooth: they are
// left out.
#include "scene/mesh_raw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace nephroid::scene {
namespace {

constexpr std::size_t head_bytes = 84, facet_bytes = 50; // 80 of text and a count; 12 floats and 2 bytes

void add_corner(RawMesh& mesh, const glm::dvec3& place) {
  mesh.positions.push_back(place);
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  if (count % 3 == 0) mesh.triangles.emplace_back(count - 3, count - 2, count - 1);
  if (mesh.triangles.size() > max_triangles)
    throw std::runtime_error(fmt::format("more than {} triangles", max_triangles));
}

RawMesh read_text(std::string_view text) {
  RawMesh mesh;
  std::size_t line = 1;
  bool is_open = false;
  for (std::string_view word = next_word(text, &line); !word.empty(); word = next_word(text, &line)) {
    if (word == "solid" || word == "endsolid") // a name follows, which may be any words
      text.remove_prefix(std::min(text.find('\n'), text.size()));
    is_open = word == "facet" || (is_open && word != "endfacet");
    if (word != "vertex") continue;
    glm::dvec3 place;
    for (int i = 0; i < 3; ++i) place[i] = coordinate_of(next_word(text, &line), line);
    add_corner(mesh, place);
  }
  if (is_open || mesh.positions.size() % 3 != 0) throw std::runtime_error("the file ends within a facet; it is cut");
  return mesh;
}

} // namespace

RawMesh read_stl(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= head_bytes) std::memcpy(&count, bytes.data() + head_bytes - sizeof count, sizeof count);
  const std::uint64_t size = head_bytes + facet_bytes * std::uint64_t{count};
  std::string_view text = bytes;
  // Some files of bytes begin with "solid" too.
  if (bytes.size() != size && next_word(text) == "solid") return read_text(bytes);
  if (bytes.size() < head_bytes || bytes.size() < size)
    throw std::runtime_error(fmt::format("the file has {} bytes of the {} that {} facets need; it is cut, or no STL",
                                         bytes.size(), size, count));
  RawMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<float, 12> facet{};
    std::memcpy(facet.data(), bytes.data() + head_bytes + facet_bytes * i, sizeof facet);
    for (std::size_t corner = 3; corner < facet.size(); corner += 3) {
      const glm::vec3 place(facet[corner], facet[corner + 1], facet[corner + 2]);
      if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z))
        throw std::runtime_error(fmt::format("facet {} has a coordinate that is not a finite number", i));
      add_corner(mesh, place);
    }
  }
  return mesh;
}

} // namespace nephroid::scene
