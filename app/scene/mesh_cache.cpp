// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_cache.h"

#include "base/files.h"
#include "base/hashed_bytes.h"

#include <cstdint>
#include <list>
#include <mutex>

namespace nephroid::scene {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20;

struct Kept {
  std::filesystem::path file;
  std::uint64_t bytes = 0, hash = 0; ///< of the file
  std::shared_ptr<const Mesh> mesh;
};

std::uint64_t bytes_of(const Mesh& mesh)
{
  return mesh.positions.size() * sizeof(glm::vec3) + mesh.normals.size() * sizeof(glm::vec3) + mesh.triangles.size() * sizeof(glm::uvec3);
}

} // namespace

bool has_further_files(const std::filesystem::path& file) { return file.extension() == ".gltf" || file.extension() == ".GLTF"; }

std::shared_ptr<const Mesh> load_mesh_once(const std::filesystem::path& file)
{
  static std::mutex mutex;
  static std::list<Kept> all; // the last used first
  if (has_further_files(file)) return std::make_shared<const Mesh>(load_mesh(file));
  const std::lock_guard lock(mutex);
  const std::string bytes = read_file(file);
  PieceHash hash;
  hash.add(std::as_bytes(std::span(bytes)));
  Kept wanted{file, bytes.size(), hash.value(), nullptr};
  for (auto kept = all.begin(); kept != all.end(); ++kept)
    if (kept->file == wanted.file && kept->bytes == wanted.bytes && kept->hash == wanted.hash) {
      all.splice(all.begin(), all, kept);
      return kept->mesh;
    }
  wanted.mesh = std::make_shared<const Mesh>(load_mesh(file));
  all.remove_if([&](const Kept& kept) { return kept.file == file; });
  all.push_front(wanted);
  std::uint64_t sum = 0;
  all.remove_if([&](const Kept& kept) { return (sum += bytes_of(*kept.mesh)) > most_bytes; });
  return wanted.mesh;
}

} // namespace nephroid::scene
