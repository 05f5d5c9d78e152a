// SPDX-License-Identifier: Apache-2.0
// Stochastic progressive photon mapping (Hachisuka and Jensen 2009) as the thesis uses it (4.1): each cluster has a run
// and statistics of its own. The runs take turns: one of importance u has ceil(u p) iterations after p passes. With
// effort `random` (thesis figure 1.5) each pass draws one cluster, which stands for all in one run.
#include "optics/colour.h"
#include "photons/effort/emitters.h"
#include "photons/effort/importance.h"
#include "photons/maps/photon_map.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/scales.h"
#include "tracing/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <span>

namespace nephroid::photons {
namespace {

/// The progressive run of a cluster, or the one that all share.
struct ClusterRun {
  compute::Buffer<shared::PixelStatistics> statistics; ///< [pixel]
  compute::Buffer<std::int64_t> energy;                ///< [OUTCOME_COUNT] quanta, over the run's iterations
};

/// About as many visible points as make work for a slice.
std::size_t visible_points(const shared::DeviceCamera& camera) {
  return std::min<std::size_t>(1 << 16,
                               static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
}

/// The photons of an iteration of a cluster.
struct ClusterPhotons {
  compute::Buffer<shared::DeviceEmitter> emitters; ///< one a light
  int emitter_count = 0;
  double photon_scale = 1; ///< quanta per W
};

class SppmStage final : public Stage {
public:
  SppmStage(StageContext& world, const scene::Scene& scene, const Settings& settings)
      : world_(world), photons_(static_cast<std::uint32_t>(settings.photons_per_pass)),
        random_(settings.effort == Settings::Effort::random), alpha_(settings.sppm.alpha),
        first_radius_(first_map_radius(settings, scene)), map_(world.context, photons_, world.defines),
        points_(world.context, "visible points", visible_points(world.tables.camera)),
        pixels_(world.pixels.count, 1024, static_cast<std::int64_t>(points_.size())),
        unused_(world.context, "unused", 0), no_guide_(world.context, "unused", 0) {
    compute::Defines defines = world.photon_defines();
    defines["NEPHROID_SPLAT"] = std::to_string(0);
    defines["NEPHROID_STORE"] = std::to_string(1);
    defines["NEPHROID_RECEIVERS"] = std::to_string(0);
    send_ = compute::Program(world.context, "photons/photons.cl", defines).kernel("photons");
    view_ = compute::Program(world.context, "photons/view.cl", world.eye_defines()).kernel("view");
    const compute::Program gather(world.context, "photons/gather.cl", world.defines);
    gather_ = gather.kernel("gather_to_statistics");
    start_ = gather.kernel("start_statistics");
    add_radiance_ = gather.kernel("add_radiance");
    for (int cluster = 0; cluster < cluster_count(); ++cluster) senders_.push_back(make_sender(cluster));
    for (int run = 0; run < (random_ ? 1 : cluster_count()); ++run) runs_.push_back(make_run());
  }

  const char* name() const override { return "photon maps"; }
  double fraction_done() const override { return static_cast<double>(at_.cluster) / cluster_count(); }
  std::uint64_t photons_per_pass() const override {
    const std::vector<double>& u = world_.tables.importance;
    return static_cast<std::uint64_t>(
        std::llround(photons_ * (random_ ? 1.0 : std::accumulate(u.begin(), u.end(), 0.0))));
  }

  /// Its state may be gigabytes, so nothing is saved: kernels run over no photon and no pixel.
  void warm_up(const Communicator& /*communicator*/) override {
    send_photons(0, {});
    map_.build(first_radius_, 0);
    see(0, 0, 0, 0);
    gather_photons(0, 0, 0, 1);
  }

  bool advance(std::int64_t pass) override {
    to_next_turn(pass);
    if (at_.cluster < cluster_count()) {
      if (!at_.sent)
        at_.sent = send(pass);
      else if (gather(pass)) {
        at_.sent = sorted_ = false;
        ++at_.cluster;
        to_next_turn(pass);
      }
    }
    if (at_.cluster < cluster_count()) return false;
    at_ = {};
    return true;
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override {
    compute::Buffer<float> sums(world_.context, "radiance", 3 * std::size_t{pixel_count()});
    sums.fill_zero();
    const double metres = world_.tables.scene.metres_per_unit, power = world_.tables.power_unit;
    const auto per_iteration = [&](std::int64_t count) {
      return count > 0
                 ? static_cast<float>(power / (static_cast<double>(count) * std::pow(std::numbers::pi * metres, 2)))
                 : 0.0f;
    };
    for (int run = 0; run < static_cast<int>(runs_.size()); ++run) {
      const std::int64_t before = iterations_of(run, passes), after = iterations_of(run, passes + 1);
      const bool in_hand = !done && (random_ || run == at_.cluster);
      // Pixels before the split have had the current iteration.
      const std::uint32_t split = done || (!random_ && run < at_.cluster) ? pixel_count()
                                  : in_hand                               ? static_cast<std::uint32_t>(pixels_.done())
                                                                          : 0;
      add_radiance_.run(pixel_count(), 64,
                        {{"statistics", runs_[static_cast<std::size_t>(run)].statistics},
                         {"xyz", sums},
                         {"pixels", pixel_count()},
                         {"split", split},
                         {"per_iteration_before", per_iteration(after)},
                         {"per_iteration_after", per_iteration(before)}});
    }
    std::vector<float> xyz = sums.read();
    const Communicator& communicator = world_.context.communicator();
    own_pixels().clear_others(std::span(xyz), 3);
    communicator.all_reduce_or(std::as_writable_bytes(std::span(xyz)));
    std::vector<float>& caustic = tracing::layer_of(picture, "caustic").rgb;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      const optics::Colour rgb =
          optics::xyz_to_linear_srgb({xyz[i] / world_.white, xyz[i + 1] / world_.white, xyz[i + 2] / world_.white});
      for (std::size_t c = 0; c < 3; ++c) caustic[i + c] += static_cast<float>(rgb[c]);
    }
    picture.error_draw.clear(); // there are no two halves: a radius depends on all photons
  }

  void report(std::int64_t passes, bool done, Energy& energy) override {
    OutcomeWatts watts{};
    for (int run = 0; run < static_cast<int>(runs_.size()); ++run) {
      const bool in_hand = !done && (random_ || run == at_.cluster);
      const bool had = done || (!random_ && run < at_.cluster) || (in_hand && at_.sent);
      const double count = static_cast<double>(iterations_of(run, passes + (had ? 1 : 0))) +
                           (in_hand && !at_.sent ? slices_.fraction_done() : 0);
      if (count <= 0) continue;
      const OutcomeWatts run_watts =
          outcome_watts(world_.context.all_reduced_sum(runs_[static_cast<std::size_t>(run)].energy),
                        world_.tables.energy_scale, count);
      const double share = random_ ? cluster_count() : 1; // a run that all clusters share draws one of them for all
      for (std::size_t i = 0; i < watts.size(); ++i) watts[i] += is_count(i) ? run_watts[i] : share * run_watts[i];
    }
    energy.caustics = balance_of(watts);
  }

  void serialize(tracing::Archive& archive) override {
    archive.value(at_);
    slices_.serialize(archive);
    pixels_.serialize(archive);
    archive.joined(map_.stored());
    for (ClusterRun& run : runs_) {
      archive.owned(run.statistics, own_pixels(), 1);
      archive.buffer(run.energy);
    }
    if (archive.is_read()) sorted_ = false;
  }

private:
  struct Position {
    int cluster = 0;   ///< cluster whose turn it is, or the next that may have one
    bool sent = false; ///< whether its photons are all sent
  };

  int cluster_count() const { return world_.tables.scene.cluster_count; }
  std::uint32_t pixel_count() const { return world_.pixels.count; }
  Partition own_pixels() const { return {world_.context.communicator(), pixel_count()}; }
  ClusterRun& run_of(int cluster) { return runs_[random_ ? 0 : static_cast<std::size_t>(cluster)]; }

  /// The iterations of a cluster's run in `passes` passes.
  std::int64_t iterations_of(int cluster, std::int64_t passes) const {
    return random_ ? passes : iterations(world_.tables.importance[static_cast<std::size_t>(cluster)], passes);
  }

  bool has_turn(int cluster, std::int64_t pass) const {
    if (random_) return cluster == drawn_cluster(pass);
    return iterations_of(cluster, pass + 1) > iterations_of(cluster, pass);
  }

  /// The cluster that effort `random` draws: uniform, by seed and pass alone.
  int drawn_cluster(std::int64_t pass) const {
    std::seed_seq seeds{world_.seed.x, world_.seed.y, static_cast<std::uint32_t>(pass)};
    return static_cast<int>(std::mt19937_64(seeds)() % static_cast<std::uint64_t>(cluster_count()));
  }

  void to_next_turn(std::int64_t pass) {
    while (at_.cluster < cluster_count() && !has_turn(at_.cluster, pass)) ++at_.cluster;
  }

  /// The seed of a cluster's run: runs count their own iterations, so each needs other random numbers.
  shared::uint2 seed_of(int cluster) const {
    return {world_.seed.x, world_.seed.y ^ static_cast<std::uint32_t>(cluster + 1) * 0x9E3779B9u};
  }

  ClusterRun make_run() {
    ClusterRun run{{world_.context, "progressive statistics", pixel_count()}, world_.zeroed("energy", OUTCOME_COUNT)};
    start_.run(pixel_count(), 64,
               {{"statistics", run.statistics},
                {"pixels", pixel_count()},
                {"radius2", static_cast<float>(first_radius_ * first_radius_)}});
    return run;
  }

  ClusterPhotons make_sender(int cluster) const {
    const RunTables& t = world_.tables;
    const auto c = static_cast<std::size_t>(cluster);
    std::vector<PhotonSource> sources;
    double weights = 0;
    for (std::size_t l = 0; l < t.lights.size(); ++l) {
      const double share = t.wavelengths.share[l][c];
      sources.push_back({t.towards_targets_w[l] * tracing::worth(t.wavelengths.seen[l][c], share), static_cast<int>(l),
                         cluster, share});
      weights += sources.back().weight;
    }
    std::vector<shared::DeviceEmitter> emitters = make_emitters(sources, photons_);
    for (shared::DeviceEmitter& emitter : emitters)
      emitter.sequence = static_cast<std::uint32_t>(cluster); // clusters have runs of their own
    return {{world_.context, "emitters of a cluster", emitters},
            static_cast<int>(emitters.size()),
            photon_scale(photons_, weights)};
  }

  void send_photons(std::int64_t pass, const tracing::PhotonSlice& slice) {
    const int cluster = std::min(at_.cluster, cluster_count() - 1);
    const ClusterPhotons& sender = senders_[static_cast<std::size_t>(cluster)];
    const std::int64_t iteration = iterations_of(cluster, pass);
    shared::DevicePhotonLaunch launch = world_.photon_launch();
    launch.seed = seed_of(cluster);
    launch.photons_per_batch = photons_;
    launch.map_pass = static_cast<std::uint32_t>(iteration);
    launch.emitter_count = sender.emitter_count;
    launch.energy_scale = world_.on_device(world_.tables.energy_scale);
    launch.stored_scale = world_.on_device(sender.photon_scale);
    world_.send(send_, slice, iteration, launch,
                {{"emitters", sender.emitters},
                 {"film", unused_},
                 {"energy", run_of(cluster).energy},
                 {"moments", unused_},
                 {"guide_moments", unused_},
                 {"guide", no_guide_},
                 {"worth", no_guide_},
                 {"stored", map_.stored()},
                 {"receiver_table", no_table_},
                 {"light", unused_}});
  }

  /// items is the number of work items, at least one; the first `count` gather.
  void gather_photons(std::uint32_t first_pixel, std::uint32_t count, int cluster, std::size_t items) {
    const double weight = random_ ? cluster_count() : 1;
    const double unit = weight / (senders_[static_cast<std::size_t>(cluster)].photon_scale * world_.tables.power_unit);
    gather_.run(items, 64, map_.arguments(),
                {{"points", points_},
                 {"statistics", run_of(cluster).statistics},
                 {"first_pixel", first_pixel},
                 {"count", count},
                 {"alpha", static_cast<float>(alpha_)},
                 {"unit", static_cast<float>(unit)}});
  }

  bool send(std::int64_t pass) {
    if (slices_.at_start()) map_.stored().fill_zero(); // each photon is stored by one rank
    return slices_.advance(world_.context.communicator(), photons_,
                           [&](const tracing::PhotonSlice& slice) { send_photons(pass, slice); }) > 0;
  }

  bool gather(std::int64_t pass) {
    const std::int64_t iteration = iterations_of(at_.cluster, pass);
    // Pixels without photons keep the first radius, and a search may be as wide as 3 cells.
    if (!sorted_)
      map_.build(std::max(first_radius_ * map_radius_factor(iteration, alpha_), 0.34 * first_radius_), photons_);
    sorted_ = true;
    return pixels_.advance(world_.context.communicator(), [&](std::uint32_t first_pixel, std::uint32_t count) {
      see(iteration, at_.cluster, first_pixel, count);
      gather_photons(first_pixel, count, at_.cluster, count);
      world_.context.finish();
    });
  }

  /// Finds the visible points of an iteration.
  void see(std::int64_t iteration, int cluster, std::uint32_t first_pixel, std::uint32_t count) {
    const shared::DeviceViewLaunch launch{seed_of(cluster), static_cast<std::uint32_t>(iteration),
                                          cluster,          static_cast<int>(world_.tables.objects.size()),
                                          first_pixel,      count};
    world_.queue(view_, std::max(count, 1u), 64,
                 {{"points", points_}, {"camera", world_.tables.camera}, {"launch", launch}});
  }

  StageContext& world_;
  std::uint32_t photons_; ///< photons of an iteration
  bool random_;
  double alpha_, first_radius_;
  PhotonMap map_;
  compute::Buffer<shared::VisiblePoint> points_;
  tracing::PixelSlices pixels_;
  compute::Kernel send_, view_, gather_, start_, add_radiance_;
  std::vector<ClusterPhotons> senders_; ///< [cluster]
  std::vector<ClusterRun> runs_;
  compute::Buffer<std::int64_t> unused_;                       ///< argument for what the photon kernel does not do here
  compute::Buffer<float> no_guide_;                            ///< likewise
  compute::Buffer<int> no_table_{world_.context, "unused", 0}; ///< likewise
  tracing::PhotonSlices slices_;
  Position at_;
  bool sorted_ = false; ///< whether the grid has this iteration's photons
};

/// The plan's warning about a spectral.sppm.radius that loses the caustics, or an empty string. Such a radius is wider
/// than 32 pixels or than the whole scene, or below 1/16 pixel, where a pass with as many photons as pixels finds one
/// in some hundred pixels. It also warns of an alpha that shrinks the radius so far at a pixel's first photons.
std::string map_radius_note(const Settings& settings, const scene::Scene& scene) {
  const double radius = first_map_radius(settings, scene), alpha = settings.sppm.alpha,
               shrunk = radius * std::sqrt(alpha);
  const scene::Sphere bounds = tracing::scene_bounds(scene);
  const double pixel = middle_pixel_width(scene), least = pixel / 16;
  if (radius >= least && shrunk < least)
    return fmt::format("spectral.sppm.alpha: {:.3g} shrinks a radius from {:.3g} to {:.3g} pixels at its first "
                       "photons, and hardly another one "
                       "lies so near: caustics grow darker from pass to pass; choose 0.667 or so",
                       alpha, radius / pixel, shrunk / pixel);
  if (!settings.sppm.radius) return "";
  const auto note = [&](const char* consequence) {
    return fmt::format(
        "spectral.sppm.radius: {} units are {:.3g} pixels: {}; choose about {:.3g}, two pixels, or leave it out",
        radius, radius / pixel, consequence, 2 * pixel);
  };
  if (radius > 32 * pixel || (radius > bounds.radius && radius > 2 * pixel))
    return note("caustics are blurred away, and gathering is slow");
  return radius < least ? note("hardly a photon lies so near, and caustics are black but for rare bright dots") : "";
}

plan::Decision sppm_decision(const PlanInput& input) {
  const char* const name = "photon maps";
  if (!input.caustics.runs) return {name, false, "there are no caustics to gather"};
  return {name, true,
          fmt::format(
              "spectral.estimator is sppm: every caustic is gathered, {}, {}", map_radius(input.settings, input.scene),
              input.settings.effort == Settings::Effort::random ? "one cluster a pass in shared statistics"
                                                                : "with statistics of each pixel in each cluster")};
}

PlanPart plan_sppm(const PlanInput& input) {
  PlanPart part{.decisions = {sppm_decision(input)}};
  if (!part.decisions[0].runs) return part;
  const std::size_t objects = input.scene.objects.size(), clusters = input.tables.wavelengths.clusters.size();
  if (2 * clusters * objects > MAX_PHOTON_GROUPS)
    throw bad_input(Location(input.scene.source) / "scene" / "objects",
                    fmt::format("{} objects in {} wavelength clusters", objects, clusters),
                    fmt::format("photon maps tell {} surfaces in clusters apart", int{MAX_PHOTON_GROUPS}),
                    "choose another spectral.estimator, or a larger threshold_deg");
  const auto photons = static_cast<std::uint32_t>(input.settings.photons_per_pass);
  const std::uint64_t stored = photons * sizeof(shared::StoredPhoton),
                      runs = input.settings.effort == Settings::Effort::random ? 1 : clusters;
  part.buffers = {{"photons on surfaces", stored},
                  {"photon grid", PhotonMap::bytes(photons) - stored},
                  {"visible points", visible_points(input.tables.camera) * sizeof(shared::VisiblePoint)},
                  {"statistics of pixels", runs * input.pixels() * sizeof(shared::PixelStatistics)},
                  {"radiance", 3 * input.pixels() * sizeof(float)}};
  if (const std::string note = map_radius_note(input.settings, input.scene); !note.empty()) part.notes = {note};
  return part;
}

} // namespace

const RunPart sppm_stage{plan_sppm, make_stage<SppmStage>, "caustic"};

} // namespace nephroid::photons
