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
#include <numeric>
#include <span>

namespace nephroid::inverse {
namespace {

constexpr int places_across = 64;
constexpr std::size_t place_count = std::size_t{places_across} * places_across;
/// So many places of a mesh are looked at.
constexpr std::size_t looks = std::size_t{1} << 16;

/// Orders places along Morton's curve by x and y, so that those which follow each other are neighbours.
void order(std::vector<glm::dvec4>& places) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec4& place : places)
    low = glm::min(low, glm::dvec2(place)), high = glm::max(high, glm::dvec2(place));
  const glm::dvec2 cell = glm::max(high - low, glm::dvec2(1e-300)) / 65535.0;
  const auto number = [&](const glm::dvec4& place) {
    const glm::uvec2 at((glm::dvec2(place) - low) / cell);
    std::uint64_t bits = 0;
    for (std::uint32_t bit = 0; bit < 16; ++bit)
      bits |= (std::uint64_t{at.x >> bit & 1} << (2 * bit)) | (std::uint64_t{at.y >> bit & 1} << (2 * bit + 1));
    return bits;
  };
  std::ranges::stable_sort(places, {}, number);
}

/// Maps a square of -1..1 to the unit disc, areas to equal parts (Shirley and Chiu 1997).
glm::dvec2 to_disc(const glm::dvec2& p) {
  if (p == glm::dvec2(0)) return p;
  const bool by_x = std::abs(p.x) > std::abs(p.y);
  const double r = by_x ? p.x : p.y, phi = glm::quarter_pi<double>() * (by_x ? p.y / p.x : 2 - p.x / p.y);
  return r * glm::dvec2(std::cos(phi), std::sin(phi));
}

/// Places of the mesh, moved by `to_mesh`, that the origin sees: the more of them are on a triangle the larger it
/// looks.
std::vector<glm::dvec3> places_seen(const scene::Mesh& mesh, const glm::dvec3& to_mesh) {
  const auto seen_at = [&](std::uint32_t vertex) {
    const glm::dvec3 p = glm::dvec3(mesh.positions[vertex]) + to_mesh;
    return glm::dvec2(p) / p.z;
  };
  std::vector<double> up_to; // the sizes of the triangles before each one and of itself
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec2 a = seen_at(t.x), b = seen_at(t.y) - a, c = seen_at(t.z) - a;
    up_to.push_back(sum += std::abs(b.x * c.y - b.y * c.x));
  }
  std::vector<glm::dvec3> places;
  if (sum == 0) return places;
  const scene::Bvh bvh = scene::build_bvh(mesh);
  std::size_t i = 0;
  for (std::size_t k = 0; k < looks; ++k) {
    const double at = (static_cast<double>(k) + 0.5) / static_cast<double>(looks) * sum;
    while (up_to[i] < at && i + 1 < up_to.size()) ++i;
    const double before = i > 0 ? up_to[i - 1] : 0, along = std::sqrt((at - before) / (up_to[i] - before)),
                 across = glm::fract(static_cast<double>(k) * glm::golden_ratio<double>());
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 way((1 - along) * seen_at(t.x) + along * glm::mix(seen_at(t.y), seen_at(t.z), across), 1);
    if (const auto hit = scene::closest_hit(bvh, -to_mesh, way); hit && hit->primitive == i)
      places.push_back(hit->t * way);
  }
  return places;
}

/// The middles of equal parts and the mean covariance in them.
LightPoints middles_of(const std::vector<std::span<glm::dvec3>>& parts) {
  LightPoints points;
  for (const std::span<glm::dvec3> part : parts) {
    const auto count = static_cast<double>(part.size());
    const glm::dvec3 middle = std::reduce(part.begin(), part.end()) / count;
    points.at.push_back(middle);
    for (const glm::dvec3& p : part)
      points.left += glm::outerProduct(p - middle, p - middle) / (count * static_cast<double>(parts.size()));
  }
  return points;
}

/// Of a disc with a covariance of 1. count: LightPoints::most or few.
LightPoints disc_points(std::size_t count) {
  const bool few = count == LightPoints::few;
  const double left = few ? 0.27 : 0.22, first = few ? 1.0 / 6 : 1.0 / 16;
  LightPoints points{{}, glm::dmat3(left)};
  for (std::size_t i = 0; i < count; ++i) {
    const double phi = 2 * glm::pi<double>() * (first + static_cast<double>(i) / static_cast<double>(count));
    points.at.push_back(std::sqrt(2 * (1 - left)) * glm::dvec3(std::cos(phi), std::sin(phi), 0));
  }
  return points;
}

} // namespace

Lamp flat_lamp(const Light& light, const glm::dvec3& middle) {
  Lamp lamp{middle, {}, light.shape == Light::Shape::disc};
  const glm::dvec2 half = glm::dvec2(light.size_mm[0], light.size_mm[1]) / 2.0;
  for (int y = 0; y < places_across; ++y)
    for (int x = 0; x < places_across; ++x) {
      const glm::dvec2 p = (2.0 * glm::dvec2(x, y) + 1.0) / static_cast<double>(places_across) - 1.0;
      lamp.places.emplace_back(half * (lamp.is_disc ? to_disc(p) : p), 0, 1);
    }
  order(lamp.places);
  return lamp;
}

Lamp mesh_lamp(const Light& light, const glm::dvec3& origin, double thickness, const Location& where) {
  const std::shared_ptr<const scene::Mesh> mesh = scene::load_mesh_once(light.file);
  const glm::dvec3 front(0, 0, thickness), to_mesh = origin + mesh->middle - front;
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : mesh->triangles)
    for (const std::uint32_t vertex : {t.x, t.y, t.z})
      nearest = std::min(nearest, double{mesh->positions[vertex].z} + to_mesh.z);
  if (nearest <= 0)
    throw bad_input(where / "distance_mm",
                    fmt::format("is {} mm, and the lamp reaches {:.4g} mm behind the front of the object",
                                light.distance_mm, 0 - nearest),
                    fmt::format("expected more than {:.4g} mm", light.distance_mm - nearest));
  const std::vector<glm::dvec3> seen = places_seen(*mesh, to_mesh);
  if (seen.empty())
    throw bad_input(where / "file", "is a mesh of which the object sees only an edge",
                    "expected one that turns a face to the object", "turn it in its file");
  // With the mean of the ways and the harmonic mean of the distances light comes from the middle on average, on all
  // facets.
  double over = 0;
  glm::dvec2 way(0);
  for (const glm::dvec3& p : seen) {
    over += 1 / p.z / static_cast<double>(seen.size());
    way += glm::dvec2(p) / p.z / static_cast<double>(seen.size());
  }
  const double distance = 1 / over;
  const glm::dvec3 middle = distance * glm::dvec3(way, 1);
  // An equal part of the outline gives the same light at whatever distance it is, by its cosine to the front's normal.
  std::vector<glm::dvec4> places;
  for (const glm::dvec3& p : seen)
    places.emplace_back(p - middle, std::pow(p.z / distance, 3) * glm::length(middle) / glm::length(p));
  order(places);
  Lamp lamp{front + middle, {}};
  for (std::size_t i = 0; i < place_count; ++i)
    lamp.places.push_back(places[(2 * i + 1) * places.size() / (2 * place_count)]);
  return lamp;
}

LightPoints points_of_places(const Lamp& lamp, double thickness, std::size_t count) {
  const double distance = lamp.middle.z - thickness;
  std::vector<glm::dvec3> places;
  for (const glm::dvec4& place : lamp.places) places.push_back(glm::dvec3(place) * distance / (distance + place.z));
  // All parts are halved across the same axis, for what is left in them is one covariance.
  std::vector<std::span<glm::dvec3>> parts{places};
  LightPoints points = middles_of(parts);
  const glm::dvec3 middle = points.at.front();
  if (lamp.is_disc && count > 1) {
    const glm::dmat3 squares = points.left;
    points = disc_points(count);
    for (glm::dvec3& p : points.at) p *= glm::dvec3(std::sqrt(squares[0][0]), std::sqrt(squares[1][1]), 0);
    points.left = points.left * squares;
    return points;
  }
  while (parts.size() < count) {
    const int axis = points.left[0][0] > points.left[1][1] ? 0 : 1;
    std::vector<std::span<glm::dvec3>> halves;
    for (const std::span<glm::dvec3> part : parts) {
      const std::size_t half = part.size() / 2;
      std::ranges::nth_element(part, part.begin() + static_cast<std::ptrdiff_t>(half), {},
                               [&](const glm::dvec3& p) { return p[axis]; });
      halves.push_back(part.first(half));
      halves.push_back(part.subspan(half));
    }
    parts = std::move(halves);
    points = middles_of(parts);
  }
  for (glm::dvec3& p : points.at) p -= middle;
  return points;
}

const LightPoints& points_of(const Illumination& light, bool few) {
  static const LightPoints disc = disc_points(LightPoints::most), few_of_disc = disc_points(LightPoints::few);
  if (light.lamp_places.empty()) return few ? few_of_disc : disc;
  return few ? light.few_points : light.points;
}

glm::dmat3x2 seen_along(const glm::dvec2& sines) {
  const glm::dvec2 t = sines / std::sqrt(1 - glm::dot(sines, sines));
  return {1, 0, 0, 1, t.x, t.y}; // moves a place along the light to the distance of the middle
}

glm::dmat2 root_of_places(const Illumination& light, const glm::dvec2& sines) {
  const glm::dmat3x2 seen = seen_along(sines);
  return lower_root(seen * light.lamp_covariance * glm::transpose(seen));
}

glm::dmat2 lower_root(const glm::dmat2& covariance) {
  glm::dmat2 root(0);
  root[0][0] = std::sqrt(std::max(0.0, covariance[0][0]));
  if (root[0][0] > 0) root[0][1] = covariance[0][1] / root[0][0];
  root[1][1] = std::sqrt(std::max(0.0, covariance[1][1] - root[0][1] * root[0][1]));
  return root;
}

} // namespace nephroid::inverse
