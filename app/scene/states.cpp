// SPDX-License-Identifier: Apache-2.0
#include "scene/states.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/recent.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace nephroid::scene {
namespace {

using Meshes = std::vector<std::shared_ptr<const Mesh>>; ///< the object's own, then its states'

/// A mesh with the vertices of all states. Two corners are one vertex where they are in each of them.
struct Morph {
  Meshes meshes;                                  ///< that it is of
  Mesh own;                                       ///< without normals where a state has none
  MeshReport report;                              ///< of its own mesh
  std::vector<std::vector<glm::vec3>> to;         ///< a state: what its weight moves each vertex by
  std::vector<std::vector<glm::vec3>> normals_to; ///< the same for the normals; empty where `own` has none
};

/// Each corner's vertex of the morph, and each vertex' in every mesh.
std::vector<std::vector<std::uint32_t>> join_corners(const Meshes& meshes, std::vector<glm::uvec3>& triangles) {
  const auto corner_of = [&](std::size_t mesh, std::uint32_t corner) {
    return meshes[mesh]->triangles[corner / 3][static_cast<int>(corner % 3)];
  };
  std::vector<std::uint32_t> corners(3 * meshes[0]->triangles.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (corner_of(m, a) != corner_of(m, b)) return corner_of(m, a) < corner_of(m, b);
    return false;
  };
  std::ranges::sort(corners, less);
  std::vector<std::vector<std::uint32_t>> vertices(meshes.size());
  triangles.resize(meshes[0]->triangles.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || less(corners[i - 1], corners[i]))
      for (std::size_t m = 0; m < meshes.size(); ++m) vertices[m].push_back(corner_of(m, corners[i]));
    triangles[corners[i] / 3][static_cast<int>(corners[i] % 3)] = static_cast<std::uint32_t>(vertices[0].size() - 1);
  }
  return vertices;
}

Morph make_morph(Meshes meshes) {
  Morph morph;
  const auto vertices = join_corners(meshes, morph.own.triangles);
  const Mesh& own = *meshes[0];
  const bool has_normals = std::ranges::none_of(meshes, [](const auto& mesh) { return mesh->normals.empty(); });
  morph.own.middle = own.middle;
  morph.own.texcoords = own.texcoords;
  morph.own.mended_normals = own.mended_normals;
  for (const std::uint32_t vertex : vertices[0]) {
    morph.own.positions.push_back(own.positions[vertex]);
    if (has_normals) morph.own.normals.push_back(own.normals[vertex]);
  }
  for (std::size_t m = 1; m < meshes.size(); ++m) {
    const Mesh& state = *meshes[m];
    const glm::dvec3 shift = state.middle - own.middle;
    std::vector<glm::vec3>&to = morph.to.emplace_back(), &normals_to = morph.normals_to.emplace_back();
    for (std::size_t i = 0; i < vertices[m].size(); ++i) {
      to.emplace_back(glm::dvec3(state.positions[vertices[m][i]]) + shift - glm::dvec3(morph.own.positions[i]));
      if (has_normals) normals_to.push_back(state.normals[vertices[m][i]] - morph.own.normals[i]);
    }
  }
  morph.report = inspect(own);
  morph.meshes = std::move(meshes);
  return morph;
}

/// What is open has no volume that its sign would tell.
void check_turned(const Morph& morph, const Mesh& deformed, const std::vector<preset::State>& states,
                  const Location& where) {
  const auto count = static_cast<std::uint32_t>(deformed.triangles.size());
  if (!morph.report.closed() || morph.report.signed_volume * signed_volume(deformed, 0, count) >= 0) return;
  std::vector<double> weights;
  for (const preset::State& state : states) weights.push_back(state.weight);
  throw bad_input(where, fmt::format("weights of {:g} turn the mesh inside out", fmt::join(weights, ", ")),
                  "expected weights at which it stays as it is",
                  "its vertices go through each other on the way; add a state between");
}

std::size_t bytes_of(const Morph& morph) {
  std::size_t vertices = 0, triangles = morph.own.triangles.size();
  for (const auto& mesh : morph.meshes) {
    vertices += mesh->positions.size() + morph.own.positions.size();
    triangles += mesh->triangles.size();
  }
  return 2 * sizeof(glm::vec3) * vertices + sizeof(glm::uvec3) * triangles;
}

/// The last objects' are kept, as long as load_mesh_once() gives the same meshes: an animation goes through them again
/// and again.
std::shared_ptr<const Morph> morph_of(const Meshes& meshes) {
  static Recent<Morph> recent(std::uint64_t{256} << 20);
  if (auto same = recent.find([&](const Morph& morph) { return morph.meshes == meshes; })) return same;
  Morph morph = make_morph(meshes);
  const std::size_t bytes = bytes_of(morph);
  return recent.add(std::move(morph), bytes);
}

} // namespace

std::shared_ptr<const Mesh>
deformed_mesh(const preset::Object& object, const Location& where,
              const std::function<std::shared_ptr<const Mesh>(const std::string& file, const Location& at)>& load) {
  Meshes meshes{load(*object.mesh, where / "mesh")};
  if (object.states.empty()) return meshes[0];
  for (std::size_t i = 0; i < object.states.size(); ++i) {
    const Location at = where / "states" / i / "mesh";
    meshes.push_back(load(object.states[i].mesh, at));
    if (meshes.back()->triangles.size() != meshes[0]->triangles.size())
      throw bad_input(at,
                      fmt::format("has {}, and the object's mesh has {}",
                                  counted(meshes.back()->triangles.size(), "triangle"), meshes[0]->triangles.size()),
                      "expected the same triangles, in the same order");
  }
  const std::shared_ptr<const Morph> morph = morph_of(meshes);
  auto mesh = std::make_shared<Mesh>(morph->own);
  for_ranges(mesh->positions.size(), 16384, [&](std::size_t, Range range) {
    for (std::size_t s = 0; s < object.states.size(); ++s) {
      const auto weight = static_cast<float>(object.states[s].weight);
      for (std::size_t i = range.begin; i < range.end; ++i) {
        mesh->positions[i] += weight * morph->to[s][i];
        if (!mesh->normals.empty()) mesh->normals[i] += weight * morph->normals_to[s][i];
      }
    }
    if (!mesh->normals.empty())
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const float length = glm::length(mesh->normals[i]);
        mesh->normals[i] = length > 0 ? mesh->normals[i] / length : morph->own.normals[i];
      }
  });
  check_turned(*morph, *mesh, object.states, where / "states");
  return mesh;
}

} // namespace nephroid::scene
