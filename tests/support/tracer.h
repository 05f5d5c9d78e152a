// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/trace.cl and Embree behind the same two structs, for tests and benchmarks that compare them.
#pragma once
#include "check/tracer.h"
#include "tests/support/standard.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace nephroid::test {

using check::Hit;
using check::KernelTracer;
using check::no_primitive;
using check::Ray;

/// Embree's own tracer over the same mesh.
class EmbreeTracer {
public:
  EmbreeTracer(const scene::Mesh& mesh, RTCSceneFlags flags)
      : device_(rtcNewDevice(settings)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, flags);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             mesh.positions.size());
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(vertices));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                              mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<glm::uvec3*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeTracer() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  /// Safe from several threads.
  Hit closest(const Ray& ray) const {
    RTCRayHit query = {};
    query.ray = {ray.origin.x,
                 ray.origin.y,
                 ray.origin.z,
                 0,
                 ray.direction.x,
                 ray.direction.y,
                 ray.direction.z,
                 0,
                 ray.t_max,
                 ~0u,
                 0,
                 0};
    query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
#endif
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
