// SPDX-License-Identifier: Apache-2.0
// Ray against triangle in double precision, over every triangle of a mesh: who is right where two tracers differ.
#pragma once
#include "check/tracer.h"
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace nephroid::check {

/// Where a ray's line meets a triangle's plane.
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

  /// The closest hit by asking every triangle; u and v are left 0. Of hits at one distance the lowest triangle.
  Hit closest(const Ray& ray) const;

  /// Whether `ours` is a right answer. Same: as theirs. Tie: both at one distance. Edge: the ray passes an edge so closely that
  /// the rounding of coordinates decides on which side. Start: they differ on a triangle that the ray starts on.
  /// A ray's `skip` and `t_max` count.
  Verdict judge(const Ray& ray, const Hit& ours, const Hit& theirs) const;

private:
  std::vector<std::uint32_t> candidates(const Ray& ray) const;

  const scene::Mesh& mesh_;
  double tolerance_;
  double longest_edge_ = 0;
  std::vector<double> x_, y_, z_; ///< first vertices
};

} // namespace nephroid::check
