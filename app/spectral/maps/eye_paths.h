// SPDX-License-Identifier: Apache-2.0
// Paths from the eye in steps of some rows: kernels/spectral/view.cl finds where they end, the caller gathers photons there.
#pragma once
#include "kernels/spectral/photon_map_types.h"
#include "spectral/tables/device_world.h"
#include "tracing/pixel_rows.h"

#include <algorithm>
#include <cstdint>

namespace nephroid::spectral {

class EyePaths {
public:
  /// paths: for each pixel in a pass, at least 1.
  EyePaths(DeviceWorld& world, std::uint32_t paths)
      : world_(world), paths_(paths), points_(world.context, "visible points", point_count(world.tables.camera)),
        view_(compute::Program(world.context, "spectral/view.cl", world.defines).kernel("view")), rows_(world.tables.camera.height)
  {
  }
  /// What it takes on the device.
  static std::uint64_t bytes(const shared::DeviceCamera& camera) { return point_count(camera) * sizeof(shared::VisiblePoint); }

  /// The paths of every pixel of the next rows, one after the other: gather(points, first_pixel, count) queues kernels for each. cluster:
  /// see view.cl. True when all rows are done.
  template <class Gather>
  bool step(shared::uint2 seed, std::uint32_t pass, int cluster, const Gather& gather)
  {
    const auto width = static_cast<std::uint32_t>(world_.tables.camera.width);
    return rows_.step(static_cast<std::int64_t>(points_.size() / width), [&](int first_row, int rows) {
      const std::uint32_t first_pixel = static_cast<std::uint32_t>(first_row) * width, count = static_cast<std::uint32_t>(rows) * width;
      for (std::uint32_t path = 0; path < paths_; ++path) {
        look({seed, pass, path, paths_, cluster, first_row, rows}, count);
        gather(points_, first_pixel, count);
      }
      world_.context.finish();
    });
  }

  /// Stage::warm_up for its kernel.
  void warm_up() { look({world_.seed, 0, 0, 1, 0, 0, 0}, 1); }
  const compute::Buffer<shared::VisiblePoint>& points() const { return points_; }

  const tracing::PixelRows& rows() const { return rows_; }

  void save(tracing::StateWriter& to) const { rows_.save(to); }
  void load(tracing::StateReader& from) { rows_.load(from); }

private:
  /// Which paths a launch of view.cl has.
  struct Look {
    shared::uint2 seed{};
    std::uint32_t pass = 0, path = 0, paths = 1;
    int cluster = 0, first_row = 0, rows = 0;
  };
  void look(const Look& at, std::uint32_t items)
  {
    world_.run(view_, items, 64,
               {{"cluster_cdf", world_.buffers.cluster_cdf},
                {"points", points_},
                {"camera", world_.tables.camera},
                {"seed", at.seed},
                {"pass", at.pass},
                {"path_number", at.path},
                {"path_count", at.paths},
                {"cluster", at.cluster},
                {"object_count", static_cast<int>(world_.tables.objects.size())},
                {"first_row", at.first_row},
                {"row_count", at.rows}});
  }

  /// Whole rows, of at least one and about as many pixels as make work for a step.
  static std::size_t point_count(const shared::DeviceCamera& camera)
  {
    const auto width = static_cast<std::size_t>(camera.width);
    return width * std::clamp<std::size_t>((1 << 16) / width, 1, static_cast<std::size_t>(camera.height));
  }

  DeviceWorld& world_;
  std::uint32_t paths_;
  compute::Buffer<shared::VisiblePoint> points_;
  compute::Kernel view_;
  tracing::PixelRows rows_;
};

} // namespace nephroid::spectral
