// SPDX-License-Identifier: Apache-2.0
// The directions in which occluders are looked for, without a device: exact sums, and what is left of a light behind
// balls, against every texel of the cube.
#include "environment/occlusion/samples.h"
#include "tests/environment/maps.h"
#include "tests/support/pictures.h"

namespace nephroid::samples_test {

using namespace nephroid::environment;

Segmentation cut(const CubeMap& cube, int lights) { return segment(cube, {.lights = lights}); }

std::span<const LightSample> samples_of(const std::vector<LightSample>& samples, std::size_t light) {
  return std::span(samples).subspan(1024 * light, 1024);
}

/// A cube of grey noise over some decades, some texels of it black.
CubeMap noise(int size, unsigned seed) {
  CubeMap cube{size, {}};
  for (int i = 0; i < face_count * size * size; ++i) {
    const double flux = test::hashed(i, 0, 1, seed) < 0.3 ? 0.0 : std::pow(10, 4 * test::hashed(i, 0, 0, seed));
    cube.flux.insert(cube.flux.end(), {flux, flux, flux});
  }
  return cube;
}

TEST(Samples, AddUpToTheLightsFlux) {
  for (const test::NamedMap& map : test::synthetic_maps()) {
    const CubeMap cube = make_cube_map(map.map);
    // A threshold of a thousandth drops regions that are not black: their flux is the nearest lights'.
    for (const SegmentSettings& settings :
         {SegmentSettings{.lights = 24}, SegmentSettings{.lights = 64, .threshold = 1e-3}}) {
      const Segmentation lights = segment(cube, settings);
      const std::vector<LightSample> samples = sample_lights(lights, cube);
      ASSERT_EQ(samples.size(), 1024 * lights.lights.size());
      for (std::size_t i = 0; i < lights.lights.size(); ++i) {
        glm::dvec3 sum(0);
        for (const LightSample& sample : samples_of(samples, i)) sum += sample.flux;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / lights.lights[i].flux[c], 1, 1e-12) << map.name << ' ' << i;
      }
    }
  }
}

TEST(Samples, LieInTheirRectangleWhereItIsLit) {
  const CubeMap cube = noise(16, 3);
  for (const int q : {6, 24, 200}) {
    const Segmentation lights = cut(cube, q);
    const std::vector<LightSample> samples = sample_lights(lights, cube);
    for (std::size_t i = 0; i < lights.lights.size(); ++i)
      for (const LightSample& sample : samples_of(samples, i)) {
        const Region& light = lights.lights[i];
        const CubePoint at = met_point(sample.direction);
        const int x = texel_of(at.s, cube.size), y = texel_of(at.t, cube.size);
        EXPECT_EQ(at.face, light.face);
        EXPECT_TRUE(x >= light.rect.x0 && x < light.rect.x1 && y >= light.rect.y0 && y < light.rect.y1)
            << q << ' ' << i;
        EXPECT_GT(cube.flux_of(cube.texel(at.face, x, y)).x, 0) << q << ' ' << i;
        EXPECT_NEAR(glm::length(sample.direction), 1, 1e-12);
      }
  }
}

TEST(Samples, OfGreyLightAreAllAsStrong) {
  const CubeMap cube = noise(16, 5);
  const Segmentation lights = cut(cube, 24);
  const std::vector<LightSample> samples = sample_lights(lights, cube);
  for (std::size_t i = 0; i < lights.lights.size(); ++i)
    for (const LightSample& sample : samples_of(samples, i))
      EXPECT_NEAR(sample.flux.x / lights.lights[i].flux.x * 1024, 1, 1e-9) << i;
}

TEST(Samples, AreAtMostThreeThousandthsOfAChannel) {
  for (const test::NamedMap& map : test::synthetic_maps()) {
    const CubeMap cube = make_cube_map(map.map);
    const Segmentation lights = cut(cube, 24);
    const std::vector<LightSample> samples = sample_lights(lights, cube);
    for (std::size_t i = 0; i < lights.lights.size(); ++i)
      for (const LightSample& sample : samples_of(samples, i))
        for (int c = 0; c < 3; ++c)
          EXPECT_LT(sample.flux[c], 3.0001 / 1024 * lights.lights[i].flux[c]) << map.name << ' ' << i;
  }
}

/// 4096 lights of 1024 samples would be 4 million rays.
TEST(Samples, OfVeryManyLightsAreFewerEach) {
  EXPECT_EQ(samples_per_light(0), 1024u);
  EXPECT_EQ(samples_per_light(256), 1024u);
  EXPECT_EQ(samples_per_light(257), 512u);
  EXPECT_EQ(samples_per_light(4096), 64u);
  const CubeMap cube = make_cube_map(test::synthetic_maps().front().map);
  const Segmentation lights = cut(cube, 1000);
  const std::vector<LightSample> samples = sample_lights(lights, cube);
  ASSERT_EQ(lights.lights.size(), 1000u);
  ASSERT_EQ(samples.size(), 256u * 1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 256; ++k) sum += samples[256 * i + k].flux.y;
    EXPECT_NEAR(sum / lights.lights[i].flux.y, 1, 1e-12) << i;
  }
}

/// An even face: 32 x 32 cells, and 1024 columns and rows that each have one sample. An edge along s or t meets them
/// one by one.
TEST(Samples, OfAnEvenSquareHaveARowAndAColumnEach) {
  CubeMap cube{8, std::vector<double>(18 * 64, 1.0)};
  const Segmentation lights = cut(cube, 6);
  const std::vector<LightSample> samples = sample_lights(lights, cube);
  for (std::size_t i = 0; i < 6; ++i) {
    std::set<int> columns, rows, cells;
    for (const LightSample& sample : samples_of(samples, i)) {
      const CubePoint at = met_point(sample.direction);
      columns.insert(texel_of(at.s, 1024));
      rows.insert(texel_of(at.t, 1024));
      cells.insert(32 * texel_of(at.t, 32) + texel_of(at.s, 32));
    }
    EXPECT_EQ(columns.size(), 1024u);
    EXPECT_EQ(rows.size(), 1024u);
    EXPECT_EQ(cells.size(), 1024u);
  }
}

/// A light's rectangle in 32 x 32 even parts, as the thesis renders it, each seen in its middle.
std::vector<LightSample> even_samples(const Segmentation& lights, const CubeMap& cube) {
  std::vector<LightSample> samples;
  for (const Region& light : lights.lights) {
    const double width = light.rect.width() / 32.0, height = light.rect.height() / 32.0;
    for (int i = 0; i < 1024; ++i) {
      const int column = i % 32, row = i / 32;
      const double left = light.rect.x0 + width * column, top = light.rect.y0 + height * row;
      LightSample sample;
      sample.direction = glm::normalize(
          position({light.face, 2 * (left + width / 2) / cube.size - 1, 2 * (top + height / 2) / cube.size - 1}));
      for (int y = static_cast<int>(top); y < top + height; ++y)
        for (int x = static_cast<int>(left); x < left + width; ++x)
          sample.flux += (std::min(top + height, y + 1.0) - std::max<double>(top, y)) *
                         (std::min(left + width, x + 1.0) - std::max<double>(left, x)) *
                         cube.flux_of(cube.texel(light.face, x, y));
      samples.push_back(sample);
    }
  }
  return samples;
}

/// Every texel of a light, in 4 x 4 parts.
std::vector<LightSample> texels_of(const Region& light, const CubeMap& cube) {
  std::vector<LightSample> texels;
  for (int y = 4 * light.rect.y0; y < 4 * light.rect.y1; ++y)
    for (int x = 4 * light.rect.x0; x < 4 * light.rect.x1; ++x)
      texels.push_back({glm::normalize(position({light.face, middle(x, 4 * cube.size), middle(y, 4 * cube.size)})),
                        cube.flux_of(cube.texel(light.face, x / 4, y / 4)) / 16.0});
  return texels;
}

/// What a ball that is seen as a disc about a direction leaves of the light.
glm::dvec3 left_behind(const glm::dvec3& ball, double radius_deg, std::span<const LightSample> samples) {
  const double edge = std::cos(radius_deg * test::pi / 180);
  glm::dvec3 sum(0);
  for (const LightSample& sample : samples)
    if (glm::dot(sample.direction, ball) < edge) sum += sample.flux;
  return sum;
}

struct Errors {
  double sum = 0, count = 0, largest = 0;
  void add(double error) {
    sum += error;
    ++count;
    largest = std::max(largest, error);
  }
  double mean() const { return sum / count; }
};

/// Errors are in parts of all the map's light: of the lights that the ball hides a part of, and of all lights together.
TEST(Samples, FindWhatABallHides) {
  Errors of_lights, of_all, even_of_lights, even_of_all;
  for (const test::NamedMap& map : test::synthetic_maps()) {
    const CubeMap cube = make_cube_map(map.map);
    const Segmentation lights = cut(cube, 24);
    const std::vector<LightSample> samples = sample_lights(lights, cube), even = even_samples(lights, cube);
    std::vector<std::vector<LightSample>> texels;
    for (const Region& light : lights.lights) texels.push_back(texels_of(light, cube));
    for (int k = 0; k < 48; ++k) {
      // Spread over the sphere; every fourth is before the strongest light.
      const auto strongest =
          std::ranges::max_element(lights.lights, {}, [](const Region& light) { return light.flux.y; });
      const double height = 1 - (2 * k + 1) / 48.0, turn = 2.4 * k, radius_deg = 2.0 + 4 * (k % 7);
      const glm::dvec3 spread(std::sqrt(1 - height * height) * std::cos(turn), height,
                              std::sqrt(1 - height * height) * std::sin(turn));
      const glm::dvec3 ball = k % 4 == 0 ? glm::normalize(strongest->direction + 0.05 * spread) : spread;
      double all = 0, even_all = 0;
      for (std::size_t i = 0; i < lights.lights.size(); ++i) {
        const double truth = left_behind(ball, radius_deg, texels[i]).y;
        const double error = (left_behind(ball, radius_deg, samples_of(samples, i)).y - truth) / lights.total_flux.y;
        const double even_error = (left_behind(ball, radius_deg, samples_of(even, i)).y - truth) / lights.total_flux.y;
        all += error;
        even_all += even_error;
        if (truth > 0.9999 * lights.lights[i].flux.y) continue;
        of_lights.add(std::abs(error));
        even_of_lights.add(std::abs(even_error));
      }
      of_all.add(std::abs(all));
      even_of_all.add(std::abs(even_all));
    }
  }
  RecordProperty("lights_mean", std::to_string(of_lights.mean()));
  RecordProperty("lights_largest", std::to_string(of_lights.largest));
  RecordProperty("all_mean", std::to_string(of_all.mean()));
  RecordProperty("all_largest", std::to_string(of_all.largest));
  RecordProperty("even_lights_mean", std::to_string(even_of_lights.mean()));
  RecordProperty("even_lights_largest", std::to_string(even_of_lights.largest));
  RecordProperty("even_all_mean", std::to_string(even_of_all.mean()));
  RecordProperty("even_all_largest", std::to_string(even_of_all.largest));
  EXPECT_LT(of_lights.mean(), 1.2e-4);
  EXPECT_LT(of_lights.largest, 7e-3);
  EXPECT_LT(of_lights.mean(), even_of_lights.mean());
  EXPECT_LT(of_lights.largest, even_of_lights.largest);
}

} // namespace nephroid::samples_test
