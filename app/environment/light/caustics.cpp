// SPDX-License-Identifier: Apache-2.0
#include "environment/light/caustics.h"

#include "base/parallel.h"
#include "tracing/scene_buffers.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace nephroid::environment {
namespace {

constexpr std::size_t group = 32;

shared::float4 to_float4(const glm::dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0}; }

/// [number]: the unit way of Bake::ways.
std::vector<shared::float4> all_ways()
{
  std::vector<shared::float4> ways;
  for (std::size_t i = 0; i < Bake::way_map.texels(); ++i) ways.push_back(to_float4(Bake::way_map.direction(i)));
  return ways;
}

/// Half floats as the upper halves of floats.
std::vector<std::uint16_t> upper_halves(const std::vector<std::uint16_t>& halves)
{
  std::vector<std::uint16_t> of(std::size_t{1} << 16);
  for (std::size_t half = 0; half < of.size(); ++half) {
    const auto bits = std::bit_cast<std::uint32_t>(glm::unpackHalf1x16(static_cast<std::uint16_t>(half)));
    of[half] = static_cast<std::uint16_t>((bits + 0x7fff + (bits >> 16 & 1)) >> 16); // to the nearest, ties to even
  }
  std::vector<std::uint16_t> upper(halves.size());
  for_ranges(halves.size(), 1 << 20, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) upper[i] = of[halves[i]];
  });
  return upper;
}

} // namespace

Caustics::Caustics(const Bake& bake, const compute::Context& context, int own, const std::vector<double>& own_radii)
    : context_(context),
      directions_(static_cast<int>(bake.directions.size())), spheres_{static_cast<int>(bake.radii.size()), bake.map.side,
                                                                      static_cast<float>(Bake::unit * bake.size * bake.size),
                                                                      static_cast<int>(own_radii.size())},
      stored_(context, "caustic spheres", bake.sphere_items() * maps(own)),
      ways_(context, "ways through spheres", bake.map.texels() * maps(own)), way_of_(tracing::upload_vector(context, "ways", all_ways())),
      radii_(context, "radii", bake.radii.size() + own_radii.size()), sets_(context, "turned sets", 1)
{
  stored_.write(upper_halves(bake.halves));
  ways_.write(bake.ways);
  radii_.write(std::vector<float>(bake.radii.begin(), bake.radii.end()));
  radii_.write(std::vector<float>(own_radii.begin(), own_radii.end()), bake.radii.size());
  const compute::Defines defines{{"NEPHROID_CHANNELS", std::to_string(bake.channels)}};
  const compute::Program program(context, "environment/cast.cl", defines);
  direct_ = program.kernel("cast_direct");
  compile_ = program.kernel("compile");
  compiled_cast_ = program.kernel("cast_compiled");
}

void Caustics::set_own(const Bake& own)
{
  own_ = own.directions;
  stored_.write(upper_halves(own.halves), maps(0) * own.sphere_items());
  ways_.write(own.ways, maps(0) * own.map.texels());
}

void Caustics::set_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation)
{
  upload(turned_sets(lights, rotation, directions_, own_), rotation);
}

void Caustics::draw_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation, std::uint32_t pass)
{
  upload(drawn_sets(lights, rotation, directions_, pass, own_), rotation);
}

std::size_t Caustics::maps(int own) const
{
  return static_cast<std::size_t>(directions_) * static_cast<std::size_t>(spheres_.count) +
         static_cast<std::size_t>(own) * static_cast<std::size_t>(spheres_.own_count);
}

void Caustics::upload(std::vector<shared::DeviceTurnedSet> sets, const glm::dmat3& rotation)
{
  for (shared::DeviceTurnedSet& set : sets) {
    const int own = set.direction - directions_;
    set.own = own >= 0 ? 1 : 0;
    set.first_map = own >= 0 ? static_cast<int>(maps(own)) : set.direction * spheres_.count;
  }
  if (sets.size() > sets_.size()) sets_ = compute::Buffer<shared::DeviceTurnedSet>(context_, "turned sets", sets.size());
  if (!sets.empty()) sets_.write(sets);
  used_sets_ = static_cast<int>(sets.size());
  compiled_.object_x = to_float4(rotation[0]);
  compiled_.object_y = to_float4(rotation[1]);
  compiled_.object_z = to_float4(rotation[2]);
}

void Caustics::compile(int side)
{
  compiled_.spheres = {spheres_.count, side, 1, 0};
  const std::size_t items = static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * static_cast<std::size_t>(spheres_.count);
  if (compiled_.texels.size() < 3 * items) compiled_.texels = compute::Buffer<float>(context_, "compiled spheres", 3 * items);
  const std::uint32_t first = 0;
  const auto count = static_cast<std::uint32_t>(items);
  compile_.run(count, group,
               {{"stored", stored_},
                {"radii", radii_},
                {"sets", sets_},
                {"set_count", used_sets_},
                {"spheres", spheres_},
                {"object_x", compiled_.object_x},
                {"object_y", compiled_.object_y},
                {"object_z", compiled_.object_z},
                {"side", side},
                {"first", first},
                {"count", count},
                {"compiled", compiled_.texels}});
  context_.finish();
}

void Caustics::cast_direct(const CastTexels& texels, std::uint32_t first, std::uint32_t count)
{
  direct_.run(count, group,
              {{"stored", stored_},
               {"ways", ways_},
               {"way_of", way_of_},
               {"radii", radii_},
               {"sets", sets_},
               {"set_count", used_sets_},
               {"spheres", spheres_},
               {"list", *texels.list},
               {"first", first},
               {"count", count},
               {"size", texels.size},
               {"distances", *texels.distances},
               {"normals", *texels.normals},
               {"caustics", *texels.caustics}});
  context_.finish();
}

void Caustics::cast_compiled(const CastTexels& texels, std::uint32_t first, std::uint32_t count)
{
  compiled_cast_.run(count, group,
                     {{"compiled", compiled_.texels},
                      {"radii", radii_},
                      {"spheres", compiled_.spheres},
                      {"object_x", compiled_.object_x},
                      {"object_y", compiled_.object_y},
                      {"object_z", compiled_.object_z},
                      {"list", *texels.list},
                      {"first", first},
                      {"count", count},
                      {"size", texels.size},
                      {"distances", *texels.distances},
                      {"normals", *texels.normals},
                      {"caustics", *texels.caustics}});
  context_.finish();
}

} // namespace nephroid::environment
