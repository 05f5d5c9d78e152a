// SPDX-License-Identifier: Apache-2.0
// What the stages of a job share: the scene on its device, the run's tables, the energy counters.
#pragma once
#include "kernels/photons/launch_types.h"
#include "photons/coarse.h"
#include "photons/receivers/receiver_light.h"
#include "photons/tables/run_tables.h"
#include "tracing/film.h"
#include "tracing/slices.h"
#include "tracing/world.h"

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

namespace nephroid::photons {

/// The pixels that paths from the eye start from.
struct PixelLists {
  std::vector<std::uint32_t> glass;         ///< glass_pixels() in pixel_surfaces.h
  std::vector<bool> may_show_glass;         ///< [pixel]
  std::uint32_t count = 0;                  ///< pixels of the picture
  compute::Buffer<std::uint32_t> on_device; ///< all pixels, then those of glass
};

/// The newest of a run's previews.
struct PreviewBlocks {
  Blocks blocks{0, 0, 0};               ///< edge 0: there is none
  unsigned batches = 0;                 ///< batches of photons, from the first pass
  compute::Buffer<std::uint32_t> glass; ///< blocks that may show glass or a mirror
};

struct Relighting;

/// What paths from the eye have found of a kind of light on receivers.
struct SeenLight {
  compute::Buffer<std::int64_t> film, preview;                 ///< in quanta of the direct film
  std::function<std::array<double, 2>(std::size_t)> samples{}; ///< of a pixel, in each half
};

struct StageContext : tracing::World {
  RunTables tables;
  double white = 1;
  /// Independent parts of a film: 2 where the error is estimated (tracing/film.h), else 1; meter_replicates for a
  /// meter.
  unsigned halves = 2;
  compute::Buffer<std::int64_t> energy{}; ///< [OUTCOME_COUNT] quanta
  compute::Buffer<shared::DeviceEmitter> emitters{};
  PixelLists pixels{};
  PreviewBlocks preview{};
  std::optional<ReceiverLight> receivers{}; ///< light that photons leave where glass and mirrors show it
  std::optional<SeenLight> caustics_seen{}, indirect_seen{}; ///< with receivers, and light of that kind
  std::shared_ptr<Relighting> relighting{};                  ///< set where layers are kept for another light

  /// The number of 64-bit sums of a film of XYZ.
  std::size_t film_size() const { return std::size_t{3} * halves * pixels.count; }
  bool keeps_indirect() const { return receivers && defines.at("NEPHROID_KINDS_OF_LIGHT") == "2"; }
  /// Adds what paths from the eye have found to a layer of the picture, or to that of the preview.
  void add_seen_light(const SeenLight& seen, const char* layer, job::Picture& picture) const {
    tracing::add_layer(layer, {context.all_reduced_sum(seen.film), tables.direct_scale * white, seen.samples}, picture);
  }
  void add_seen_preview(const SeenLight& seen, const char* layer, job::Picture& picture) const {
    const double second = preview.batches > 1 ? 1 : 0; // a half without photons has no light
    const auto samples = [second](std::size_t) { return std::array{1.0, second}; };
    tracing::add_layer(layer, {context.all_reduced_sum(seen.preview), tables.direct_scale * white, samples}, picture);
  }
  /// Whether paths from the eye are to see what a pass has left on receivers: to sum up all pages takes as long as some
  /// 100,000 photons, so it is after ever fewer of the passes.
  static bool is_taken(std::int64_t pass) { return std::popcount(static_cast<std::uint64_t>(pass + 1)) <= 2; }
  /// How many of so many batches or passes are in each half.
  std::array<double, 2> of_halves(std::int64_t count) const {
    const std::int64_t second = halves == 2 ? count / 2 : 0;
    return {static_cast<double>(count - second), static_cast<double>(second)};
  }
  /// The run's camera with a pixel for each block of the preview.
  shared::DeviceCamera preview_camera() const {
    shared::DeviceCamera camera = tables.camera;
    camera.width = preview.blocks.across();
    camera.height = preview.blocks.down();
    return camera;
  }
  /// The film of the preview, empty where there is none.
  compute::Buffer<std::int64_t> preview_film() const {
    return zeroed("preview", std::size_t{3} * halves * (preview.blocks.edge > 0 ? preview.blocks.count() : 0));
  }
  /// A launch of a photons' kernel that says what all launches say.
  shared::DevicePhotonLaunch photon_launch() const {
    shared::DevicePhotonLaunch launch{};
    launch.seed = seed;
    launch.object_count = static_cast<int>(tables.objects.size());
    return launch;
  }
  /// Runs a kernel that sends a slice of the photons of a pass.
  void send(compute::Kernel& kernel, const tracing::PhotonSlice& slice, std::int64_t iteration,
            shared::DevicePhotonLaunch launch, std::initializer_list<compute::Argument> own) {
    launch.iteration = static_cast<std::uint32_t>(iteration);
    launch.offset = slice.offset;
    launch.stride = slice.stride;
    launch.count = slice.count;
    run_photons(kernel, slice.count, own, {{"camera", tables.camera}, {"launch", launch}});
  }
  /// A scale for powers in the device's unit.
  float on_device(double scale) const { return static_cast<float>(scale * tables.power_unit); }
};

struct RunPlan;

/// Without receivers. Copies scene and tree to the device. Throws as tracing::make_world.
StageContext make_stage_context(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                const RunPlan& plan, const mpi::RankContext& context);

/// Makes StageContext::receivers, with pages where paths from the eye ask for them.
ReceiverLight make_receiver_light(StageContext& world, const scene::Scene& scene);

} // namespace nephroid::photons
