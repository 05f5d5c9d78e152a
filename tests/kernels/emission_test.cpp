// SPDX-License-Identifier: Apache-2.0
// kernels/emission.h: photons sent towards a set of spheres carry, in sum, what the light sends into the union of their cones, and
// fill it uniformly.
#include "compute/compute.h"
#include "kernels/shared_types.h"
#include "tests/support/test_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace nephroid;
using shared::DeviceTarget;
using shared::float4;

namespace {

constexpr const char* source = R"(
#include "shared_types.h"
#include "random.h"
#include "light.h"
#include "emission.h"
kernel void sample(global const DeviceTarget* targets, int target_count, float4 from, uint2 seed, global float4* out, uint count)
{
  const uint i = get_global_id(0);
  if (i >= count) return;
  Emission photon;
  const float steradians = sample_targets(targets, target_count, from.xyz, random4(seed, 0u, i, 0u, 0u), &photon);
  out[i] = (float4)(photon.direction, steradians);
}
)";

struct Uint2 {
  std::uint32_t x, y;
};

bool meets(const DeviceTarget& target, const std::array<double, 3>& d)
{
  const float4 s = target.centre_radius;
  const double along = s.x * d[0] + s.y * d[1] + s.z * d[2], distance2 = double(s.x) * s.x + double(s.y) * s.y + double(s.z) * s.z;
  const double r2 = double(s.w) * s.w;
  return distance2 <= r2 || (along > 0 && distance2 - along * along <= r2);
}

/// Steradians of the union of the cones, by counting uniform directions.
double union_steradians(const std::vector<DeviceTarget>& targets, std::size_t directions)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < directions; ++i) {
    const double z = uniform(random), phi = M_PI * uniform(random), s = std::sqrt(1 - z * z);
    const std::array<double, 3> d{s * std::cos(phi), s * std::sin(phi), z};
    hits += std::any_of(targets.begin(), targets.end(), [&](const DeviceTarget& t) { return meets(t, d); });
  }
  return 4 * M_PI * static_cast<double>(hits) / static_cast<double>(directions);
}

std::vector<float4> sample(const std::vector<DeviceTarget>& targets, std::size_t count)
{
  const test::TestKernels kernels(source);
  const compute::Buffer<DeviceTarget> on_device(kernels.context(), "targets", std::span<const DeviceTarget>(targets));
  compute::Buffer<float4> out(kernels.context(), "out", count);
  kernels.kernel("sample").run(count, 64, on_device, static_cast<int>(targets.size()), float4{0, 0, 0, 0}, Uint2{7, 0}, out,
                               static_cast<std::uint32_t>(count));
  return out.read();
}

TEST(Emission, OneFarTargetHasItsSolidAngle)
{
  // 1 mm seen from 1 km: 1 - cos is 5e-13, far below what 1 - cos(x) keeps in single precision.
  const std::vector<float4> samples = sample({{{0, 0, 1000, 1e-3f}}}, 1000);
  for (const float4& s : samples) {
    EXPECT_NEAR(s.w / (M_PI * 1e-12), 1, 1e-5);
    EXPECT_LT(std::hypot(s.x, s.y), 1.001e-6);
  }
}

TEST(Emission, OverlappingTargetsCountOnce)
{
  const std::vector<DeviceTarget> targets{{{0, 0, 3, 1}}, {{0.8f, 0, 3, 1}}, {{0, 0.1f, 6, 0.5f}}, {{-2, 0, 0, 0.5f}}};
  constexpr std::size_t count = 1 << 18;
  double sum = 0, sum2 = 0;
  for (const float4& s : sample(targets, count)) {
    sum += s.w / count;
    sum2 += double(s.w) * s.w / count;
    EXPECT_TRUE(std::any_of(targets.begin(), targets.end(), [&](const DeviceTarget& t) {
      DeviceTarget wider = t;
      wider.centre_radius.w *= 1.0001f;
      return meets(wider, {s.x, s.y, s.z});
    }));
  }
  constexpr std::size_t directions = 4'000'000;
  const double truth = union_steradians(targets, directions), p = truth / (4 * M_PI);
  const double sigma = std::sqrt((sum2 - sum * sum) / count + 16 * M_PI * M_PI * p * (1 - p) / directions);
  EXPECT_NEAR(sum, truth, 4 * sigma);
}

// Weighted by 1 / density, directions are uniform on the union: chi-square over bands of equal solid angle about the axis of a cone
// that two equal targets share.
TEST(Emission, FillsAConeUniformly)
{
  const DeviceTarget target{{0, 0, 2, 1}};
  constexpr int bands = 32;
  constexpr std::size_t count = 1 << 18;
  const double one_minus_cos = 1 - std::sqrt(1 - 0.25);
  std::array<double, bands * 4> counts{};
  for (const float4& s : sample({target, target}, count)) {
    const int band = std::min(static_cast<int>((1 - double(s.z)) / one_minus_cos * bands), bands - 1);
    const int quarter = (s.x > 0 ? 1 : 0) + (s.y > 0 ? 2 : 0);
    ++counts[static_cast<std::size_t>(band * 4 + quarter)];
  }
  const double expected = static_cast<double>(count) / counts.size();
  double chi2 = 0;
  for (const double c : counts) chi2 += (c - expected) * (c - expected) / expected;
  // 127 degrees of freedom: the 99.99 % point is 193.
  EXPECT_LT(chi2, 193);
}

// Uniform on the sphere: each coordinate has mean 0 and mean square 1/3, also from the very middle of a target.
TEST(Emission, FromInsideATargetItIsTheWholeSphere)
{
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

} // namespace
