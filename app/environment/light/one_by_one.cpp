// SPDX-License-Identifier: Apache-2.0
#include "environment/light/one_by_one.h"

#include "environment/light/caustics.h"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace nephroid::environment {
namespace {

constexpr std::size_t items_per_group = 32;

bool compiles(Technique t) { return t == Technique::compiled || t == Technique::compiled_launches || t == Technique::compiled_buffers; }
bool has_buffers(Technique t) { return t == Technique::direct_buffers || t == Technique::compiled_buffers; }
bool has_launches(Technique t) { return t != Technique::direct && t != Technique::compiled; }

} // namespace

OneByOne::OneByOne(Technique technique, const std::vector<std::uint16_t>& stored, std::size_t directions, std::size_t channels,
                   const compute::Context& context)
    : technique_(technique), context_(context)
{
  const std::size_t items = stored.size() / directions;
  if (has_buffers(technique))
    for (std::size_t i = 0; i < directions; ++i) {
      of_direction_.emplace_back(context, "caustic spheres of one direction", items);
      of_direction_.back().write(std::span(stored).subspan(i * items, items));
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
      shared.emplace_back(names[i], of_direction_[direction]);
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
