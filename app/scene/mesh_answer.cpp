// SPDX-License-Identifier: Apache-2.0
// Nothing that the mesh reader's program answers is believed before it was looked at: a file that corrupts its memory makes it say
// anything.
#include "scene/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace nephroid::scene {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error("the program that reads it answers nonsense: " + what); }

/// Fills `items` with the answer's next ones; false where it ends before them. Memory grows with what comes, not with what is promised.
/// Refuses more than `most`.
template <class Items>
bool take_items(std::FILE* from, Items& items, std::uint64_t most)
{
  std::uint64_t count = 0;
  if (std::fread(&count, sizeof count, 1, from) != 1) return false;
  if (count > most) refuse(fmt::format("{} items where {} are the most", count, most));
  constexpr std::uint64_t piece = 1 << 20;
  while (items.size() < count) {
    const std::size_t before = items.size(), more = std::min(piece, count - before);
    items.resize(before + more);
    if (std::fread(static_cast<void*>(items.data() + before), sizeof *items.data(), more, from) != more) return false;
  }
  return true;
}

} // namespace

std::optional<MeshAnswer> take_answer(std::FILE* from)
{
  constexpr std::uint64_t longest_refusal = 1 << 20;
  MeshAnswer answer;
  Mesh& mesh = answer.mesh;
  const bool whole = take_items(from, answer.refusal, longest_refusal) && take_items(from, mesh.positions, 3 * max_triangles) &&
                     take_items(from, mesh.normals, 3 * max_triangles) && take_items(from, mesh.triangles, max_triangles) &&
                     take_items(from, answer.mended, 1);
  return whole ? std::optional(std::move(answer)) : std::nullopt;
}

Mesh mesh_of(MeshAnswer answer)
{
  if (!answer.refusal.empty()) throw std::runtime_error(answer.refusal);
  if (answer.mended.empty()) refuse("no count of mended normals");
  Mesh mesh = std::move(answer.mesh);
  mesh.mended_normals = answer.mended[0];
  const std::size_t vertices = mesh.positions.size();
  if (!mesh.normals.empty() && mesh.normals.size() != vertices)
    refuse(fmt::format("{} normals of {} vertices", mesh.normals.size(), vertices));
  if (mesh.mended_normals > mesh.normals.size()) refuse(fmt::format("{} mended normals of {}", mesh.mended_normals, mesh.normals.size()));
  for (const glm::vec3& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("a coordinate that is not finite");
  for (const glm::vec3& normal : mesh.normals)
    if (!(std::abs(glm::dot(normal, normal) - 1) < 1e-3f)) refuse("a normal that is no unit vector");
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (triangle[corner] >= vertices) refuse(fmt::format("a triangle with vertex {} of {}", triangle[corner], vertices));
  return mesh;
}

} // namespace nephroid::scene
