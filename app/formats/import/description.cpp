// SPDX-License-Identifier: Apache-2.0
#include "formats/import/description.h"

#include "base/error.h"
#include "base/files.h"
#include "base/inflate.h"
#include "base/lower_case.h"
#include "base/numbers.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <numbers>

namespace nephroid::formats {

namespace fs = std::filesystem;
using std::numbers::pi;

namespace {

/// The mesh reader takes a file by its ending, so it gets an unpacked one.
scene::Mesh packed_mesh(const fs::path& file) {
  const std::string bytes = inflated(read_file(file), file);
  const TemporaryFolder folder;
  const fs::path unpacked = folder.path() / file.stem().filename();
  write_file_whole(unpacked, bytes);
  try {
    return scene::load_mesh(unpacked);
  } catch (const Error& error) {
    throw error.at(file);
  }
}

} // namespace

Nesting::Nesting(int& depth, const char* what, const Location& where) : depth_(depth) {
  constexpr int deepest = 8;
  if (depth_ >= deepest)
    throw bad_input(where,
                    fmt::format("{} are in each other more than {} deep, or go round in a circle", what, deepest));
  ++depth_;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "nephroid-import-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw failed(name, std::string("cannot be made: ") + std::strerror(errno), {},
                 "set TMPDIR to a folder that you may write to");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string read_packed_file(const fs::path& file) {
  const std::string bytes = read_file(file);
  return lower_case(file.extension().string()) == ".gz" ? inflated(bytes, file) : bytes;
}

std::string ending_of(const fs::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".gz" ? lower_case(file.stem().extension().string()) : ending;
}

void describe_file(const fs::path& file, Description& into) {
  const std::string kind = ending_of(file);
  if (kind == ".xml") return describe_mitsuba(file, into);
  if (kind == ".pbrt") return describe_pbrt(file, into);
  if (kind == ".asc") return describe_gemcad(file, into);
  describe_gltf(file, into);
}

void Description::note(const std::string& text) {
  if (noted.insert(text).second) notes.push_back(text);
}

void Description::note_length_of_paths(const Location& where, const char* field, double most) {
  constexpr double few = 8;
  if (most >= 0 && most < few)
    note(where, fmt::format("paths end at {} {:g} there, and are followed to their end here", field, most));
}

std::string Description::mesh_file(const std::filesystem::path& file, const Location& where) {
  std::string& key = mesh_files[file.lexically_normal()];
  if (!key.empty()) return key;
  if (!is_there(file)) throw bad_input(where, "the mesh " + file.string() + " is not there", {}, "put it there");
  const bool packed = lower_case(file.extension().string()) == ".gz";
  return key = own_mesh(file.stem().string(), packed ? packed_mesh(file) : scene::load_mesh(file));
}

std::string Description::own_mesh(const std::string& name, scene::Mesh mesh) {
  const std::string key = own_file(name, ".ply");
  meshes.emplace(key, std::move(mesh));
  return key;
}

std::string Description::own_file(const std::string& name, const char* ending) {
  int& count = file_counts[file_name_of(name, ending)];
  for (;;) {
    const std::string file = file_name_of(name, ++count == 1 ? ending : fmt::format("-{}{}", count, ending).c_str());
    if (!meshes.contains(file) && !files.contains(file)) return file;
  }
}

std::string Description::own_bytes(const std::string& name, const char* ending, const ByteStore& bytes) {
  const std::string file = own_file(name, ending);
  files.emplace(file, std::string(reinterpret_cast<const char*>(bytes.bytes().data()), bytes.bytes().size()));
  return file;
}

std::string name_of(const std::string& text, const std::string& otherwise) {
  std::string name = text.substr(0, 60);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != ' ') c = '-';
  return name.empty() ? otherwise : name;
}

std::string file_name_of(const std::string& text, const char* ending) {
  std::string name = name_of(text, "mesh");
  std::ranges::replace(name, ' ', '-');
  return name + ending;
}

std::string unique(const std::string& name, TakenNames& taken) {
  int& count = taken[name];
  if (count++ == 0) return name;
  for (;; ++count)
    if (std::string free = fmt::format("{} {}", name, count); taken.try_emplace(free, 1).second) return free;
}

std::optional<double> scene_number(std::string_view text) {
  const auto number = typed_number<double>(text);
  return number && std::abs(*number) <= 1e12 ? number : std::nullopt;
}

DescribedGlass glass_of(double n, const Location& where) {
  if (!(n >= 0.01 && n <= 100)) throw bad_input(where, "its index of refraction is out of range");
  DescribedGlass glass;
  glass.inside.n = n;
  return glass;
}

void require_inverse(const glm::dmat4& matrix, const Location& where) {
  const glm::dmat3 axes(matrix);
  const double lengths = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
  if (!(std::abs(glm::determinant(axes)) > 1e-12 * lengths))
    throw bad_input(where, "its transform has no inverse: it flattens what it places", {}, "give no scale of 0");
}

glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up, const Location& where) {
  const glm::dvec3 way = target - origin, across = glm::cross(up, way);
  if (!(glm::length(across) > 0)) throw bad_input(where, "looks nowhere, or up is the way it looks");
  const glm::dvec3 z = glm::normalize(way), x = glm::normalize(across);
  return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

glm::dmat4 rotated(const glm::dmat4& matrix, double degrees, const glm::dvec3& axis, const Location& where) {
  if (!(glm::length(axis) > 0)) throw bad_input(where, "the axis has no direction");
  return glm::rotate(matrix, glm::radians(degrees), axis);
}

double vertical_fov_deg(double degrees, double height, double extent) {
  const double half = glm::radians(std::clamp(degrees, 0.001, 179.0)) / 2;
  return glm::degrees(2 * std::atan(std::tan(half) * height / extent));
}

scene::Mesh polygon(const std::vector<glm::vec3>& corners, const std::vector<glm::vec2>& texcoords) {
  scene::Mesh mesh;
  mesh.positions = corners;
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.emplace_back(0, i - 1, i);
    if (!texcoords.empty()) mesh.texcoords.push_back({texcoords[0], texcoords[i - 1], texcoords[i]});
  }
  return mesh;
}

scene::Mesh cube() {
  scene::Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  for (const auto& q : {std::array{0u, 2u, 3u, 1u}, std::array{4u, 5u, 7u, 6u}, std::array{0u, 1u, 5u, 4u},
                        std::array{2u, 6u, 7u, 3u}, std::array{0u, 4u, 6u, 2u}, std::array{1u, 3u, 7u, 5u}}) {
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
  }
  return mesh;
}

scene::Mesh disk(double radius) {
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 128; ++i)
    corners.emplace_back(radius * std::cos(2 * pi * i / 128), radius * std::sin(2 * pi * i / 128), 0);
  return polygon(corners);
}

scene::Mesh open_cylinder(const glm::dvec3& from, const glm::dvec3& to, double radius) {
  scene::Mesh mesh;
  const glm::dvec3 axis = glm::normalize(to - from),
                   u = glm::normalize(
                       glm::cross(axis, std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 v = glm::cross(axis, u);
  constexpr std::uint32_t around = 128;
  for (std::uint32_t i = 0; i < around; ++i) {
    const glm::dvec3 n = std::cos(2 * pi * i / around) * u + std::sin(2 * pi * i / around) * v;
    for (const glm::dvec3& end : {from, to}) {
      mesh.positions.emplace_back(end + radius * n);
      mesh.normals.emplace_back(n);
    }
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % around);
    mesh.triangles.emplace_back(a, b, b + 1);
    mesh.triangles.emplace_back(a, b + 1, a + 1);
  }
  return mesh;
}

void crop(DescribedCamera& camera, const glm::dvec2& corner, const glm::dvec2& size) {
  const glm::dvec2 whole(camera.resolution[0], camera.resolution[1]), middle = (corner + 0.5 * size) / whole - 0.5;
  camera.shift = (camera.shift + glm::dvec2(middle.x, -middle.y)) * whole / size;
  const double part = size.y / whole.y;
  camera.fov_deg = glm::degrees(2 * std::atan(std::tan(glm::radians(camera.fov_deg) / 2) * part));
  if (camera.height) *camera.height *= part;
  camera.resolution = {static_cast<int>(size.x), static_cast<int>(size.y)};
}

} // namespace nephroid::formats
