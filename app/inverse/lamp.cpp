// SPDX-License-Identifier: Apache-2.0
#include "inverse/lamp.h"

#include "scene/bvh.h"
#include "scene/mesh.h"
#include "scene/ray.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace nephroid::inverse {
namespace {

constexpr std::uint32_t places_across = 64, lookouts_across = 256;
constexpr std::size_t place_count = std::size_t{places_across} * places_across;

/// The middle of cell i of a unit square along Morton's curve, so that cells which follow each other are neighbours.
glm::dvec2 on_curve(std::uint32_t i, std::uint32_t cells_across) {
  std::uint32_t x = 0, y = 0;
  for (std::uint32_t bit = 0; bit < 16; ++bit) {
    x |= (i >> (2 * bit) & 1) << bit;
    y |= (i >> (2 * bit + 1) & 1) << bit;
  }
  return (glm::dvec2(x, y) + 0.5) / static_cast<double>(cells_across);
}

/// Maps a square of -1..1 to the unit disc, areas to equal parts (Shirley and Chiu 1997).
glm::dvec2 to_disc(const glm::dvec2& p) {
  if (p == glm::dvec2(0)) return p;
  const bool by_x = std::abs(p.x) > std::abs(p.y);
  const double r = by_x ? p.x : p.y, phi = glm::quarter_pi<double>() * (by_x ? p.y / p.x : 2 - p.x / p.y);
  return r * glm::dvec2(std::cos(phi), std::sin(phi));
}

} // namespace

Lamp flat_lamp(const Light& light, const glm::dvec3& middle) {
  Lamp lamp{middle, {}};
  const glm::dvec2 half = glm::dvec2(light.size_mm[0], light.size_mm[1]) / 2.0;
  for (std::uint32_t i = 0; i < place_count; ++i) {
    const glm::dvec2 p = 2.0 * on_curve(i, places_across) - 1.0;
    lamp.places.emplace_back(half * (light.shape == Light::Shape::disc ? to_disc(p) : p), 0, 1);
  }
  return lamp;
}

Lamp mesh_lamp(const Light& light, const glm::dvec3& origin, double thickness, const Location& where) {
  const std::shared_ptr<const scene::Mesh> mesh = scene::load_mesh_once(light.file);
  const glm::dvec3 front(0, 0, thickness), to_mesh = origin + mesh->middle - front;
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::vec3& position : mesh->positions) {
    const glm::dvec3 p = glm::dvec3(position) + to_mesh;
    nearest = std::min(nearest, p.z);
    low = glm::min(low, glm::dvec2(p) / p.z);
    high = glm::max(high, glm::dvec2(p) / p.z);
  }
  if (nearest <= 0)
    throw bad_input(where / "distance_mm",
                    fmt::format("is {} mm, and the lamp reaches {:.4g} mm behind the front of the object",
                                light.distance_mm, -nearest),
                    fmt::format("expected more than {:.4g} mm", light.distance_mm - nearest));
  const scene::Bvh bvh = scene::build_bvh(*mesh);
  std::vector<glm::dvec3> seen;
  for (std::uint32_t i = 0; i < lookouts_across * lookouts_across; ++i) {
    const glm::dvec3 way(glm::mix(low, high, on_curve(i, lookouts_across)), 1);
    if (const auto hit = scene::closest_hit(bvh, -to_mesh, way)) seen.push_back(front + hit->t * way);
  }
  if (seen.empty())
    throw bad_input(where / "file", "is a mesh of which the object sees only an edge",
                    "expected one that turns a face to the object", "turn it in its file");
  Lamp lamp;
  for (const glm::dvec3& p : seen) lamp.middle += p / static_cast<double>(seen.size());
  // Equal parts of the outline give the same light from wherever on their way they come.
  const double distance = lamp.middle.z - thickness;
  for (std::size_t i = 0; i < place_count; ++i) {
    const glm::dvec3& p = seen[(2 * i + 1) * seen.size() / (2 * place_count)];
    lamp.places.emplace_back(p - lamp.middle, std::pow((p.z - thickness) / distance, 2));
  }
  return lamp;
}

glm::dmat2 covariance_of_places(const Lamp& lamp, double thickness) {
  const double distance = lamp.middle.z - thickness, each = 1.0 / static_cast<double>(lamp.places.size());
  const glm::dvec2 middle(lamp.middle);
  glm::dvec2 mean(0);
  glm::dmat2 squares(0);
  for (const glm::dvec4& place : lamp.places) {
    const glm::dvec2 p = (middle + glm::dvec2(place)) * distance / (distance + place.z) - middle;
    mean += each * p;
    squares += each * glm::outerProduct(p, p);
  }
  return squares - glm::outerProduct(mean, mean);
}

glm::dmat2 lower_root(const glm::dmat2& covariance) {
  glm::dmat2 root(0);
  root[0][0] = std::sqrt(covariance[0][0]);
  if (root[0][0] > 0) root[0][1] = covariance[0][1] / root[0][0];
  root[1][1] = std::sqrt(std::max(0.0, covariance[1][1] - root[0][1] * root[0][1]));
  return root;
}

} // namespace nephroid::inverse
