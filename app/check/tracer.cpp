// SPDX-License-Identifier: Apache-2.0
#include "check/tracer.h"

#include <algorithm>
#include <cmath>

namespace nephroid::check {

KernelTracer::KernelTracer(const compute::Context& context, const scene::Bvh& bvh, compute::Defines defines)
    : bvh_(bvh), context_(context), nodes_(context, "nodes", std::span(bvh.nodes)),
      blocks_(context, "blocks", std::span(bvh.blocks)) {
  defines.merge(scene::tree_defines(bvh));
  const compute::Program program(context, "tracing/trace.cl", defines);
  closest_ = program.kernel("closest_hits");
  any_ = program.kernel("any_hits");
}

void KernelTracer::set_rays(const std::vector<Ray>& rays) {
  std::vector<DeviceRay> packed;
  for (const Ray& r : rays)
    packed.push_back(
        {{r.origin.x, r.origin.y, r.origin.z}, r.t_max, {r.direction.x, r.direction.y, r.direction.z}, r.skip});
  rays_ = {context_, "rays", packed};
  hits_ = {context_, "hits", rays.size()};
  found_ = {context_, "found", rays.size()};
}

void KernelTracer::run(compute::Kernel& kernel, const compute::Argument& answers) {
  const auto count = static_cast<std::uint32_t>(rays_.size());
  kernel.run(count, 64,
             {{"nodes", nodes_}, {"blocks", blocks_}, {"root", bvh_.root}, {"rays", rays_}, {"count", count}, answers});
  context_.finish();
}

void KernelTracer::run_closest() { run(closest_, {"hits", hits_}); }

void KernelTracer::run_any() { run(any_, {"hit", found_}); }

std::vector<Hit> KernelTracer::closest(const std::vector<Ray>& rays) {
  set_rays(rays);
  run_closest();
  return hits_.read();
}

std::vector<std::uint32_t> KernelTracer::any(const std::vector<Ray>& rays) {
  set_rays(rays);
  run_any();
  return found_.read();
}

Judge::Judge(const scene::Mesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x];
    x_.push_back(a.x), y_.push_back(a.y), z_.push_back(a.z);
    for (const std::uint32_t corner : {t.y, t.z})
      longest_edge_ = std::max(longest_edge_, glm::distance(a, glm::dvec3(mesh.positions[corner])));
  }
}

Exact Judge::exact(const Ray& ray, std::uint32_t primitive) const {
  const glm::uvec3& corners = mesh_.triangles[primitive];
  const glm::dvec3 p[3] = {mesh_.positions[corners.x], mesh_.positions[corners.y], mesh_.positions[corners.z]};
  const glm::dvec3 o(ray.origin), d(ray.direction), area = glm::cross(p[1] - p[0], p[2] - p[0]);
  Exact result;
  if (glm::length(area) == 0) return result;
  const glm::dvec3 normal = glm::normalize(area);
  result.tilt = std::abs(glm::dot(normal, d)) / glm::length(d);
  if (result.tilt < 1e-9) return result;
  result.t = glm::dot(p[0] - o, normal) / glm::dot(d, normal);
  result.margin = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 across = glm::cross(p[(i + 1) % 3] - p[i], d);
    const double side = glm::dot(across, p[i] - o) * (glm::dot(area, d) > 0 ? 1 : -1);
    result.margin = std::min(result.margin, side / glm::length(across));
  }
  return result;
}

Hit Judge::closest(const Ray& ray) const {
  Hit hit;
  double nearest = ray.t_max;
  for (const std::uint32_t i : candidates(ray)) {
    if (i == ray.skip) continue;
    const Exact e = exact(ray, i);
    if (e.margin < 0 || e.t <= 0 || e.t > nearest || (e.t == nearest && hit.primitive != no_primitive)) continue;
    nearest = e.t;
    hit.primitive = i;
  }
  hit.t = static_cast<float>(nearest);
  return hit;
}

Verdict Judge::judge(const Ray& ray, const Hit& ours, const Hit& theirs) const {
  if (ours.primitive == no_primitive && theirs.primitive == no_primitive) return Verdict::same;
  Verdict verdict = Verdict::tie;
  double limit = ray.t_max;
  if (ours.primitive != no_primitive) {
    const Exact hit = exact(ray, ours.primitive);
    if (ours.primitive == ray.skip || ours.t > ray.t_max) return Verdict::wrong;
    if (hit.margin < -tolerance_ || std::abs(ours.t - hit.t) * hit.tilt > tolerance_) return Verdict::wrong;
    if (ours.primitive == theirs.primitive) return Verdict::same;
    if (hit.margin <= tolerance_) verdict = Verdict::edge;
    limit = hit.t;
  }
  // The ray must pass every nearer triangle at an edge, or start on it.
  for (const std::uint32_t i : candidates(ray)) {
    if (i == ours.primitive || i == ray.skip) continue;
    const Exact hit = exact(ray, i);
    if (hit.t * hit.tilt < -tolerance_ || hit.margin < -tolerance_ || (limit - hit.t) * hit.tilt <= tolerance_)
      continue;
    if (hit.t * hit.tilt <= tolerance_)
      verdict = Verdict::start;
    else if (hit.margin <= tolerance_)
      verdict = Verdict::edge;
    else
      return Verdict::wrong;
  }
  return verdict;
}

/// Triangles near the ray's line: their first vertex is within the longest edge of it.
std::vector<std::uint32_t> Judge::candidates(const Ray& ray) const {
  const glm::dvec3 o(ray.origin), d = glm::normalize(glm::dvec3(ray.direction));
  const double reach = (longest_edge_ + tolerance_) * (longest_edge_ + tolerance_);
  std::vector<std::uint32_t> near;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double px = x_[i] - o.x, py = y_[i] - o.y, pz = z_[i] - o.z, along = px * d.x + py * d.y + pz * d.z;
    if (px * px + py * py + pz * pz - along * along <= reach) near.push_back(static_cast<std::uint32_t>(i));
  }
  return near;
}

} // namespace nephroid::check
