// SPDX-License-Identifier: Apache-2.0
#include "inverse/judge.h"

#include "inverse/bending.h"
#include "inverse/engine.h"
#include "inverse/uniform.h"

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {

namespace {

constexpr std::size_t group = 32;
/// A step's rays, some milliseconds of two cores.
constexpr int rays_a_step = 1 << 15;

/// Rays along one side of a facet: about four million in all, and so many a facet that a cell's light is known to a few percent, since the
/// brightest cell scales the cost: a million judge `dispersion` at .016, four at .011.
int rays_along(const Layout& layout) { return std::clamp(2048 / std::max(layout.facets.x, layout.facets.y), 5, 64); }

shared::float4 four(const glm::dvec3& v, double w = 0)
{
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

/// Outward, of each triangle, and its part.
std::vector<shared::float4> normals_of(const Solid& solid)
{
  std::vector<shared::float4> normals;
  normals.reserve(solid.parts.size());
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    const glm::uvec3& t = solid.mesh.triangles[i];
    const glm::dvec3 a = solid.mesh.positions[t.x], b = solid.mesh.positions[t.y], c = solid.mesh.positions[t.z];
    normals.push_back(four(glm::normalize(glm::cross(b - a, c - a)), static_cast<double>(solid.parts[i])));
  }
  return normals;
}

shared::DeviceFront front_of(const Layout& l, std::size_t screens)
{
  const auto number = [](double value) { return static_cast<float>(value); };
  const bool lamp = l.lamp.has_value();
  const glm::dvec3 beside = l.lamp.value_or(glm::dvec3(0));
  return {.direction = four(light_ray(l, {0, 0, l.thickness}).direction),
          .lamp = four(beside),
          .lamp_weight = lamp ? number(lamp_weight(l)) : 0,
          .n = number(l.n),
          .sun_radius = number(l.sun_radius),
          .scatter = number(l.scatter),
          .size_x = number(l.size.x),
          .size_y = number(l.size.y),
          .facet_x = number(l.facet().x),
          .facet_y = number(l.facet().y),
          .thickness = number(l.thickness),
          .receiver_x = number(l.receiver.x),
          .receiver_y = number(l.receiver.y),
          .cell_x = number(l.cell().x),
          .cell_y = number(l.cell().y),
          .columns = l.facets.x,
          .along = rays_along(l),
          .cells_x = l.cells.x,
          .cells_y = l.cells.y,
          .screens = static_cast<int>(screens),
          .index_count = static_cast<int>(l.indices.size()),
          .is_round = l.round ? 1 : 0};
}

bool spreads(const Layout& l) { return l.sun_radius > 0 || l.scatter > 0 || !l.indices.empty(); }

} // namespace

SolidOnDevice::SolidOnDevice(const compute::Context& context, const Solid& solid, bool spreads)
{
  const scene::Bvh bvh = scene::build_bvh(solid.mesh);
  nodes = compute::Buffer(context, "solid's tree", bvh.nodes);
  blocks = compute::Buffer(context, "solid's triangles", bvh.blocks);
  normals = compute::Buffer(context, "solid's normals", normals_of(solid));
  root = bvh.root;
  compute::Defines defines = scene::tree_defines(bvh);
  defines.insert_or_assign("NEPHROID_SPREAD", std::string(1, spreads ? '1' : '0'));
  program.emplace(context, "inverse/judge.cl", defines);
}

std::vector<WayOut> follow(const compute::Context& context, const Solid& solid, double n, const std::vector<Ray>& rays)
{
  SolidOnDevice on_device(context, solid, false);
  std::vector<shared::float4> from, directions;
  for (const Ray& ray : rays) {
    from.push_back(four(ray.from));
    directions.push_back(four(glm::normalize(ray.direction)));
  }
  const compute::Buffer starts(context, "rays", from), goes(context, "rays' directions", directions);
  const compute::Buffer<shared::DeviceWayOut> ways(context, "rays' ways", rays.size());
  const auto index = static_cast<float>(n);
  const auto count = static_cast<std::uint32_t>(rays.size());
  on_device.program->kernel("follow_rays")
      .run(count, group,
           {{"nodes", on_device.nodes},
            {"blocks", on_device.blocks},
            {"root", on_device.root},
            {"normals", on_device.normals},
            {"n", index},
            {"from", starts},
            {"directions", goes},
            {"count", count},
            {"ways", ways}});
  std::vector<WayOut> made;
  for (const shared::DeviceWayOut& w : ways.read())
    made.push_back({{w.from.x, w.from.y, w.from.z}, {w.direction.x, w.direction.y, w.direction.z}, w.part, w.reflected, w.met_wall != 0});
  return made;
}

Judge::Judge(const compute::Context& context, const Layout& layout, const Solid& solid, std::uint64_t seed)
    : context_(context), layout_(layout),
      solid_(context, solid, spreads(layout)), seed_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}
{
  std::vector<double> screens = layout.distances;
  screens.insert(screens.end(), layout.frames.begin(), layout.frames.end());
  front_ = front_of(layout, screens.size());
  indices_ = compute::Buffer(context, "indices", std::vector<float>(layout.indices.begin(), layout.indices.end()));
  distances_ = compute::Buffer(context, "screens", std::vector<float>(screens.begin(), screens.end()));
  light_on_screens_ = compute::zeroed<std::int64_t>(context, "light on the screens", layout.cell_count() * screens.size());
  fates_ = compute::zeroed<std::int64_t>(context, "where the light goes", std::size_t{FATES} * FATE_SUMS);
  judge_ = solid_.program->kernel("judge");
  light_.assign(screens.size(), std::vector<double>(layout.cell_count()));
}

void Judge::advance()
{
  const int rays_a_row = layout_.facets.x * front_.along * front_.along;
  const int rows = std::min(layout_.facets.y - row_, std::max(1, rays_a_step / rays_a_row));
  const auto first = static_cast<std::uint32_t>(row_), count = static_cast<std::uint32_t>(rows * rays_a_row);
  judge_.run(count, group,
             {{"nodes", solid_.nodes},
              {"blocks", solid_.blocks},
              {"root", solid_.root},
              {"normals", solid_.normals},
              {"front", front_},
              {"indices", indices_},
              {"distances", distances_},
              {"seed", seed_},
              {"first_row", first},
              {"count", count},
              {"light", light_on_screens_},
              {"fates", fates_}});
  context_.finish();
  row_ += rows;
  if (finished()) read_sums();
}

void Judge::read_sums()
{
  const std::vector<std::int64_t> light = light_on_screens_.read(), fates = fates_.read();
  for (std::size_t j = 0; j < light_.size(); ++j)
    for (std::size_t c = 0; c < light_[j].size(); ++c) light_[j][c] = static_cast<double>(light[j * light_[j].size() + c]) / RAY_QUANTA;
  std::array<std::int64_t, FATES> sums{};
  for (std::size_t i = 0; i < fates.size(); ++i) sums[i % FATES] += fates[i];
  const auto facets = [&](int fate) { return static_cast<double>(sums[static_cast<std::size_t>(fate)]) / RAY_QUANTA; };
  sum_ = {facets(FATE_REFLECTED), facets(FATE_LOST), facets(FATE_SENT), facets(FATE_BY_WALLS)};
}

Fates Judge::fates() const
{
  const double all = std::max(1.0, static_cast<double>(row_) * layout_.facets.x);
  return {sum_.reflected / all, sum_.lost / all, sum_.sent / all, sum_.by_walls / all};
}

std::vector<Cost> Judge::costs(const std::vector<Target>& targets) const { return costs_of(targets, light_, sum_.sent); }

void Judge::state(State& state)
{
  std::vector<std::int64_t> light = light_on_screens_.read(), fates = fates_.read();
  state.value(row_);
  state.items(light);
  state.items(fates);
  if (!state.is_read()) return;
  light_on_screens_.write(light);
  fates_.write(fates);
  read_sums();
}

namespace {

/// A single facet is a prism: light through its middle leaves with the slope that it was made for, from the place where it left.
check::Result one_facet(const compute::Context& context, std::uint64_t seed)
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
    const WayOut way = follow(context, make_solid(layout, {slope}), layout.n, {{{at, layout.thickness + 1}, {0, 0, -1}}}).front();
    const double z = glm::dot(facet_gradient(slope, layout.n), at), distance = layout.distances[0];
    const glm::dvec2 spot = glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (distance + way.from.z);
    farthest = std::max(farthest, glm::length(spot - (at + slope * (distance + z))));
  }
  return check::judged(farthest, 0.01, "mm", "the spot of a facet over 100 mm against its slope");
}

} // namespace

std::vector<check::Check> closed_forms() { return {{"inverse: a facet's spot", one_facet}}; }

} // namespace nephroid::inverse
