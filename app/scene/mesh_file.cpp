// SPDX-License-Identifier: Apache-2.0
// Mesh files by Assimp, read in a child process because corrupt ones crash it or never end.
#include "base/error.h"
#include "base/files.h"
#include "scene/isolated.h"
#include "scene/mesh.h"
#include "scene/mesh_check.h"
#include "scene/mesh_parts.h"

#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace nephroid::scene {
namespace {

constexpr std::string_view formats = "a triangle mesh as OBJ, PLY, STL, glTF or 3DS";

glm::dmat4 to_glm(const aiMatrix4x4& m)
{
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

bool is_finite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// What the triangulation relies on. The messages have no file name: load_mesh adds it.
void check(const aiScene& scene)
{
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumVertices; ++i)
      if (!is_finite(part.mVertices[i])) throw std::runtime_error(fmt::format("vertex {} has a coordinate that is not a finite number", i));
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      for (unsigned i = 0; i < part.mFaces[f].mNumIndices; ++i)
        if (part.mFaces[f].mIndices[i] >= part.mNumVertices)
          throw std::runtime_error(
              fmt::format("face {} names vertex {} of {}", f, static_cast<int>(part.mFaces[f].mIndices[i]), part.mNumVertices));
  }
}

void append(Mesh& mesh, const aiMesh& part, const glm::dmat4& transform, bool with_normals)
{
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  if (std::uint64_t{first} + part.mNumVertices > 3 * max_triangles || mesh.triangles.size() + part.mNumFaces > max_triangles)
    throw std::runtime_error(fmt::format("more than {} triangles", max_triangles));
  const glm::dmat3 linear(transform);
  const glm::dmat3 normal_transform = glm::transpose(glm::inverse(linear));
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    mesh.positions.emplace_back(transform * glm::dvec4(p.x, p.y, p.z, 1));
    if (!with_normals) continue;
    const aiVector3D n = part.HasNormals() ? part.mNormals[i] : aiVector3D(0);
    const glm::dvec3 normal = normal_transform * glm::dvec3(n.x, n.y, n.z);
    const double length = glm::length(normal);
    mesh.normals.emplace_back(length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0));
  }
  const bool mirrored = glm::determinant(linear) < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue; // a point or a line
    const glm::uvec3 triangle{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
    mesh.triangles.push_back(first + (mirrored ? glm::uvec3(triangle.x, triangle.z, triangle.y) : triangle));
  }
}

void append(Mesh& mesh, const aiScene& scene, const aiNode& node, const glm::dmat4& parent, bool with_normals)
{
  const glm::dmat4 transform = parent * to_glm(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) append(mesh, *scene.mMeshes[node.mMeshes[i]], transform, with_normals);
  for (unsigned i = 0; i < node.mNumChildren; ++i) append(mesh, scene, *node.mChildren[i], transform, with_normals);
}

/// Joins equal vertices and removes those that no triangle uses.
void join_vertices(Mesh& mesh)
{
  const std::vector<std::uint32_t> first = first_equal_vertex(mesh, true);
  constexpr std::uint32_t unused = ~0u;
  std::vector<std::uint32_t> new_index(mesh.positions.size(), unused);
  Mesh joined;
  for (glm::uvec3 triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t old = first[triangle[i]];
      if (new_index[old] == unused) {
        new_index[old] = static_cast<std::uint32_t>(joined.positions.size());
        joined.positions.push_back(mesh.positions[old]);
        if (!mesh.normals.empty()) joined.normals.push_back(mesh.normals[old]);
      }
      triangle[i] = new_index[old];
    }
    joined.triangles.push_back(triangle);
  }
  mesh = std::move(joined);
}

/// A file's normal that is missing, or lies on the other side of the surface than its triangles say, would bend light the wrong
/// way: the mean of the triangles at that vertex takes its place.
void mend_normals(Mesh& mesh)
{
  std::vector<std::uint32_t> itself(mesh.positions.size());
  for (std::uint32_t i = 0; i < itself.size(); ++i) itself[i] = i;
  const std::vector<glm::vec3> means = mean_normals(mesh, itself);
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (glm::dot(mesh.normals[i], means[i]) > 0) continue;
    mesh.normals[i] = means[i] == glm::vec3(0) ? glm::vec3(0, 1, 0) : means[i];
    ++mesh.mended_normals;
  }
}

/// STL stores a facet's normal, from which Assimp makes vertex normals that are not meant to be smooth.
bool is_stl(const Assimp::Importer& importer)
{
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* format = index < 0 ? nullptr : importer.GetImporterInfo(static_cast<std::size_t>(index));
  return format != nullptr && std::string_view(format->mFileExtensions) == "stl";
}

Mesh read_with_assimp(const std::filesystem::path& file)
{
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene == nullptr) {
    const std::string reason = importer.GetErrorString();
    if (reason == "std::bad_alloc") throw std::bad_alloc();
    throw std::runtime_error(reason);
  }
  check(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());

  bool with_normals = false;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) with_normals |= scene->mMeshes[m]->HasNormals();
  with_normals = with_normals && !is_stl(importer);
  Mesh mesh;
  append(mesh, *scene, *scene->mRootNode, glm::dmat4(1), with_normals);
  for (const glm::vec3& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw std::runtime_error("a node's transform makes a coordinate infinite");
  join_vertices(mesh);
  if (with_normals) mend_normals(mesh);
  return mesh;
}

/// The mesh as bytes, for the way out of the child process: the number of items of each array, then the arrays.
std::string pack(const Mesh& mesh)
{
  std::string bytes;
  const auto add = [&bytes](const auto& items) {
    const std::uint64_t count = items.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof items[0]);
  };
  add(mesh.positions);
  add(mesh.normals);
  add(mesh.triangles);
  add(std::array{mesh.mended_normals});
  return bytes;
}

Mesh unpack(std::string_view bytes)
{
  const auto take = [&bytes](auto& items) {
    std::uint64_t count = 0;
    std::memcpy(&count, bytes.data(), sizeof count);
    items.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(items.data()), bytes.data() + sizeof count, count * sizeof items[0]);
    bytes.remove_prefix(sizeof count + count * sizeof items[0]);
  };
  Mesh mesh;
  take(mesh.positions);
  take(mesh.normals);
  take(mesh.triangles);
  std::vector<std::uint32_t> mended;
  take(mended);
  mesh.mended_normals = mended.at(0);
  return mesh;
}

} // namespace

Mesh load_mesh(const std::filesystem::path& file)
{
  const Place where = file.string();
  std::size_t size = 0;
  {
    const std::string bytes = read_file(file);
    if (bytes.empty()) throw bad_input(where, "the mesh file is empty", std::string(formats));
    check_declared_size(bytes, where);
    size = bytes.size();
  }
  // Good files need some 20 times their size and a second for 50 MB; glTF may keep its data in another file.
  IsolationLimits limits;
  limits.cpu_seconds += static_cast<unsigned>(size >> 20);
  limits.extra_memory_bytes += 64 * size;
  Mesh mesh;
  try {
    mesh = unpack(run_isolated([&file] { return pack(read_with_assimp(file)); }, limits));
  } catch (const IsolatedFailure& failure) {
    throw bad_input(where, "the mesh cannot be read: " + printable(failure.what()), std::string(formats),
                    "check the file in another program");
  }
  if (std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                  [&mesh](const glm::uvec3& triangle) { return is_degenerate(mesh, triangle); }))
    throw bad_input(where, mesh.triangles.empty() ? "the mesh has no triangles" : "no triangle of the mesh has an area",
                    std::string(formats));
  return mesh;
}

} // namespace nephroid::scene
