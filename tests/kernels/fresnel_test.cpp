// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/fresnel.h in single precision against optics/fresnel.h in double precision.
#include "compute/compute.h"
#include "kernels/tracing/shared_types.h"
#include "optics/fresnel.h"
#include "tests/support/test_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace nephroid;

namespace {

using Float4 = shared::float4;

std::vector<Float4> run(const char* kernel, const std::vector<Float4>& in, std::size_t outputs_each)
{
  const compute::Context context = compute::Context::open(test::device_options());
  compute::Buffer<Float4> from(context, "in", std::span<const Float4>(in)), to(context, "out", in.size() * outputs_each);
  compute::Program(context, "check/check.cl")
      .kernel(kernel)
      .run(in.size(), 64, {{"in", from}, {"out", to}, {"count", static_cast<std::uint32_t>(in.size())}});
  return to.read();
}

TEST(FresnelKernel, ReflectanceAndRefractionFollowTheDoublePrecisionFormulas)
{
  std::vector<Float4> in;
  const float indices[] = {1, 1.0001f, 1.33f, 1.5f, 1.9f, 2.42f, 4};
  for (const float a : indices)
    for (const float b : indices)
      for (int k = 0; k <= 1000; ++k) in.push_back({static_cast<float>(std::cos(M_PI / 2 * k / 1000)), a, b, 0});
  for (const float grazing : {1e-2f, 1e-4f, 1e-6f}) in.push_back({grazing, 1, 1.5f, 0});
  const std::vector<Float4> out = run("interfaces", in, 1);
  double worst_cosine = 0, worst_reflectance = 0;
  int at_the_edge = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double cos_i = in[i].x, n_i = in[i].y, n_t = in[i].z;
    const auto cos_t = optics::refracted_cosine(cos_i, n_i, n_t);
    if (cos_t.has_value() != (out[i].x >= 0)) {
      // Within float spacing of the critical angle either answer is right.
      const double sin_t = n_i / n_t * std::sqrt(1 - cos_i * cos_i);
      EXPECT_NEAR(sin_t, 1, 4e-7) << "cos " << cos_i << ", n " << n_i << " to " << n_t;
      ++at_the_edge;
      continue;
    }
    if (!cos_t) continue;
    // cos_t = sqrt(1 - sin_t^2): an error e of sin_t is e tan_t of cos_t, which grows without bound at grazing refraction; its square does
    // not.
    worst_cosine = std::max(worst_cosine, std::abs(out[i].x * double(out[i].x) - *cos_t * *cos_t));
    // R depends on cos_t with a slope of the order of n_i / n_t + n_t / n_i, and cos_t has the error of its square over 2 cos_t.
    const double condition = (n_i / n_t + n_t / n_i) / *cos_t;
    EXPECT_TRUE(out[i].y >= 0 && out[i].y <= 1.000001f);
    if (*cos_t > 0.01)
      worst_reflectance = std::max(worst_reflectance, std::abs(out[i].y - optics::fresnel_reflectance(cos_i, n_i, n_t)) / condition);
  }
  EXPECT_LT(worst_cosine, 1e-6);
  EXPECT_LT(worst_reflectance, 1e-6);
  EXPECT_LT(at_the_edge, 10);
}

TEST(FresnelKernel, TotalReflectionStartsWithinFloatSpacingOfTheCriticalAngle)
{
  const float n = 1.5f;
  const double critical = std::asin(1 / double(n));
  std::vector<Float4> in;
  for (int k = -200; k <= 200; ++k) in.push_back({static_cast<float>(std::cos(critical + k * 1e-8)), n, 1, 0});
  const std::vector<Float4> out = run("interfaces", in, 1);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double beyond = std::acos(double(in[i].x)) - critical; // of the cosine as rounded
    if (std::abs(beyond) > 3e-7) {
      EXPECT_EQ(out[i].x<0, beyond> 0) << beyond << " radians beyond the critical angle";
    }
  }
}

TEST(FresnelKernel, DirectionsKeepTheTangentialPartTimesTheIndex)
{
  std::vector<Float4> in;
  for (const float eta : {0.25f, 0.5f, 1 / 1.5f, 1.0f, 1.2f})
    for (int k = 0; k < 500; ++k) {
      const float theta = static_cast<float>(M_PI / 2) * static_cast<float>(k) / 500, phi = static_cast<float>(k);
      in.push_back({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta), eta});
    }
  const std::vector<Float4> out = run("directions", in, 2);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Float4 d = in[i], r = out[2 * i], t = out[2 * i + 1];
    EXPECT_NEAR(r.x, d.x, 1e-6);
    EXPECT_NEAR(r.z, -d.z, 1e-6);
    if (t.w < 0) continue;
    EXPECT_NEAR(t.x, d.w * d.x, 1e-6);
    EXPECT_NEAR(t.y, d.w * d.y, 1e-6);
    EXPECT_NEAR(t.x * t.x + t.y * t.y + t.z * t.z, 1, 1e-6);
    EXPECT_LE(t.z, 0);
  }
}

} // namespace
