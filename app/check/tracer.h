// SPDX-License-Identifier: Apache-2.0
// Runs kernels/tracing/bvh.h over a list of rays (trace.cl), for checks, tests and benchmarks; and a ray against every
// triangle in double precision, which judges where two tracers differ.
#pragma once
#include "compute/compute.h"
#include "scene/bvh.h"
#include "scene/mesh.h"

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

/// The struct of kernels/tracing/trace.cl.
struct DeviceHit {
  float t = 0, u = 0, v = 0;
  std::uint32_t primitive = no_primitive;
};
using Hit = DeviceHit;

/// The struct of kernels/tracing/trace.cl.
struct DeviceRay {
  float origin[3];
  float t_max;
  float direction[3];
  std::uint32_t skip;
};
static_assert(sizeof(Hit) == 16 && sizeof(DeviceRay) == 32);

/// Traces rays through a mesh's tree on the device.
class KernelTracer {
public:
  KernelTracer(const compute::Context& context, const scene::Mesh& mesh)
      : KernelTracer(context, scene::build_bvh(mesh)) {}
  KernelTracer(const compute::Context& context, const scene::Bvh& bvh, compute::Defines defines = {});

  std::vector<Hit> closest(const std::vector<Ray>& rays);
  std::vector<std::uint32_t> any(const std::vector<Ray>& rays); ///< not 0: the ray hits something

  /// For timing: the rays stay on the device, and each run waits for its end.
  void set_rays(const std::vector<Ray>& rays);
  void run_closest();
  void run_any();
  const scene::Bvh& bvh() const { return bvh_; }

private:
  void run(compute::Kernel& kernel, const compute::Argument& answers);

  scene::Bvh bvh_;
  compute::Context context_;
  compute::Buffer<float> nodes_, blocks_;
  compute::Kernel closest_, any_;
  compute::Buffer<DeviceRay> rays_;
  compute::Buffer<Hit> hits_;
  compute::Buffer<std::uint32_t> found_;
};

/// The point at which a ray's line meets a triangle's plane.
struct Exact {
  double t = -1;
  double margin = -1; ///< how far the line passes from the nearest edge's line, in lengths: positive inside
  double tilt = 0;    ///< cosine between direction and normal: an error e of the coordinates moves t by e / tilt
};

enum class Verdict { same, tie, edge, start, wrong };

/// Judges a tracer's answers for one mesh, which must outlive it.
class Judge {
public:
  /// tolerance: the rounding error of the longest distance between a ray's origin and a vertex.
  Judge(const scene::Mesh& mesh, double tolerance);

  Exact exact(const Ray& ray, std::uint32_t primitive) const;

  /// The closest hit, by testing every triangle; u and v stay 0. Of hits at one distance the lowest triangle counts.
  Hit closest(const Ray& ray) const;

  /// Whether `ours` is a right answer. Same: it equals `theirs`. Tie: both are at one distance. Edge: rounding decides
  /// on which side of an edge the ray passes. Start: they differ in a triangle that the ray starts on.
  Verdict judge(const Ray& ray, const Hit& ours, const Hit& theirs) const;

private:
  std::vector<std::uint32_t> candidates(const Ray& ray) const;

  const scene::Mesh& mesh_;
  double tolerance_;
  double longest_edge_ = 0;
  std::vector<double> x_, y_, z_; ///< coordinates of the first vertices
};

} // namespace nephroid::check
