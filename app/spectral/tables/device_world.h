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
#include <initializer_list>
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

  /// Runs a kernel that has WORLD_ARGUMENTS (kernels/tracing/world.h) beside its `own`, and waits for it.
  void run(compute::Kernel& kernel, std::size_t global, std::size_t local, std::initializer_list<compute::Argument> own)
  {
    const DeviceBuffers& b = buffers;
    const compute::Argument world[] = {{"nodes", b.nodes},
                                       {"blocks", b.blocks},
                                       {"corners", b.corners},
                                       {"positions", b.positions},
                                       {"normals", b.normals},
                                       {"object_of_triangle", b.object_of_triangle},
                                       {"objects", b.objects},
                                       {"materials", b.materials},
                                       {"lights", b.lights},
                                       {"index_of_cluster", b.index_of_cluster},
                                       {"index_of_wavelength", b.index_of_wavelength},
                                       {"wavelength_cdf", b.wavelength_cdf},
                                       {"index_slope", b.index_slope},
                                       {"stretch_place", b.stretch_place},
                                       {"stretch_span", b.stretch_span},
                                       {"reflected_xyz", b.reflected_xyz},
                                       {"cluster_first", b.cluster_first},
                                       {"cluster_wavelengths", b.cluster_wavelengths},
                                       {"coefficient", b.coefficient},
                                       {"light_xyz", b.light_xyz},
                                       {"reflectance", b.reflectance},
                                       {"reflector_count", tables.wavelengths.reflector_count},
                                       {"scene", tables.scene}};
    kernel.run(global, local, world, own);
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
  void run_photons(compute::Kernel& kernel, std::uint32_t count, std::initializer_list<compute::Argument> own)
  {
    run(kernel, std::max(1u, (count + photons_per_item() - 1) / photons_per_item()), 32, own);
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
