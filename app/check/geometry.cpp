// SPDX-License-Identifier: Apache-2.0
// The traversal of kernels/tracing/bvh.h against every triangle in double precision. Where a ray passes an edge within
// the rounding of coordinates either side is right; nothing else may differ.
#include "check/check.h"
#include "check/tracer.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nephroid::check {
namespace {

constexpr std::size_t ray_count = 1 << 13;
/// The longest distance between an origin below and a vertex, and the spacing of floats there.
constexpr double reach = 5.5, rounding = 0x1p-24 * reach;

/// A rod of radius 1 with a brilliant in it, about 600 thin triangles.
scene::Mesh rod_and_brilliant() {
  scene::Mesh mesh =
      scene::make_shape({.type = preset::Shape::Type::cylinder, .radius = 1, .height = 2, .segments = 120});
  const scene::Mesh inner = scene::make_shape({.type = preset::Shape::Type::brilliant, .radius = 0.7});
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), inner.positions.begin(), inner.positions.end());
  for (const glm::uvec3& t : inner.triangles) mesh.triangles.push_back(t + first);
  mesh.normals.clear();
  return mesh;
}

glm::vec3 direction(std::mt19937_64& random) {
  std::normal_distribution<float> normal; // three of these give every direction the same likelihood
  const float x = normal(random), y = normal(random), z = normal(random);
  return glm::normalize(glm::vec3(x, y, z));
}

/// Rays from outside and inside towards the mesh. Some run along an axis, some end early.
std::vector<Ray> rays_towards_the_mesh(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(-0.9f, 0.9f);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < ray_count; ++i) {
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    const glm::vec3 to(x, y, z), from = direction(random) * (i % 2 ? 4.0f : 0.8f);
    Ray ray{.origin = from, .direction = glm::normalize(to - from)};
    if (i % 16 == 0) {
      const auto axis = static_cast<glm::length_t>(i / 16 % 3);
      ray.origin = to;
      ray.origin[axis] = i % 32 == 0 ? 4.0f : -4.0f;
      ray.direction = glm::vec3(0);
      ray.direction[axis] = i % 32 == 0 ? -1.0f : 1.0f;
    }
    if (i % 16 == 1) ray.t_max = 3.2f + uniform(random);
    rays.push_back(ray);
  }
  return rays;
}

/// The mesh, the rays of one seed and their hits. Some rays skip the triangle that they would hit.
struct Rays {
  scene::Mesh mesh = rod_and_brilliant();
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  explicit Rays(const compute::Context& context, std::uint64_t seed) : rays(rays_towards_the_mesh(seed)) {
    KernelTracer tracer(context, mesh);
    hits = tracer.closest(rays);
    for (std::size_t i = 0; i < rays.size(); i += 8) rays[i].skip = hits[i].primitive;
    hits = tracer.closest(rays);
  }
};

Result closest_hits(const compute::Context& context, std::uint64_t seed) {
  const Rays traced(context, seed);
  const Judge judge(traced.mesh, 8 * rounding);
  double wrong = 0;
  std::size_t hits = 0, differ = 0;
  for (std::size_t i = 0; i < traced.rays.size(); ++i) {
    const Hit truth = judge.closest(traced.rays[i]);
    wrong += judge.judge(traced.rays[i], traced.hits[i], truth) == Verdict::wrong;
    hits += truth.primitive != no_primitive;
    differ += traced.hits[i].primitive != truth.primitive;
  }
  return judged(
      wrong, 0, "rays",
      fmt::format(
          "{} rays at {} triangles, {} hits, {} decided otherwise than in double precision by rounding at an edge",
          traced.rays.size(), traced.mesh.triangles.size(), hits, differ - static_cast<std::size_t>(wrong)));
}

/// Compares t and the point (1 - u - v) a + u b + v c with where the ray's line meets the triangle's plane. In a thin
/// triangle, barycentrics are off by the coordinates' error over its height, the place by that times the longest edge.
Result hit_places(const compute::Context& context, std::uint64_t seed) {
  const Rays traced(context, seed);
  const Judge judge(traced.mesh, 8 * rounding);
  double worst = 0;
  for (std::size_t i = 0; i < traced.rays.size(); ++i) {
    const Hit& hit = traced.hits[i];
    if (hit.primitive == no_primitive) continue;
    const Exact exact = judge.exact(traced.rays[i], hit.primitive);
    worst = std::max(worst, std::abs(hit.t - exact.t) * exact.tilt);
    const glm::uvec3& corner = traced.mesh.triangles[hit.primitive];
    const glm::dvec3 a = traced.mesh.positions[corner.x], b = traced.mesh.positions[corner.y],
                     c = traced.mesh.positions[corner.z];
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const double height = glm::length(glm::cross(b - a, c - a)) / longest;
    const glm::dvec3 place = a + double(hit.u) * (b - a) + double(hit.v) * (c - a);
    const glm::dvec3 truth = glm::dvec3(traced.rays[i].origin) + exact.t * glm::dvec3(traced.rays[i].direction);
    worst = std::max(worst, glm::distance(place, truth) * exact.tilt * height / longest);
  }
  return judged(worst / rounding, 16, "roundings",
                "distance and barycentric place of every hit, times the cosine there, in float spacings of the "
                "farthest coordinate");
}

Result any_hits(const compute::Context& context, std::uint64_t seed) {
  const Rays traced(context, seed);
  const std::vector<std::uint32_t> any = KernelTracer(context, traced.mesh).any(traced.rays);
  double differ = 0;
  for (std::size_t i = 0; i < any.size(); ++i) differ += (any[i] != 0) != (traced.hits[i].primitive != no_primitive);
  return judged(
      differ, 0, "rays",
      fmt::format("of {} rays, those where \"is anything hit\" and \"what is hit first\" disagree", any.size()));
}

/// Rays from inside a closed mesh, aimed exactly at its vertices and at points of its edges, where a leak would be.
Result no_leaks(const compute::Context& context, std::uint64_t seed) {
  const scene::Mesh mesh = rod_and_brilliant();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < ray_count; ++i) {
    const glm::uvec3& t = mesh.triangles[random() % mesh.triangles.size()];
    const float along = i % 3 == 0 ? 0 : uniform(random);
    const glm::vec3 aim = mesh.positions[t.x] + along * (mesh.positions[i % 2 ? t.y : t.z] - mesh.positions[t.x]);
    const glm::vec3 from = 0.9f * uniform(random) * direction(random);
    rays.push_back({.origin = from, .direction = glm::normalize(aim - from)});
  }
  const std::vector<Hit> hits = KernelTracer(context, mesh).closest(rays);
  const auto escaped = std::ranges::count_if(hits, [](const Hit& h) { return h.primitive == no_primitive; });
  return judged(
      static_cast<double>(escaped), 0, "rays",
      fmt::format("of {} rays from inside at vertices and edges of a closed mesh, those that got out", rays.size()));
}

/// Ellipsoids hit from outside and inside. The truth is the plain quadratic in double; distances are along the normal.
Result ellipsoid_hits(const compute::Context& context, std::uint64_t seed) {
  scene::Mesh mesh;
  mesh.ellipsoids = {{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, false},
                     {{0.1f, 0, 0}, {{{0.3f, 0.4f, 0}, {-0.32f, 0.24f, 0}, {0, 0, 0.7f}}}, false}};
  const std::vector<Ray> rays = rays_towards_the_mesh(seed);
  const std::vector<Hit> hits = KernelTracer(context, mesh).closest(rays);
  double worst = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::dvec3 o(rays[i].origin), d(rays[i].direction);
    double nearest = rays[i].t_max, steepness = 0;
    for (const scene::Ellipsoid& ellipsoid : mesh.ellipsoids) {
      double a = 0, b = 0, c = -1;
      for (const glm::dvec3& row : to_unit_sphere(ellipsoid)) {
        const double along = glm::dot(row, d), from = glm::dot(row, o - glm::dvec3(ellipsoid.centre));
        a += along * along, b += along * from, c += from * from;
      }
      const double root = std::sqrt(b * b - a * c);
      for (const double t : {(-b - root) / a, (-b + root) / a})
        if (t > 0 && t < nearest) nearest = t, steepness = std::abs(glm::dot(d, normal_at(ellipsoid, o + t * d)));
    }
    if (steepness > 0 && steepness < 0.01) continue; // rounding decides whether the ray hits
    const bool hit = hits[i].primitive != no_primitive;
    worst = std::max(worst, hit != (steepness > 0) ? INFINITY : hit ? std::abs(hits[i].t - nearest) * steepness : 0.0);
  }
  return judged(worst / rounding, 16, "roundings",
                "distance of every hit of a sphere and an ellipsoid, times the cosine there, in float spacings of the "
                "farthest coordinate");
}

} // namespace

Checks geometry_checks() {
  return {{"rays: closest hits", closest_hits},
          {"rays: distance and place of hits", hit_places},
          {"rays: any hit", any_hits},
          {"rays: spheres and ellipsoids", ellipsoid_hits},
          {"rays: no gap between triangles", no_leaks}};
}

} // namespace nephroid::check
