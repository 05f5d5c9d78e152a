// SPDX-License-Identifier: Apache-2.0
// Spheres and ellipsoids of kernels/tracing/bvh.h, and of the host's rays, against the plain quadratic in long double.
#include "check/tracer.h"
#include "scene/bvh.h"
#include "scene/ray.h"
#include "tests/support/ellipsoids.h"
#include "tests/support/meshes.h"
#include "tests/support/test_kernels.h"

#include <glm/gtc/matrix_transform.hpp>

namespace nephroid::ellipsoid_test {

using namespace check;

constexpr double inf = std::numeric_limits<double>::infinity();

/// Half axes of these lengths, turned somehow.
scene::Ellipsoid turned(const glm::vec3& centre, const glm::dvec3& lengths) {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(1, -2, 0.5));
  scene::Ellipsoid ellipsoid{centre, {}, false};
  for (glm::length_t i = 0; i < 3; ++i)
    ellipsoid.half_axes[static_cast<std::size_t>(i)] = lengths[i] * glm::dvec3(turn[i]);
  return ellipsoid;
}

/// A point of the ball that the ellipsoid is an image of, `reach` of the way to the surface.
glm::dvec3 inner_point(const scene::Ellipsoid& e, std::mt19937& random, double reach) {
  const glm::dvec3 u = reach * glm::dvec3(random_direction(random));
  return glm::dvec3(e.centre) + u.x * glm::dvec3(e.half_axes[0]) + u.y * glm::dvec3(e.half_axes[1]) +
         u.z * glm::dvec3(e.half_axes[2]);
}

enum class From { outside, inside, surface };

/// Rays that meet the ellipsoid: from `distance` half axes away, from inside of it, or from its surface inwards.
std::vector<Ray> rays_at(const scene::Ellipsoid& e, From from, double distance, std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const double reach = std::cbrt(uniform(random));
    const glm::dvec3 to = inner_point(e, random, from == From::surface ? 0.9 * reach : reach);
    glm::dvec3 start = inner_point(e, random, from == From::surface ? 1 : 0.5 * uniform(random));
    if (from == From::outside)
      start = glm::dvec3(e.centre) + distance * longest_half_axis(e) * glm::dvec3(random_direction(random));
    Ray ray{.origin = glm::vec3(start), .direction = glm::vec3(glm::normalize(to - start))};
    if (from == From::surface) ray.skip = 0;
    rays.push_back(ray);
  }
  return rays;
}

struct EllipsoidCase {
  std::string name;
  scene::Ellipsoid ellipsoid;
  double distance;  ///< of rays from outside, in half axes
  double tolerance; ///< of the place on the surface, times the cosine there, in half axes
};

class EllipsoidRays : public testing::TestWithParam<EllipsoidCase> {};

// The error of a hit is that of the ray's coordinates over the cosine at the surface, not of the square of its
// distance, as it would be from the quadratic in single precision.
TEST_P(EllipsoidRays, MeetItWhereTheQuadraticSays) {
  const auto& [name, ellipsoid, distance, tolerance] = GetParam();
  scene::Mesh mesh{.ellipsoids = {ellipsoid}};
  const compute::Context context = compute::Context::open(device_options());
  KernelTracer tracer(context, mesh);
  const double size = longest_half_axis(ellipsoid);
  for (const From from : {From::outside, From::inside, From::surface}) {
    const std::vector<Ray> rays = rays_at(ellipsoid, from, distance, 20000);
    const std::vector<Hit> hits = tracer.closest(rays);
    const std::vector<std::uint32_t> any = tracer.any(rays);
    std::size_t wrong = 0, host_wrong = 0;
    double worst = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const glm::dvec3 o(rays[i].origin), d(rays[i].direction);
      const auto [near, far] = both_hits(ellipsoid, o, d);
      const double truth = from == From::outside && near > 0 ? near : far;
      const double cosine = std::abs(glm::dot(d, normal_at(ellipsoid, o + truth * d)));
      const auto host = scene::closest_hit(tracer.bvh(), o, d, {}, inf, rays[i].skip);
      const bool grazes = !(cosine > 1e-3); // which side it passes on is a matter of rounding
      if (grazes) continue;
      wrong += hits[i].primitive != 0 || any[i] == 0;
      // The rows of the matrix are rounded to single precision in the tree.
      host_wrong += !host || std::abs(host->t - truth) * cosine > 2e-6 * (size + std::abs(truth));
      if (hits[i].primitive == 0) worst = std::max(worst, std::abs(double(hits[i].t) - truth) * cosine);
    }
    EXPECT_EQ(wrong, 0u) << name;
    EXPECT_EQ(host_wrong, 0u) << name;
    const double limit = (from == From::outside ? tolerance : 4e-6) * size;
    EXPECT_LT(worst, limit) << name;
    fmt::print("{:28} {}: worst {:.2g} of the half axis\n", name, static_cast<int>(from), worst / size);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, EllipsoidRays,
                         testing::Values(EllipsoidCase{"unit", sphere_at({0, 0, 0}, 1), 4, 2e-6},
                                         EllipsoidCase{"unit, from 1000 radii", sphere_at({0, 0, 0}, 1), 1000, 2e-4},
                                         EllipsoidCase{"radius 1e-5", sphere_at({0, 0, 0}, 1e-5f), 4, 2e-6},
                                         EllipsoidCase{"radius 1e5 at 1e6", sphere_at({7e5f, -7e5f, 1e5f}, 1e5f), 4,
                                                       4e-6},
                                         EllipsoidCase{"three half axes", turned({1, 2, 3}, {1, 0.6, 0.3}), 4, 1e-5}),
                         [](const auto& tested) { return "case" + std::to_string(tested.index); });

// A ray that leaves a sphere outwards does not meet it again, one that enters it meets its far side: also at a radius
// of 1e-5 of the coordinates, where the rounded place is off the surface by a two-hundredth of the radius.
TEST(Ellipsoid, TheOneThatARayLeavesIsMetOnItsFarSideOnly) {
  const compute::Context context = compute::Context::open(device_options());
  std::mt19937 random(2);
  for (const glm::vec3& centre : {glm::vec3(0), glm::vec3(0.7f, -0.7f, 0.1f)})
    for (const float radius : {1e-5f, 1.0f}) {
      scene::Mesh mesh{.ellipsoids = {sphere_at(centre, radius)}};
      std::vector<Ray> rays;
      std::vector<bool> inwards;
      for (int i = 0; i < 20000; ++i) {
        const glm::vec3 normal = random_direction(random), direction = random_direction(random);
        const float cosine = glm::dot(normal, direction);
        // A place that is rounded by 5e-8 of its coordinates, .005 of the radius, is off the ray's chord where the
        // cosine is below .1.
        if (std::abs(cosine) < 0.12f) continue;
        rays.push_back({.origin = centre + radius * normal, .direction = direction, .skip = 0});
        inwards.push_back(cosine < 0);
      }
      KernelTracer tracer(context, mesh);
      const std::vector<Hit> hits = tracer.closest(rays);
      const std::vector<std::uint32_t> any = tracer.any(rays);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < rays.size(); ++i)
        wrong += (hits[i].primitive == 0) != inwards[i] || (any[i] != 0) != inwards[i] ||
                 (inwards[i] && !(hits[i].t > 0.05f * radius));
      EXPECT_EQ(wrong, 0u) << radius << " at " << centre.x;
    }
}

// Hundreds of spheres among triangles: the tree finds the same one as asking each.
TEST(Ellipsoid, ATreeOfManyFindsTheClosest) {
  scene::Mesh mesh = placed(box_mesh(), 3, {0, 0, 0});
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-1.5f, 1.5f);
  for (int i = 0; i < 500; ++i) {
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    mesh.ellipsoids.push_back(i % 2 ? sphere_at({x, y, z}, 0.05f) : turned({x, y, z}, {0.1, 0.05, 0.02}));
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 20000; ++i) {
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    rays.push_back({.origin = {x, y, z}, .direction = random_direction(random)});
  }
  const compute::Context context = compute::Context::open(device_options());
  KernelTracer tracer(context, mesh);
  const std::vector<Hit> hits = tracer.closest(rays);
  std::size_t wrong = 0, spheres = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::dvec3 o(rays[i].origin), d(rays[i].direction);
    double closest = inf;
    std::uint32_t which = no_primitive;
    for (std::uint32_t e = 0; e < mesh.ellipsoids.size(); ++e)
      if (const double t = first_hit(mesh.ellipsoids[e], o, d); t < closest) closest = t, which = 12 + e;
    const auto host = scene::closest_hit(tracer.bvh(), o, d);
    spheres += which != no_primitive;
    if (which == no_primitive) {
      wrong += hits[i].primitive >= 12; // the box about all
      continue;
    }
    // Within rounding of a silhouette either answer is right.
    const bool same = hits[i].primitive == which && std::abs(hits[i].t - closest) < 1e-4;
    const double cosine = std::abs(glm::dot(d, normal_at(mesh.ellipsoids[which - 12], o + closest * d)));
    wrong += !same && cosine > 1e-2 && closest > 1e-5;
    wrong += cosine > 1e-2 && closest > 1e-5 && (!host || host->primitive != which);
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(spheres, rays.size() / 8);
}

} // namespace nephroid::ellipsoid_test
