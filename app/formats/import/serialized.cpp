// SPDX-License-Identifier: Apache-2.0
#include "formats/import/serialized.h"

#include "base/files.h"
#include "base/inflate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nephroid::formats {
namespace {

enum Flags : std::uint32_t {
  has_normals = 0x0001,
  has_texture_coordinates = 0x0002,
  has_colours = 0x0008,
  has_face_normals = 0x0010,
  is_double = 0x2000
};

constexpr std::uint16_t magic = 0x041C;
constexpr std::uint64_t most_vertices = 3 * scene::max_triangles;

/// The value at this place of the file, which is little-endian as the machine is.
template <class T>
T value_at(const std::string& bytes, std::uint64_t place, const Location& file) {
  if (place > bytes.size() || bytes.size() - place < sizeof(T)) throw bad_input(file, "is cut short");
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

/// Where mesh `index` begins: the file ends with all beginnings and their number.
std::uint64_t beginning_of(const std::string& bytes, double index, std::uint16_t version, const Location& file,
                           const Location& where) {
  if (index == 0) return 0;
  if (bytes.size() < 4) throw bad_input(file, "is cut short");
  const auto count = value_at<std::uint32_t>(bytes, bytes.size() - 4, file);
  if (!(index > 0 && index < count && index == std::floor(index)))
    throw bad_input(where, fmt::format("{} has no mesh {}", file.text(), index),
                    fmt::format("expected 0 to {}", count - 1));
  const std::uint64_t width = version == 3 ? 4 : 8, back = 4 + width * (count - static_cast<std::uint64_t>(index));
  if (back > bytes.size()) throw bad_input(file, "is cut short");
  const std::uint64_t place = bytes.size() - back;
  return width == 4 ? value_at<std::uint32_t>(bytes, place, file) : value_at<std::uint64_t>(bytes, place, file);
}

/// Memory grows with what comes, not with what is promised.
template <class Item, class Number>
void read_items(Inflater& from, std::uint64_t count, std::vector<Item>& into) {
  constexpr std::uint64_t piece = 1 << 16;
  constexpr int width = sizeof(Item) / sizeof(into[0][0]);
  std::vector<std::array<Number, width>> read;
  while (into.size() < count) {
    read.resize(std::min(piece, count - into.size()));
    from.read(std::as_writable_bytes(std::span(read)));
    for (const auto& numbers : read) {
      Item& item = into.emplace_back();
      for (int i = 0; i < width; ++i)
        item[i] = static_cast<typename Item::value_type>(numbers[static_cast<std::size_t>(i)]);
    }
  }
}

template <class Number>
SerializedMesh read_mesh(Inflater& from, std::uint32_t flags, const Location& file) {
  SerializedMesh result;
  scene::Mesh& mesh = result.mesh;
  std::uint64_t vertices = 0, triangles = 0;
  from.value(vertices);
  from.value(triangles);
  if (vertices > most_vertices || triangles > scene::max_triangles)
    throw bad_input(file, fmt::format("has {} vertices and {} triangles, which is too many", vertices, triangles));
  read_items<glm::vec3, Number>(from, vertices, mesh.positions);
  if (flags & has_normals) read_items<glm::vec3, Number>(from, vertices, mesh.normals);
  std::vector<glm::vec2> coordinates;
  if (flags & has_texture_coordinates) read_items<glm::vec2, Number>(from, vertices, coordinates);
  for (glm::vec2& place : coordinates)
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) place = glm::vec2(0);
  std::vector<glm::vec3> colours;
  if (flags & has_colours) read_items<glm::vec3, Number>(from, vertices, colours);
  read_items<glm::uvec3, std::uint32_t>(from, triangles, mesh.triangles);
  for (const glm::vec3& p : mesh.positions)
    if (!(glm::length(p) < 1e15f)) throw bad_input(file, "has a vertex at no place");
  for (const glm::uvec3& t : mesh.triangles)
    if (std::max({t.x, t.y, t.z}) >= vertices) throw bad_input(file, "has a triangle with a vertex that is not there");
  if (mesh.triangles.empty()) throw bad_input(file, "has no triangles");
  if (!coordinates.empty())
    for (const glm::uvec3& t : mesh.triangles)
      mesh.texcoords.push_back({coordinates[t.x], coordinates[t.y], coordinates[t.z]});
  for (glm::vec3& n : mesh.normals) n = glm::normalize(n);
  if (std::ranges::any_of(mesh.normals, [](const glm::vec3& n) { return !(glm::length(n) > 0.5f); }))
    mesh.normals.clear();
  result.faceted = flags & has_face_normals;
  return result;
}

} // namespace

SerializedMesh read_serialized(const std::filesystem::path& file, double index, const Location& where) {
  if (!is_there(file)) throw bad_input(where, "the mesh " + file.string() + " is not there", {}, "put it there");
  const std::string bytes = read_file(file);
  const Location place(file);
  const auto version = value_at<std::uint16_t>(bytes, 2, place);
  if (value_at<std::uint16_t>(bytes, 0, place) != magic || (version != 3 && version != 4))
    throw bad_input(place, "is no serialized mesh of version 3 or 4");
  const std::uint64_t start = beginning_of(bytes, index, version, place, where);
  if (value_at<std::uint16_t>(bytes, start, place) != magic)
    throw bad_input(place, fmt::format("mesh {} does not begin where the file says", index));
  value_at<std::uint32_t>(bytes, start, place);
  Inflater from(std::string_view(bytes).substr(start + 4), place);
  std::uint32_t flags = 0;
  from.value(flags);
  for (char c = version == 4 ? 'x' : '\0'; c != '\0';) from.value(c); // its name
  return flags & is_double ? read_mesh<double>(from, flags, place) : read_mesh<float>(from, flags, place);
}

} // namespace nephroid::formats
