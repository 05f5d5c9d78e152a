// SPDX-License-Identifier: Apache-2.0
#include "environment/light/caustics.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace nephroid::environment {
namespace {

constexpr std::size_t group = 32;

/// [number]: the unit way of Bake::ways.
std::vector<shared::float4> all_ways()
{
  std::vector<shared::float4> ways;
  for (std::size_t i = 0; i < Bake::way_map.texels(); ++i) ways.push_back(tracing::to_float4(Bake::way_map.direction(i)));
  return ways;
}

/// Eight after eight. direction_texels: of all that are stored of one direction.
std::vector<shared::DeviceEightSets> eights_of(const std::vector<TurnedSet>& sets, std::size_t direction_texels)
{
  std::vector<shared::DeviceEightSets> eights;
  for (std::size_t i = 0; i < (sets.size() + 7) / 8 * 8; ++i) {
    const bool missing = i >= sets.size();
    const TurnedSet& set = missing ? sets.back() : sets[i];
    const std::size_t lane = i % 8;
    if (lane == 0) eights.emplace_back();
    shared::DeviceEightSets& eight = eights.back();
    for (int k = 0; k < 9; ++k) eight.to_bake[k][lane] = static_cast<float>(set.to_bake[k % 3][k / 3]); // glm has columns
    for (int c = 0; c < 3; ++c) eight.flux[c][lane] = missing ? 0.0F : static_cast<float>(set.flux[c]);
    eight.first[lane] = static_cast<std::size_t>(set.direction) * direction_texels;
  }
  return eights;
}

constexpr std::size_t items_per_group = 32;

bool compiles(Technique t) { return t == Technique::compiled || t == Technique::compiled_launches || t == Technique::compiled_buffers; }
bool has_buffers(Technique t) { return t == Technique::direct_buffers || t == Technique::compiled_buffers; }
bool has_launches(Technique t) { return t != Technique::direct && t != Technique::compiled; }

} // namespace

Caustics::Caustics(const Bake& bake, const compute::Context& context, Technique technique)
    : context_(context), directions_(static_cast<int>(bake.directions.size())), spheres_{static_cast<int>(bake.radii.size()), bake.map.side,
                                                                                         static_cast<float>(bake.size * bake.size), 0},
      way_of_(compute::Buffer(context, "ways", all_ways())),
      radii_(compute::Buffer(context, "radii", std::vector<float>(bake.radii.begin(), bake.radii.end()))), sets_(context, "turned sets", 1)
{
  const auto channels = static_cast<std::size_t>(bake.channels);
  stored_ = compute::Buffer<std::uint16_t>::wrapping_host_memory(context, "caustic spheres", bake.light);
  ways_ = compute::Buffer<std::uint16_t>::wrapping_host_memory(context, "ways through spheres", bake.ways);
  if (technique != Technique::eight_sets) one_by_one_.emplace(technique, bake.light, bake.directions.size(), channels, context);
  const compute::Defines defines{{"NEPHROID_CHANNELS", std::to_string(bake.channels)}};
  const compute::Program program(context, "environment/cast.cl", defines);
  cast_ = program.kernel("cast");
  compile_air_ = program.kernel("compile_air");
}

std::uint64_t Caustics::bytes(const Bake& bake, Technique technique)
{
  const std::size_t texels = bake.direction_texels(), directions = bake.directions.size(),
                    channels = static_cast<std::size_t>(bake.channels);
  return sizeof(std::uint16_t) * directions * texels * (channels + 1) + OneByOne::bytes(technique, texels, directions, channels);
}

std::uint64_t Caustics::air_bytes(const Bake& bake, int side)
{
  return 6 * sizeof(float) * SphereMap{side}.stored_texels() * bake.radii.size();
}

template <class Work>
void Caustics::timed(const Work& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void Caustics::set_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation)
{
  timed([&] {
    const std::vector<TurnedSet> sets = turned_sets(lights, rotation, directions_);
    const std::vector<shared::DeviceEightSets> eights =
        eights_of(sets, SphereMap{spheres_.side}.stored_texels() * static_cast<std::size_t>(spheres_.count));
    if (eights.size() > sets_.size()) sets_ = compute::Buffer<shared::DeviceEightSets>(context_, "turned sets", eights.size());
    if (!eights.empty()) sets_.write(eights);
    used_eights_ = static_cast<int>(eights.size());
    air_.object_x = tracing::to_float4(rotation[0]);
    air_.object_y = tracing::to_float4(rotation[1]);
    air_.object_z = tracing::to_float4(rotation[2]);
    if (one_by_one_) one_by_one_->set_lights(turned(), sets);
  });
}

TurnedSpheres Caustics::turned() const { return {stored_, radii_, sets_, spheres_, air_.object_x, air_.object_y, air_.object_z}; }

void Caustics::compile_air(int side)
{
  air_.spheres = {spheres_.count, side, 1, 0};
  const std::size_t items = SphereMap{side}.stored_texels() * static_cast<std::size_t>(spheres_.count);
  if (air_.light.size() < 6 * items) air_.light = compute::Buffer<float>(context_, "light in the air", 6 * items);
  const auto count = static_cast<std::uint32_t>(items);
  compile_air_.run(count, group,
                   {{"stored", stored_},
                    {"ways", ways_},
                    {"way_of", way_of_},
                    {"radii", radii_},
                    {"sets", sets_},
                    {"eights", used_eights_},
                    {"spheres", spheres_},
                    {"object_x", air_.object_x},
                    {"object_y", air_.object_y},
                    {"object_z", air_.object_z},
                    {"side", side},
                    {"count", count},
                    {"air", air_.light}});
  context_.finish();
}

void Caustics::cast(const CastTexels& texels)
{
  timed([&] {
    if (one_by_one_) return one_by_one_->cast(turned(), texels);
    cast_.run(texels.count, group, texels.arguments(),
              {{"stored", stored_},
               {"ways", ways_},
               {"way_of", way_of_},
               {"radii", radii_},
               {"sets", sets_},
               {"eights", used_eights_},
               {"spheres", spheres_}});
    context_.finish();
  });
}

OneByOne::OneByOne(Technique technique, const std::vector<std::uint16_t>& stored, std::size_t directions, std::size_t channels,
                   const compute::Context& context)
    : technique_(technique), context_(context)
{
  const std::size_t items = stored.size() / directions;
  if (has_buffers(technique))
    for (std::size_t i = 0; i < directions; ++i) {
      direction_spheres_.emplace_back(context, "caustic spheres of one direction", items);
      direction_spheres_.back().write(std::span(stored).subspan(i * items, items));
    }
  if (compiles(technique)) compiled_ = compute::Buffer<float>(context, "compiled spheres", 3 * items / channels);
  const compute::Defines defines{{"NEPHROID_CHANNELS", std::to_string(channels)},
                                 {"NEPHROID_DIRECTION_BUFFERS", has_buffers(technique) ? "1" : "0"}};
  const compute::Program program(context, "environment/one_by_one.cl", defines);
  cast_ = program.kernel("cast");
  compile_ = program.kernel("compile");
  cast_compiled_ = program.kernel("cast_compiled");
}

std::uint64_t OneByOne::bytes(Technique technique, std::size_t texels, std::size_t directions, std::size_t channels)
{
  return (has_buffers(technique) ? sizeof(std::uint16_t) * texels * directions * channels : 0) +
         (compiles(technique) ? 3 * sizeof(float) * texels : 0);
}

void OneByOne::set_lights(const TurnedSpheres& turned, const std::vector<TurnedSet>& sets)
{
  launches_.clear();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const bool begins = i == 0 || (has_launches(technique_) && sets[i].light != sets[i - 1].light);
    if (begins) launches_.push_back({static_cast<int>(i), {}});
    launches_.back().directions.push_back(sets[i].direction);
  }
  if (launches_.empty()) launches_.emplace_back(); // which writes zeros
  if (!compiles(technique_)) return;
  const auto count = static_cast<std::uint32_t>(compiled_.size() / 3);
  run(compile_, count, turned,
      {{"object_x", turned.object_x},
       {"object_y", turned.object_y},
       {"object_z", turned.object_z},
       {"count", count},
       {"compiled", compiled_}});
}

void OneByOne::cast(const TurnedSpheres& turned, const CastTexels& texels)
{
  if (!compiles(technique_)) return run(cast_, texels.count, turned, texels.arguments());
  cast_compiled_.run(texels.count, items_per_group, texels.arguments(),
                     {{"compiled", compiled_},
                      {"radii", turned.radii},
                      {"spheres", turned.spheres},
                      {"object_x", turned.object_x},
                      {"object_y", turned.object_y},
                      {"object_z", turned.object_z}});
  context_.finish();
}

void OneByOne::run(compute::Kernel& kernel, std::uint32_t items, const TurnedSpheres& turned, const std::vector<compute::Argument>& own)
{
  for (const Launch& launch : launches_) {
    const auto set_count = static_cast<int>(launch.directions.size());
    const int anew = &launch == &launches_.front() ? 1 : 0;
    std::vector<compute::Argument> shared = own;
    if (!has_buffers(technique_)) shared.emplace_back("stored", turned.stored);
    static constexpr std::array<std::string_view, 4> names{"stored_0", "stored_1", "stored_2", "stored_3"};
    for (std::size_t i = 0; has_buffers(technique_) && i < names.size(); ++i) {
      const std::size_t direction = i < launch.directions.size() ? static_cast<std::size_t>(launch.directions[i]) : 0;
      shared.emplace_back(names[i], direction_spheres_[direction]);
    }
    kernel.run(items, items_per_group, shared,
               {{"sets", turned.sets},
                {"first_set", launch.first_set},
                {"set_count", set_count},
                {"radii", turned.radii},
                {"spheres", turned.spheres},
                {"anew", anew}});
  }
  context_.finish();
}

} // namespace nephroid::environment
