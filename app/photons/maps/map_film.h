// SPDX-License-Identifier: Apache-2.0
// A film of what glass and mirrors show of the photons in a map: paths from the eye gather them. The radius shrinks
// from pass to pass and is the same for all pixels (Knaus and Zwicker 2011). So each pass is an independent estimate,
// and the film adds passes up like any other film.
#pragma once
#include "photons/maps/eye_paths.h"
#include "photons/maps/photon_map.h"
#include "photons/stage.h"
#include "tracing/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::photons {

class MapFilm {
public:
  /// What a map holds of a pass, and what the film makes of it.
  struct Photons {
    std::uint32_t slots = 0;
    double passes = 1;   ///< as how many times the photons of which each has its part of the light they count
    double scale = 1;    ///< film quanta per unit of XYZ radiance
    double per_watt = 1; ///< quanta per W of a stored photon
  };

  /// defines: those of the photons' kernel that its paths share.
  MapFilm(StageContext& world, PhotonMap& map, const scene::Scene& scene, const Settings& settings, const char* name,
          const compute::Defines& defines)
      : world_(world), map_(map), first_radius_(first_map_radius(settings, scene)), alpha_(settings.sppm.alpha),
        paths_(world.tables.eye_paths), eye_(world, EyePaths::Pixels::glass, defines),
        film_(world.zeroed(name, world.film_size())),
        gather_(compute::Program(world.context, "photons/gather.cl", world.defines).kernel("gather_to_film")) {}

  PhotonMap& map() { return map_; }
  const EyePaths& eye() const { return eye_; }
  std::uint32_t paths() const { return paths_; }
  void set_paths(double paths) { paths_ = static_cast<std::uint32_t>(std::clamp(std::round(paths), 1.0, 64.0)); }

  /// Runs its kernels over no photon and no pixel.
  void warm_up(const Photons& photons) {
    map_.build(first_radius_, 0);
    eye_.warm_up();
    gather(film_, world_.pixels.count, 0, first_radius_, photons, world_.pixels.on_device, 0, 0);
  }

  /// A slice of a pass, whose photons are stored. True when it is complete.
  bool advance(std::int64_t pass, const Photons& photons) {
    const double radius = first_radius_ * map_radius_factor(pass, alpha_);
    if (sorted_pass_ != pass) map_.build(radius, photons.slots);
    sorted_pass_ = pass;
    const auto number = static_cast<std::uint32_t>(pass);
    const EyePaths::Paths paths{paths_, before_[0] + before_[1], before_[number % 2]};
    const bool complete = eye_.advance(world_.seed, number, paths, -1, [&](std::uint32_t first, std::uint32_t count) {
      gather(film_, world_.pixels.count, number, radius, photons, world_.pixels.on_device, first, count);
    });
    if (complete) before_[number % 2] += paths_;
    return complete;
  }

  /// Adds the photons of blocks of pixels to `film`, within a radius that grows with the blocks.
  void advance_preview(const compute::Buffer<std::int64_t>& film, const Photons& photons) {
    constexpr std::uint32_t paths_of_half = 4;
    const PreviewBlocks& preview = world_.preview;
    const shared::DeviceCamera camera = world_.preview_camera();
    const double radius = first_radius_ * preview.blocks.edge;
    const auto count = static_cast<std::uint32_t>(preview.glass.size());
    map_.build(radius, photons.slots);
    for (std::uint32_t path = 0; path < 2 * paths_of_half; ++path)
      Partition(world_.context.communicator(), count).for_own(0, count, [&](std::int64_t begin, std::int64_t own) {
        const auto from = static_cast<std::uint32_t>(begin), blocks = static_cast<std::uint32_t>(own);
        eye_.trace(camera, world_.seed, 0, {paths_of_half, path, path}, -1, preview.glass, from, blocks);
        gather(film, static_cast<std::uint32_t>(camera.width * camera.height), path % 2, radius, photons, preview.glass,
               from, blocks);
      });
    world_.context.finish();
  }

  /// Adds the film to a layer, as Stage::develop does.
  void develop(std::int64_t passes, bool done, const char* layer, double scale, job::Picture& picture) {
    const std::int64_t complete = passes + (done ? 1 : 0);
    const std::uint32_t next =
        eye_.done() > 0 ? world_.pixels.glass[static_cast<std::size_t>(eye_.done())] : 0; // in the current pass
    const auto samples = [=](std::size_t pixel) { return tracing::halves_of(complete + (pixel < next ? 1 : 0), 0); };
    tracing::add_layer(layer, {world_.context.all_reduced_sum(film_), scale, samples}, picture);
  }

  void serialize(tracing::Archive& archive) {
    eye_.serialize(archive);
    archive.value(paths_);
    archive.value(before_);
    archive.buffer(film_);
    archive.joined(map_.stored());
    if (archive.is_read()) sorted_pass_ = -1;
  }

private:
  /// picture is the number of the film's pixels.
  void gather(const compute::Buffer<std::int64_t>& film, std::uint32_t picture, std::uint32_t pass, double radius,
              const Photons& photons, const compute::Buffer<std::uint32_t>& pixels, std::uint32_t first,
              std::uint32_t count) {
    const double metres = radius * world_.tables.scene.metres_per_unit;
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
                 {"film_per_quantum", static_cast<float>(photons.scale / photons.per_watt / photons.passes /
                                                         std::pow(std::numbers::pi * metres, 2))}});
  }

  StageContext& world_;
  PhotonMap& map_;
  double first_radius_, alpha_;
  std::uint32_t paths_;                   ///< paths of a pixel in a pass
  std::array<std::uint32_t, 2> before_{}; ///< paths of a pixel in even and in odd passes
  EyePaths eye_;
  compute::Buffer<std::int64_t> film_;
  compute::Kernel gather_;
  std::int64_t sorted_pass_ = -1; ///< the pass whose photons the grid has
};

} // namespace nephroid::photons
