// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/trace.cl, the traversal of kernels/tracing/bvh.h, over a list of rays: for checks, tests and benchmarks.
#pragma once
#include "compute/compute.h"
#include "scene/bvh.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::check {

inline constexpr std::uint32_t no_primitive = 0xFFFFFFFF;

struct Ray {
  glm::vec3 origin{0};
  float t_max = std::numeric_limits<float>::infinity();
  glm::vec3 direction{0, 0, 1};
  std::uint32_t skip = no_primitive;
};

/// As in kernels/tracing/trace.cl.
struct DeviceHit {
  float t = 0, u = 0, v = 0;
  std::uint32_t primitive = no_primitive;
};
using Hit = DeviceHit;

/// As in kernels/tracing/trace.cl.
struct DeviceRay {
  float origin[3];
  float t_max;
  float direction[3];
  std::uint32_t skip;
};
static_assert(sizeof(Hit) == 16 && sizeof(DeviceRay) == 32);

/// A mesh's tree on the device.
class KernelTracer {
public:
  KernelTracer(const compute::Context& context, const scene::Mesh& mesh) : KernelTracer(context, scene::build_bvh(mesh)) {}
  KernelTracer(const compute::Context& context, const scene::Bvh& bvh, compute::Defines defines = {});

  std::vector<Hit> closest(const std::vector<Ray>& rays);
  std::vector<std::uint32_t> any(const std::vector<Ray>& rays); ///< not 0: something is hit

  /// For timing: the rays stay on the device, a run waits for its end.
  void set_rays(const std::vector<Ray>& rays);
  void run_closest();
  void run_any();
  const scene::Bvh& bvh() const { return bvh_; }

private:
  scene::Bvh bvh_;
  compute::Context context_;
  compute::Buffer<float> nodes_, blocks_;
  compute::Kernel closest_, any_;
  compute::Buffer<DeviceRay> rays_;
  compute::Buffer<Hit> hits_;
  compute::Buffer<std::uint32_t> found_;
};

} // namespace nephroid::check
