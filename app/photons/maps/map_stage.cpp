// SPDX-License-Identifier: Apache-2.0
// Caustics seen through glass or in a mirror: paths from the eye gather the photons that the photon stage has stored
// beside its splats. The radius shrinks from pass to pass and is the same for all pixels (Knaus and Zwicker 2011). So
// each pass is an independent estimate, and the film adds passes up like any other film.
#include "base/counted.h"
#include "photons/maps/eye_paths.h"
#include "photons/maps/photon_map.h"
#include "photons/stage.h"
#include "tracing/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::photons {
namespace {

class MapStage final : public Stage {
public:
  MapStage(StageContext& world, const scene::Scene& scene, const Settings& settings)
      : world_(world), map_(world.map.value()), first_radius_(first_map_radius(settings, scene)),
        alpha_(settings.sppm.alpha), paths_(world.tables.eye_paths), eye_(world, EyePaths::Pixels::glass),
        film_(world.zeroed("film photon maps", world.film_size())), preview_film_(world.preview_film()),
        gather_(compute::Program(world.context, "photons/gather.cl", world.defines).kernel("gather_to_film")) {}

  const char* name() const override { return "photon maps"; }
  double fraction_done() const override { return eye_.fraction_done(); }
  void share_work(const Noise& noise) override {
    double sum = 0;
    for (const std::uint32_t pixel : world_.pixels.glass)
      for (std::size_t c = 0; c < 3; ++c) sum += noise.of(3 * std::size_t{pixel} + c);
    const double work = static_cast<double>(noise.passes) * paths_ * work_through_glass * eye_.size();
    if (work > 0)
      paths_ = static_cast<std::uint32_t>(
          std::clamp(std::round(paths_ * std::sqrt(sum / work / noise.photon_gain)), 1.0, 64.0));
  }

  /// Runs its kernels over no photon and no pixel.
  void warm_up(const Communicator& /*communicator*/) override {
    map_.build(first_radius_, 0);
    eye_.warm_up();
    gather(film_, world_.pixels.count, 0, first_radius_, world_.tables.batches, world_.pixels.on_device, 0, 0);
  }

  /// Gathers the photons of the first batches within a radius that grows with the blocks.
  bool advance_preview() override {
    const PreviewBlocks& preview = world_.preview;
    const shared::DeviceCamera camera = world_.preview_camera();
    const auto count = static_cast<std::uint32_t>(preview.glass.size());
    const double radius = first_radius_ * preview.blocks.edge;
    preview_film_ = world_.preview_film();
    if (preview.batches == 0) return true;
    map_.build(radius, preview.batches * world_.tables.photons_per_batch);
    for (std::uint32_t path = 0; path < 2 * preview_paths; ++path) {
      Partition(world_.context.communicator(), count).for_own(0, count, [&](std::int64_t begin, std::int64_t own) {
        const auto from = static_cast<std::uint32_t>(begin), blocks = static_cast<std::uint32_t>(own);
        eye_.trace(camera, world_.seed, 0, {preview_paths, path, path}, -1, preview.glass, from, blocks);
        gather(preview_film_, static_cast<std::uint32_t>(camera.width * camera.height), path % 2, radius,
               preview.batches, preview.glass, from, blocks);
      });
    }
    world_.context.finish();
    return true;
  }

  void develop_preview(job::Picture& picture) override {
    const double scale = world_.tables.caustic_scale * world_.white;
    const auto samples = [](std::size_t) { return std::array{1.0, 1.0}; };
    tracing::add_layer("caustic", {world_.context.all_reduced_sum(preview_film_), scale, samples}, picture);
  }

  bool advance(std::int64_t pass) override {
    const double radius = first_radius_ * map_radius_factor(pass, alpha_);
    if (sorted_pass_ != pass) map_.build(radius, world_.tables.photons_per_pass());
    sorted_pass_ = pass;
    const auto number = static_cast<std::uint32_t>(pass);
    const EyePaths::Paths paths{paths_, before_[0] + before_[1], before_[number % 2]};
    const bool complete = eye_.advance(world_.seed, number, paths, -1, [&](std::uint32_t first, std::uint32_t count) {
      gather(film_, world_.pixels.count, number, radius, world_.tables.batches, world_.pixels.on_device, first, count);
    });
    if (complete) before_[number % 2] += paths_;
    return complete;
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override {
    const std::int64_t complete = passes + (done ? 1 : 0);
    const std::uint32_t next =
        eye_.done() > 0 ? world_.pixels.glass[static_cast<std::size_t>(eye_.done())] : 0; // in the current pass
    const auto samples = [=](std::size_t pixel) { return tracing::halves_of(complete + (pixel < next ? 1 : 0), 0); };
    tracing::add_layer("caustic",
                       {world_.context.all_reduced_sum(film_), world_.tables.caustic_scale * world_.white, samples},
                       picture);
  }

  void serialize(tracing::Archive& archive) override {
    eye_.serialize(archive);
    archive.value(paths_);
    archive.value(before_);
    archive.buffer(film_);
    if (archive.is_read()) preview_film_ = world_.preview_film();
    archive.buffer(preview_film_);
    archive.joined(map_.stored());
    if (archive.is_read()) sorted_pass_ = -1;
  }

private:
  /// The paths of a pixel in each half of the preview.
  static constexpr std::uint32_t preview_paths = 4;

  /// picture is the number of the film's pixels, batches that of the batches of photons in the map.
  void gather(const compute::Buffer<std::int64_t>& film, std::uint32_t picture, std::uint32_t pass, double radius,
              unsigned batches, const compute::Buffer<std::uint32_t>& pixels, std::uint32_t first,
              std::uint32_t count) {
    const RunTables& t = world_.tables;
    const double quanta = photon_scale(t.photons_per_batch, t.light_towards_targets_w),
                 metres = radius * t.scene.metres_per_unit;
    gather_.run(std::max(count, 1u), 64, map_.arguments(),
                {{"points", eye_.points()},
                 {"film", film},
                 {"energy", world_.energy},
                 {"pixels", pixels},
                 {"picture", picture},
                 {"pass", pass},
                 {"first", first},
                 {"count", count},
                 {"radius", static_cast<float>(radius)},
                 {"film_per_quantum",
                  static_cast<float>(t.caustic_scale / quanta / batches / std::pow(std::numbers::pi * metres, 2))}});
  }

  StageContext& world_;
  PhotonMap& map_;
  double first_radius_, alpha_;
  std::uint32_t paths_;                   ///< paths of a pixel in a pass
  std::array<std::uint32_t, 2> before_{}; ///< paths of a pixel in even and in odd passes
  EyePaths eye_;
  compute::Buffer<std::int64_t> film_, preview_film_;
  compute::Kernel gather_;
  std::int64_t sorted_pass_ = -1; ///< the pass whose photons the grid has
};

PlanPart plan_maps(const PlanInput& input) {
  PlanPart part = plan_gathering(input, map_decision(input), input.tables.photons_per_pass());
  const bool runs = part.decisions[0].runs;
  if (runs) part.buffers.push_back({"film photon maps", input.film_bytes()});
  // Photons and eye paths must share a wavelength. A pass has 32 in all: a picture of fewer has a colour cast.
  const int clusters = std::max(static_cast<int>(input.tables.wavelengths.clusters.size()), 1);
  part.defines = {
      {"NEPHROID_PASS_BANDS", std::to_string(runs && jitter_decision(input).runs ? std::max(1, 32 / clusters) : 1)}};
  return part;
}

} // namespace

plan::Decision map_decision(const PlanInput& input) {
  const char* const name = "photon maps";
  if (input.settings.relight)
    return {name, false, "spectral.relight is true: layers are kept of splats, not of photon maps", "/spectral/relight",
            false};
  if (!input.caustics.runs) return {name, false, "there are no caustics to gather"};
  const bool sees = tracing::may_see_glass_or_mirror(input.scene);
  if (input.settings.estimator == Settings::Estimator::splat)
    return {name, false,
            fmt::format("spectral.estimator is splat: {}", sees ? "what glass and mirrors show of caustics is left out"
                                                                : "the camera sees no glass and no mirror")};
  if (!sees)
    return tracing::not_needed(name, input.leave_out.photon_maps,
                               "the camera sees no glass and no mirror, so every caustic is splatted");
  return tracing::needed(
      name,
      fmt::format(
          "caustics seen through glass or in a mirror are gathered, {}, {} a pixel and pass; the others are splatted",
          map_radius(input.settings, input.scene), counted(input.tables.eye_paths, "path")));
}

const RunPart map_stage{plan_maps, make_stage<MapStage>, "caustic"};

} // namespace nephroid::photons
