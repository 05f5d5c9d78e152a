// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/mesh_files.h"

#include <fmt/format.h>

#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace nephroid::inverse {
namespace {

void write_text(std::string_view text, ByteSink& to) { to.write(std::as_bytes(std::span(text))); }

} // namespace

void write_obj(const scene::Mesh& mesh, ByteSink& to)
{
  write_text("# millimetres\n", to);
  fmt::memory_buffer line;
  const auto write_line = [&] {
    write_text({line.data(), line.size()}, to);
    line.clear();
  };
  for (const glm::vec3& p : mesh.positions) {
    fmt::format_to(std::back_inserter(line), "v {} {} {}\n", p.x, p.y, p.z);
    write_line();
  }
  for (const glm::uvec3& t : mesh.triangles) {
    fmt::format_to(std::back_inserter(line), "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    write_line();
  }
}

/// 80 bytes of title, the number of triangles, then for each its normal, its corners and two empty bytes; little-endian.
void write_stl(const scene::Mesh& mesh, ByteSink& to)
{
  std::string title = "Nephroid: inverse caustics, millimetres";
  title.resize(80, ' ');
  write_text(title, to);
  to.value(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    for (const glm::vec3& v :
         {glm::vec3(glm::normalize(glm::cross(b - a, c - a))), mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]})
      to.write(std::as_bytes(std::span(&v, 1)));
    to.value(std::uint16_t{0});
  }
}

void write_ply(const scene::Mesh& mesh, ByteSink& to)
{
  write_text(fmt::format("ply\nformat binary_little_endian 1.0\ncomment Nephroid: inverse caustics, millimetres\n"
                         "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                         "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                         mesh.positions.size(), mesh.triangles.size()),
             to);
  to.write(std::as_bytes(std::span(mesh.positions)));
  for (const glm::uvec3& t : mesh.triangles) {
    to.value(std::uint8_t{3});
    to.write(std::as_bytes(std::span(&t, 1)));
  }
}

} // namespace nephroid::inverse
