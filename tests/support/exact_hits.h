// SPDX-License-Identifier: Apache-2.0
// Ray against triangle in double precision, over every triangle of a mesh: who is right where two tracers differ.
#pragma once
#include "tests/support/tracer.h"

#include <algorithm>
#include <cmath>

namespace nephroid::test {

/// Where a ray's line meets a triangle's plane.
struct Exact {
  double t = -1;
  double margin = -1; ///< how far the line passes from the nearest edge's line, in lengths: positive inside
  double tilt = 0;    ///< cosine between direction and normal: an error e of the coordinates moves t by e / tilt
};

enum class Verdict { same, tie, edge, start, wrong };

/// Judges a tracer's answers for one mesh.
class Judge {
public:
  /// tolerance: the rounding error of the longest distance between a ray's origin and a vertex.
  Judge(const scene::Mesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance)
  {
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = mesh.positions[t.x];
      x_.push_back(a.x), y_.push_back(a.y), z_.push_back(a.z);
      for (const std::uint32_t corner : {t.y, t.z})
        longest_edge_ = std::max(longest_edge_, glm::distance(a, glm::dvec3(mesh.positions[corner])));
    }
  }

  Exact exact(const Ray& ray, std::uint32_t primitive) const
  {
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

  /// Whether `ours` is a right answer. Same: as theirs. Tie: both at one distance. Edge: the ray passes an edge so closely that
  /// the rounding of coordinates decides on which side. Start: they differ on a triangle that the ray starts on.
  Verdict judge(const Ray& ray, const Hit& ours, const Hit& theirs) const
  {
    if (ours.primitive == no_primitive && theirs.primitive == no_primitive) return Verdict::same;
    Verdict verdict = Verdict::tie;
    double limit = std::numeric_limits<double>::infinity();
    if (ours.primitive != no_primitive) {
      const Exact hit = exact(ray, ours.primitive);
      if (hit.margin < -tolerance_ || std::abs(ours.t - hit.t) * hit.tilt > tolerance_) return Verdict::wrong;
      if (ours.primitive == theirs.primitive) return Verdict::same;
      if (hit.margin <= tolerance_) verdict = Verdict::edge;
      limit = hit.t;
    }
    // Every triangle before ours must be passed at an edge or be where the ray starts.
    for (const std::uint32_t i : candidates(ray)) {
      if (i == ours.primitive) continue;
      const Exact hit = exact(ray, i);
      if (hit.t * hit.tilt < -tolerance_ || hit.margin < -tolerance_ || (limit - hit.t) * hit.tilt <= tolerance_) continue;
      if (hit.t * hit.tilt <= tolerance_)
        verdict = Verdict::start;
      else if (hit.margin <= tolerance_)
        verdict = Verdict::edge;
      else
        return Verdict::wrong;
    }
    return verdict;
  }

private:
  /// Triangles that come near the ray's line: those whose first vertex is within the longest edge of it.
  std::vector<std::uint32_t> candidates(const Ray& ray) const
  {
    const glm::dvec3 o(ray.origin), d = glm::normalize(glm::dvec3(ray.direction));
    const double reach = (longest_edge_ + tolerance_) * (longest_edge_ + tolerance_);
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double px = x_[i] - o.x, py = y_[i] - o.y, pz = z_[i] - o.z, along = px * d.x + py * d.y + pz * d.z;
      if (px * px + py * py + pz * pz - along * along <= reach) near.push_back(static_cast<std::uint32_t>(i));
    }
    return near;
  }

  const scene::Mesh& mesh_;
  double tolerance_;
  double longest_edge_ = 0;
  std::vector<double> x_, y_, z_; ///< first vertices
};

} // namespace nephroid::test
