// SPDX-License-Identifier: Apache-2.0
// kernels/lights, first in extreme places: a far and small target, and a light inside of one.
#include "kernels/lights/light_types.h"
#include "tests/support/statistics.h"
#include "tests/support/test_kernels.h"

#include <glm/glm.hpp>

#include <functional>
#include <numeric>

namespace nephroid::emission_samplers_test {

using namespace shared;

constexpr const char* source = R"(
#include "kernels/tracing/random.h"
#include "kernels/lights/lights.h"
#include "kernels/tracing/work_item.h"
kernel void sample(global const DeviceTarget* targets, int target_count, float4 from, uint2 seed, global float4* out, uint count)
{
  const uint i = work_item();
  if (i >= count) return;
  Emission photon;
  const float steradians = sample_targets(targets, target_count, from.xyz, random4(seed, 0u, i, 0u, 0u), &photon);
  out[i] = (float4)(photon.direction, steradians);
}
typedef struct {
  float4 origin_watts, direction;
} Sent;
kernel void emissions(global const DeviceLight* light, global const DeviceTarget* targets, DeviceScene scene, uint2 seed, global Sent* out, uint count)
{
  const uint i = work_item();
  if (i >= count) return;
  const World world = {.lights = light, .targets = targets, .scene = scene};
  const Emission sent = emit(&world, 0, random4(seed, 0u, i, 0u, STREAM_PHOTONS), random4(seed, 0u, i, 1u, STREAM_PHOTONS).xy);
  out[i].origin_watts = (float4)(sent.origin, sent.watts);
  out[i].direction = (float4)(sent.direction, 0.0f);
}
)";

const TestKernels& kernels() {
  static const TestKernels kernels(source);
  return kernels;
}

std::vector<float4> sample(const std::vector<DeviceTarget>& targets, std::size_t count) {
  const compute::Buffer<DeviceTarget> on_device(kernels().context(), "targets", std::span<const DeviceTarget>(targets));
  compute::Buffer<float4> out(kernels().context(), "out", count);
  kernels().kernel("sample").run(count, 64,
                                 {{"targets", on_device},
                                  {"target_count", static_cast<int>(targets.size())},
                                  {"from", float4{0, 0, 0, 0}},
                                  {"seed", shared::uint2{7, 0}},
                                  {"out", out},
                                  {"count", static_cast<std::uint32_t>(count)}});
  return out.read();
}

TEST(Emission, OneFarTargetHasItsSolidAngle) {
  // 1 mm seen from 1 km: 1 - cos is 5e-13, far below what 1 - cos(x) keeps in single precision.
  const std::vector<float4> samples = sample({{{0, 0, 1000, 1e-3f}}}, 1000);
  for (const float4& s : samples) {
    EXPECT_NEAR(s.w / (M_PI * 1e-12), 1, 1e-5);
    EXPECT_LT(std::hypot(s.x, s.y), 1.001e-6);
  }
}

// Uniform on the sphere: each coordinate has mean 0 and mean square 1/3, also from the very middle of a target.
TEST(Emission, FromInsideATargetItIsTheWholeSphere) {
  constexpr std::size_t count = 1 << 16;
  for (const float z : {0.1f, 0.0f}) {
    std::array<double, 3> mean{}, square{};
    for (const float4& s : sample({{{0, 0, z, 1}}}, count)) {
      EXPECT_FLOAT_EQ(s.w, static_cast<float>(4 * M_PI));
      const std::array<double, 3> d{s.x, s.y, s.z};
      for (std::size_t i = 0; i < 3; ++i) {
        mean[i] += d[i] / count;
        square[i] += d[i] * d[i] / count;
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(mean[i], 0, 4 * std::sqrt(1 / 3.0 / count));
      EXPECT_NEAR(square[i], 1 / 3.0, 4 * std::sqrt(4 / 45.0 / count));
    }
  }
}

// A small target is 1.5e-4 of all that targets fill. MOST_CROWDED times that is less than its half of what all have
// alike. Its photons together stand for its solid angle.
TEST(Emission, ASmallTargetHasPhotonsBesideALargeOne) {
  constexpr std::size_t count = 1 << 16;
  const double small = 1 - std::cos(std::asin(0.01)), large = 1 - std::cos(std::asin(0.75));
  double hits = 0, steradians = 0, all = 0;
  for (const float4& s : sample({{{0, 0, 10, 7.5f}}, {{10, 0, 0, 0.1f}}}, count)) {
    all += double{s.w} / count;
    if (s.x > 0.9f) ++hits, steradians += double{s.w} / count;
  }
  const double by_size = small / (small + large),
               chance = (MOST_CROWDED + 1) * by_size / (MOST_CROWDED * by_size + 1.5);
  const double deviation = std::sqrt(chance * (1 - chance) / count);
  EXPECT_NEAR(hits / count, chance, 4 * deviation);
  EXPECT_NEAR(steradians / (2 * M_PI * small), 1, 4 * deviation / chance);
  EXPECT_NEAR(all / (2 * M_PI * (small + large)), 1, 4 * deviation / (1 - chance));
}

// Photons of every type of light towards several overlapping targets. Their density is what the sampler is
// meant to have, by chi-square, and the power that they carry is what the light sends towards the targets, everywhere,
// whatever the density. Both truths are integrals over cells, of formulas that are written here anew, in double
// precision.

struct Sent {
  float4 origin_watts, direction;
};

constexpr std::uint32_t count = 1 << 20;

glm::dvec3 vector(const float4& v) { return {v.x, v.y, v.z}; }
float4 device(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}

DeviceTarget target(double x, double y, double z, double radius) {
  DeviceTarget t{.centre_radius = device({x, y, z})};
  t.centre_radius.w = static_cast<float>(radius);
  return t;
}

/// Overlapping, one behind another, one apart, seen from near the origin.
const std::vector<DeviceTarget> targets{target(0, 0, -3, 1), target(0.8, 0, -3, 1), target(0, 0.3, -6, 1),
                                        target(-2, 1, -1, 0.7)};

std::vector<Sent> emit(const DeviceLight& light) {
  DeviceLight with_targets = light;
  with_targets.first_target = 0;
  with_targets.target_count = static_cast<int>(targets.size());
  shared::DeviceScene scene{.metres_per_unit = 0.01f, .outside_distance = 20};
  const compute::Buffer<DeviceTarget> on_device(kernels().context(), "targets", std::span<const DeviceTarget>(targets));
  const compute::Buffer<DeviceLight> lights(kernels().context(), "light", std::vector{with_targets});
  const compute::Buffer<Sent> out(kernels().context(), "out", count);
  kernels()
      .kernel("emissions")
      .run(count, 64,
           {{"light", lights},
            {"targets", on_device},
            {"scene", scene},
            {"seed", shared::uint2{8, 15}},
            {"out", out},
            {"count", count}});
  return out.read();
}

double radius_of(const DeviceTarget& t) { return static_cast<double>(t.centre_radius.w); }

bool meets(const DeviceTarget& t, const glm::dvec3& from, const glm::dvec3& direction) {
  const glm::dvec3 way = vector(t.centre_radius) - from;
  const double along = glm::dot(way, direction), aside2 = glm::dot(way, way) - along * along;
  return glm::length(way) <= radius_of(t) || (along > 0 && aside2 <= radius_of(t) * radius_of(t));
}

/// The solid angles of all targets over 2 pi.
std::vector<double> solid_angles(const glm::dvec3& from) {
  std::vector<double> sizes;
  for (const DeviceTarget& t : targets) {
    const double d = glm::length(vector(t.centre_radius) - from);
    sizes.push_back(d <= radius_of(t) ? 2 : 1 - std::sqrt(1 - radius_of(t) * radius_of(t) / (d * d)));
  }
  return sizes;
}

/// The density of photons where they could have been sent to each target that `met` tells: half of them go by size,
/// half to all alike.
double density_of(const std::vector<double>& sizes, const std::function<bool(const DeviceTarget&)>& met) {
  const double sum = std::accumulate(sizes.begin(), sizes.end(), 0.0);
  double density = 0;
  for (std::size_t t = 0; t < targets.size(); ++t)
    if (met(targets[t])) density += 0.5 / (static_cast<double>(targets.size()) * sizes[t]) + 0.5 / sum;
  return density;
}
double density_of(const glm::dvec3& from, const glm::dvec3& direction) {
  return density_of(solid_angles(from), [&](const DeviceTarget& t) { return meets(t, from, direction); });
}
double sum_of_solid_angles(const glm::dvec3& from) {
  const std::vector<double> sizes = solid_angles(from);
  return 2 * M_PI * std::accumulate(sizes.begin(), sizes.end(), 0.0);
}

/// Cells of equal measure over a square of two coordinates in [0, 1).
constexpr int columns = 48, rows = 32;
constexpr int points_a_cell = 4096;
std::size_t cell_of(double a, double b) {
  const auto index = [](double x, int n) { return std::clamp(static_cast<int>(std::floor(x * n)), 0, n - 1); };
  return static_cast<std::size_t>(index(b, rows) * columns + index(a, columns));
}

/// Directions by their height and angle about z: cells of equal solid angle.
glm::dvec3 direction_of(double a, double b) {
  const double z = 2 * b - 1, s = std::sqrt(1 - z * z), phi = 2 * M_PI * a;
  return {s * std::cos(phi), s * std::sin(phi), z};
}
std::size_t cell_of_direction(const glm::dvec3& d) {
  const double turn = std::atan2(d.y, d.x) / (2 * M_PI);
  return cell_of(turn < 0 ? turn + 1 : turn, (d.z + 1) / 2);
}

/// Integrals over the cells of f(a, b, s, t) times `measure`, the whole square's, as means over s and t in [0, 1):
/// quasi-random points whose steps are powers of the root of x^5 = x + 1 (Roberts 2018, "The unreasonable effectiveness
/// of quasirandom sequences").
template <class F>
std::vector<double> integrals(double measure, F f) {
  constexpr double root = 1.1673039782614187;
  std::vector<double> result(static_cast<std::size_t>(columns * rows), 0.0);
  const auto fraction = [](double x) { return x - std::floor(x); };
  for (int k = 0; k < points_a_cell; ++k) {
    const double n = k + 0.5, a = fraction(n / root), b = fraction(n / (root * root)),
                 s = fraction(n / std::pow(root, 3)), t = fraction(n / std::pow(root, 4));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        result[static_cast<std::size_t>(row * columns + column)] += f((column + a) / columns, (row + b) / rows, s, t);
  }
  for (double& value : result) value *= measure / points_a_cell / (columns * rows);
  return result;
}

/// Holds what was sent against its density (any scale) and its power, cell by cell, and shows that a few per cent more
/// would be seen.
void expect_emission(const std::vector<Sent>& sent, const std::function<std::size_t(const Sent&)>& cell,
                     std::vector<double> density, std::vector<double> watts) {
  std::vector<double> counts(density.size(), 0.0);
  WeightedCells weights(watts.size());
  for (const Sent& photon : sent) {
    ++counts[cell(photon)];
    ASSERT_GE(photon.origin_watts.w, 0);
    weights.add(cell(photon), static_cast<double>(photon.origin_watts.w));
  }
  EXPECT_GT(chi_square_test(counts, density).p, false_alarm);
  // The integrals are off where an edge crosses a cell, by 0.2 % of a whole cell and seldom by 0.5 %.
  const double fullest = *std::max_element(watts.begin(), watts.end()), error = 0.004 * fullest;
  EXPECT_GT(weights_test(weights, watts, count, error), false_alarm);

  for (std::size_t i = 0; i < density.size(); ++i) density[i] *= i % 2 == 0 ? 1.05 : 0.95;
  EXPECT_LT(chi_square_test(counts, density).p, false_alarm) << "a density that is 5 % off passes";
  std::vector<double> brighter = watts;
  for (double& w : brighter) w *= 1.03;
  EXPECT_LT(weights_test(weights, brighter, count, error), false_alarm) << "3 % more power passes";
  *std::max_element(watts.begin(), watts.end()) *= 1.3;
  EXPECT_LT(weights_test(weights, watts, count, error), false_alarm) << "one cell with 30 % more power passes";
}

std::size_t cell_of_sent_direction(const Sent& photon) { return cell_of_direction(vector(photon.direction)); }

TEST(EmissionSamplers, PointLight) {
  const glm::dvec3 from(0.1, -0.2, 0.3);
  DeviceLight light{.type = LIGHT_POINT, .radiometric = 7, .table = -1};
  light.as.point = {.position = device(from)};
  const std::vector<double> density =
      integrals(4 * M_PI, [&](double a, double b, double, double) { return density_of(from, direction_of(a, b)); });
  const std::vector<double> watts = integrals(4 * M_PI, [&](double a, double b, double, double) {
    return density_of(from, direction_of(a, b)) > 0 ? 7 / (4 * M_PI) : 0.0;
  });
  expect_emission(emit(light), cell_of_sent_direction, density, watts);
}

DeviceLight spot(double half_angle_deg) {
  const auto one_minus_cos = static_cast<float>(1 - std::cos(half_angle_deg * M_PI / 180));
  DeviceLight light{.type = LIGHT_SPOT, .radiometric = 7};
  light.as.spot = {{},
                   device(glm::normalize(glm::dvec3(0.1, 0.1, -1))),
                   one_minus_cos,
                   2 * static_cast<float>(M_PI) * one_minus_cos};
  return light;
}

bool in_cone(const DeviceLight& light, const glm::dvec3& direction) {
  return 1 - glm::dot(direction, vector(light.as.spot.direction)) <= static_cast<double>(light.as.spot.one_minus_cos);
}

// The cone is tighter than the targets: photons fill it evenly, whether they meet a target or not.
TEST(EmissionSamplers, NarrowSpot) {
  const DeviceLight light = spot(25);
  const std::vector<double> inside = integrals(
      4 * M_PI, [&](double a, double b, double, double) { return in_cone(light, direction_of(a, b)) ? 1.0 : 0.0; });
  std::vector<double> watts = inside;
  for (double& w : watts) w *= 7 / static_cast<double>(light.as.spot.solid_angle);
  expect_emission(emit(light), cell_of_sent_direction, inside, watts);
}

// The targets are tighter than the cone, which cuts one of them: photons beyond it carry nothing.
TEST(EmissionSamplers, WideSpot) {
  const DeviceLight light = spot(62);
  const glm::dvec3 from(0);
  ASSERT_GT(static_cast<double>(light.as.spot.solid_angle), sum_of_solid_angles(from));
  const std::vector<double> density =
      integrals(4 * M_PI, [&](double a, double b, double, double) { return density_of(from, direction_of(a, b)); });
  const std::vector<double> watts = integrals(4 * M_PI, [&](double a, double b, double, double) {
    const glm::dvec3 d = direction_of(a, b);
    return in_cone(light, d) && density_of(from, d) > 0 ? 7 / static_cast<double>(light.as.spot.solid_angle) : 0.0;
  });
  expect_emission(emit(light), cell_of_sent_direction, density, watts);
}

/// A rectangle of 1.2 by 0.6 that faces between the targets, with one of them partly behind it.
DeviceLight panel() {
  DeviceLight light{.type = LIGHT_AREA, .radiometric = 7, .table = -1};
  light.as.area = {.centre = device({-0.2, 0.1, 0.2}),
                   .normal = device(glm::normalize(glm::dvec3(1, 0, -1))),
                   .edge_u = device(1.2 * glm::normalize(glm::dvec3(1, 0, 1))),
                   .edge_v = device({0, 0.6, 0})};
  return light;
}

/// Power through a cell of directions is P cos(theta) / pi a steradian from each point of the light, where that meets a
/// target.
TEST(EmissionSamplers, AreaLightDirections) {
  const DeviceLight light = panel();
  const DeviceArea& area = light.as.area;
  const auto point = [&](double s, double t) {
    return vector(area.centre) + (s - 0.5) * vector(area.edge_u) + (t - 0.5) * vector(area.edge_v);
  };
  const std::vector<double> density = integrals(4 * M_PI, [&](double a, double b, double s, double t) {
    const glm::dvec3 from = point(s, t);
    return density_of(from, direction_of(a, b));
  });
  const std::vector<double> watts = integrals(4 * M_PI, [&](double a, double b, double s, double t) {
    const glm::dvec3 d = direction_of(a, b);
    return density_of(point(s, t), d) > 0 ? 7 / M_PI * std::max(glm::dot(d, vector(area.normal)), 0.0) : 0.0;
  });
  expect_emission(emit(light), cell_of_sent_direction, density, watts);
}

/// Places are even on the rectangle; the power from a place is that of the directions from there that meet a target.
TEST(EmissionSamplers, AreaLightPlaces) {
  const DeviceLight light = panel();
  const DeviceArea& area = light.as.area;
  const auto cell = [&](const Sent& photon) {
    const glm::dvec3 from = vector(photon.origin_watts) - vector(area.centre), u = vector(area.edge_u),
                     v = vector(area.edge_v);
    return cell_of(glm::dot(from, u) / glm::dot(u, u) + 0.5, glm::dot(from, v) / glm::dot(v, v) + 0.5);
  };
  const std::vector<double> density = integrals(1, [&](double, double, double, double) { return 1.0; });
  const std::vector<double> watts = integrals(4 * M_PI, [&](double a, double b, double s, double t) {
    const glm::dvec3 from = vector(area.centre) + (a - 0.5) * vector(area.edge_u) + (b - 0.5) * vector(area.edge_v),
                     d = direction_of(s, t);
    return density_of(from, d) > 0 ? 7 / M_PI * std::max(glm::dot(d, vector(area.normal)), 0.0) : 0.0;
  });
  const std::vector<Sent> sent = emit(light);
  std::vector<double> counts(density.size(), 0.0);
  WeightedCells weights(watts.size());
  for (const Sent& photon : sent) {
    ++counts[cell(photon)];
    weights.add(cell(photon), static_cast<double>(photon.origin_watts.w));
  }
  EXPECT_GT(chi_square_test(counts, density).p, false_alarm);
  // A cell's integral over all directions with 4096 points is off by 1 %.
  const double fullest = *std::max_element(watts.begin(), watts.end());
  EXPECT_GT(weights_test(weights, watts, count, 0.01 * fullest), false_alarm);
}

// Places in the plane across the light's direction; every cell of a target's shadow carries E times its area in square
// metres.
TEST(EmissionSamplers, DirectionalLight) {
  DeviceLight light{.type = LIGHT_DIRECTIONAL, .radiometric = 7};
  const glm::dvec3 along = glm::normalize(glm::dvec3(0.3, -0.2, -1));
  light.as.directional = {device(along), 0};
  const glm::dvec3 x = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0))), y = glm::cross(along, x);
  constexpr double edge = 8; // of the square about the origin that holds all shadows
  const auto place = [&](double a, double b) { return edge * ((a - 0.5) * x + (b - 0.5) * y); };
  std::vector<double> sizes;
  for (const DeviceTarget& t : targets) sizes.push_back(radius_of(t) * radius_of(t));
  const auto density_at = [&](const glm::dvec3& p) {
    return density_of(sizes, [&](const DeviceTarget& t) {
      const glm::dvec3 way = vector(t.centre_radius) - p;
      return glm::length(way - glm::dot(way, along) * along) <= radius_of(t);
    });
  };
  const std::vector<double> density =
      integrals(edge * edge, [&](double a, double b, double, double) { return density_at(place(a, b)); });
  const std::vector<double> watts = integrals(
      edge * edge, [&](double a, double b, double, double) { return density_at(place(a, b)) > 0 ? 7 * 1e-4 : 0.0; });
  const std::vector<Sent> sent = emit(light);
  for (const Sent& photon : sent) ASSERT_LT(glm::distance(vector(photon.direction), along), 1e-6);
  const auto cell = [&](const Sent& photon) {
    const glm::dvec3 p = vector(photon.origin_watts);
    return cell_of(glm::dot(p, x) / edge + 0.5, glm::dot(p, y) / edge + 0.5);
  };
  expect_emission(sent, cell, density, watts);
}

} // namespace nephroid::emission_samplers_test
