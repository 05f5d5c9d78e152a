// SPDX-License-Identifier: Apache-2.0
// Chi-square tests of what the kernels draw, but for emission (emission_samplers_test.cpp): uniforms, places on area
// lights, places in a pixel, clusters of a camera path, reflection or refraction. Each also shows that it rejects a
// distribution a few per cent off.
#include "kernels/lights/light_types.h"
#include "optics/fresnel.h"
#include "tests/support/statistics.h"
#include "tests/support/test_kernels.h"

namespace nephroid::samplers_test {

using shared::float4;

constexpr const char* source = R"(
#include "kernels/tracing/random.h"
#include "kernels/photons/direct.cl"
#include "kernels/tracing/work_item.h"

kernel void uniforms(uint2 seed, uint pass, uint block, uint stream, global float4* out, uint count)
{
  const uint i = work_item();
  if (i < count) out[i] = random4(seed, pass, i, block, stream);
}
kernel void area_places(global const DeviceLight* light, uint2 seed, global float4* out, uint count)
{
  const uint i = work_item();
  if (i < count) out[i] = (float4)(area_point(light, random4(seed, 0u, i, 1u, STREAM_PHOTONS).xy), 0.0f);
}
// Item i is frame i / pixels of pixel i % pixels.
kernel void camera_directions(DeviceCamera camera, uint2 seed, global float4* out, uint count)
{
  const uint i = work_item();
  if (i >= count) return;
  const uint pixels = (uint)(camera.width * camera.height), pixel = i % pixels;
  const float4 jitter = random4(seed, i / pixels, pixel, 0u, STREAM_CAMERA);
  out[i] = (float4)(primary_direction(&camera, (int)pixel % camera.width, (int)pixel / camera.width, jitter.xy), 0.0f);
}
kernel void clusters(global const float* cdf, int clusters, uint2 seed, uint frame, uint path, global int* out, uint count)
{
  const uint i = work_item();
  if (i < count) out[i] = choose_cluster(cdf, clusters, seed, frame, path, PATHS_THROUGH_GLASS, i, STREAM_CAMERA_CLUSTER);
}
// Item i meets interface i % interfaces: (cosine, n before, n after). Bit k of the answer: choice k of four reflects.
kernel void reflections(global const float4* interfaces, int interface_count, uint2 seed, global int* out, uint count)
{
  const uint i = work_item();
  if (i >= count) return;
  const float4 at = interfaces[i % interface_count];
  Surface surface;
  surface.geometric = surface.shading = (float3)(0.0f, 0.0f, 1.0f);
  float4 choices = random4(seed, 0u, i, 2u, STREAM_PHOTONS);
  int reflected = 0;
  for (int k = 0; k < 4; ++k) {
    const ScatterSample sample =
        scatter_at((float3)(sqrt(1.0f - at.x * at.x), 0.0f, -at.x), &surface, at.y, at.z, no_film(), choices.x);
    if (!sample.transmitted) reflected |= 1 << k;
    choices = choices.yzwx;
  }
  out[i] = reflected;
}
)";

constexpr std::uint32_t count = 1 << 20;
constexpr shared::uint2 seed{20'26, 4};

const TestKernels& kernels() {
  static const TestKernels kernels(source);
  return kernels;
}

/// What a kernel of `source` writes to "out" for `count` items.
template <class T>
std::vector<T> draw(const std::string& kernel, std::initializer_list<compute::Argument> arguments) {
  const compute::Buffer<T> out(kernels().context(), "out", count);
  kernels().kernel(kernel).run(count, 64, std::array{compute::Argument("out", out), compute::Argument("count", count)},
                               arguments);
  return out.read();
}

using Column = std::vector<float>; ///< uniforms in [0, 1)

std::vector<Column> columns_of(const std::vector<float4>& numbers) {
  std::vector<Column> columns(4, Column(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::array<float, 4> n{numbers[i].x, numbers[i].y, numbers[i].z, numbers[i].w};
    for (std::size_t d = 0; d < 4; ++d) columns[d][i] = n[d];
  }
  return columns;
}

/// Counts in bins^d equal cells of the unit cube of d columns. Outside of [0, 1) counts in a last cell of its own.
std::vector<double> cube_counts(const std::vector<const Column*>& columns, std::size_t bins) {
  std::size_t cells = 1;
  for (std::size_t d = 0; d < columns.size(); ++d) cells *= bins;
  std::vector<double> counts(cells + 1, 0.0);
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    std::size_t cell = 0;
    for (const Column* column : columns) {
      const float u = (*column)[i];
      if (!(u >= 0 && u < 1)) {
        cell = cells;
        break;
      }
      cell = cell * bins + static_cast<std::size_t>(u * static_cast<float>(bins));
    }
    ++counts[cell];
  }
  return counts;
}

/// p of the columns being uniform in their cube.
double uniform_p(const std::vector<const Column*>& columns, std::size_t bins) {
  const std::vector<double> counts = cube_counts(columns, bins);
  std::vector<double> distribution(counts.size(), 1.0);
  distribution.back() = 0;
  return chi_square_test(counts, distribution).p;
}

/// The distribution with half of its cells 3 % too likely and half too unlikely.
std::vector<double> tilted(std::vector<double> distribution) {
  for (std::size_t i = 0; i < distribution.size(); ++i) distribution[i] *= i % 2 == 0 ? 1.03 : 0.97;
  return distribution;
}

/// A right distribution is accepted and one that is 3 % off is not.
void expect_distribution(const std::vector<double>& counts, const std::vector<double>& distribution,
                         int constraints = 1) {
  EXPECT_GT(chi_square_test(counts, distribution, constraints).p, false_alarm);
  EXPECT_LT(chi_square_test(counts, tilted(distribution), constraints).p, false_alarm);
}

// Every pair among the numbers of a photon (two blocks), of its neighbour, of the next pass, of another stream and of
// another seed.
TEST(Uniforms, ArePairwiseIndependent) {
  std::vector<Column> columns;
  const auto add = [&](shared::uint2 key, std::uint32_t pass, std::uint32_t block, std::uint32_t stream) {
    for (Column& column :
         columns_of(draw<float4>("uniforms", {{"seed", key}, {"pass", pass}, {"block", block}, {"stream", stream}})))
      columns.push_back(std::move(column));
  };
  add(seed, 0, 0, 0);
  add(seed, 0, 1, 0);
  add(seed, 1, 0, 0);
  add(seed, 0, 0, 1);
  add({seed.x + 1, seed.y}, 0, 0, 0);
  for (std::size_t d = 0; d < 4; ++d) {
    columns.push_back(columns[d]);
    std::rotate(columns.back().begin(), columns.back().begin() + 1, columns.back().end());
  }
  for (std::size_t a = 0; a < columns.size(); ++a) {
    EXPECT_GT(uniform_p({&columns[a]}, 1024), false_alarm) << "column " << a;
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(uniform_p({&columns[a], &columns[b]}, 32), false_alarm) << "columns " << a << " and " << b;
  }
}

TEST(Uniforms, FillTheCubesOfThreeAndFourDimensions) {
  const std::vector<Column> columns =
      columns_of(draw<float4>("uniforms", {{"seed", seed}, {"pass", 5u}, {"block", 0u}, {"stream", 0u}}));
  EXPECT_GT(uniform_p({&columns[0], &columns[1], &columns[2]}, 16), false_alarm);
  EXPECT_GT(uniform_p({&columns[1], &columns[2], &columns[3]}, 16), false_alarm);
  EXPECT_GT(uniform_p({&columns[0], &columns[1], &columns[2], &columns[3]}, 8), false_alarm);
}

TEST(Uniforms, WrongOnesAreFound) {
  const std::vector<Column> columns =
      columns_of(draw<float4>("uniforms", {{"seed", seed}, {"pass", 0u}, {"block", 0u}, {"stream", 0u}}));
  EXPECT_LT(uniform_p({&columns[0], &columns[0]}, 32), false_alarm);
  Column bent = columns[0], leaning = columns[1];
  for (std::size_t i = 0; i < bent.size(); ++i) {
    bent[i] = std::pow(bent[i], 1.02f);
    if (i % 25 == 0) leaning[i] = columns[0][i]; // every 25th equals its neighbour dimension
  }
  EXPECT_LT(uniform_p({&bent}, 1024), false_alarm);
  EXPECT_LT(uniform_p({&columns[0], &leaning}, 32), false_alarm);
  bent[0] = 1;
  EXPECT_EQ(cube_counts({&bent}, 4).back(), 1);
  expect_distribution(cube_counts({&columns[2], &columns[3]}, 16), [] {
    std::vector<double> flat(257, 1.0);
    flat.back() = 0;
    return flat;
  }());
}

TEST(AreaPoint, FillsTheRectangleEvenly) {
  shared::DeviceLight light{.type = LIGHT_AREA, .table = -1};
  light.as.area = {.centre = {3, -2, 1, 0}, // with edges of length 1 and 2, at right angles
                   .edge_u = {0.6f, 0.8f, 0, 0},
                   .edge_v = {-0.96f, 0.72f, 1.6f, 0}};
  const compute::Buffer<shared::DeviceLight> on_device(kernels().context(), "light", std::vector{light});
  Column u, v;
  for (const float4& p : draw<float4>("area_places", {{"light", on_device}, {"seed", seed}})) {
    const double x = p.x - 3.0, y = p.y + 2.0, z = p.z - 1.0;
    u.push_back(static_cast<float>(0.6 * x + 0.8 * y + 0.5));
    v.push_back(static_cast<float>((-0.96 * x + 0.72 * y + 1.6 * z) / 4 + 0.5));
    ASSERT_NEAR(0.64 * x - 0.48 * y + 0.6 * z, 0, 1e-6); // along u x v: in the plane
  }
  // A place on the very edge may come out beyond it by rounding.
  for (Column* column : {&u, &v})
    for (float& place : *column)
      if (std::abs(place - 0.5f) < 0.5f + 1e-6f) place = std::clamp(place, 0.0f, 1 - 0x1p-24f);
  EXPECT_GT(uniform_p({&u, &v}, 32), false_alarm);
  for (float& place : u) place = std::pow(place, 1.02f);
  EXPECT_LT(uniform_p({&u, &v}, 32), false_alarm);
}

// Directions, projected back, fall into their own pixel and fill its square evenly, the same in every part of the
// picture.
TEST(CameraJitter, FillsThePixel) {
  shared::DeviceCamera camera{.right = {1, 0, 0, 0},
                              .up = {0, 0.6f, 0.8f, 0},
                              .forward = {0, 0.8f, -0.6f, 0},
                              .tan_x = 0.8f,
                              .tan_y = 0.5f,
                              .width = 32,
                              .height = 16};
  Column across, down;
  const std::vector<float4> directions = draw<float4>("camera_directions", {{"camera", camera}, {"seed", seed}});
  int strays = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double x = directions[i].x, y = directions[i].y, z = directions[i].z, depth = 0.8 * y - 0.6 * z;
    const int pixel = static_cast<int>(i % 512);
    // Continuous picture coordinates in pixels: column from the left, row from the top.
    const double column = 16 + 16 * x / (depth * 0.8), row = 8 - 8 * (0.6 * y + 0.8 * z) / (depth * 0.5);
    const double s = column - pixel % 32, t = row - pixel / 32; // NOLINT(bugprone-integer-division): a row's number
    if (std::abs(s - 0.5) > 0.5001 || std::abs(t - 0.5) > 0.5001) ++strays;
    across.push_back(static_cast<float>(std::clamp(s, 0.0, 1 - 0x1p-24)));
    down.push_back(static_cast<float>(std::clamp(t, 0.0, 1 - 0x1p-24)));
  }
  EXPECT_EQ(strays, 0);
  EXPECT_GT(uniform_p({&across, &down}, 32), false_alarm);
  for (float& s : across) s = 0.01f + 0.98f * s;
  EXPECT_LT(uniform_p({&across, &down}, 32), false_alarm);
}

class ClusterChoice : public testing::Test {
protected:
  /// Uneven clusters, one of them empty.
  ClusterChoice() {
    for (std::size_t c = 0; c < 17; ++c) shares_.push_back(c == 5 ? 0.0 : 0.3 + static_cast<double>(c * 7 % 11));
    double sum = 0, before = 0;
    for (const double s : shares_) sum += s;
    cdf_.push_back(0);
    for (const double s : shares_) cdf_.push_back(static_cast<float>((before += s) / sum));
    cdf_.back() = 1;
    for (std::size_t c = 0; c < shares_.size(); ++c)
      shares_[c] = static_cast<double>(cdf_[c + 1]) - static_cast<double>(cdf_[c]);
  }
  std::vector<int> choices(std::uint32_t frame, std::uint32_t path) const {
    const compute::Buffer<float> cdf(kernels().context(), "cdf", std::span<const float>(cdf_));
    return draw<int>("clusters", {{"cdf", cdf},
                                  {"clusters", static_cast<int>(shares_.size())},
                                  {"seed", seed},
                                  {"frame", frame},
                                  {"path", path}});
  }
  std::vector<double> shares_;
  std::vector<float> cdf_;
};

TEST_F(ClusterChoice, HasTheStatedProbabilities) {
  for (const std::array<std::uint32_t, 2> at : {std::array<std::uint32_t, 2>{0, 0}, {0, 3}, {1, 0}, {2, 1}, {63, 2}}) {
    std::vector<double> counts(shares_.size(), 0.0);
    for (const int cluster : choices(at[0], at[1])) ++counts.at(static_cast<std::size_t>(cluster));
    SCOPED_TRACE(testing::Message() << "frame " << at[0] << ", path " << at[1]);
    EXPECT_EQ(counts[5], 0);
    expect_distribution(counts, shares_);
  }
}

// The halves of the film are independent: what a pixel takes in an even frame says nothing of an odd one. Nor does its
// neighbour.
TEST_F(ClusterChoice, FramesOfBothHalvesAndNeighboursAreIndependent) {
  std::vector<double> product;
  for (const double a : shares_)
    for (const double b : shares_) product.push_back(a * b);
  const auto pairs = [&](const std::vector<int>& a, const std::vector<int>& b, std::size_t shift) {
    std::vector<double> counts(product.size(), 0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
      ++counts[static_cast<std::size_t>(a[i]) * shares_.size() + static_cast<std::size_t>(b[(i + shift) % b.size()])];
    return counts;
  };
  const std::vector<int> even = choices(0, 0), odd = choices(1, 0), same_half = choices(2, 0);
  expect_distribution(pairs(even, odd, 0), product);
  expect_distribution(pairs(even, even, 1), product);
  // Two steps of one golden-ratio sequence are anything but independent: the test can tell.
  EXPECT_LT(chi_square_test(pairs(even, same_half, 0), product).p, false_alarm);
}

// Reflection has Fresnel's probability whichever of four numbers chooses; beyond the critical angle it is certain.
TEST(ReflectOrRefract, HasFresnelsProbability) {
  std::vector<float4> interfaces;
  std::vector<double> distribution;
  for (const std::array<float, 2> n : {std::array<float, 2>{1, 1.5f}, {1.5f, 1}, {1, 2.4f}, {1.33f, 1.9f}})
    for (const float degrees : {0.0f, 20.0f, 35.0f, 60.0f, 75.0f, 85.0f}) {
      const float cosine = std::cos(degrees * static_cast<float>(M_PI) / 180);
      const double reflectance = optics::fresnel_reflectance(static_cast<double>(cosine), static_cast<double>(n[0]),
                                                             static_cast<double>(n[1]));
      interfaces.push_back({cosine, n[0], n[1], 0});
      distribution.insert(distribution.end(), {reflectance, 1 - reflectance});
    }
  const compute::Buffer<float4> at(kernels().context(), "interfaces", std::span<const float4>(interfaces));
  const std::vector<int> reflected = draw<int>(
      "reflections", {{"interfaces", at}, {"interface_count", static_cast<int>(interfaces.size())}, {"seed", seed}});
  for (int choice = 0; choice < 4; ++choice) {
    std::vector<double> counts, expected;
    std::vector<double> all(distribution.size(), 0.0);
    for (std::size_t i = 0; i + i % interfaces.size() < reflected.size(); ++i)
      ++all[2 * (i % interfaces.size()) + ((reflected[i] >> choice & 1) != 0 ? 0 : 1)];
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
      if (distribution[2 * i] == 1) {
        EXPECT_EQ(all[2 * i + 1], 0) << "refracted beyond the critical angle";
        continue;
      }
      const double met = all[2 * i] + all[2 * i + 1];
      counts.insert(counts.end(), {all[2 * i], all[2 * i + 1]});
      expected.insert(expected.end(), {met * distribution[2 * i], met * distribution[2 * i + 1]});
    }
    SCOPED_TRACE(choice);
    // The sum of each interface is fixed.
    expect_distribution(counts, expected, static_cast<int>(counts.size() / 2));
  }
}

} // namespace nephroid::samplers_test
