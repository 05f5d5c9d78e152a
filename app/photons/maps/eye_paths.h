// SPDX-License-Identifier: Apache-2.0
// Paths from the eye in slices of pixels: photons/view.cl finds where they end, and the caller gathers photons there.
#pragma once
#include "kernels/photons/photon_map_types.h"
#include "photons/stage_context.h"
#include "tracing/slices.h"

#include <algorithm>
#include <cstdint>

namespace nephroid::photons {

class EyePaths {
public:
  /// The pixels that have paths: all of them, or those that may show glass or a mirror.
  enum class Pixels { all, glass };
  /// defines: more than those of the world.
  EyePaths(StageContext& world, Pixels pixels, const compute::Defines& defines = {})
      : world_(world), begin_(pixels == Pixels::all ? 0 : world.pixels.count),
        size_(pixels == Pixels::all ? world.pixels.count : static_cast<std::uint32_t>(world.pixels.glass.size())),
        points_(world.context, "visible points", point_count(world.tables.camera)),
        view_(compute::Program(world.context, "photons/view.cl", joined(defines, world.eye_defines())).kernel("view")),
        slices_(size_, 1024, static_cast<std::int64_t>(points_.size())) {}
  static std::uint64_t bytes(const shared::DeviceCamera& camera) {
    return point_count(camera) * sizeof(shared::VisiblePoint);
  }

  /// The number of paths of a pixel in a pass, and of its earlier paths, in all and in this half of the film.
  struct Paths {
    std::uint32_t count = 1, before = 0, before_in_half = 0;
  };
  /// Traces the paths of each of the next pixels, one after the other; gather(first, count) queues kernels for each.
  /// first is an index into StageContext::pixels. view.cl explains cluster. True when all pixels are done.
  template <class Gather>
  bool advance(shared::uint2 seed, std::uint32_t pass, const Paths& paths, int cluster, const Gather& gather) {
    if (size_ == 0) return true;
    return slices_.advance(world_.context.communicator(), [&](std::uint32_t done, std::uint32_t count) {
      const std::uint32_t first = begin_ + done;
      for (std::uint32_t path = 0; path < paths.count; ++path) {
        trace(world_.tables.camera, seed, pass, {paths.count, paths.before + path, paths.before_in_half + path},
              cluster, world_.pixels.on_device, first, count);
        gather(first, count);
      }
      world_.context.finish();
    });
  }

  void warm_up() { trace(world_.tables.camera, world_.seed, 0, {}, 0, world_.pixels.on_device, 0, 0); }
  const compute::Buffer<shared::VisiblePoint>& points() const { return points_; }

  double fraction_done() const { return slices_.fraction_done(); }
  /// How many of the size() pixels are done in the current pass.
  std::int64_t done() const { return slices_.done(); }
  std::uint32_t size() const { return size_; }

  void serialize(tracing::Archive& archive) { slices_.serialize(archive); }

  /// Queues the next path of each of `count` of the camera's pixels, into points().
  void trace(const shared::DeviceCamera& camera, shared::uint2 seed, std::uint32_t pass, const Paths& paths,
             int cluster, const compute::Buffer<std::uint32_t>& pixels, std::uint32_t first, std::uint32_t count) {
    const shared::DeviceViewLaunch launch{seed,
                                          pass,
                                          paths.before,
                                          paths.before_in_half,
                                          paths.count,
                                          cluster,
                                          static_cast<int>(world_.tables.objects.size()),
                                          first,
                                          count};
    world_.queue(view_, std::max(count, 1u), 64,
                 {{"points", points_}, {"camera", camera}, {"pixels", pixels}, {"launch", launch}});
  }

private:
  /// Of both the first, and the others of the second.
  static compute::Defines joined(compute::Defines first, const compute::Defines& second) {
    first.insert(second.begin(), second.end());
    return first;
  }

  /// About as many points as make work for a slice.
  static std::size_t point_count(const shared::DeviceCamera& camera) {
    return std::min<std::size_t>(1 << 16,
                                 static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  }

  StageContext& world_;
  std::uint32_t begin_, size_; ///< range of the pixels in StageContext::pixels
  compute::Buffer<shared::VisiblePoint> points_;
  compute::Kernel view_;
  tracing::PixelSlices slices_;
};

} // namespace nephroid::photons
