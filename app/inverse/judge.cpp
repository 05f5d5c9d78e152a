// SPDX-License-Identifier: Apache-2.0
#include "inverse/judge.h"

#include "inverse/bending.h"
#include "inverse/diffraction.h"
#include "inverse/light.h"
#include "inverse/uniform.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

constexpr std::size_t work_group = 32;
/// A step's rays, some milliseconds of two cores.
constexpr int rays_a_slice = 1 << 15;

/// Rays along one side of a facet: about two million a round.
int rays_along(const Layout& layout) { return std::clamp(1448 / std::max(layout.facets.x, layout.facets.y), 4, 45); }

constexpr int least_rounds = 2, most_rounds = 4;

shared::float4 four(const glm::dvec3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

/// Each triangle's outward normal and its part.
std::vector<shared::float4> normals_of(const Solid& solid) {
  std::vector<shared::float4> normals;
  normals.reserve(solid.parts.size());
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    const glm::uvec3& t = solid.mesh.triangles[i];
    const glm::dvec3 a = solid.mesh.positions[t.x], b = solid.mesh.positions[t.y], c = solid.mesh.positions[t.z];
    normals.push_back(four(glm::normalize(glm::cross(b - a, c - a)), static_cast<double>(solid.parts[i])));
  }
  return normals;
}

/// A step through so many parts that meets each, and spreads neighbours: about the fifth power of 1 / g (see judge.cl).
std::uint32_t part_step(int parts) {
  int step = std::max(1, static_cast<int>(0.5316 * parts));
  while (std::gcd(step, parts) != 1) ++step;
  return static_cast<std::uint32_t>(step);
}

/// `l` has the light as that of all.
shared::DeviceFront front_of(const Layout& l, std::size_t screens) {
  const auto number = [](double value) { return static_cast<float>(value); };
  // The rays of a mirror begin below all of its relief.
  const double before = l.is_mirror() ? l.thickness + glm::length(l.size) : 1e-3 * l.thickness;
  return {.direction = four(light_ray(l, {0, 0, l.entry()}).direction),
          .lamp = four(l.light.lamp.value_or(glm::dvec3(0))),
          .lamp_weight = l.light.lamp ? number(lamp_weight(l)) : 0,
          .n = number(l.n),
          .sun_radius = number(l.light.lamp_places.empty() ? l.disc(l.light) : 0),
          .scatter = number(l.scatter),
          .wavelength = number(l.wavelength),
          .size_x = number(l.size.x),
          .size_y = number(l.size.y),
          .facet_x = number(l.facet().x),
          .facet_y = number(l.facet().y),
          .entry = number(l.entry()),
          .before = number(before),
          .receiver_x = number(l.receiver.x),
          .receiver_y = number(l.receiver.y),
          .cell_x = number(l.cell().x),
          .cell_y = number(l.cell().y),
          .columns = l.facets.x,
          .along = rays_along(l),
          .cells_x = l.cells.x,
          .cells_y = l.cells.y,
          .screens = static_cast<int>(screens),
          .part_step = l.spectrum ? part_step(rays_along(l) * rays_along(l)) : 0,
          .is_round = l.round ? 1 : 0,
          .lamp_places = static_cast<std::uint32_t>(l.light.lamp_places.size()),
          .padding = 0};
}

/// The receivers, then the frames between them.
std::vector<shared::DeviceReceiver> screens_of(const Layout& l) {
  std::vector<shared::DeviceReceiver> screens;
  const auto add = [&](double distance, const glm::dvec2& middle) {
    screens.push_back({.x = static_cast<float>(middle.x),
                       .y = static_cast<float>(middle.y),
                       .distance = static_cast<float>(distance),
                       .weight = 1,
                       .light = 0,
                       .spreads = 0,
                       .lamp = 0,
                       .padding = 0});
  };
  for (std::size_t j = 0; j < l.distances.size(); ++j) add(l.distances[j], l.offset(j));
  for (std::size_t k = 0; k < l.frames.size(); ++k) {
    const std::size_t each = l.frames.size() / (l.distances.size() - 1), j = k / each;
    add(l.frames[k],
        glm::mix(l.offset(j), l.offset(j + 1), static_cast<double>(k % each + 1) / static_cast<double>(each + 1)));
  }
  return screens;
}

/// A light between two: a part of the way from one to the other.
Illumination between(const Illumination& a, const Illumination& b, double part) {
  Illumination made = a;
  made.facets.reset();
  made.sun_radius = glm::mix(a.sun_radius, b.sun_radius, part);
  if (a.lamp && b.lamp) made.lamp = glm::mix(*a.lamp, *b.lamp, part);
  made.lamp_places.resize(std::max(a.lamp_places.size(), b.lamp_places.size()), {0, 0, 0, 1});
  for (std::size_t i = 0; i < made.lamp_places.size(); ++i)
    made.lamp_places[i] =
        glm::mix(made.lamp_places[i], b.lamp_places.empty() ? glm::dvec4(0, 0, 0, 1) : b.lamp_places[i], part);
  const auto direction = [](const Illumination& l) {
    return glm::dvec3(l.sines, std::sqrt(1 - glm::dot(l.sines, l.sines)));
  };
  made.sines = glm::dvec2(glm::normalize(glm::mix(direction(a), direction(b), part)));
  return made;
}

compute::Defines judge_defines(const Layout& l) {
  return {{"NEPHROID_SPREAD", l.blurs() ? "1" : "0"},
          {"NEPHROID_DIFFRACTION", l.diffracts ? "1" : "0"},
          {"NEPHROID_CHANNELS", l.coloured() ? "3" : "1"}};
}

/// RankContext::all_reduced_sum gives it again.
void write_sum(compute::Buffer<std::int64_t>& buffer, const std::vector<std::int64_t>& sum,
               const Communicator& communicator) {
  buffer.fill_zero();
  if (communicator.is_root()) buffer.write(sum);
}

std::size_t channels(const Layout& l) { return l.coloured() ? 3 : 1; }

/// The parallelogram's law: with noise, each half is farther from what is wanted than their mean is, by its square.
double noise_of(double whole, double a, double b) {
  return std::sqrt(std::max(0.0, (a * a + b * b) / 2 - whole * whole));
}

} // namespace

SolidOnDevice::SolidOnDevice(const compute::Context& context, const Solid& solid, const compute::Defines& more) {
  scene::Bvh bvh = scene::build_bvh(solid.mesh);
  nodes = compute::Buffer(context, "solid's tree", std::exchange(bvh.nodes, {})); // a large one is in memory once
  blocks = compute::Buffer(context, "solid's triangles", std::exchange(bvh.blocks, {}));
  normals = compute::Buffer(context, "solid's normals", normals_of(solid));
  root = bvh.root;
  compute::Defines defines = scene::tree_defines(bvh);
  defines.insert(more.begin(), more.end());
  program.emplace(context, "inverse/judge.cl", defines);
}

std::vector<WayOut> follow(const compute::Context& context, const Solid& solid, double n,
                           const std::vector<Ray>& rays) {
  SolidOnDevice on_device(context, solid,
                          {{"NEPHROID_SPREAD", "0"}, {"NEPHROID_DIFFRACTION", "0"}, {"NEPHROID_CHANNELS", "1"}});
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
      .run(count, work_group,
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
    made.push_back({{w.from.x, w.from.y, w.from.z},
                    {w.direction.x, w.direction.y, w.direction.z},
                    w.part,
                    w.reflected,
                    w.met_wall != 0});
  return made;
}

Judge::Judge(const mpi::RankContext& context, const Layout& layout, const Solid& solid, std::uint64_t seed,
             const std::vector<Target>& targets)
    : context_(context), layout_(layout), targets_(targets),
      solid_(context, solid, judge_defines(layout)), seed_{static_cast<std::uint32_t>(seed),
                                                           static_cast<std::uint32_t>(seed >> 32)} {
  screens_ = screens_of(layout);
  along_ = rays_along(layout);
  std::vector<shared::float4> parts;
  std::vector<float> wavelengths;
  if (layout.spectrum) {
    const int count = along_ * along_;
    for (const LightPart& part : equal_parts(layout.spectrum->parts, static_cast<std::size_t>(count))) {
      const glm::dvec3 xyz = part.xyz * static_cast<double>(count); // each has its share of the rays
      parts.push_back(four({part.n, xyz.x, xyz.y}, xyz.z));
      wavelengths.push_back(static_cast<float>(part.nm * mm_a_nm));
    }
  }
  parts_ = compute::Buffer(context, "parts of the spectrum", parts);
  quantiles_ = compute::Buffer(context, "a slit's light",
                               layout.diffracts ? slit_quantiles(SLIT_QUANTILES) : std::vector<float>());
  wavelengths_ = compute::Buffer(context, "their wavelengths", wavelengths);
  judge_ = solid_.program->kernel("judge");
  light_.assign(screens_.size(), std::vector<double>(layout.cell_count()));
  halves_.fill(light_);
  std::vector<std::size_t> some(layout.own_lights.empty() ? screens_.size() : layout.distances.size());
  std::iota(some.begin(), some.end(), std::size_t{0});
  first_light_ = !layout.light_of.empty() && std::ranges::count(layout.light_of, 0u) == 0 ? 1 : 0;
  for (std::size_t k = first_light_; k <= layout.own_lights.size(); ++k) add_light(layout.numbered(k), some);
  if (layout.own_lights.empty() || layout.frames.empty()) return;
  const std::size_t each = layout.frames.size() / (layout.distances.size() - 1);
  for (std::size_t f = 0; f < layout.frames.size(); ++f)
    add_light(between(layout.light_on(f / each), layout.light_on(f / each + 1),
                      static_cast<double>(f % each + 1) / static_cast<double>(each + 1)),
              {layout.distances.size() + f});
}

void Judge::add_light(const Illumination& light, std::vector<std::size_t> screens) {
  Layout lit = layout_;
  lit.light = light;
  lit.own_lights.clear();
  OneLight one;
  one.front = front_of(lit, screens.size());
  std::vector<shared::DeviceReceiver> receivers;
  for (const std::size_t screen : screens) receivers.push_back(screens_[screen]);
  one.receivers = compute::Buffer(context_, "screens", receivers);
  std::vector<shared::float4> places;
  for (const glm::dvec4& place : light.lamp_places) places.push_back(four(glm::dvec3(place), place.w));
  one.lamp_places = compute::Buffer(context_, "places of the lamp", places);
  for (auto& half : one.sums)
    half = compute::zeroed<std::int64_t>(context_, "light on the screens",
                                         layout_.cell_count() * screens.size() * channels(layout_));
  one.outcomes =
      compute::zeroed<std::int64_t>(context_, "where the light goes", std::size_t{RAY_OUTCOMES} * RAY_OUTCOME_SUMS);
  one.light.assign(screens.size(), std::vector<double>(layout_.cell_count()));
  one.halves.fill(one.light);
  one.screens = std::move(screens);
  lights_.push_back(std::move(one));
}

std::size_t Judge::lamp_of(std::size_t screen) const {
  if (layout_.own_lights.empty()) return 0;
  const std::size_t receivers = layout_.distances.size();
  return (screen < receivers ? layout_.light_index(screen) : layout_.own_lights.size() + 1 + screen - receivers) -
         first_light_;
}

std::size_t Judge::place_of(std::size_t screen) const {
  return layout_.own_lights.empty() || screen < layout_.distances.size() ? screen : 0;
}

double Judge::fraction_done() const {
  const int rounds = std::max(least_rounds, (round_ + 2) / 2 * 2);
  return finished_ ? 1 : (round_ + static_cast<double>(row_) / (layout_.facets.y * lights_.size())) / rounds;
}

std::uint64_t rays_of(const Layout& layout) {
  const auto along = static_cast<std::uint64_t>(rays_along(layout));
  return layout.facet_count() * along * along;
}

void Judge::advance() {
  const int rays_a_row = layout_.facets.x * along_ * along_, rows_a_light = layout_.facets.y, row = row_ % rows_a_light;
  const Communicator& communicator = context_.communicator();
  const int rows = std::min(rows_a_light - row, std::max(1, rays_a_slice / rays_a_row) * communicator.size());
  const auto turn = static_cast<std::uint32_t>(round_);
  OneLight& light = lights_[static_cast<std::size_t>(row_ / rows_a_light)];
  Partition(communicator, rows_a_light).for_own(row, rows, [&](std::int64_t first_row, std::int64_t own) {
    judge_rows(light, static_cast<std::uint32_t>(first_row), static_cast<std::uint32_t>(own * rays_a_row), turn);
  });
  context_.finish();
  row_ += rows;
  if (row_ < rows_a_light * static_cast<int>(lights_.size())) return;
  row_ = 0;
  if (++round_ % 2 == 0) end_pair();
}

void Judge::judge_rows(OneLight& light, std::uint32_t first, std::uint32_t count, std::uint32_t turn) {
  const shared::DeviceJudgeLaunch launch{seed_, turn, first, count, 0};
  judge_.run(count, work_group,
             {{"nodes", solid_.nodes},
              {"blocks", solid_.blocks},
              {"root", solid_.root},
              {"normals", solid_.normals},
              {"front", light.front},
              {"parts", parts_},
              {"wavelengths", wavelengths_},
              {"quantiles", quantiles_},
              {"lamp_places", light.lamp_places},
              {"screens", light.receivers},
              {"launch", launch},
              {"light", light.sums[turn % 2]},
              {"outcomes", light.outcomes}});
}

void Judge::end_pair() {
  read_sums();
  finished_ = round_ >= most_rounds || targets_.empty();
  if (finished_) return;
  const Cost said = mean(costs(targets_)), noisy = mean(noise(targets_));
  finished_ = noisy.cost <= said.cost / 3 && noisy.rel_l2 <= said.rel_l2 / 3;
}

void Judge::read_sums() {
  for (OneLight& light : lights_) read_sums(light);
  for (std::size_t screen = 0; screen < screens_.size(); ++screen) {
    const OneLight& light = lights_[lamp_of(screen)];
    light_[screen] = light.light[place_of(screen)];
    for (std::size_t half = 0; half < 2; ++half) halves_[half][screen] = light.halves[half][place_of(screen)];
  }
  if (finished()) solid_ = {}; // no ray follows
}

void Judge::read_sums(OneLight& light) {
  const std::size_t cells = layout_.cell_count(), screen = cells * channels(layout_);
  for (std::size_t half = 0; half < 2; ++half) {
    const std::vector<std::int64_t> sums = context_.all_reduced_sum(light.sums[half]);
    for (std::size_t j = 0; j < light.light.size(); ++j)
      for (std::size_t c = 0; c < cells; ++c)
        light.halves[half][j][c] = static_cast<double>(sums[j * screen + c]) / RAY_QUANTA * 2 / round_;
  }
  for (std::size_t j = 0; j < light.light.size(); ++j)
    for (std::size_t c = 0; c < cells; ++c) light.light[j][c] = (light.halves[0][j][c] + light.halves[1][j][c]) / 2;
  const std::vector<std::int64_t> outcomes = context_.all_reduced_sum(light.outcomes);
  std::array<std::int64_t, RAY_OUTCOMES> sums{};
  for (std::size_t i = 0; i < outcomes.size(); ++i) sums[i % RAY_OUTCOMES] += outcomes[i];
  const auto facets = [&](int outcome) {
    return static_cast<double>(sums[static_cast<std::size_t>(outcome)]) / RAY_QUANTA / round_;
  };
  light.sum = {facets(RAY_REFLECTED), facets(RAY_LOST), facets(RAY_SENT), facets(RAY_BY_WALLS)};
}

std::vector<glm::dvec3> Judge::colours(std::size_t which_screen) const {
  const std::size_t cells = layout_.cell_count(), screen = place_of(which_screen);
  std::vector<glm::dvec3> xyz(cells);
  for (const auto& half : lights_[lamp_of(which_screen)].sums) {
    const std::vector<std::int64_t> light = context_.all_reduced_sum(half);
    const auto channel = [&](std::size_t which, std::size_t c) {
      return static_cast<double>(light[(3 * screen + which) * cells + c]) / RAY_QUANTA / round_;
    };
    for (std::size_t c = 0; c < cells; ++c) xyz[c] += glm::dvec3(channel(1, c), channel(0, c), channel(2, c));
  }
  return xyz;
}

RayOutcomes Judge::outcomes() const {
  const std::size_t receivers = layout_.distances.size();
  const double rays = static_cast<double>(layout_.facet_count()) * static_cast<double>(receivers);
  RayOutcomes mean;
  for (std::size_t j = 0; j < receivers; ++j) {
    const RayOutcomes& sum = lights_[lamp_of(j)].sum;
    mean.reflected += sum.reflected / rays;
    mean.lost += sum.lost / rays;
    mean.sent += sum.sent / rays;
    mean.by_walls += sum.by_walls / rays;
  }
  return mean;
}

std::vector<Cost> Judge::costs_by(const std::vector<Target>& targets,
                                  const std::vector<std::vector<double>>& light) const {
  std::vector<double> sent;
  for (std::size_t j = 0; j < targets.size(); ++j) sent.push_back(lights_[lamp_of(j)].sum.sent);
  return costs_of(targets, light, sent);
}

std::vector<Cost> Judge::costs(const std::vector<Target>& targets) const { return costs_by(targets, light_); }

std::vector<Cost> Judge::noise(const std::vector<Target>& targets) const {
  std::vector<Cost> noise = costs(targets);
  const std::vector<Cost> a = costs_by(targets, halves_[0]), b = costs_by(targets, halves_[1]);
  for (std::size_t j = 0; j < noise.size(); ++j)
    noise[j] = {noise_of(noise[j].cost, a[j].cost, b[j].cost),
                noise_of(noise[j].cost_all, a[j].cost_all, b[j].cost_all),
                noise_of(noise[j].rel_l2, a[j].rel_l2, b[j].rel_l2), std::abs(a[j].missed - b[j].missed) / 2};
  return noise;
}

void Judge::serialize(Archive& archive) {
  archive.value(row_);
  archive.value(round_);
  archive.value(finished_);
  for (OneLight& one : lights_) {
    const auto put = [&](compute::Buffer<std::int64_t>& sums) {
      std::vector<std::int64_t> sum = context_.all_reduced_sum(sums);
      archive.items(sum);
      if (archive.is_read()) write_sum(sums, sum, context_.communicator());
    };
    for (auto& half : one.sums) put(half);
    put(one.outcomes);
  }
  if (!archive.is_read()) return;
  if (finished_) read_sums();
}

namespace {

/// A single facet is a prism: light through its middle leaves with the slope that it was made for, from where it left.
check::Result one_facet(const compute::Context& context, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  double farthest = 0;
  for (int i = 0; i < 20; ++i) {
    Layout layout;
    layout.size = {1, 1};
    layout.facets = {1, 1};
    layout.distances = {100};
    const auto about_0 = [&] { return uniform(random) - 0.5; };
    const glm::dvec2 slope(about_0(), about_0()), at = 0.8 * glm::dvec2(about_0(), about_0());
    const WayOut way =
        follow(context, make_solid(layout, {slope}), layout.n, {{{at, layout.thickness + 1}, {0, 0, -1}}}).front();
    const double z = glm::dot(facet_gradient(slope, layout.n), at), distance = layout.distances[0];
    const glm::dvec2 spot =
        glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (distance + way.from.z);
    farthest = std::max(farthest, glm::length(spot - (at + slope * (distance + z))));
  }
  return check::judged(farthest, 0.01, "mm", "the spot of a facet over 100 mm against its slope");
}

} // namespace

check::Checks closed_forms() { return {{"inverse: a facet's spot", one_facet}}; }

} // namespace nephroid::inverse
