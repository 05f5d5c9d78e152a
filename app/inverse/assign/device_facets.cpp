// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/device_facets.h"

#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/lamp.h"
#include "inverse/light.h"

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
static_assert(BEAMS == Beams::most && LIGHT_POINTS == LightPoints::most && FEW_POINTS == LightPoints::few);

namespace {

using Pair = std::array<float, 2>;

constexpr std::size_t group = 16;
/// How often those of a batch that came into the way of others may try again.
constexpr int turns = 6;
/// A claim tells so many turns apart.
constexpr std::uint32_t all_turns = 1u << 20;

Pair pair_of(const glm::dvec2& v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

std::vector<glm::dvec2> wide(const std::vector<Pair>& pairs) {
  std::vector<glm::dvec2> values;
  for (const Pair& p : pairs) values.emplace_back(p[0], p[1]);
  return values;
}

/// One over a lamp's distance, as light sees it in the object.
double spreads(const Layout& l, const Illumination& light) {
  return light.lamp ? 1 / (light.lamp->z - l.entry() + l.entry() / l.n) : 0;
}

/// Root of the mean variance of a lamp's places along x and y, in millimetres.
double mean_deviation(const Illumination& light) {
  return std::sqrt((light.lamp_covariance[0][0] + light.lamp_covariance[1][1]) / 2);
}

std::vector<shared::DeviceReceiver> receivers_of(const Layout& layout, std::span<const double> weights) {
  std::vector<shared::DeviceReceiver> receivers;
  for (std::size_t j = 0; j < layout.distances.size(); ++j)
    receivers.push_back(
        {.x = static_cast<float>(layout.offset(j).x),
         .y = static_cast<float>(layout.offset(j).y),
         .distance = static_cast<float>(layout.distances[j]),
         .weight = static_cast<float>(weights[j]),
         .light = static_cast<int>(layout.light_index(j)),
         .spreads = static_cast<float>(spreads(layout, layout.light_on(j))),
         .lamp = static_cast<float>(spreads(layout, layout.light_on(j)) * mean_deviation(layout.light_on(j))),
         .padding = 0});
  return receivers;
}

/// The wanted light, in facets.
std::vector<float> wanted_of(const Layout& layout, const std::vector<Target>& targets) {
  std::vector<float> wanted;
  for (const Target& target : targets)
    for (const double t : target) wanted.push_back(static_cast<float>(t * static_cast<double>(layout.facet_count())));
  return wanted;
}

/// Puts the first `own` items of each rank at their place among `count`: those of this one begin at `begin`.
template <class T>
void share(compute::Buffer<T>& items, std::size_t begin, std::size_t own, std::size_t count,
           const Communicator& communicator) {
  std::vector<T> all(count);
  items.RawBuffer::read(all.data() + begin, own * sizeof(T), 0);
  communicator.all_reduce_or(std::as_writable_bytes(std::span(all)));
  items.write(all);
}

std::size_t rimmed_cells(const Layout& l) {
  return static_cast<std::size_t>(l.cells.x + 2) * static_cast<std::size_t>(l.cells.y + 2) * l.distances.size();
}

/// More facets get into each other's way the fewer cells there are, and the more of them a facet's light touches.
std::size_t batch_of(const Layout& l) {
  std::size_t touched = 0;
  const std::size_t facet = index_at(l.facets.x / 2, l.facets.y / 2, l.facets.x);
  for (std::size_t j = 0; j < l.distances.size(); ++j) {
    const Footprint print =
        footprint(l, facet,
                  nearest_reachable(slope_towards(l, facet, (l.offset(j) - l.middle(facet)) / l.distances[j], j), l.n,
                                    l.sines_on(facet)),
                  j);
    touched = std::max(touched, static_cast<std::size_t>(print.columns) * static_cast<std::size_t>(print.rows));
  }
  const std::size_t most = std::clamp<std::size_t>(l.facet_count() / 16, 1, DeviceFacets::most_in_a_batch);
  return std::clamp<std::size_t>(l.cell_count() / std::max<std::size_t>(128, 8 * touched), 1, most);
}

double most_spread(const Layout& l) {
  double most = spreads(l, l.light);
  for (const Illumination& light : l.own_lights) most = std::max(most, spreads(l, light));
  return most;
}

/// The layout in the kernels' form.
shared::DeviceLayout device_layout(const Layout& l) {
  const auto number = [](double value) { return static_cast<float>(value); };
  shared::DeviceLayout made{.size_x = number(l.size.x),
                            .size_y = number(l.size.y),
                            .facet_x = number(l.facet().x),
                            .facet_y = number(l.facet().y),
                            .receiver_x = number(l.receiver.x),
                            .receiver_y = number(l.receiver.y),
                            .cell_x = number(l.cell().x),
                            .cell_y = number(l.cell().y),
                            .columns = l.facets.x,
                            .rows = l.facets.y,
                            .cells_x = l.cells.x,
                            .cells_y = l.cells.y,
                            .receivers = static_cast<int>(l.distances.size()),
                            .n = number(l.n),
                            .steepest = number(l.steepest),
                            .usable = number(usable_slope(l)),
                            .one_over_straight = number(1 / transmitted({0, 0}, l.n)),
                            .sun_radius = {},
                            .scatter = number(l.scatter),
                            .wave_x = number(l.wave_width().x / std::sqrt(12)),
                            .wave_y = number(l.wave_width().y / std::sqrt(12)),
                            .spreads = number(most_spread(l)),
                            .free_heights = l.free_heights,
                            .index_spread = number(index_spread(l)),
                            .index_levels = 1,
                            .index_over = {},
                            .index_part = {},
                            .index_within = {},
                            .points = {},
                            .piece_in_cells = number(piece_in_cells),
                            .wide_in_cells = number(wide_in_cells)};
  for (int level = 0; level < INDEX_LEVELS; ++level) {
    const IndexGroups groups = index_groups(l, 1 << level);
    std::transform(groups.over.begin(), groups.over.end(), made.index_over + (1 << level) - 1, number);
    std::transform(groups.parts.begin(), groups.parts.end(), made.index_part + (1 << level) - 1, number);
    made.index_within[level] = number(groups.within);
    made.index_levels = level + 1;
  }
  const auto put_points = [&](const LightPoints& points, float* at, float* left) {
    for (const glm::dvec3& p : points.at)
      for (int c = 0; c < 3; ++c) *at++ = number(p[c]);
    for (int c = 0; c < 3; ++c) {
      left[c] = number(points.left[c][c]);
      left[3 + c] = number(points.left[(c + 1) % 3][(c + 2) % 3]);
    }
  };
  for (std::size_t k = 0; k <= l.own_lights.size(); ++k) {
    made.sun_radius[k] = number(l.disc(l.numbered(k)));
    put_points(points_of(l.numbered(k), false), made.points[k].at, made.points[k].left);
    put_points(points_of(l.numbered(k), true), made.points[k].few_at, made.points[k].few_left);
  }
  return made;
}

std::vector<shared::DeviceIncoming> incoming_of(const Layout& layout) {
  std::vector<shared::DeviceIncoming> incoming;
  const auto add = [&](const Incoming& in, const glm::dmat2& lamp) {
    shared::DeviceIncoming made{};
    made.lamp[0] = static_cast<float>(lamp[0][0]);
    made.lamp[1] = static_cast<float>(lamp[0][1]);
    made.lamp[2] = static_cast<float>(lamp[1][1]);
    for (int i = 0; i < 2; ++i) {
      made.sines[i] = static_cast<float>(in.sines[i]);
      made.around[i] = static_cast<float>(in.around[i]);
      for (int k = 0; k < 2; ++k) made.spread[2 * i + k] = static_cast<float>(in.spread[i][k]);
    }
    made.power = static_cast<float>(in.power);
    incoming.push_back(made);
  };
  for (std::size_t k = 0; k <= layout.own_lights.size(); ++k)
    if (const Illumination& light = layout.numbered(k); light.facets)
      for (const Incoming& in : *light.facets) add(in, root_of_places(light, in.sines));
  return incoming;
}

} // namespace

compute::Defines facet_defines(const Layout& layout) {
  return {{"NEPHROID_INCOMING", layout.light.facets ? "1" : "0"},
          {"NEPHROID_LIGHTS", layout.own_lights.empty() ? "0" : "1"},
          {"NEPHROID_SPREAD", layout.blurs() ? "1" : "0"},
          {"NEPHROID_SMOOTHS", layout.smoothing > 0 ? "1" : "0"}};
}

DeviceFacets::DeviceFacets(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
                           std::span<const double> weights)
    : context_(context), layout_(context, "layout", std::vector{device_layout(layout)}), facets_(layout.facet_count()),
      batch_(batch_of(layout)), cells_(layout.cell_count() * targets.size()),
      rows_(static_cast<std::size_t>(layout.cells.y) * targets.size()),
      receivers_(context, "receivers", receivers_of(layout, weights)),
      incoming_(context, "light on the facets", incoming_of(layout)), heights_(context, "facets' heights", facets_),
      wanted_(context, "wanted light", wanted_of(layout, targets)), lack_(context, "lack of light", cells_),
      along_y_(context, "lack of light along y", cells_),
      smeared_(compute::zeroed<float>(context, "lack of light, smeared", rimmed_cells(layout))),
      slopes_(context, "slopes", facets_), candidates_(context, "slopes to try", 8 * most_in_a_batch),
      found_(context, "slopes found", most_in_a_batch), gradient_(context, "gradient", facets_),
      light_(context, "light on the receivers", cells_), order_(context, "order of the facets", facets_),
      claims_(context, "claims", cells_ + facets_), done_(context, "facets that have looked", most_in_a_batch) {
  const compute::Defines defines = facet_defines(layout);
  const compute::Program light(context, "inverse/light.cl", defines), propose(context, "inverse/propose.cl", defines),
      search(context, "inverse/search.cl", defines);
  add_light_ = light.kernel("add_light");
  find_lack_ = light.kernel("find_lack");
  find_gradient_ = light.kernel("find_gradient");
  smear_x_ = propose.kernel("smear_x");
  smear_y_ = propose.kernel("smear_y");
  propose_ = propose.kernel("propose");
  improve_ = search.kernel("improve");
  claim_ = search.kernel("claim");
  take_ = search.kernel("take");
}

void DeviceFacets::aim(const Layout& layout, const std::vector<Target>& targets, std::span<const double> weights) {
  layout_.write(std::vector{device_layout(layout)});
  receivers_.write(receivers_of(layout, weights));
  wanted_.write(wanted_of(layout, targets));
  find_lack();
}

void DeviceFacets::set_incoming(const Layout& layout) { incoming_.write(incoming_of(layout)); }

void DeviceFacets::find_lack() {
  find_lack_.run(
      cells_, group,
      {{"layout", layout_}, {"receivers", receivers_}, {"light", light_}, {"wanted", wanted_}, {"lack", lack_}});
}

void DeviceFacets::put(const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights) {
  std::vector<Pair> narrow(slopes.size());
  std::transform(slopes.begin(), slopes.end(), narrow.begin(), pair_of);
  slopes_.write(narrow);
  heights_.write(std::vector<float>(heights.begin(), heights.end()));
  light_.fill_zero();
  add_light_.run(facets_, group, facet_arguments(), {{"light", light_}});
  find_lack();
}

std::vector<glm::dvec2> DeviceFacets::slopes() const { return wide(slopes_.read()); }

std::vector<std::vector<double>> DeviceFacets::light() const {
  const std::vector<std::int64_t> quanta = light_.read();
  const std::size_t receivers = receivers_.size(), cells = cells_ / receivers;
  std::vector<std::vector<double>> light(receivers, std::vector<double>(cells));
  for (std::size_t j = 0; j < receivers; ++j)
    for (std::size_t c = 0; c < cells; ++c) light[j][c] = static_cast<double>(quanta[j * cells + c]) / FACET_QUANTA;
  return light;
}

void DeviceFacets::begin_sweep(const std::vector<std::uint32_t>& order, std::int64_t sweep, std::uint64_t seed) {
  order_.write(order);
  sweep_ = static_cast<std::uint32_t>(sweep);
  seed_ = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  turn_ = all_turns; // the next one begins anew
}

std::vector<compute::Argument> DeviceFacets::facet_arguments() const {
  return {{"layout", layout_},
          {"receivers", receivers_},
          {"incoming", incoming_},
          {"heights", heights_},
          {"slopes", slopes_}};
}

/// The batch outlives them.
std::vector<compute::Argument> DeviceFacets::batch_arguments(const shared::DeviceBatch& batch) const {
  std::vector<compute::Argument> arguments = facet_arguments();
  arguments.insert(arguments.end(), {{"lack", lack_}, {"order", order_}, {"batch", batch}});
  return arguments;
}

/// Each rank looks for some of the facets. Then all know of all.
void DeviceFacets::find_better(const shared::DeviceBatch& batch) {
  const Communicator& communicator = context_.communicator();
  const std::size_t ranks = static_cast<std::size_t>(communicator.size()),
                    rank = static_cast<std::size_t>(communicator.rank()), count = batch.count;
  const std::size_t begin = count * rank / ranks, own = count * (rank + 1) / ranks - begin;
  if (own > 0) {
    shared::DeviceBatch part = batch;
    part.first += static_cast<std::uint32_t>(begin);
    part.count = static_cast<std::uint32_t>(own);
    const std::vector<compute::Argument> arguments = batch_arguments(part);
    propose_.run(own, group, arguments, {{"smeared", smeared_}, {"candidates", candidates_}});
    improve_.run(own, group, arguments, {{"candidates", candidates_}, {"found", found_}, {"done", done_}});
  }
  if (communicator.is_alone()) return;
  share(found_, begin, own, count, communicator);
  share(done_, begin, own, count, communicator);
}

void DeviceFacets::improve(std::size_t first, std::size_t count, double smoothing) {
  shared::DeviceBatch batch{seed_,
                            sweep_,
                            turn_,
                            static_cast<std::uint32_t>(first),
                            static_cast<std::uint32_t>(count),
                            static_cast<float>(smoothing),
                            0};
  const std::vector<compute::Argument> arguments = batch_arguments(batch);
  smear_y_.run(rows_, 1, {{"layout", layout_}, {"receivers", receivers_}, {"lack", lack_}, {"along_y", along_y_}});
  smear_x_.run(rows_, 1,
               {{"layout", layout_}, {"receivers", receivers_}, {"along_y", along_y_}, {"smeared", smeared_}});
  find_better(batch);
  for (int i = 0; i < turns; ++i, ++turn_) {
    if (turn_ >= all_turns) {
      claims_.write(std::vector<std::uint32_t>(claims_.size(), ~0u));
      turn_ = 0;
    }
    batch.turn = turn_;
    claim_.run(count, group, arguments, {{"found", found_}, {"done", done_}, {"claims", claims_}});
    take_.run(count, group, arguments,
              {{"found", found_}, {"done", done_}, {"claims", claims_}, {"light", light_}, {"wanted", wanted_}});
  }
  context_.finish();
}

std::vector<glm::dvec2> DeviceFacets::gradient() {
  const Communicator& communicator = context_.communicator();
  const auto facets = static_cast<std::int64_t>(facets_);
  if (!communicator.is_alone()) gradient_.fill_zero();
  Partition(communicator, facets).for_own(0, facets, [&](std::int64_t begin, std::int64_t own) {
    const auto first = static_cast<std::uint32_t>(begin), count = static_cast<std::uint32_t>(own);
    find_gradient_.run(count, group, facet_arguments(),
                       {{"lack", lack_}, {"first", first}, {"count", count}, {"gradient", gradient_}});
  });
  return wide(context_.all_reduced_or(gradient_));
}

std::uint64_t DeviceFacets::bytes(const Layout& l) {
  const std::uint64_t cells = l.cell_count() * l.distances.size();
  return l.facet_count() * (sizeof(float) + 2 * sizeof(Pair) + 2 * sizeof(std::uint32_t)) +
         (1 + l.own_lights.size()) * l.incoming().size() * sizeof(shared::DeviceIncoming) +
         cells * (sizeof(std::int64_t) + 5 * sizeof(float));
}

void DeviceFacets::serialize(Archive& archive) {
  std::vector<Pair> slopes = slopes_.read();
  std::vector<float> heights = heights_.read();
  std::vector<std::int64_t> light = light_.read();
  archive.items(slopes);
  archive.items(heights);
  archive.items(light);
  if (!archive.is_read()) return;
  slopes_.write(slopes);
  heights_.write(heights);
  light_.write(light);
  find_lack();
}

} // namespace nephroid::inverse
