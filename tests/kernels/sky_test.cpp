// SPDX-License-Identifier: Apache-2.0
// kernels/lights/sky.h: directions are drawn by the flux of texels or by their peaks, evenly by solid angle inside of
// one, and a direction is of the texel that is seen there. The truth is the map's definition (scene/environment.h),
// written here anew in double precision.
#include "kernels/tracing/shared_types.h"
#include "tests/support/statistics.h"
#include "tests/support/test_kernels.h"
#include "tracing/scene_tables.h"

#include <glm/glm.hpp>

namespace nephroid::sky_test {

using shared::float4;

constexpr const char* source = R"(
#include "kernels/tracing/random.h"
#include "kernels/lights/sky.h"
#include "kernels/tracing/work_item.h"
kernel void places(global const float* cdf, global const float* colour, DeviceBackground size, uint2 seed, int by_peaks, global float4* out,
                   uint count)
{
  const uint i = work_item();
  if (i >= count) return;
  const Sky sky = {cdf, colour, size};
  const SkyPlace drawn = sample_sky(&sky, by_peaks ? cdf_of_peaks(&sky) : sky.texel_cdf, random4(seed, 0u, i, 0u, STREAM_PHOTONS).xy),
                 seen = sky_in(&sky, drawn.direction);
  out[3 * i] = (float4)(drawn.direction, drawn.density);
  out[3 * i + 1] = (float4)(drawn.rgb, seen.density);
  out[3 * i + 2] = (float4)(seen.rgb, drawn.peak_density);
}
)";

constexpr std::uint32_t count = 1 << 20;

scene::Environment uneven(int width, int height) {
  scene::Environment map{.width = width, .height = height, .rotate_deg = 50};
  for (int i = 0; i < width * height; ++i)
    for (int c = 0; c < 3; ++c) map.rgb.push_back(i % 5 == 4 ? 0.0f : static_cast<float>(0.2 + (i * 7 + c) % 4));
  return map;
}

class SkyKernel : public testing::TestWithParam<std::array<int, 2>> {};

/// floor: what the grey of a texel has to exceed to be drawn, and by how much is its chance.
void expect_drawn(const scene::Environment& map, bool by_peaks, double floor) {
  const tracing::SkyTables tables = tracing::make_sky_tables(map);
  static const TestKernels kernels(source);
  const compute::Buffer<float> cdf(kernels.context(), "cdf", std::span<const float>(tables.texel_cdf)),
      colour(kernels.context(), "colour", std::span<const float>(tables.texel_colour));
  const compute::Buffer<float4> out(kernels.context(), "out", 3 * std::size_t{count});
  kernels.kernel("places").run(count, 64,
                               {{"cdf", cdf},
                                {"colour", colour},
                                {"size", tables.size},
                                {"seed", shared::uint2{8, 15}},
                                {"by_peaks", by_peaks ? 1 : 0},
                                {"out", out},
                                {"count", count}});
  const std::vector<float4> got = out.read();

  constexpr int within = 3; // a texel's parts each way, of equal azimuth and of equal height
  const auto width = static_cast<std::size_t>(map.width), height = static_cast<std::size_t>(map.height);
  std::vector<double> counts(width * height * within * within, 0.0), chances = counts;
  const auto edge = [&](std::size_t row) { return std::cos(M_PI * static_cast<double>(row) / map.height); };
  double flux = 0, drawn_flux = 0;
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column) {
      const float* rgb = map.rgb.data() + 3 * (row * width + column);
      const double steradians = (edge(row) - edge(row + 1)) * 2 * M_PI / map.width,
                   grey = (rgb[0] + rgb[1] + rgb[2]) / 3.0;
      const double chance = std::max(grey - floor, 0.0) * steradians;
      flux += grey * steradians;
      drawn_flux += chance;
      for (std::size_t part = 0; part < within * within; ++part)
        chances[(row * width + column) * within * within + part] = chance;
    }
  int elsewhere = 0;
  for (std::size_t i = 0; i < got.size(); i += 3) {
    const glm::dvec3 d(got[i].x, got[i].y, got[i].z);
    ASSERT_NEAR(glm::length(d), 1, 1e-5);
    double azimuth = std::atan2(d.x, -d.z) / (2 * M_PI) + 0.5 + map.rotate_deg / 360;
    azimuth -= std::floor(azimuth);
    const double x = azimuth * map.width, zenith = std::atan2(std::hypot(d.x, d.z), d.y);
    const std::size_t row = std::min(static_cast<std::size_t>(zenith / M_PI * map.height), height - 1),
                      column = std::min(static_cast<std::size_t>(x), width - 1);
    const double down = std::clamp((edge(row) - d.y) / (edge(row) - edge(row + 1)), 0.0, 1 - 1e-9);
    const std::size_t part =
        static_cast<std::size_t>(down * within) * within + static_cast<std::size_t>((x - std::floor(x)) * within);
    ++counts[(row * width + column) * within * within + part];
    // At a texel's edge rounding may find its neighbour.
    const bool same = got[i + 1].x == got[i + 2].x && got[i + 1].y == got[i + 2].y && got[i].w == got[i + 1].w;
    elsewhere += !same;
    if (!same || std::abs(x - std::round(x)) < 1e-4 || std::abs(down - 0.5) > 0.499) continue;
    const float* rgb = map.rgb.data() + 3 * (row * width + column);
    if (by_peaks) {
      ASSERT_NEAR(double(got[i + 2].w), ((rgb[0] + rgb[1] + rgb[2]) / 3.0 - floor) / drawn_flux, 1e-5);
    }
    // Radiance is colour * density, of grey light of 1 in all.
    for (std::size_t c = 0; c < 3; ++c) {
      const double carried = static_cast<double>(c == 0 ? got[i + 1].x : c == 1 ? got[i + 1].y : got[i + 1].z);
      ASSERT_NEAR(carried * static_cast<double>(got[i].w), static_cast<double>(rgb[c]) / flux, 1e-5);
    }
  }
  EXPECT_LT(elsewhere, 1e-4 * count);
  EXPECT_GT(chi_square_test(counts, chances).p, false_alarm);
  for (std::size_t i = 0; i < chances.size(); ++i) chances[i] *= i % 2 == 0 ? 1.03 : 0.97;
  EXPECT_LT(chi_square_test(counts, chances).p, false_alarm) << "chances that are 3 % off pass";
}

TEST_P(SkyKernel, DrawsByFlux) { expect_drawn(uneven(GetParam()[0], GetParam()[1]), false, 0); }

TEST_P(SkyKernel, DrawsByPeaks) {
  const scene::Environment map = uneven(GetParam()[0], GetParam()[1]);
  expect_drawn(map, true, scene::flux_of(map).grey / (4 * M_PI));
}

TEST(Sky, AnEvenSkyHasNoPeaks) {
  scene::Environment map{.width = 16, .height = 8};
  map.rgb.assign(3 * 16 * 8, 0.7f);
  EXPECT_FALSE(tracing::make_sky_tables(map).size.has_peaks);
  map.rgb[100] += 0.01f; // a star
  EXPECT_TRUE(tracing::make_sky_tables(map).size.has_peaks);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SkyKernel, testing::Values(std::array{16, 8}, std::array{6, 5}, std::array{3, 1}),
                         [](const auto& parameter) {
                           return std::to_string(parameter.param[0]) + "x" + std::to_string(parameter.param[1]);
                         });

} // namespace nephroid::sky_test
