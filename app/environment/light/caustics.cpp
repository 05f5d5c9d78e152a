// SPDX-License-Identifier: Apache-2.0
#include "environment/light/caustics.h"

#include <string>

namespace nephroid::environment {
namespace {

constexpr std::size_t group = 32;

/// [texel of Bake::way_map]: the unit way.
std::vector<shared::float4> all_ways() {
  std::vector<shared::float4> ways;
  for (std::size_t i = 0; i < Bake::way_map.texels(); ++i)
    ways.push_back(tracing::to_float4(Bake::way_map.direction(i)));
  return ways;
}

/// The sets in groups of eight. spheres: how many a direction has.
std::vector<shared::DeviceEightSets> eights_of(const std::vector<TurnedSet>& sets, std::size_t spheres) {
  std::vector<shared::DeviceEightSets> eights;
  for (std::size_t i = 0; i < (sets.size() + 7) / 8 * 8; ++i) {
    const bool missing = i >= sets.size();
    const TurnedSet& set = missing ? sets.back() : sets[i];
    const std::size_t lane = i % 8;
    if (lane == 0) eights.emplace_back();
    shared::DeviceEightSets& eight = eights.back();
    for (int k = 0; k < 9; ++k)
      eight.to_bake[k][lane] = static_cast<float>(set.to_bake[k % 3][k / 3]); // glm has columns
    for (int c = 0; c < 3; ++c) eight.flux[c][lane] = missing ? 0.0F : static_cast<float>(set.flux[c]);
    eight.first[lane] = static_cast<std::size_t>(set.direction) * spheres;
  }
  return eights;
}

} // namespace

Caustics::Caustics(const Bake& bake, const compute::Context& context)
    : context_(context), directions_(static_cast<int>(bake.directions.size() / bake.weights.size())),
      weights_(bake.weights), spheres_{static_cast<int>(bake.radii.size()), bake.map.side,
                                       static_cast<float>(bake.size * bake.size), 0},
      way_of_(compute::Buffer(context, "ways", all_ways())),
      radii_(compute::Buffer(context, "radii", std::vector<float>(bake.radii.begin(), bake.radii.end()))),
      sets_(context, "turned sets", 1) {
  texels_ = compute::Buffer<std::uint8_t>::wrapping_host_memory(context, "caustic spheres", bake.texels);
  blocks_ = compute::Buffer<std::uint16_t>::wrapping_host_memory(context, "ways through spheres", bake.blocks);
  const compute::Defines defines{{"NEPHROID_CHANNELS", std::to_string(bake.channels)}};
  const compute::Program program(context, "environment/cast.cl", defines);
  cast_ = program.kernel("cast");
  compile_air_ = program.kernel("compile_air");
}

std::uint64_t Caustics::air_bytes(const Bake& bake, int side) {
  return 6 * sizeof(float) * SphereMap{side}.stored_texels() * bake.radii.size();
}

std::vector<compute::Argument> Caustics::arguments() const {
  return {{"texels", texels_}, {"blocks", blocks_},      {"way_of", way_of_},  {"radii", radii_},
          {"sets", sets_},     {"eights", used_eights_}, {"spheres", spheres_}};
}

void Caustics::set_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation) {
  seconds_ += tracing::seconds_of([&] {
    const std::vector<TurnedSet> sets = turned_sets(lights, rotation, directions_, weights_);
    const std::vector<shared::DeviceEightSets> eights = eights_of(sets, static_cast<std::size_t>(spheres_.count));
    if (eights.size() > sets_.size())
      sets_ = compute::Buffer<shared::DeviceEightSets>(context_, "turned sets", eights.size());
    if (!eights.empty()) sets_.write(eights);
    used_eights_ = static_cast<int>(eights.size());
    air_.object = {tracing::to_float4(rotation[0]), tracing::to_float4(rotation[1]), tracing::to_float4(rotation[2])};
  });
}

void Caustics::compile_air(int side) {
  air_.spheres = {spheres_.count, side, 1, 0};
  const std::size_t items = SphereMap{side}.stored_texels() * static_cast<std::size_t>(spheres_.count);
  if (air_.light.size() < 6 * items) air_.light = compute::Buffer<float>(context_, "light in the air", 6 * items);
  const auto count = static_cast<std::uint32_t>(items);
  compile_air_.run(count, group, arguments(),
                   {{"object", air_.object}, {"side", side}, {"count", count}, {"air", air_.light}});
  context_.finish();
}

void Caustics::cast(const CastTexels& texels) {
  seconds_ += tracing::seconds_of([&] {
    const shared::DeviceTexels slice{{}, texels.first, texels.count, texels.size, 0};
    cast_.run(texels.count, group, arguments(),
              {{"list", *texels.list},
               {"slice", slice},
               {"distances", *texels.distances},
               {"normals", *texels.normals},
               {"caustics", *texels.caustics}});
    context_.finish();
  });
}

} // namespace nephroid::environment
