// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/emission.h in extreme places: a far and small target, and a light inside of one. emission_samplers_test.cpp tests the
// rest.
#include "kernels/tracing/shared_types.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"

namespace nephroid::emission_test {

using namespace shared;

constexpr const char* source = R"(
#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/light.h"
#include "kernels/tracing/emission.h"
kernel void sample(global const DeviceTarget* targets, int target_count, float4 from, uint2 seed, global float4* out, uint count)
{
  const uint i = get_global_id(0);
  if (i >= count) return;
  Emission photon;
  const float steradians = sample_targets(targets, target_count, from.xyz, random4(seed, 0u, i, 0u, 0u), &photon);
  out[i] = (float4)(photon.direction, steradians);
}
)";

std::vector<float4> sample(const std::vector<DeviceTarget>& targets, std::size_t count)
{
  const test::TestKernels kernels(source);
  const compute::Buffer<DeviceTarget> on_device(kernels.context(), "targets", std::span<const DeviceTarget>(targets));
  compute::Buffer<float4> out(kernels.context(), "out", count);
  kernels.kernel("sample").run(count, 64,
                               {{"targets", on_device},
                                {"target_count", static_cast<int>(targets.size())},
                                {"from", float4{0, 0, 0, 0}},
                                {"seed", shared::uint2{7, 0}},
                                {"out", out},
                                {"count", static_cast<std::uint32_t>(count)}});
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

} // namespace nephroid::emission_test
