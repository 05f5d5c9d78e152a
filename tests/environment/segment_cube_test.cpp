// SPDX-License-Identifier: Apache-2.0
// The cube's geometry against closed forms, and its light against sums over the texels of the map.
#include "environment/segment/cube.h"
#include "environment/segment/irradiance.h"
#include "scene/bvh.h"
#include "scene/ray.h"
#include "scene/scene.h"
#include "tests/environment/maps.h"
#include "tests/support/pictures.h"

namespace nephroid::segment_cube_test {

using namespace nephroid::environment;

TEST(SegmentCube, FacesLieAsInCubeMapsOfOpenGl) {
  // Right and down of each face: the table "Selection of cube map images" of the OpenGL specification.
  const glm::dvec3 axes[face_count][3] = {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                          {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                          {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
  for (int face = 0; face < face_count; ++face)
    EXPECT_EQ(position({face, 0.25, -0.5}), axes[face][0] + 0.25 * axes[face][1] - 0.5 * axes[face][2])
        << face_names.at(static_cast<std::size_t>(face));
}

TEST(SegmentCube, ADirectionMeetsThePointThatItCameFrom) {
  for (int i = 0; i < 10000; ++i) {
    const glm::dvec3 direction = scene::even_direction(i, 10000);
    const CubePoint point = met_point(7.0 * direction);
    EXPECT_LE(std::max(std::abs(point.s), std::abs(point.t)), 1);
    EXPECT_LT(glm::distance(glm::normalize(position(point)), direction), 1e-15) << i;
  }
  for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 1, 1), glm::dvec3(0, -1, 1)})
    EXPECT_LT(glm::distance(glm::normalize(position(met_point(axis))), glm::normalize(axis)), 1e-15);
}

TEST(SegmentCube, TexelsContainTheirMiddles) {
  for (const int size : {1, 2, 7, 128, 512})
    for (int i = 0; i < size; ++i) {
      EXPECT_EQ(texel_of(middle(i, size), size), i);
      EXPECT_NEAR(middle(i, size), (border(i, size) + border(i + 1, size)) / 2, 1e-15);
    }
  EXPECT_EQ(texel_of(1, 128), 127);
  EXPECT_EQ(texel_of(-1, 128), 0);
}

TEST(SegmentCube, SolidAnglesAddUpToTheSphere) {
  EXPECT_NEAR(solid_angle({0, 0, 128, 128}, 128), 4 * test::pi / 6, 1e-14);
  EXPECT_NEAR(solid_angle({0, 0, 64, 64}, 128), 4 * test::pi / 24, 1e-14);
  constexpr int size = 37;
  double sum = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) sum += solid_angle({x, y, x + 1, y + 1}, size);
  EXPECT_NEAR(6 * sum, 4 * test::pi, 1e-13);
  // dA cos / r^2 = dA (1 + s^2 + t^2)^(-3/2): a corner has 3^(-3/2) of the middle.
  const double corner = solid_angle({0, 0, 1, 1}, 512), centre = solid_angle({256, 256, 257, 257}, 512);
  EXPECT_NEAR(centre, 4.0 / (512 * 512), 1e-9);
  EXPECT_NEAR(corner / centre, std::pow(3, -1.5), 1e-3);
}

/// A map of hashed colours over six decades.
scene::Environment wild_map(int width, int height) {
  scene::Environment map{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) map.rgb.push_back(static_cast<float>(std::pow(10, 6 * test::hashed(x, y, c, 3) - 2)));
  map.radiance = 0.7;
  return map;
}

glm::dvec3 flux_of(const CubeMap& cube) {
  glm::dvec3 sum{0};
  for (std::size_t i = 0; i < cube.flux.size() / 3; ++i) sum += cube.flux_of(i);
  return sum;
}

TEST(SegmentCube, FluxIsThatOfTheTexels) {
  for (const auto& [width, height] :
       std::vector<std::pair<int, int>>{{64, 32}, {37, 19}, {1, 1}, {5, 1}, {1, 9}, {300, 20}}) {
    const scene::Environment map = wild_map(width, height);
    const glm::dvec3 flux = flux_of(make_cube_map(map)), right = test::flux_of_texels(map);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] / right[c], 1, 1e-12) << width << " x " << height;
  }
}

TEST(SegmentCube, LightStaysWhereItIs) {
  constexpr int width = 128, height = 64;
  for (const auto& [column, row] :
       std::vector<std::pair<int, int>>{{0, 0}, {64, 32}, {100, 10}, {127, 40}, {33, 63}, {96, 31}}) {
    scene::Environment map = test::uniform_map(width, height, glm::dvec3(0));
    map.rgb[3 * static_cast<std::size_t>(row * width + column)] = 1;
    const CubeMap cube = make_cube_map(map);
    glm::dvec3 moment{0};
    double flux = 0;
    for (int face = 0; face < face_count; ++face)
      for (int y = 0; y < cube.size; ++y)
        for (int x = 0; x < cube.size; ++x) {
          const double value = cube.flux[3 * cube.texel(face, x, y)];
          const glm::dvec3 direction = glm::normalize(position({face, middle(x, cube.size), middle(y, cube.size)}));
          moment += value * direction;
          flux += value;
          // A texel of the map has 2.8 degrees, one of the cube 0.9.
          const glm::dvec3 right = test::map_direction(column + 0.5, row + 0.5, width, height);
          EXPECT_TRUE(value == 0 || glm::dot(direction, right) > std::cos(3 * test::pi / 180));
        }
    // The integral of the direction over the texel's rectangle of longitude and latitude, by 200 x 200 points.
    glm::dvec3 right{0};
    double all = 0;
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j < 200; ++j) {
        const glm::dvec3 direction =
            test::map_direction(column + (i + 0.5) / 200, row + (j + 0.5) / 200, width, height);
        const double weight = std::sqrt(1 - direction.y * direction.y);
        right += weight * direction;
        all += weight;
      }
    // A texel at a pole is narrower than one of the cube, whose middle stands for it.
    EXPECT_LT(glm::distance(moment / flux, right / all), row == 0 || row == height - 1 ? 1.0 / cube.size : 5e-4)
        << column << ", " << row;
  }
}

// Each texel's share is exact but for the parts on its border: a part is a quarter of a texel wide or less.
TEST(SegmentCube, AUniformMapIsUniform) {
  const CubeMap cube = make_cube_map(test::uniform_map(64, 32));
  double largest = 0, squares = 0;
  for (int face = 0; face < face_count; ++face) {
    double of_face = 0;
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) {
        const double flux = cube.flux[3 * cube.texel(face, x, y)],
                     off = flux / solid_angle({x, y, x + 1, y + 1}, cube.size) - 1;
        of_face += flux;
        largest = std::max(largest, std::abs(off));
        squares += off * off;
      }
    EXPECT_NEAR(of_face, 4 * test::pi / 6, 3e-4);
  }
  const double deviation = std::sqrt(squares / (6.0 * cube.size * cube.size));
  RecordProperty("largest", std::to_string(largest));
  RecordProperty("deviation", std::to_string(deviation));
  EXPECT_LT(deviation, 0.1);
  EXPECT_LT(largest, 0.5);
}

TEST(SegmentCube, SizeFollowsTheMap) {
  EXPECT_EQ(cube_size({1, 1, {}}), 128);
  EXPECT_EQ(cube_size({1024, 512, {}}), 256);
  EXPECT_EQ(cube_size({100, 500, {}}), 250);
  EXPECT_EQ(cube_size({1030, 515, {}}), 258);
  EXPECT_EQ(cube_size({16384, 8192, {}}), 512);
}

// preset.h: rotate_deg turns the surroundings about +y, counterclockwise as seen from above, where +x is right and -z
// up.
TEST(SegmentCube, DirectionsTurnAsTheMapDoes) {
  EXPECT_LT(glm::distance(turned({1, 0, 0}, 90), glm::dvec3(0, 0, -1)), 1e-15);
  EXPECT_LT(glm::distance(turned({0, 0, -1}, 90), glm::dvec3(-1, 0, 0)), 1e-15);
  EXPECT_LT(glm::distance(turned({0.6, 0.8, 0}, -3600), glm::dvec3(0.6, 0.8, 0)), 1e-15);
  EXPECT_LT(glm::distance(turned({0, 1, 0}, 33), glm::dvec3(0, 1, 0)), 1e-15);
}

// How far the lights' irradiance is from the map's, over all normals, on six made maps: the default method against the
// thesis'.

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

TEST(SegmentQuality, IsTheNormOfTheDifference) {
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

TEST(SegmentQuality, VarianceIsBetterThanHalving) {
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
        RecordProperty(fmt::format("{}_{}_{}", maps[i].name, names[k], lights),
                       fmt::format("{:.3f}", errors[k].back()));
      }
      better += errors[0].back() < errors[1].back();
    }
    const double variance = median(errors[0]), thesis = median(errors[1]);
    std::printf("q %3d: median of 6 maps, %%: variance %.3f, thesis %.3f, thesis with texel weights %.3f\n", lights,
                variance, thesis, median(errors[2]));
    EXPECT_LT(variance, thesis) << lights;
    EXPECT_LT(variance, last == 1 ? 20 : last) << lights;
    last = variance;
  }
  std::printf("variance is better %d times of %zu\n", better, maps.size() * counts.size());
  EXPECT_GE(better, 24);
}

} // namespace nephroid::segment_cube_test
