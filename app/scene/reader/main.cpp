// SPDX-License-Identifier: Apache-2.0
// nephroid_mesh_reader FILE CPU_SECONDS MEMORY_BYTES: the only program that links Assimp. It is one of its own because
// corrupt files make Assimp crash, loop for ever or ask for all memory: Assimp 5.2's PLY and glTF readers overrun the
// stack on some. The answer on standard output: why the file is refused (empty: it is not), positions, normals,
// triangles, texcoords, one number, of the mended normals, and the three of the middle; each as its 64-bit count and
// then the items, as they lie in memory. OBJ, PLY and STL are read by mesh_raw.h, for Assimp has single precision.
#include "base/lower_case.h"
#include "scene/mesh_parts.h"
#include "scene/mesh_raw.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <sys/resource.h>
#include <unistd.h>

namespace nephroid::scene {
namespace {

glm::dmat4 to_glm(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

bool is_finite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// What the triangulation relies on. The messages have no file name: load_mesh() adds it.
void check(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumVertices; ++i)
      if (!is_finite(part.mVertices[i]))
        throw std::runtime_error(fmt::format("vertex {} has a coordinate that is not a finite number", i));
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      for (unsigned i = 0; i < part.mFaces[f].mNumIndices; ++i)
        if (part.mFaces[f].mIndices[i] >= part.mNumVertices)
          throw std::runtime_error(fmt::format("face {} names vertex {} of {}", f,
                                               static_cast<int>(part.mFaces[f].mIndices[i]), part.mNumVertices));
  }
}

void append(RawMesh& mesh, const aiMesh& part, const glm::dmat4& transform, bool with_normals, bool with_texcoords) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  if (std::uint64_t{first} + part.mNumVertices > 3 * max_triangles ||
      mesh.triangles.size() + part.mNumFaces > max_triangles)
    throw std::runtime_error(fmt::format("more than {} triangles", max_triangles));
  const glm::dmat3 linear(transform);
  const glm::dmat3 normal_transform = glm::transpose(glm::inverse(linear));
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    const glm::dvec3 place = transform * glm::dvec4(p.x, p.y, p.z, 1);
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(static_cast<float>(place[axis])))
        throw std::runtime_error("a node's transform makes a coordinate infinite");
    mesh.positions.push_back(place);
    if (!with_normals) continue;
    const aiVector3D n = part.HasNormals() ? part.mNormals[i] : aiVector3D(0);
    mesh.normals.push_back(direction_of(normal_transform * glm::dvec3(n.x, n.y, n.z)));
  }
  const bool mirrored = glm::determinant(linear) < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue; // a point or a line
    glm::uvec3 triangle{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
    if (mirrored) std::swap(triangle.y, triangle.z);
    mesh.triangles.push_back(first + triangle);
    if (!with_texcoords) continue;
    Texcoords& texcoords = mesh.texcoords.emplace_back();
    for (int corner = 0; part.HasTextureCoords(0) && corner < 3; ++corner) {
      const aiVector3D& place = part.mTextureCoords[0][triangle[corner]];
      if (std::isfinite(place.x) && std::isfinite(place.y))
        texcoords[static_cast<std::size_t>(corner)] = {place.x, place.y};
    }
  }
}

void append(RawMesh& mesh, const aiScene& scene, const aiNode& node, const glm::dmat4& parent, bool with_normals,
            bool with_texcoords) {
  const glm::dmat4 transform = parent * to_glm(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    append(mesh, *scene.mMeshes[node.mMeshes[i]], transform, with_normals, with_texcoords);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    append(mesh, scene, *node.mChildren[i], transform, with_normals, with_texcoords);
}

/// Assimp reserves memory for whatever a GLB header promises (glTF 2.0, section 4.4).
void check_glb(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return;
  std::uint32_t declared = 12;
  if (bytes.size() >= declared) std::memcpy(&declared, bytes.data() + 8, sizeof declared);
  if (declared > bytes.size())
    throw std::runtime_error(
        fmt::format("the file has {} bytes of the {} that its header declares; it is cut", bytes.size(), declared));
}

RawMesh read_by_assimp(Assimp::Importer& importer, const char* file) {
  const aiScene* scene = importer.ReadFile(file, 0);
  if (scene == nullptr) {
    const std::string reason = importer.GetErrorString();
    if (reason == "std::bad_alloc") throw std::bad_alloc();
    throw std::runtime_error(reason);
  }
  check(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());

  bool with_normals = false, with_texcoords = false;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    with_normals |= scene->mMeshes[m]->HasNormals();
    with_texcoords |= scene->mMeshes[m]->HasTextureCoords(0);
  }
  RawMesh mesh;
  append(mesh, *scene, *scene->mRootNode, glm::dmat4(1), with_normals, with_texcoords);
  return mesh;
}

RawMesh read(Assimp::Importer& importer, const char* file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(std::filesystem::file_size(file), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const bool is_ply =
      bytes.starts_with("ply") && (bytes.size() == 3 || std::isalnum(static_cast<unsigned char>(bytes[3])) == 0);
  if (is_ply) return read_ply(bytes);
  const std::string kind = lower_case(std::filesystem::path(file).extension().string());
  if (kind == ".obj") return read_obj(std::move(bytes));
  if (kind == ".stl") return read_stl(bytes);
  check_glb(bytes);
  for (const char* extension : {"EXT_mesh_gpu_instancing", "KHR_node_visibility"}) // Assimp does not read them
    if ((kind == ".gltf" || kind == ".glb") && bytes.find(extension) != std::string::npos)
      throw std::runtime_error(fmt::format("it uses {}, which makes it a scene: nephroid import takes it", extension));
  bytes = {};
  return read_by_assimp(importer, file);
}

void lower_limit(__rlimit_resource_t resource, rlim_t value) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(value, limit.rlim_cur); // RLIM_INFINITY is the largest value
  setrlimit(resource, &limit);
}

/// The address space that this process has: the first number of /proc/self/statm. Under sanitizers it is terabytes.
rlim_t address_space_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// So that every way of going wrong ends this process, by a signal that says which.
void set_limits(unsigned cpu_seconds, rlim_t memory_bytes) {
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(signal, SIG_DFL); // sanitizers have handlers of their own
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_CPU, cpu_seconds);
  lower_limit(RLIMIT_AS, address_space_bytes() + memory_bytes);
  lower_limit(RLIMIT_STACK, 8 << 20); // endless recursion ends early whatever the shell's limit
  alarm(mesh_reader_patience * cpu_seconds);
}

template <class Items>
void put(std::FILE* answer, const Items& items) {
  const std::uint64_t count = items.size();
  std::fwrite(&count, sizeof count, 1, answer);
  std::fwrite(items.data(), sizeof *items.data(), count, answer);
}

} // namespace
} // namespace nephroid::scene

int main(int count, char** arguments) {
  using namespace nephroid::scene;
  if (count != 4) {
    std::fputs("usage: nephroid_mesh_reader FILE CPU_SECONDS MEMORY_BYTES\n", stderr);
    return 2;
  }
  std::FILE* const answer = fdopen(dup(STDOUT_FILENO), "wb");
  dup2(STDERR_FILENO, STDOUT_FILENO); // what a library prints is no part of the answer
  set_limits(static_cast<unsigned>(std::strtoul(arguments[2], nullptr, 10)), std::strtoull(arguments[3], nullptr, 10));
  Assimp::Importer importer;
  Mesh mesh;
  std::string refusal;
  try {
    mesh = finished(read(importer, arguments[1]));
  } catch (const std::bad_alloc&) {
    refusal = "asked for more memory than its size explains";
  } catch (const std::exception& e) {
    refusal = e.what();
  }
  put(answer, refusal);
  put(answer, mesh.positions);
  put(answer, mesh.normals);
  put(answer, mesh.triangles);
  put(answer, mesh.texcoords);
  put(answer, std::array{mesh.mended_normals});
  put(answer, std::array{mesh.middle.x, mesh.middle.y, mesh.middle.z});
  _exit(std::fflush(answer) == 0 ? 0
                                 : 1); // nothing is given back: it takes time, and a corrupt file may have damaged it
}
