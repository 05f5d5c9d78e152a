// SPDX-License-Identifier: Apache-2.0
// kernels/trace.cl and Embree behind the same two structs, for tests and benchmarks that compare them.
#pragma once
#include "base/error.h"
#include "compute/compute.h"
#include "scene/bvh.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nephroid::test {

constexpr std::uint32_t no_primitive = 0xFFFFFFFF;

struct Ray {
  glm::vec3 origin{0};
  float t_max = std::numeric_limits<float>::infinity();
  glm::vec3 direction{0, 0, 1};
  std::uint32_t skip = no_primitive;
};

/// As in kernels/trace.cl.
struct DeviceRay {
  float origin[3];
  float t_max;
  float direction[3];
  std::uint32_t skip;
};

/// As in kernels/bvh.h.
struct Hit {
  float t = 0, u = 0, v = 0;
  std::uint32_t primitive = no_primitive;
};
static_assert(sizeof(Hit) == 16);

/// A mesh's tree on the device.
class KernelTracer {
public:
  KernelTracer(const compute::Context& context, const scene::Mesh& mesh) : KernelTracer(context, scene::build_bvh(mesh)) {}
  KernelTracer(const compute::Context& context, const scene::Bvh& bvh, compute::Defines defines = {})
      : bvh_(bvh), context_(context), nodes_(context, "nodes", std::span(bvh.nodes)), blocks_(context, "blocks", std::span(bvh.blocks))
  {
    defines["NEPHROID_BVH_STACK"] = std::to_string(bvh.stack);
    const compute::Program program(context, "trace.cl", defines);
    closest_ = program.kernel("closest_hits");
    any_ = program.kernel("any_hits");
  }

  void set_rays(const std::vector<Ray>& rays)
  {
    std::vector<DeviceRay> packed;
    for (const Ray& r : rays)
      packed.push_back({{r.origin.x, r.origin.y, r.origin.z}, r.t_max, {r.direction.x, r.direction.y, r.direction.z}, r.skip});
    rays_ = {context_, "rays", std::span<const DeviceRay>(packed)};
    hits_ = {context_, "hits", rays.size()};
    found_ = {context_, "found", rays.size()};
  }
  void run_closest() { closest_.run(rays_.size(), local_size, nodes_, blocks_, bvh_.root, rays_, hits_, count()), context_.finish(); }
  void run_any() { any_.run(rays_.size(), local_size, nodes_, blocks_, bvh_.root, rays_, found_, count()), context_.finish(); }

  std::vector<Hit> closest(const std::vector<Ray>& rays)
  {
    set_rays(rays);
    run_closest();
    return hits_.read();
  }
  std::vector<std::uint32_t> any(const std::vector<Ray>& rays)
  {
    set_rays(rays);
    run_any();
    return found_.read();
  }
  const scene::Bvh& bvh() const { return bvh_; }

private:
  static constexpr std::size_t local_size = 64;
  std::uint32_t count() const { return static_cast<std::uint32_t>(rays_.size()); }

  scene::Bvh bvh_;
  compute::Context context_;
  compute::Buffer<float> nodes_, blocks_;
  compute::Kernel closest_, any_;
  compute::Buffer<DeviceRay> rays_;
  compute::Buffer<Hit> hits_;
  compute::Buffer<std::uint32_t> found_;
};

/// Embree's own tracer over the same mesh.
class EmbreeTracer {
public:
  EmbreeTracer(const scene::Mesh& mesh, RTCSceneFlags flags) : device_(rtcNewDevice(settings)), scene_(rtcNewScene(device_))
  {
    rtcSetSceneFlags(scene_, flags);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size());
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(vertices));
    void* triangles =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<glm::uvec3*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeTracer()
  {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  /// Safe from several threads.
  Hit closest(const Ray& ray) const
  {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query = {};
    query.ray = {ray.origin.x, ray.origin.y, ray.origin.z, 0, ray.direction.x, ray.direction.y, ray.direction.z, 0, ray.t_max, ~0u, 0, 0};
    query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return {query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
  }

private:
#ifdef __SANITIZE_THREAD__
  static constexpr const char* settings = "threads=1"; // as in scene/bvh.cpp
#else
  static constexpr const char* settings = nullptr;
#endif
  RTCDevice device_;
  RTCScene scene_;
};

} // namespace nephroid::test
