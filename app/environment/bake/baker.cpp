// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/baker.h"

#include "base/parallel.h"
#include "environment/colours.h"
#include "tracing/omissions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace nephroid::environment {
namespace {

/// Quanta that a photon with an equal share of all power has: far more than rounding takes, and 2^30 photons of 2^6 times as much fit.
constexpr double quanta_of_photon = 0x1p24;

} // namespace

bool is_coloured(const tracing::WavelengthTables& tables)
{
  if (tables.clusters_spread) return true;
  for (std::size_t i = 0; i < tables.coefficient.size(); ++i)
    if (tables.coefficient[i] != tables.coefficient[i - i % WAVELENGTH_COUNT]) return true;
  return false;
}

Bake BakeTask::empty_bake() const
{
  Bake bake;
  bake.map.side = resolution;
  bake.channels = coloured ? 3 : 1;
  bake.size = caster.size;
  bake.radii = radii;
  bake.directions = directions;
  return bake;
}

BakeTask make_task(const preset::Preset& preset)
{
  const Settings& s = settings(preset);
  BakeTask task;
  task.caster = make_caster(preset);
  task.radii = sphere_radii(s, task.caster, preset.source);
  task.directions = light_directions(s.directions);
  task.resolution = s.resolution;
  task.photons = static_cast<std::uint32_t>(s.photons);
  task.seed = preset.seed;
  const scene::Scene& scene = task.caster.scene;
  task.bvh = scene::build_bvh(scene.geometry);
  const tracing::LeaveOut leave_out{.all = preset.leave_out};
  task.tables = tracing::make_scene_tables(scene, {optics::all_wavelengths()}, leave_out);
  task.coloured = is_coloured(task.tables.wavelengths);
  task.defines = tracing::code_omissions(leave_out, scene, task.tables.wavelengths.attenuator_count).defines;
  task.defines["NEPHROID_CHANNELS"] = std::to_string(task.coloured ? 3 : 1);
  task.defines["NEPHROID_JITTER"] = std::to_string(int(task.coloured));
  task.defines["NEPHROID_DIFFERENTIALS"] = std::to_string(0);
  task.defines.merge(scene::tree_defines(task.bvh));
  return task;
}

Baker::Baker(const BakeTask& task, const compute::Context& context)
    : task_(task), world_(tracing::make_world(context, task.caster.scene, task.bvh, task.tables, task.defines, task.seed)),
      light_rgb_(compute::Buffer(context, "white light", white_light())),
      radii_(compute::Buffer(context, "radii", std::vector<float>(task.radii.begin(), task.radii.end()))), bake_(task.empty_bake())
{
  // As kernels/tracing/emission.h has it: photons are spread over the discs of all targets, which may overlap.
  double discs = 0;
  for (const scene::Sphere& target : task.tables.spheres) discs += std::numbers::pi * target.radius * target.radius;
  watts_ = discs * std::pow(task.caster.scene.metres_per_unit, 2); // 1 W/m^2
  bake_.halves.reserve(bake_.direction_items() * task.directions.size());
  bake_.ways.reserve(bake_.direction_texels() * task.directions.size());
  film_ = world_.zeroed("spheres of one direction", bake_.direction_items());
  ways_ = world_.zeroed("ways of one direction", 3 * bake_.direction_texels());
  energy_ = world_.zeroed("energy", OUTCOME_COUNT);
  kernel_ = compute::Program(context, "environment/bake.cl", world_.photon_defines()).kernel("bake");
}

void Baker::step()
{
  const auto count =
      static_cast<std::uint32_t>(std::clamp<std::int64_t>(std::llround(photons_a_step_.amount()), 1, std::int64_t{task_.photons} - sent_));
  const auto number = static_cast<std::uint32_t>(bake_.baked.size());
  // The light of the tables has power_unit W/m^2 as its unit.
  const auto scale = static_cast<float>(quanta_of_photon / watts_ * task_.tables.power_unit);
  photons_a_step_.timed(count, [&] {
    world_.run_photons(kernel_, count,
                       {{"targets", world_.buffers.targets},
                        {"light_rgb", light_rgb_},
                        {"radii", radii_},
                        {"film", film_},
                        {"ways", ways_},
                        {"energy", energy_},
                        {"sphere_count", static_cast<int>(task_.radii.size())},
                        {"side", task_.resolution},
                        {"direction", tracing::to_float4(task_.directions[number])},
                        {"number", number},
                        {"seed", world_.seed},
                        {"first", sent_},
                        {"count", count},
                        {"scale", scale}});
  });
  sent_ += count;
  if (sent_ == task_.photons) finish_direction();
}

void Baker::finish_sphere(std::size_t sphere, double scale)
{
  const std::size_t number = bake_.baked.size() * task_.radii.size() + sphere, items = bake_.sphere_items(), texels = bake_.map.texels();
  std::vector<std::int64_t> sums(items), ways(3 * texels);
  film_.RawBuffer::read(sums.data(), items * sizeof(std::int64_t), sphere * items * sizeof(std::int64_t));
  ways_.RawBuffer::read(ways.data(), 3 * texels * sizeof(std::int64_t), 3 * sphere * texels * sizeof(std::int64_t));
  std::uint16_t* const halves = bake_.halves.data() + number * items;
  for_ranges(items, 1 << 14, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) halves[i] = to_half(scale * static_cast<double>(sums[i]));
  });
  std::uint16_t* const to = bake_.ways.data() + number * texels;
  for_ranges(texels, 1 << 14, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const glm::dvec3 way(ways[3 * i], ways[3 * i + 1], ways[3 * i + 2]);
      to[i] = static_cast<std::uint16_t>(Bake::way_map.texel(way == glm::dvec3(0) ? bake_.map.direction(i) : way));
    }
  });
}

void Baker::finish_direction()
{
  const double size2 = std::pow(task_.caster.size * task_.caster.scene.metres_per_unit, 2);
  const double area_of_quantum = watts_ / (quanta_of_photon * task_.photons * size2); // in size^2
  const double scale = area_of_quantum / (bake_.map.solid_angle() * Bake::unit);
  bake_.halves.resize(bake_.halves.size() + bake_.direction_items());
  bake_.ways.resize(bake_.ways.size() + bake_.direction_texels());
  for (std::size_t sphere = 0; sphere < task_.radii.size(); ++sphere) finish_sphere(sphere, scale);
  const std::vector<std::int64_t> energy = energy_.read();
  const auto area = [&](std::size_t outcome) { return area_of_quantum * static_cast<double>(energy[outcome]); };
  bake_.baked.push_back({area(OUTCOME_EMITTED) - area(OUTCOME_MISSED), area(OUTCOME_ESCAPED), area(OUTCOME_ABSORBED), area(OUTCOME_LOST)});
  film_.fill_zero();
  ways_.fill_zero();
  energy_.fill_zero();
  sent_ = 0;
}

void Baker::state(tracing::State& state)
{
  std::uint64_t baked = bake_.baked.size();
  state.value(sent_);
  state.value(baked);
  if (state.is_read() && (baked > task_.directions.size() || sent_ >= task_.photons)) throw bad_input("checkpoint", "is of another run");
  bake_.baked.resize(baked);
  bake_.halves.resize(baked * bake_.direction_items());
  bake_.ways.resize(baked * bake_.direction_texels());
  state.items(std::span(bake_.baked));
  state.items(std::span(bake_.halves));
  state.items(std::span(bake_.ways));
  state.buffer(film_);
  state.buffer(ways_);
  state.buffer(energy_);
}

} // namespace nephroid::environment
