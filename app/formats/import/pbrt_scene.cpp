// SPDX-License-Identifier: Apache-2.0
#include "formats/import/pbrt_scene.h"

#include "base/error.h"
#include "formats/import/gltf_scene.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::formats {
namespace {

using std::numbers::pi;

/// n at 587.6 nm of the glasses that PBRT names.
const std::map<std::string, double> named_glasses{
    {"glass-BK7", 1.5168}, {"glass-BAF10", 1.6700}, {"glass-FK51A", 1.4866}, {"glass-LASF9", 1.8503},
    {"glass-F5", 1.6034},  {"glass-SF5", 1.6727},   {"glass-SF10", 1.7283},  {"glass-SF11", 1.7847}};

double above_zero(const PbrtParameters& p, const char* name) {
  const double value = p.number(name, 1);
  if (!(value > 0)) throw bad_input(p.where, fmt::format("its {} is not above 0", name));
  return value;
}

double index_of(PbrtScene& scene, const PbrtParameters& p) {
  const char* const name = p.find("eta") ? "eta" : "index";
  const PbrtParameter* eta = p.find(name);
  if (!eta || eta->type != "spectrum" || eta->values.empty()) return p.number(name, 1.5);
  const auto glass = named_glasses.find(eta->values[0]);
  const double n = glass == named_glasses.end() ? 1.5 : glass->second;
  scene.d.note(eta->where, fmt::format("the spectrum of eta is left out: n = {} takes its place", n));
  return n;
}

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
  const auto n = p.find("N") ? p.find("N")->numbers() : std::vector<double>();
  if (n.size() != v.size()) return mesh;
  for (std::size_t i = 0; i < n.size(); i += 3) {
    const glm::dvec3 normal(n[i], n[i + 1], n[i + 2]);
    mesh.normals.emplace_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::dvec3(0, 0, 1));
  }
  return mesh;
}

} // namespace

glm::dvec3 pbrt_colour(PbrtScene& scene, const PbrtParameters& p, const std::string& name, const glm::dvec3& standard) {
  const PbrtParameter* given = p.find(name);
  if (given && given->type == "texture" && !given->values.empty())
    if (const auto found = scene.textures.find(given->values[0]); found != scene.textures.end()) given = &found->second;
  if (!given) return standard;
  if (given->type == "rgb" || given->type == "color" || given->type == "float") {
    const auto v = given->numbers();
    if (v.size() == 1) return glm::dvec3(v[0]);
    if (v.size() == 3) return {v[0], v[1], v[2]};
    throw bad_input(given->where, fmt::format("\"{}\" has {} values", name, v.size()), "expected one or three");
  }
  scene.d.note(given->where, fmt::format("the {} \"{}\" is left out: {:.3g} {:.3g} {:.3g} takes its place", given->type,
                                         name, standard.x, standard.y, standard.z));
  return standard;
}

preset::Material pbrt_material(PbrtScene& scene, const std::string& type, const PbrtParameters& p) {
  const bool rough = p.find("roughness") && p.find("roughness")->type == "float" && p.number("roughness", 0) > 0;
  if (type == "dielectric" || type == "thindielectric" || type == "glass") {
    if (type == "thindielectric") scene.d.note(p.where, "a thin film is solid glass here");
    if (rough) scene.d.note(p.where, "roughness is left out: the glass is polished");
    return glass_of(index_of(scene, p), p.where);
  }
  preset::Material made;
  const auto reflect = [&](const char* name, double standard) {
    made.reflectance = reflectance_of(scene::to_vec3(pbrt_colour(scene, p, name, glm::dvec3(standard))));
  };
  if (type == "conductor" || type == "mirror") {
    made.type = preset::Material::Type::mirror;
    reflect(type == "mirror" ? "Kr" : "reflectance", 0.9);
    if (type == "conductor" && !p.find("reflectance"))
      scene.d.note(p.where, "the metal is left out: a mirror of 0.9 takes its place");
    if (rough) scene.d.note(p.where, "roughness is left out: the mirror is polished");
    return made;
  }
  reflect(p.find("Kd") ? "Kd" : "reflectance", 0.5);
  if (type != "diffuse" && type != "matte")
    scene.d.note(p.where, "the material " + (type.empty() ? "\"\"" : type) +
                              " is left out: a matt surface of its colour takes its place");
  return made;
}

/// The luminance of a white of 1 is 1 in version 4, which divides a light by the luminance of its spectrum.
void add_pbrt_light(PbrtScene& scene, const std::string& type, const PbrtParameters& p, const glm::dmat4& to_world) {
  DescribedLight light;
  light.where = p.where;
  const glm::dvec3 from = p.vector("from", {0, 0, 0}), to = p.vector("to", {0, 0, 1});
  light.position = glm::dvec3(to_world * glm::dvec4(from, 1));
  light.direction = glm::dmat3(to_world) * (to - from);
  light.colour =
      pbrt_colour(scene, p, type == "distant" || type == "infinite" ? "L" : "I", glm::dvec3(1)) * p.number("scale", 1);
  const double power = p.number("power", -1), lux = p.number("illuminance", -1);
  if (type == "point") {
    if (power > 0) light.colour *= power / (4 * pi);
  } else if (type == "spot") {
    light.type = preset::Light::Type::spot;
    const double cone = std::clamp(p.number("coneangle", 30), 0.01, 90.0);
    const double start = std::clamp(cone - p.number("conedeltaangle", 5), 0.0, cone);
    const double low = std::cos(glm::radians(cone)), high = std::cos(glm::radians(start));
    light.half_angle_deg = same_power_half_angle_deg(cone, [&](double a) {
      const double t = high > low ? std::clamp((std::cos(a) - low) / (high - low), 0.0, 1.0) : 1;
      return t * t * (3 - 2 * t);
    });
    if (power > 0) light.colour *= power / (2 * pi * (1 - std::cos(glm::radians(light.half_angle_deg))));
    if (start < cone) scene.d.note(p.where, "the spot's fading edge is left out: a sharp cone has its power");
  } else if (type == "distant") {
    light.type = preset::Light::Type::directional;
    if (lux > 0) light.colour *= lux;
  } else if (type == "infinite" && !p.find("filename") && !p.find("mapname")) {
    scene.d.surroundings = {.where = p.where, .file = {}, .colour = light.colour, .scale = lux > 0 ? lux / pi : 1};
    return;
  } else
    return scene.d.note(p.where, "the light " + type + (type == "infinite" ? " with a picture" : "") + " is left out");
  scene.d.lights.push_back(light);
}

std::optional<DescribedShape> pbrt_shape(PbrtScene& scene, const std::string& type, const PbrtParameters& p,
                                         const glm::dmat4& to_world) {
  Description& d = scene.d;
  DescribedShape shape;
  shape.where = p.where;
  shape.name = type;
  shape.to_world = to_world;
  if (type == "sphere") {
    shape.radius = above_zero(p, "radius");
    if (p.find("zmin") || p.find("zmax") || p.find("phimax")) d.note(p.where, "a part of a sphere is whole here");
  } else if (type == "plymesh") {
    shape.mesh = d.mesh_file(std::filesystem::path(p.where.name).parent_path() / p.text("filename", ""), p.where);
  } else if (type == "trianglemesh" || type == "bilinearmesh") {
    shape.mesh = d.own_mesh(type, listed_mesh(p, type == "trianglemesh" ? 3 : 4));
  } else if (type == "disk") {
    shape.to_world = glm::translate(to_world, glm::dvec3(0, 0, p.number("height", 0)));
    shape.mesh = d.own_mesh(type, disk(above_zero(p, "radius")));
  } else if (type == "cylinder") {
    const double radius = p.number("radius", 1), low = p.number("zmin", -1), high = p.number("zmax", 1);
    if (!(radius > 0) || !(low < high)) throw bad_input(p.where, "the cylinder has no size");
    shape.mesh = d.own_mesh(type, open_cylinder({0, 0, low}, {0, 0, high}, radius));
  } else {
    d.note(p.where, "the shape " + type + " is left out");
    return std::nullopt;
  }
  return shape;
}

} // namespace nephroid::formats
