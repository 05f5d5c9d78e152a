// SPDX-License-Identifier: Apache-2.0
#include "formats/import/backs.h"

#include "formats/import/emitter.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::formats {
namespace {

/// A mesh whose vertices have moved along their normals.
scene::Mesh swollen(scene::Mesh mesh, double distance) {
  std::vector<glm::dvec3> normals(mesh.positions.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const auto at = [&](int corner) { return glm::dvec3(mesh.positions[t[corner]]); };
    const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
    for (int corner = 0; corner < 3; ++corner) normals[t[corner]] += area;
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (const double length = glm::length(normals[i]); length > 0)
      mesh.positions[i] += glm::vec3(distance / length * normals[i]);
  return mesh;
}

/// How much longer lengths become, on average.
double scale_of(const glm::dmat4& to_world) { return std::cbrt(std::abs(glm::determinant(glm::dmat3(to_world)))); }

} // namespace

DescribedShape behind(const DescribedShape& shape, const glm::dmat4& to_preset, double distance, Description& from) {
  DescribedShape back = shape;
  const glm::dmat4 to_world = to_preset * shape.to_world;
  const double outwards = shape.inside_out ? distance : -distance;
  if (shape.mesh.empty()) {
    back.radius += outwards / scale_of(to_world);
    return back;
  }
  const scene::Mesh& mesh = from.meshes.at(shape.mesh);
  if (const Emitter e = emitter_of(mesh, to_world); e.flat) {
    const glm::dvec3 way = glm::inverse(glm::dmat3(to_preset)) * (outwards * e.normal);
    back.to_world = glm::translate(glm::dmat4(1), way) * shape.to_world;
    return back;
  }
  back.states.clear();
  const double own = outwards / scale_of(to_world); // instances share it
  std::string& known = from.swollen[fmt::format("{} {:.3g}", shape.mesh, own)];
  if (known.empty()) known = from.own_mesh(shape.name, swollen(mesh, own));
  back.mesh = known;
  return back;
}

bool shows_back(const DescribedShape& shape, const glm::dmat4& to_preset, std::span<const glm::dvec3> places,
                Description& from) {
  const glm::dmat4 to_world = to_preset * shape.to_world;
  scene::Bounds box;
  bool has_front_outside = !shape.inside_out;
  if (shape.mesh.empty()) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 way(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const glm::dvec3 place(to_world * glm::dvec4(shape.radius * way, 1));
      box = scene::enclosing(box, {place, place});
    }
  } else {
    const scene::Mesh& mesh = from.meshes.at(shape.mesh);
    const auto [known, is_new] = from.reports.try_emplace(shape.mesh);
    if (is_new) known->second = inspect(mesh);
    if (!known->second.closed()) return true;
    if (known->second.signed_volume < 0) has_front_outside = !has_front_outside;
    for (const glm::vec3& p : mesh.positions) {
      const glm::dvec3 place(to_world * glm::dvec4(glm::dvec3(p), 1));
      box = scene::enclosing(box, {place, place});
    }
  }
  return !has_front_outside || std::ranges::any_of(places, [&](const glm::dvec3& p) {
    return glm::all(glm::greaterThanEqual(p, box.low)) && glm::all(glm::lessThanEqual(p, box.high));
  });
}

} // namespace nephroid::formats
