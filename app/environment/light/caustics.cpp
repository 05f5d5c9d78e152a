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

/// Texels of a map in its stored form.
std::size_t stored_texels(int side) { return static_cast<std::size_t>(side + 2) * static_cast<std::size_t>(side + 2); }

/// Numbers of one direction in their stored form.
std::size_t stored_items(const Bake& bake)
{
  return stored_texels(bake.map.side) * static_cast<std::size_t>(bake.channels) * bake.radii.size();
}

/// texel_of_stored of kernels/environment/spheres.h, for all.
std::vector<std::size_t> texels_of_stored(int side)
{
  std::vector<std::size_t> texels;
  const int last = side - 1;
  for (int row = -1; row <= side; ++row)
    for (int column = -1; column <= side; ++column) {
      const bool across = column < 0 || column > last, down = row < 0 || row > last;
      const int x = std::clamp(column, 0, last), y = std::clamp(row, 0, last);
      texels.push_back(static_cast<std::size_t>(across ? last - y : y) * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(down ? last - x : x));
    }
  return texels;
}

/// Half floats as the upper halves of floats, by half float.
std::vector<std::uint16_t> upper_halves()
{
  std::vector<std::uint16_t> of(std::size_t{1} << 16);
  for (std::size_t half = 0; half < of.size(); ++half) {
    const auto bits = std::bit_cast<std::uint32_t>(glm::unpackHalf1x16(static_cast<std::uint16_t>(half)));
    of[half] = static_cast<std::uint16_t>((bits + 0x7fff + (bits >> 16 & 1)) >> 16); // to the nearest, ties to even
  }
  return of;
}

/// Of all that is baked, as kernels read it: [direction][sphere][texel of the stored form][channel].
std::vector<std::uint16_t> stored_form(const Bake& bake)
{
  const std::vector<std::size_t> texels = texels_of_stored(bake.map.side);
  const std::vector<std::uint16_t> upper = upper_halves();
  const auto channels = static_cast<std::size_t>(bake.channels);
  const std::size_t maps = bake.halves.size() / bake.sphere_items(), map_items = texels.size() * channels;
  std::vector<std::uint16_t> stored(maps * map_items);
  for_blocks(maps, [&](std::size_t map) {
    const std::uint16_t* from = bake.halves.data() + map * bake.sphere_items();
    std::uint16_t* to = stored.data() + map * map_items;
    for (const std::size_t texel : texels)
      for (std::size_t c = 0; c < channels; ++c) *to++ = upper[from[texel * channels + c]];
  });
  return stored;
}

/// Eight after eight. items: numbers of a direction.
std::vector<shared::DeviceEightSets> in_eights(const std::vector<TurnedSet>& sets, std::size_t items)
{
  std::vector<shared::DeviceEightSets> eights((sets.size() + 7) / 8);
  for (std::size_t i = 0; i < 8 * eights.size(); ++i) {
    const bool missing = i >= sets.size();
    const TurnedSet& set = missing ? sets.back() : sets[i];
    shared::DeviceEightSets& eight = eights[i / 8];
    const std::size_t lane = i % 8;
    for (int k = 0; k < 9; ++k) eight.to_bake[k][lane] = static_cast<float>(set.to_bake[k % 3][k / 3]); // glm has columns
    for (int c = 0; c < 3; ++c) eight.flux[c][lane] = missing ? 0.0F : static_cast<float>(set.flux[c]);
    eight.first[lane] = static_cast<std::size_t>(set.direction) * items;
  }
  return eights;
}

} // namespace

Caustics::Caustics(const Bake& bake, const compute::Context& context, int own)
    : context_(context), directions_(static_cast<int>(bake.directions.size())),
      direction_items_(stored_items(bake)), spheres_{static_cast<int>(bake.radii.size()), bake.map.side,
                                                     static_cast<float>(Bake::unit * bake.size * bake.size), 0},
      stored_(context, "caustic spheres", stored_items(bake) * (bake.directions.size() + static_cast<std::size_t>(own))),
      radii_(tracing::upload_vector(context, "radii", std::vector<float>(bake.radii.begin(), bake.radii.end()))),
      sets_(context, "turned sets", 1)
{
  stored_.write(stored_form(bake));
  const compute::Defines defines{{"NEPHROID_CHANNELS", std::to_string(bake.channels)}};
  const compute::Program program(context, "environment/cast.cl", defines);
  direct_ = program.kernel("cast_direct");
  compile_ = program.kernel("compile");
  compiled_cast_ = program.kernel("cast_compiled");
}

void Caustics::set_own(const Bake& own)
{
  own_ = own.directions;
  stored_.write(stored_form(own), static_cast<std::size_t>(directions_) * stored_items(own));
}

void Caustics::set_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation)
{
  upload(turned_sets(lights, rotation, directions_, own_), rotation);
}

void Caustics::draw_lights(const std::vector<DistantLight>& lights, const glm::dmat3& rotation, std::uint32_t pass)
{
  upload(drawn_sets(lights, rotation, directions_, pass, own_), rotation);
}

void Caustics::upload(const std::vector<TurnedSet>& sets, const glm::dmat3& rotation)
{
  const std::vector<shared::DeviceEightSets> eights = in_eights(sets, direction_items_);
  if (eights.size() > sets_.size()) sets_ = compute::Buffer<shared::DeviceEightSets>(context_, "turned sets", eights.size());
  if (!eights.empty()) sets_.write(eights);
  used_eights_ = static_cast<int>(eights.size());
  compiled_.object_x = to_float4(rotation[0]);
  compiled_.object_y = to_float4(rotation[1]);
  compiled_.object_z = to_float4(rotation[2]);
}

void Caustics::compile(int side)
{
  compiled_.spheres = {spheres_.count, side, 1, 0};
  const std::size_t items = stored_texels(side) * static_cast<std::size_t>(spheres_.count);
  if (compiled_.texels.size() < 3 * items) compiled_.texels = compute::Buffer<float>(context_, "compiled spheres", 3 * items);
  const std::uint32_t first = 0;
  const auto count = static_cast<std::uint32_t>(items);
  compile_.run(count, group,
               {{"stored", stored_},
                {"sets", sets_},
                {"eights", used_eights_},
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
               {"radii", radii_},
               {"sets", sets_},
               {"eights", used_eights_},
               {"spheres", spheres_},
               {"list", *texels.list},
               {"first", first},
               {"count", count},
               {"size", texels.size},
               {"distances", *texels.distances},
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
                      {"caustics", *texels.caustics}});
  context_.finish();
}

} // namespace nephroid::environment
