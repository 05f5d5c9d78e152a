// SPDX-License-Identifier: Apache-2.0
// What glass and mirrors show of the light that photons have left on receivers: kernels/photons/receiver_eye.cl.
#include "base/counted.h"
#include "photons/maps/photon_map.h"
#include "photons/pixel_surfaces.h"
#include "photons/receivers/receiver_light.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::photons {
namespace {

/// Paths that a sample through glass divides into, more or less.
constexpr double paths_a_sample = 3;

class ReceiverStage final : public Stage {
public:
  ReceiverStage(StageContext& world, const scene::Scene&, const Settings&)
      : world_(world), light_(world.receivers.value()), paths_(world.tables.eye_paths),
        slices_(static_cast<std::int64_t>(world.pixels.glass.size()), 1024),
        film_(world.zeroed("film light on receivers", world.film_size())), preview_film_(world.preview_film()),
        kernel_(compute::Program(world.context, "photons/receiver_eye.cl", world.eye_defines(true))
                    .kernel("see_receivers")) {}

  const char* name() const override { return "light on receivers"; }
  double fraction_done() const override { return slices_.fraction_done(); }

  void share_work(const Noise& noise) override {
    double sum = 0;
    for (const std::uint32_t pixel : world_.pixels.glass)
      for (std::size_t c = 0; c < 3; ++c) sum += noise.of(3 * std::size_t{pixel} + c);
    const double work =
        static_cast<double>(noise.passes) * paths_ * work_through_glass * double(world_.pixels.glass.size());
    if (work > 0) paths_ = std::clamp(paths_ * std::sqrt(sum / work / noise.photon_gain), 1.0, 64.0);
  }

  void warm_up(const Communicator&) override {
    see(film_, world_.tables.camera, world_.pixels.on_device, {}, 1);
    light_.clear(); // of what the tiles' own has left
  }

  bool advance(std::int64_t pass) override {
    if (!light_.has_light()) return true;
    const auto half = static_cast<std::uint32_t>(pass % world_.halves);
    const std::uint32_t samples = samples_a_pass();
    const bool complete = world_.pixels.glass.empty() ||
                          slices_.advance(world_.context.communicator(), [&](std::uint32_t first, std::uint32_t count) {
                            see(film_, world_.tables.camera, world_.pixels.on_device,
                                {world_.seed, before_[half] * world_.halves + half, world_.halves, samples, half,
                                 world_.pixels.count + first, count, 0},
                                count);
                            world_.context.finish();
                          });
    half_in_hand_ = half;
    if (!complete) return false;
    before_[half] += samples;
    ++passes_[half];
    return true;
  }

  bool advance_preview() override {
    preview_film_ = world_.preview_film();
    if (!light_.has_light()) return true;
    const auto count = static_cast<std::int64_t>(world_.preview.glass.size());
    for (std::uint32_t half = 0; half < world_.halves; ++half)
      Partition(world_.context.communicator(), count).for_own(0, count, [&](std::int64_t begin, std::int64_t own) {
        see(preview_film_, world_.preview_camera(), world_.preview.glass,
            {world_.seed, half, world_.halves, 2, half, static_cast<std::uint32_t>(begin),
             static_cast<std::uint32_t>(own), 0},
            static_cast<std::uint32_t>(own));
      });
    world_.context.finish();
    return true;
  }

  void develop_preview(job::Picture& picture) override {
    const auto samples = [](std::size_t) { return std::array{1.0, 1.0}; };
    tracing::add_layer("caustic", {world_.context.all_reduced_sum(preview_film_), scale(), samples}, picture);
  }

  void develop(std::int64_t, bool, job::Picture& picture) override {
    const std::uint32_t next =
        slices_.done() > 0 ? world_.pixels.glass[static_cast<std::size_t>(slices_.done())] : 0; // in the current pass
    const auto samples = [&](std::size_t pixel) {
      std::array<double, 2> of_halves{double(passes_[0]), double(passes_[1])};
      if (pixel < next) ++of_halves[half_in_hand_];
      return of_halves;
    };
    tracing::add_layer("caustic", {world_.context.all_reduced_sum(film_), scale(), samples}, picture);
  }

  void serialize(tracing::Archive& archive) override {
    light_.serialize(archive);
    slices_.serialize(archive);
    archive.value(paths_);
    archive.value(before_);
    archive.value(passes_);
    archive.value(half_in_hand_);
    archive.buffer(film_);
    if (archive.is_read()) preview_film_ = world_.preview_film();
    archive.buffer(preview_film_);
  }

private:
  double scale() const { return world_.tables.caustic_scale * world_.white; }
  std::uint32_t samples_a_pass() const {
    return static_cast<std::uint32_t>(std::max(std::round(paths_ / paths_a_sample), 1.0));
  }

  void see(const compute::Buffer<std::int64_t>& film, const shared::DeviceCamera& camera,
           const compute::Buffer<std::uint32_t>& pixels, shared::DeviceLookLaunch launch, std::size_t items) {
    launch.film_per_quantum = static_cast<float>(world_.tables.caustic_scale / light_.quanta_per_watt() /
                                                 (std::numbers::pi * std::pow(world_.tables.scene.metres_per_unit, 2)));
    world_.queue(kernel_, std::max<std::size_t>(items, 1), 64,
                 {{"receiver_table", light_.table()},
                  {"totals", light_.totals()},
                  {"film", film},
                  {"energy", world_.energy},
                  {"camera", camera},
                  {"pixels", pixels},
                  {"launch", launch}});
  }

  StageContext& world_;
  ReceiverLight& light_;
  double paths_; ///< paths of a pixel in a pass
  tracing::PixelSlices slices_;
  std::array<std::uint32_t, 2> before_{}, passes_{}; ///< samples of a pixel and complete passes in each half
  std::uint32_t half_in_hand_ = 0;
  compute::Buffer<std::int64_t> film_, preview_film_;
  compute::Kernel kernel_;
};

plan::Decision receiver_decision(const PlanInput& input) {
  const char* const name = "light on receivers";
  if (!input.caustics.runs) return {name, false, "there are no caustics to keep"};
  if (!tracing::may_see_glass_or_mirror(input.scene))
    return tracing::not_needed(name, input.leave_out.photon_maps,
                               "the camera sees no glass and no mirror, so every caustic is splatted");
  return tracing::needed(
      name,
      fmt::format("caustics seen through glass or in a mirror are kept in texels where they fall, {} a pixel and pass",
                  counted(input.tables.eye_paths, "path")));
}

PlanPart plan_receivers(const PlanInput& input) {
  PlanPart part{.decisions = {receiver_decision(input)}};
  const bool runs = part.decisions[0].runs;
  part.defines = {{"NEPHROID_RECEIVERS", std::to_string(int(runs))}};
  if (!runs) return part;
  const int layers = receiver_layers(input.tables.wavelengths.clusters.size());
  const auto halves = static_cast<unsigned>(input.halves());
  part.buffers = {{"film light on receivers", input.film_bytes()},
                  {"light on receivers, at most",
                   page_bytes(layers, halves) * most_pages(glass_pixels(input.scene).size(), layers, halves)}};
  return part;
}

} // namespace

ReceiverLight make_receiver_light(StageContext& world, const scene::Scene& scene) {
  // One pixel of four asks, where there are many.
  constexpr std::size_t enough = 40'000;
  std::vector<std::uint32_t> pixels = world.pixels.glass;
  if (pixels.size() > enough)
    std::erase_if(pixels, [&](std::uint32_t pixel) {
      const auto width = static_cast<std::uint32_t>(world.tables.camera.width);
      return pixel % width % 2 != 0 || pixel / width % 2 != 0;
    });
  const Charts charts = make_charts(scene);
  const auto count = static_cast<std::uint32_t>(pixels.size());
  const compute::Buffer<int> table(world.context, "charts of receivers", receiver_table(charts, {}, 1));
  const compute::Buffer<std::uint32_t> on_device(world.context, "pixels that ask", pixels);
  const compute::Buffer<shared::DeviceLook> looks(world.context, "looks", std::size_t{ASKING_ENDS} * count);
  compute::Kernel ask =
      compute::Program(world.context, "photons/receiver_eye.cl", world.eye_defines(true)).kernel("ask_for_pages");
  if (count > 0)
    world.run(ask, count, 64,
              {{"receiver_table", table},
               {"camera", world.tables.camera},
               {"pixels", on_device},
               {"launch", shared::DeviceLookLaunch{world.seed, 0, 1, 1, 0, 0, count, 0}},
               {"looks", looks}});
  const int layers = receiver_layers(world.tables.wavelengths.clusters.size());
  return {world,
          charts,
          looks.read(),
          most_pages(world.pixels.glass.size(), layers, world.halves),
          layers,
          world.halves,
          photon_scale(world.tables.photons_per_batch, world.tables.light_towards_targets_w) * 0x1p8};
}

const RunPart receiver_stage{plan_receivers, make_stage<ReceiverStage>, "caustic"};

} // namespace nephroid::photons
