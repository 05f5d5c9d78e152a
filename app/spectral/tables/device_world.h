// SPDX-License-Identifier: Apache-2.0
// What the stages of a job share: the device, the scene on it, the seed, the energy counters, and how kernels are run in that scene.
#pragma once
#include "compute/compute.h"
#include "preset/preset.h"
#include "spectral/tables/device_buffers.h"
#include "spectral/tables/device_scene.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace nephroid::spectral {

struct DeviceWorld {
  compute::Context context;
  DeviceTables tables;
  DeviceBuffers buffers;
  compute::Defines defines; ///< of the plan, for every kernel
  shared::uint2 seed{};
  double white = 1;
  unsigned halves = 2;                  ///< of a film: 2 where the error is estimated (film.h)
  compute::Buffer<std::int64_t> energy; ///< [OUTCOME_COUNT] quanta

  /// The number of 64-bit sums of a film of XYZ.
  std::size_t film_size() const
  {
    return std::size_t{3} * halves * static_cast<std::size_t>(tables.camera.width) * static_cast<std::size_t>(tables.camera.height);
  }
  compute::Buffer<std::int64_t> zeroed(const std::string& name, std::size_t count) const
  {
    compute::Buffer<std::int64_t> buffer(context, name, count);
    buffer.fill_zero();
    return buffer;
  }
  /// A scale for powers as the device knows them.
  float on_device(double scale) const { return static_cast<float>(scale * tables.power_unit); }

  /// Runs a kernel whose arguments begin with WORLD_ARGUMENTS (kernels/tracing/world.h), and waits for it.
  template <class... Rest>
  void run(compute::Kernel& kernel, std::size_t global, std::size_t local, const Rest&... rest)
  {
    const DeviceBuffers& b = buffers;
    kernel.run(global, local, b.nodes, b.blocks, b.corners, b.positions, b.normals, b.object_of_triangle, b.objects, b.materials, b.lights,
               b.index_of_cluster, b.index_of_wavelength, b.wavelength_cdf, b.index_slope, b.stretch_place, b.stretch_span, b.reflected_xyz,
               b.cluster_first, b.cluster_wavelengths, b.coefficient, b.light_xyz, b.reflectance, tables.wavelengths.reflector_count,
               tables.scene, rest...);
    context.finish();
  }

  /// Photons that one work item follows, one after the other, so that what an item adds up for itself is worth while: on a CPU.
  unsigned photons_per_item() const { return context.device().type == "cpu" ? 16 : 1; }
  /// For a kernel that run_photons runs.
  compute::Defines photon_defines() const
  {
    compute::Defines all = defines;
    all["NEPHROID_PHOTONS_PER_ITEM"] = std::to_string(photons_per_item());
    return all;
  }
  /// As run, with items for `count` photons, and one at least.
  template <class... Rest>
  void run_photons(compute::Kernel& kernel, std::uint32_t count, const Rest&... rest)
  {
    run(kernel, std::max(1u, (count + photons_per_item() - 1) / photons_per_item()), 32, rest...);
  }
};

/// How much work fits into a step, learned from the steps before.
class StepSize {
public:
  explicit StepSize(double start) : amount_(start) {}
  double amount() const { return amount_; }
  /// Calls work(), which does `amount` of it, and learns from the time it took: by little at a time, because the first step of a kernel
  /// also compiles it, and the rows of a picture differ.
  template <class Work>
  void timed(double amount, const Work& work)
  {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    work();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    amount_ = std::clamp(amount * step_seconds / std::max(seconds, 1e-6), 0.25 * amount_, 1.5 * amount_);
  }

private:
  static constexpr double step_seconds = 0.05;
  double amount_;
};

} // namespace nephroid::spectral
