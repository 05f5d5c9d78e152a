// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/baker.h"

#include "base/error.h"
#include "base/hashed_bytes.h"
#include "environment/colours.h"
#include "kernels/environment/render_types.h"
#include "tracing/omissions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace nephroid::environment {
namespace {

/// The quanta of a photon with the mean share of all power: 2^30 photons of 2^6 times as much fit.
constexpr double quanta_of_photon = 0x1p24;

} // namespace

bool is_coloured(const tracing::WavelengthTables& tables) { return tables.clusters_spread || tables.colours_light; }

Bake BakeTask::empty_bake() const {
  Bake bake;
  bake.map.side = resolution;
  bake.channels = coloured ? 3 : 1;
  bake.size = caster.size;
  bake.radii = radii;
  bake.directions = directions;
  return bake;
}

BakeTask make_task(const preset::Preset& preset) {
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
  task.defines = tracing::code_omissions(leave_out, scene, task.tables.wavelengths.takes_light).defines;
  task.defines["NEPHROID_CHANNELS"] = std::to_string(task.coloured ? 3 : 1);
  task.defines["NEPHROID_JITTER"] = std::to_string(int(task.coloured));
  task.defines["NEPHROID_DIFFERENTIALS"] = std::to_string(0);
  task.defines.merge(scene::tree_defines(task.bvh));
  return task;
}

Baker::Baker(const BakeTask& task, const mpi::RankContext& context, std::size_t wanted, Bake before)
    : task_(task), first_(before.baked.size()), wanted_(std::min(wanted, first_ + task.directions.size())),
      world_(tracing::make_world(context, task.caster.scene, task.bvh, task.tables, task.defines, task.seed)),
      light_rgb_(compute::Buffer(context, "white light", white_light())),
      radii_(compute::Buffer(context, "radii", std::vector<float>(task.radii.begin(), task.radii.end()))),
      bake_(std::move(before)) {
  // The light through the discs of all targets, as if none overlapped, is what photons of mean power carry.
  double discs = 0;
  for (const scene::Sphere& target : task.tables.spheres) discs += std::numbers::pi * target.radius * target.radius;
  watts_ = discs * std::pow(task.caster.scene.metres_per_unit, 2); // 1 W/m^2
  bake_.resize(bake_.directions.size());                           // takes all its memory now
  bake_.resize(first_);
  film_ = world_.zeroed("spheres of one direction", task.radii.size() * task.sums_a_sphere());
  energy_ = world_.zeroed("energy", OUTCOME_COUNT);
  kernel_ = compute::Program(context, "environment/bake.cl", world_.photon_defines()).kernel("bake");
}

std::size_t Baker::at_once() const {
  return std::min(static_cast<std::size_t>(world_.context.communicator().size()), wanted_ - bake_.baked.size());
}

void Baker::advance() {
  const Communicator& communicator = world_.context.communicator();
  const auto count = static_cast<std::uint32_t>(std::clamp<std::int64_t>(
      std::llround(photons_a_slice_.amount(communicator)), 1, std::int64_t{task_.photons} - sent_));
  const auto rank = static_cast<std::size_t>(communicator.rank()), number = done() + rank;
  // The unit of the tables' light is power_unit W/m^2.
  const auto scale = static_cast<float>(quanta_of_photon / watts_ * task_.tables.power_unit);
  photons_a_slice_.timed(count, [&] {
    if (rank >= at_once()) return;
    const shared::DeviceBakeLaunch launch{tracing::to_float4(task_.directions[number]),
                                          world_.seed,
                                          static_cast<std::uint32_t>(number),
                                          sent_,
                                          count,
                                          static_cast<int>(task_.radii.size()),
                                          task_.resolution,
                                          scale};
    world_.run_photons(
        kernel_, count,
        {{"light_rgb", light_rgb_}, {"radii", radii_}, {"film", film_}, {"energy", energy_}, {"launch", launch}});
  });
  sent_ += count;
  if (sent_ == task_.photons) finish_directions();
}

std::optional<double> Baker::seconds_left(std::size_t more) const {
  if (!seconds_a_direction_) return std::nullopt;
  return *seconds_a_direction_ * (static_cast<double>(task_.directions.size() - done() + more) - fraction_done());
}

void Baker::finish_sphere(std::size_t direction, std::size_t sphere, double scale) {
  const std::size_t channels = task_.sums_a_texel() - 3;
  std::vector<std::int64_t> sums(task_.sums_a_sphere());
  const std::size_t bytes = sums.size() * sizeof(std::int64_t);
  film_.RawBuffer::read(sums.data(), bytes, sphere * bytes);
  std::vector<TexelLight> light(bake_.map.texels());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const std::int64_t *const texel = &sums[i * task_.sums_a_texel()], *const way = texel + channels;
    for (int c = 0; c < 3; ++c) light[i].light[c] = scale * static_cast<double>(texel[channels == 3 ? c : 0]);
    light[i].way = {way[0], way[1], way[2]};
  }
  bake_.store(direction, sphere, light);
}

BakedDirection Baker::finish_direction(std::size_t direction) {
  const double size2 = std::pow(task_.caster.size * task_.caster.scene.metres_per_unit, 2);
  const double area_of_quantum = watts_ / (quanta_of_photon * task_.photons * size2); // in size^2
  const double scale = area_of_quantum / bake_.map.solid_angle();
  for (std::size_t sphere = 0; sphere < task_.radii.size(); ++sphere) finish_sphere(direction, sphere, scale);
  const std::vector<std::int64_t> energy = energy_.read();
  const auto area = [&](std::size_t outcome) { return area_of_quantum * static_cast<double>(energy[outcome]); };
  return {area(OUTCOME_EMITTED) - area(OUTCOME_MISSED), area(OUTCOME_ESCAPED), area(OUTCOME_ABSORBED),
          area(OUTCOME_LOST)};
}

void Baker::finish_directions() {
  const Communicator& communicator = world_.context.communicator();
  const std::size_t before = bake_.baked.size(), after = before + at_once(),
                    own = before + static_cast<std::size_t>(communicator.rank());
  bake_.resize(after);
  if (own < after) bake_.baked[own] = finish_direction(own);
  const auto join = [&](auto& items) { // all ranks get all directions
    const std::size_t each = items.size() / after;
    communicator.all_reduce_or(std::as_writable_bytes(std::span(items).subspan(before * each)));
  };
  join(bake_.texels);
  join(bake_.blocks);
  join(bake_.baked);
  clear();
  const auto now = std::chrono::steady_clock::now();
  seconds_a_direction_ =
      std::chrono::duration<double>(now - std::exchange(began_, now)).count() / static_cast<double>(after - before);
}

/// Begins the directions in hand anew.
void Baker::clear() {
  film_.fill_zero();
  energy_.fill_zero();
  sent_ = 0;
}

void Baker::serialize(tracing::Archive& archive) {
  // The directions in hand are baked again, so that any number of ranks may go on.
  const bool is_alone = world_.context.communicator().is_alone();
  std::uint64_t baked = done();
  std::uint32_t sent = is_alone ? sent_ : 0;
  archive.value(sent);
  archive.value(baked);
  if (archive.is_read() && (baked > task_.directions.size() || sent >= task_.photons))
    throw bad_input("checkpoint", "is of another run");
  bake_.resize(first_ + baked);
  const auto own = [&](auto& items) {
    return std::span(items).subspan(baked > 0 ? items.size() / bake_.baked.size() * first_ : items.size());
  };
  archive.items(own(bake_.baked));
  archive.items(own(bake_.texels));
  archive.items(own(bake_.blocks));
  if (sent > 0) {
    archive.buffer(film_);
    archive.buffer(energy_);
  }
  if (!archive.is_read()) return;
  if (sent == 0 || !is_alone) clear();
  sent_ = is_alone ? sent : 0;
}

Baking::Baking(std::shared_ptr<const BakeTask> task, std::vector<PlannedBake> bakes, std::size_t directions,
               const mpi::RankContext& context)
    : task_(std::move(task)), context_(context), bakes_(std::move(bakes)),
      kernels_(hash_of(compute::kernel_source(context, "environment/bake.cl"))), wanted_(directions),
      bake_(task_->empty_bake()) {
  bake_.weights.clear();
  bake_.directions.clear();
  for (const PlannedBake& bake : bakes_) {
    bake_.weights.push_back(bake.weight);
    bake_.directions.insert(bake_.directions.end(), bake.task->directions.begin(), bake.task->directions.end());
  }
  if (bakes_.size() > 1) bake_.resize(bake_.directions.size()); // takes all its memory now
  bake_.resize(0);
  go_on();
}

/// Goes past bakes that are in their files, to the first one that has to be made.
void Baking::go_on() {
  while (!is_complete() && read()) ++shape_;
  if (!is_complete()) baker_.emplace(*bakes_[shape_].task, context_, wanted_, std::move(bake_));
}

void Baking::advance() {
  baker_->advance();
  if (!baker_->finished()) return;
  photons_ += baker_->photons();
  bake_ = baker_->take();
  baker_.reset(); // frees its device memory for others
  keep();
  ++shape_;
  go_on();
}

void Baking::set_shape(std::shared_ptr<const BakeTask> task, std::vector<double> weights) {
  Bake& bake = baker_ ? baker_->bake() : bake_;
  bake.size = task->caster.size;
  bake.radii = task->radii;
  bake.weights = std::move(weights);
  task_ = std::move(task);
}

void Baking::begin_anew(std::size_t shape) {
  if (baker_) bake_ = baker_->take();
  baker_.reset();
  bake_.resize(shape * task_->directions.size());
  shape_ = shape;
  baker_.emplace(*bakes_[shape_].task, context_, wanted_, std::move(bake_));
}

double Baking::fraction_done() const {
  return is_complete() ? 1.0
                       : (static_cast<double>(directions()) + baker_->fraction_done()) /
                             static_cast<double>(bake().directions.size());
}

std::optional<double> Baking::seconds_left() const {
  std::size_t more = 0;
  for (std::size_t i = shape_ + 1; i < bakes_.size(); ++i) more += bakes_[i].reads ? 0 : task_->directions.size();
  return baker_->seconds_left(more);
}

/// Adds the bake in hand from its file; false where that has none. All ranks get rank 0's.
bool Baking::read() {
  const Communicator& communicator = context_.communicator();
  const PlannedBake& planned = bakes_[shape_];
  if (!communicator.broadcast(planned.reads)) return false;
  Bake bake = planned.task->empty_bake();
  try {
    if (communicator.is_root()) bake = read_bake(planned.file, identity());
  } catch (const Error& error) {
    warnings_.push_back(error.line() + "; it is baked again");
  }
  if (!communicator.broadcast(!bake.baked.empty())) return false;
  if (!communicator.is_alone()) {
    bake.baked = communicator.broadcast(std::move(bake.baked));
    bake.texels = communicator.broadcast(std::move(bake.texels));
    bake.blocks = communicator.broadcast(std::move(bake.blocks));
  }
  if (bakes_.size() == 1)
    bake_ = std::move(bake);
  else
    bake_.append(bake);
  return true;
}

/// Writes the bake in hand, which is complete.
void Baking::keep() {
  if (!context_.communicator().is_root()) return;
  std::optional<Bake> part; // one bake alone needs no copy
  if (bakes_.size() > 1) {
    part = bakes_[shape_].task->empty_bake();
    part->append(bake_, shape_ * task_->directions.size());
  }
  try {
    write_bake(bakes_[shape_].file, identity(), part ? *part : bake_);
  } catch (const Error& error) {
    warnings_.push_back(error.line() + "; the bake is not kept, and the next start bakes again");
  }
}

} // namespace nephroid::environment
