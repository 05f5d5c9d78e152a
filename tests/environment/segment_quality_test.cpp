// SPDX-License-Identifier: Apache-2.0
// How far the lights' irradiance is from the map's, over all normals, on six made maps: the default method against the thesis'.
#include "environment/segment/quality.h"
#include "tests/environment/maps.h"
#include "tests/support/test.h"

#include <cstdio>

namespace nephroid::segment_quality_test {

using namespace nephroid::environment;

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

TEST(SegmentQuality, IsTheNormOfTheDifference)
{
  CubeMap cube{1, std::vector<double>(18, 0.0)};
  cube.flux[0] = cube.flux[1] = cube.flux[2] = 1; // all light from +x
  Segmentation wrong;
  wrong.lights = {{0, {0, 0, 1, 1}, {1, 0, 0}, {1, 1, 1}, 1}};
  EXPECT_EQ(irradiance_error(irradiances(cube), wrong), 0);
  wrong.lights[0].flux = {1.1, 1.1, 1.1};
  EXPECT_NEAR(irradiance_error(irradiances(cube), wrong), 0.1, 1e-12);
  wrong.lights[0].flux = {1, 1, 1.3}; // a third of the square is wrong by 30 %
  EXPECT_NEAR(irradiance_error(irradiances(cube), wrong), 0.3 / std::sqrt(3), 1e-12);
  // From -x instead: no normal has both, so the square of the difference is twice that of the truth.
  wrong.lights[0] = {1, {0, 0, 1, 1}, {-1, 0, 0}, {1, 1, 1}, 1};
  EXPECT_NEAR(irradiance_error(irradiances(cube, 4096), wrong), std::sqrt(2), 1e-3);
  EXPECT_EQ(irradiance_error(irradiances(cube), Segmentation{}), 1) << "no light at all";
}

TEST(SegmentQuality, VarianceIsBetterThanHalving)
{
  const std::array<int, 5> counts{8, 16, 24, 64, 256};
  std::vector<test::NamedMap> maps = test::synthetic_maps();
  std::vector<CubeMap> cubes;
  std::vector<std::vector<glm::dvec3>> truths;
  for (const test::NamedMap& named : maps) {
    cubes.push_back(make_cube_map(named.map));
    truths.push_back(irradiances(cubes.back()));
  }
  double last = 1;
  int better = 0;
  for (const int lights : counts) {
    std::array<std::vector<double>, 3> errors; // percent, by variance, thesis, thesis with the weights of the thesis
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const std::array<SegmentSettings, 3> settings{{{.lights = lights},
                                                     {.lights = lights, .method = SegmentMethod::thesis},
                                                     {lights, SegmentMethod::thesis, SegmentWeights::texel}}};
      for (std::size_t k = 0; k < settings.size(); ++k) {
        errors[k].push_back(100 * irradiance_error(truths[i], segment(cubes[i], settings[k])));
        const char* const names[] = {"variance", "thesis", "thesis_texel"};
        RecordProperty(fmt::format("{}_{}_{}", maps[i].name, names[k], lights), fmt::format("{:.3f}", errors[k].back()));
      }
      better += errors[0].back() < errors[1].back();
    }
    const double variance = median(errors[0]), thesis = median(errors[1]);
    std::printf("q %3d: median of 6 maps, %%: variance %.3f, thesis %.3f, thesis with texel weights %.3f\n", lights, variance, thesis,
                median(errors[2]));
    EXPECT_LT(variance, thesis) << lights;
    EXPECT_LT(variance, last == 1 ? 20 : last) << lights;
    last = variance;
  }
  std::printf("variance is better %d times of %zu\n", better, maps.size() * counts.size());
  EXPECT_GE(better, 24);
}

} // namespace nephroid::segment_quality_test
