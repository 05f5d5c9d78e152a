// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "formats/import/pbrt_scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::formats {
namespace {

double above_zero(const PbrtParameters& p, const char* name) {
  const double value = p.number(name, 1);
  if (!(value > 0)) throw bad_input(p.where, fmt::format("its {} is not above 0", name));
  return value;
}

/// Whether a round shape does not go all around.
bool is_cut(const PbrtParameters& p) { return p.number("phimax", 360) < 360; }

std::vector<std::uint32_t> indices_of(const PbrtParameters& p, std::size_t corners, std::size_t points) {
  std::vector<double> given{0, 1, 2, 3};
  given.resize(corners);
  if (p.find("indices")) given = p.find("indices")->numbers();
  if (given.empty() || given.size() % corners != 0)
    throw bad_input(p.where, fmt::format("has {} indices", given.size()));
  std::vector<std::uint32_t> indices;
  for (const double i : given) {
    if (i < 0 || i >= static_cast<double>(points) || i != std::floor(i))
      throw bad_input(p.where, fmt::format("there is no point {} in it", i),
                      fmt::format("expected 0 to {}", points - 1));
    indices.push_back(static_cast<std::uint32_t>(i));
  }
  return indices;
}

/// The shape's own, "uv" or in version 3 "st"; without them those that PBRT gives each triangle or patch.
void give_texcoords(const PbrtParameters& p, std::size_t corners, scene::Mesh& mesh) {
  const PbrtParameter* given = p.find("uv") ? p.find("uv") : p.find("st");
  const std::vector<double> numbers = given ? given->numbers() : std::vector<double>();
  const bool by_vertex = numbers.size() == 2 * mesh.positions.size();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    scene::Texcoords& texcoords = mesh.texcoords.emplace_back();
    for (int corner = 0; corner < 3; ++corner) {
      const std::size_t vertex = mesh.triangles[i][corner];
      const bool is_second = corners == 4 && i % 2 == 1;
      constexpr std::array<glm::vec2, 3> of_triangle{{{0, 0}, {1, 0}, {1, 1}}}, of_patch{{{0, 0}, {1, 0}, {1, 1}}},
          of_second{{{0, 0}, {1, 1}, {0, 1}}};
      texcoords[static_cast<std::size_t>(corner)] =
          by_vertex ? glm::vec2(numbers[2 * vertex], numbers[2 * vertex + 1])
                    : (is_second      ? of_second
                       : corners == 4 ? of_patch
                                      : of_triangle)[static_cast<std::size_t>(corner)];
    }
  }
}

/// corners: 3, or those of a bilinear patch, which becomes two triangles.
scene::Mesh listed_mesh(const PbrtParameters& p, std::size_t corners) {
  const PbrtParameter* points = p.find("P");
  if (!points) throw bad_input(p.where, "has no points \"P\"");
  const auto v = points->numbers();
  if (v.size() % 3 != 0 || v.empty())
    throw bad_input(points->where, fmt::format("\"P\" has {} numbers", v.size()), "expected threes");
  scene::Mesh mesh;
  for (std::size_t i = 0; i < v.size(); i += 3) mesh.positions.emplace_back(v[i], v[i + 1], v[i + 2]);
  const std::vector<std::uint32_t> index = indices_of(p, corners, mesh.positions.size());
  for (std::size_t i = 0; i < index.size(); i += corners) {
    mesh.triangles.emplace_back(index[i], index[i + 1], index[i + corners - 1]);
    if (corners == 4)
      mesh.triangles.emplace_back(index[i], index[i + 3], index[i + 2]); // a patch's corners are 00, 10, 01, 11
  }
  give_texcoords(p, corners, mesh);
  const auto n = p.find("N") ? p.find("N")->numbers() : std::vector<double>();
  if (n.size() != v.size()) return mesh;
  for (std::size_t i = 0; i < n.size(); i += 3) {
    const glm::dvec3 normal(n[i], n[i + 1], n[i + 2]);
    mesh.normals.emplace_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::dvec3(0, 0, 1));
  }
  // PBRT's normals say which side is out.
  for (glm::uvec3& t : mesh.triangles) {
    const glm::vec3 face =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    if (glm::dot(face, mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]) >= 0) continue;
    std::swap(t.y, t.z);
    scene::Texcoords& texcoords = mesh.texcoords[static_cast<std::size_t>(&t - mesh.triangles.data())];
    std::swap(texcoords[1], texcoords[2]);
  }
  return mesh;
}

} // namespace

std::optional<DescribedShape> pbrt_shape(PbrtScene& scene, const std::string& type, const PbrtParameters& p,
                                         const glm::dmat4& to_world) {
  Description& d = scene.d;
  DescribedShape shape;
  shape.where = p.where;
  shape.name = type;
  shape.to_world = to_world;
  require_inverse(to_world, p.where);
  if (p.find("alpha")) d.note(p.where, "its alpha is left out: the surface is whole");
  if (type == "sphere") {
    shape.radius = above_zero(p, "radius");
    if (p.number("zmin", -shape.radius) > -shape.radius || p.number("zmax", shape.radius) < shape.radius || is_cut(p))
      d.note(p.where, "a part of a sphere is whole here");
  } else if (type == "plymesh") {
    const std::filesystem::path file = scene.file.find(p.text("filename", ""), p.where);
    shape.name = name_of(file.stem().string(), type);
    shape.mesh = d.mesh_file(file, p.where);
  } else if (type == "trianglemesh" || type == "bilinearmesh") {
    shape.mesh = d.own_mesh(type, listed_mesh(p, type == "trianglemesh" ? 3 : 4));
  } else if (type == "loopsubdiv") {
    const double levels = p.number(p.find("levels") ? "levels" : "nlevels", 3);
    if (!(levels >= 0 && levels <= 8 && levels == std::floor(levels)))
      throw bad_input(p.where, fmt::format("is subdivided {} times", levels), "expected 0 to 8");
    shape.mesh = d.own_mesh(type, subdivided(listed_mesh(p, 3), static_cast<int>(levels)));
  } else if (type == "disk") {
    shape.to_world = glm::translate(to_world, glm::dvec3(0, 0, p.number("height", 0)));
    shape.mesh = d.own_mesh(type, disk(above_zero(p, "radius")));
    if (p.number("innerradius", 0) > 0 || is_cut(p)) d.note(p.where, "a part of a disk is whole here");
  } else if (type == "cylinder") {
    const double radius = p.number("radius", 1), low = p.number("zmin", -1), high = p.number("zmax", 1);
    if (!(radius > 0) || !(low < high)) throw bad_input(p.where, "the cylinder has no size");
    shape.mesh = d.own_mesh(type, open_cylinder({0, 0, low}, {0, 0, high}, radius));
    if (is_cut(p)) d.note(p.where, "a part of a cylinder is whole here");
  } else {
    d.note(p.where, "the shape " + type + " is left out");
    return std::nullopt;
  }
  return shape;
}

} // namespace nephroid::formats
