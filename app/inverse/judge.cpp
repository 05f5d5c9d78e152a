// SPDX-License-Identifier: Apache-2.0
#include "inverse/judge.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/engine.h"
#include "inverse/uniform.h"
#include "optics/fresnel.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

namespace nephroid::inverse {

namespace {

constexpr int max_surfaces = 16;

/// Rays along one side of a facet: about a million in all, and so many a facet that a cell's light is known to a few percent, since the
/// brightest cell scales the cost.
int rays_along(const Layout& layout) { return std::clamp(1024 / std::max(layout.facets.x, layout.facets.y), 6, 64); }

/// turn: 0..1 of all around.
glm::dvec2 on_circle(double r, double turn)
{
  const double phi = 2 * glm::pi<double>() * turn;
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Two independent normal numbers of two of 0..1 (Box and Muller 1958).
glm::dvec2 normal_pair(double u, double v) { return on_circle(std::sqrt(-2 * std::log(1 - u)), v); }

/// Five numbers of 0..1 for each ray of a facet, more evenly spread than random ones: multiples of the powers of 1 / g, g being the root of
/// g^6 = g + 1 (Roberts 2018, the golden ratio in five dimensions), from a random begin.
class EvenNumbers {
public:
  explicit EvenNumbers(std::mt19937_64& random)
  {
    for (double& value : begin_) value = uniform(random);
  }
  std::array<double, 5> of(int ray) const
  {
    constexpr double g = 1.1347241384015194;
    std::array<double, 5> numbers{};
    double step = 1;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      step /= g;
      const double value = begin_[k] + ray * step;
      numbers[k] = value - std::floor(value);
    }
    return numbers;
  }

private:
  std::array<double, 5> begin_{};
};

/// A direction that leads to `offset` in a plane across d at distance 1.
glm::dvec3 beside(const glm::dvec3& d, const glm::dvec2& offset)
{
  const glm::dvec3 a = glm::normalize(glm::cross(d, std::abs(d.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  return glm::normalize(d + offset.x * a + offset.y * glm::cross(a, d));
}

glm::dvec3 outward_normal(const scene::Mesh& mesh, std::uint32_t triangle)
{
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return glm::normalize(glm::cross(b - a, c - a));
}

} // namespace

WayOut follow(const Solid& solid, const scene::Bvh& bvh, double n, glm::dvec3 from, glm::dvec3 direction)
{
  WayOut way{from, glm::normalize(direction), 1, 0, false};
  std::uint32_t leaves = scene::no_primitive;
  for (int surfaces = 0; surfaces < max_surfaces; ++surfaces) {
    const auto hit = scene::closest_hit(bvh, way.from, way.direction, {}, std::numeric_limits<double>::infinity(), leaves);
    if (!hit) {
      if (way.direction.z >= 0) way.part = 0;
      return way;
    }
    way.from += hit->t * way.direction;
    leaves = hit->primitive;
    if (solid.parts[leaves] == Part::side) break;
    way.met_wall = way.met_wall || solid.parts[leaves] == Part::wall;
    glm::dvec3 normal = outward_normal(solid.mesh, leaves);
    const bool enters = glm::dot(normal, way.direction) < 0;
    if (!enters) normal = -normal;
    const double before = enters ? 1 : n, behind = enters ? n : 1, cos_i = std::min(1.0, -glm::dot(normal, way.direction));
    if (const auto cos_t = optics::refracted_cosine(cos_i, before, behind)) {
      const double reflected = way.part * optics::fresnel_reflectance(cos_i, before, behind);
      way.reflected += reflected;
      way.part -= reflected;
      const double ratio = before / behind;
      way.direction = glm::normalize(ratio * way.direction + (ratio * cos_i - *cos_t) * normal);
    } else
      way.direction = glm::normalize(way.direction + 2 * cos_i * normal);
  }
  way.part = 0;
  return way;
}

/// What a row of facets sends.
struct Judge::Row {
  std::vector<std::vector<double>> light; ///< [screen][cell], in facets
  Fates fates;
};

Judge::Judge(const Layout& layout, const Solid& solid, std::uint64_t seed)
    : layout_(layout), solid_(solid), bvh_(scene::build_bvh(solid.mesh)), seed_(seed), screens_(layout.distances)
{
  screens_.insert(screens_.end(), layout.frames.begin(), layout.frames.end());
  light_.assign(screens_.size(), std::vector<double>(layout.cell_count()));
}

Judge::Row Judge::trace_row(int row) const
{
  std::mt19937_64 random(seed_ * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(row) + 0x5eed);
  Row made{std::vector<std::vector<double>>(light_.size(), std::vector<double>(layout_.cell_count())), {}};
  const int along = rays_along(layout_);
  for (int column = 0; column < layout_.facets.x; ++column) {
    const EvenNumbers even(random);
    for (int i = 0; i < along * along; ++i) {
      const int across = i % along, down = i / along;
      const glm::dvec2 at = glm::dvec2(column + (across + uniform(random)) / along, row + (down + uniform(random)) / along);
      const glm::dvec3 front(at.x * layout_.facet().x - layout_.size.x / 2, layout_.size.y / 2 - at.y * layout_.facet().y,
                             layout_.thickness);
      const std::array<double, 5> numbers = even.of(i);
      const LightRay light = light_ray(layout_, front);
      const double ray = light.weight / (along * along); // of what falls on a facet
      glm::dvec3 towards = light.direction;
      if (layout_.sun_radius > 0) towards = beside(towards, layout_.sun_radius * on_circle(std::sqrt(numbers[0]), numbers[1]));
      const double n = layout_.indices.empty()
                           ? layout_.n
                           : layout_.indices[static_cast<std::size_t>(numbers[4] * static_cast<double>(layout_.indices.size()))];
      WayOut way = follow(solid_, bvh_, n, front - 1e-3 * layout_.thickness * towards, towards);
      made.fates.reflected += ray * way.reflected;
      made.fates.lost += ray * (way.part > 0 ? 0 : 1 - way.reflected);
      if (!(way.part > 0)) continue;
      made.fates.sent += ray * way.part;
      if (way.met_wall) made.fates.by_walls += ray * way.part;
      glm::dvec2 slope = glm::dvec2(way.direction) / -way.direction.z;
      if (layout_.scatter > 0) slope += layout_.scatter * normal_pair(numbers[2], numbers[3]);
      for (std::size_t j = 0; j < light_.size(); ++j) {
        const std::optional<std::size_t> cell = layout_.cell_at(glm::dvec2(way.from) + slope * (screens_[j] + way.from.z));
        if (cell) made.light[j][*cell] += ray * way.part;
      }
    }
  }
  return made;
}

void Judge::advance()
{
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int count = std::min(threads, layout_.facets.y - row_);
  std::vector<Row> rows(static_cast<std::size_t>(count));
  for_blocks(rows.size(), [&](std::size_t i) { rows[i] = trace_row(row_ + static_cast<int>(i)); });
  for (const Row& row : rows) {
    for (std::size_t j = 0; j < light_.size(); ++j)
      for (std::size_t c = 0; c < light_[j].size(); ++c) light_[j][c] += row.light[j][c];
    sum_.reflected += row.fates.reflected;
    sum_.lost += row.fates.lost;
    sum_.sent += row.fates.sent;
    sum_.by_walls += row.fates.by_walls;
  }
  row_ += count;
}

Fates Judge::fates() const
{
  const double all = std::max(1.0, static_cast<double>(row_) * layout_.facets.x);
  return {sum_.reflected / all, sum_.lost / all, sum_.sent / all, sum_.by_walls / all};
}

std::vector<Cost> Judge::costs(const std::vector<Target>& targets) const { return costs_of(targets, light_, sum_.sent); }

void Judge::state(State& state)
{
  state.value(row_);
  state.value(sum_);
  for (auto& light : light_) state.items(light);
}

namespace {

/// A single facet is a prism: light through its middle leaves with the slope that it was made for, from the place where it left.
check::Result one_facet(const compute::Context&, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  double farthest = 0;
  for (int i = 0; i < 20; ++i) {
    Layout layout;
    layout.size = {1, 1};
    layout.facets = {1, 1};
    layout.distances = {100};
    const auto about_0 = [&] { return uniform(random) - 0.5; };
    const glm::dvec2 slope(about_0(), about_0()), at = 0.8 * glm::dvec2(about_0(), about_0());
    const Solid solid = make_solid(layout, {slope});
    const WayOut way = follow(solid, scene::build_bvh(solid.mesh), layout.n, {at, layout.thickness + 1}, {0, 0, -1});
    const double z = glm::dot(facet_gradient(slope, layout.n), at), distance = layout.distances[0];
    const glm::dvec2 spot = glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (distance + way.from.z);
    farthest = std::max(farthest, glm::length(spot - (at + slope * (distance + z))));
  }
  return check::judged(farthest, 0.01, "mm", "the spot of a facet over 100 mm against its slope");
}

} // namespace

std::vector<check::Check> closed_forms() { return {{"inverse: a facet's spot", one_facet}}; }

} // namespace nephroid::inverse
