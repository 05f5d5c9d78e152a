// SPDX-License-Identifier: Apache-2.0
#include "gems/stone.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

namespace nephroid::gems {
namespace {

constexpr double flat_deg = 0.02; ///< the angle at which two triangles are still one facet

/// The preset with the stone alone.
preset::Preset alone(const preset::Preset& preset, const std::string& name) {
  const Location where = Location(preset.source) / "scene" / "objects";
  std::vector<preset::Object> bodies;
  std::string names;
  for (const preset::Object& object : preset.scene.objects) {
    const auto material = preset.scene.materials.find(object.material);
    const bool is_body = material != preset.scene.materials.end() && preset::is_body(material->second);
    if (!name.empty() && object.name == name && !is_body)
      throw bad_input(where, fmt::format("\"{}\" is no body of glass", name), "expected one of a dielectric");
    if (!is_body) continue;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", object.name);
    if (name.empty() || object.name == name) bodies.push_back(object);
  }
  if (bodies.empty())
    throw bad_input(where, name.empty() ? "there is no stone" : fmt::format("there is no \"{}\"", name),
                    names.empty() ? "expected an object whose material is a dielectric, and not thin"
                                  : fmt::format("there are {}", names));
  if (bodies.size() > 1)
    throw bad_input(where, fmt::format("there are several bodies of glass: {}", names), "expected one stone",
                    "choose it with --object NAME");
  preset::Preset one = preset;
  one.scene.objects = {bodies.front()};
  one.scene.lights.clear();
  one.scene.meters.clear();
  one.scene.environment = {};
  return one;
}

void require_polished(const scatter::Material& material, const Location& where) {
  const char* what = is_rough(material) || has_rough_texture(material) ? "is rough"
                     : is_tinted(material)                             ? "is tinted at its surface"
                     : is_coated(material)                             ? "is coated"
                                                                       : nullptr;
  if (what)
    throw bad_input(where, fmt::format("the stone {}", what), "expected a polished one",
                    "its colour may come of its dispersion's k");
}

double at_line(const optics::Spectrum& values, double nm) {
  const auto below = static_cast<std::size_t>(nm) - optics::first_nm;
  return std::lerp(values[below], values[below + 1], nm - std::floor(nm));
}

glm::dvec3 area_of(const scene::Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]);
  return glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a) / 2.0;
}

struct Facet {
  glm::dvec3 area{0}; ///< along its normal
  double low_x = 1e300, high_x = -1e300;
};

/// Triangles that share an edge and look the same way are one facet. Edges are found by the places of their ends.
std::vector<Facet> facets_of(const scene::Mesh& mesh) {
  using Place = std::tuple<float, float, float>;
  std::vector<std::size_t> parents(mesh.triangles.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto root_of = [&](std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  std::map<std::pair<Place, Place>, std::size_t> edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    for (const auto& [from, to] : {std::pair(t.x, t.y), std::pair(t.y, t.z), std::pair(t.z, t.x)}) {
      const glm::vec3 &p = mesh.positions[from], &q = mesh.positions[to];
      const Place a{p.x, p.y, p.z}, b{q.x, q.y, q.z};
      const auto [edge, is_first] = edges.emplace(std::minmax(a, b), i);
      if (is_first) continue;
      const glm::dvec3 one = glm::normalize(area_of(mesh, mesh.triangles[edge->second])),
                       other = glm::normalize(area_of(mesh, t));
      if (glm::length(one - other) < glm::radians(flat_deg)) parents[root_of(i)] = root_of(edge->second);
    }
  }
  std::map<std::size_t, Facet> facets;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Facet& facet = facets[root_of(i)];
    facet.area += area_of(mesh, mesh.triangles[i]);
    for (const std::uint32_t corner : {mesh.triangles[i].x, mesh.triangles[i].y, mesh.triangles[i].z}) {
      facet.low_x = std::min(facet.low_x, double{mesh.positions[corner].x});
      facet.high_x = std::max(facet.high_x, double{mesh.positions[corner].x});
    }
  }
  std::vector<Facet> list;
  for (const auto& [root, facet] : facets) list.push_back(facet);
  return list;
}

void add_to(std::vector<Tier>& tiers, double angle_deg) {
  constexpr double alike_deg = 0.05;
  const auto tier =
      std::ranges::find_if(tiers, [&](const Tier& t) { return std::abs(t.angle_deg - angle_deg) < alike_deg; });
  if (tier == tiers.end())
    tiers.push_back({angle_deg, 1});
  else
    ++tier->facets;
}

Shape shape_of(const scene::Scene& scene) {
  constexpr int most_facets = 1000;
  const double mm = 1000 * scene.metres_per_unit;
  const scene::Bounds box = bounds_of(scene, scene.objects.front());
  const glm::dvec3 size = mm * (box.high - box.low);
  Shape shape;
  shape.width_mm = size.x;
  shape.depth_mm = size.z;
  shape.height_mm = size.y;
  shape.volume_mm3 = scene::signed_volume(scene.geometry, 0, scene.objects.front().triangle_count) * mm * mm * mm;
  for (const scene::Ellipsoid& ball : scene.geometry.ellipsoids) shape.volume_mm3 += volume_of(ball) * mm * mm * mm;
  const std::vector<Facet> facets = facets_of(scene.geometry);
  shape.facets = static_cast<int>(facets.size());
  double table_area = 0;
  for (const Facet& facet : facets) {
    const double angle_deg = glm::degrees(std::acos(std::clamp(glm::normalize(facet.area).y, -1.0, 1.0)));
    if (angle_deg < flat_deg && glm::length(facet.area) > table_area) {
      table_area = glm::length(facet.area);
      shape.table_share = mm * (facet.high_x - facet.low_x) / shape.width_mm;
    }
    if (shape.facets > most_facets) continue;
    std::vector<Tier>& tiers = std::abs(angle_deg - 90) < flat_deg ? shape.girdle
                               : angle_deg < 90                    ? shape.crown
                                                                   : shape.pavilion;
    add_to(tiers, angle_deg < 90 ? angle_deg : 180 - angle_deg);
  }
  for (std::vector<Tier>* tiers : {&shape.crown, &shape.pavilion})
    std::ranges::sort(*tiers, std::greater<>(), &Tier::angle_deg);
  return shape;
}

} // namespace

double Stone::critical_deg() const { return n_d > 1 ? glm::degrees(std::asin(1 / n_d)) : 90; }

Stone load_stone(const preset::Preset& preset, const std::string& object) {
  const preset::Preset one = alone(preset, object);
  Stone stone;
  stone.scene = scene::load_scene(one);
  const scene::Object& body = stone.scene.objects.front();
  const scatter::Material& material = material_of(stone.scene, body);
  stone.name = body.name;
  stone.material = one.scene.objects.front().material;
  if (!body.closed)
    throw bad_input(one.scene.objects.front().mesh.value_or(one.source), "the stone is open: its mesh has holes",
                    "expected a closed mesh", "close it, or export it as a solid");
  require_polished(material, Location(one.source) / "scene" / "materials" / stone.material);
  stone.n = material.n;
  if (const std::vector<double> loss = loss_inside(material); !loss.empty())
    std::ranges::transform(loss, stone.loss.begin(), [&](double a) { return a * stone.scene.metres_per_unit; });
  stone.n_d = at_line(stone.n, optics::line_d_nm);
  stone.n_c = at_line(stone.n, optics::line_c_nm);
  stone.n_f = at_line(stone.n, optics::line_f_nm);
  stone.loss_d = at_line(stone.loss, optics::line_d_nm);
  stone.bvh = scene::build_bvh(stone.scene.geometry);
  stone.shape = shape_of(stone.scene);
  stone.bounds = body.bounds;
  return stone;
}

} // namespace nephroid::gems
