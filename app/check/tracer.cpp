// SPDX-License-Identifier: Apache-2.0
#include "check/tracer.h"

#include <string>

namespace nephroid::check {
namespace {

constexpr std::size_t local_size = 64;

} // namespace

KernelTracer::KernelTracer(const compute::Context& context, const scene::Bvh& bvh, compute::Defines defines)
    : bvh_(bvh), context_(context), nodes_(context, "nodes", std::span(bvh.nodes)), blocks_(context, "blocks", std::span(bvh.blocks))
{
  defines["NEPHROID_ELLIPSOIDS"] = std::to_string(int(!bvh.ellipsoid_places.empty()));
  defines["NEPHROID_BVH_STACK"] = std::to_string(bvh.stack);
  const compute::Program program(context, "tracing/trace.cl", defines);
  closest_ = program.kernel("closest_hits");
  any_ = program.kernel("any_hits");
}

void KernelTracer::set_rays(const std::vector<Ray>& rays)
{
  std::vector<DeviceRay> packed;
  for (const Ray& r : rays)
    packed.push_back({{r.origin.x, r.origin.y, r.origin.z}, r.t_max, {r.direction.x, r.direction.y, r.direction.z}, r.skip});
  rays_ = {context_, "rays", std::span<const DeviceRay>(packed)};
  hits_ = {context_, "hits", rays.size()};
  found_ = {context_, "found", rays.size()};
}

void KernelTracer::run_closest()
{
  closest_.run(rays_.size(), local_size,
               {{"nodes", nodes_},
                {"blocks", blocks_},
                {"root", bvh_.root},
                {"rays", rays_},
                {"hits", hits_},
                {"count", static_cast<std::uint32_t>(rays_.size())}});
  context_.finish();
}

void KernelTracer::run_any()
{
  any_.run(rays_.size(), local_size,
           {{"nodes", nodes_},
            {"blocks", blocks_},
            {"root", bvh_.root},
            {"rays", rays_},
            {"hit", found_},
            {"count", static_cast<std::uint32_t>(rays_.size())}});
  context_.finish();
}

std::vector<Hit> KernelTracer::closest(const std::vector<Ray>& rays)
{
  set_rays(rays);
  run_closest();
  return hits_.read();
}

std::vector<std::uint32_t> KernelTracer::any(const std::vector<Ray>& rays)
{
  set_rays(rays);
  run_any();
  return found_.read();
}

} // namespace nephroid::check
