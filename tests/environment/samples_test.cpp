// SPDX-License-Identifier: Apache-2.0
// The directions in which occluders are looked for, without a device: exact sums, and what is left of a light behind balls, against every
// texel of the cube.
#include "environment/occlusion/occlusion.h"
#include "scene/bvh.h"
#include "tests/environment/bakes.h"
#include "tests/environment/maps.h"
#include "tests/support/pictures.h"

namespace nephroid::samples_test {

using namespace nephroid::environment;

Segmentation cut(const CubeMap& cube, int lights) { return segment(cube, {.lights = lights}); }

std::span<const LightSample> samples_of(const std::vector<LightSample>& samples, std::size_t light)
{
  return std::span(samples).subspan(1024 * light, 1024);
}

/// A cube of grey noise over some decades, some texels of it black.
CubeMap noise(int size, unsigned seed)
{
  CubeMap cube{size, {}};
  for (int i = 0; i < face_count * size * size; ++i) {
    const double flux = test::hashed(i, 0, 1, seed) < 0.3 ? 0.0 : std::pow(10, 4 * test::hashed(i, 0, 0, seed));
    cube.flux.insert(cube.flux.end(), {flux, flux, flux});
  }
  return cube;
}

TEST(Samples, AddUpToTheLightsFlux)
{
  for (const test::NamedMap& map : test::synthetic_maps()) {
    const CubeMap cube = make_cube_map(map.map);
    // A threshold of a thousandth drops regions that are not black: their flux is the nearest lights'.
    for (const SegmentSettings& settings : {SegmentSettings{.lights = 24}, SegmentSettings{.lights = 64, .threshold = 1e-3}}) {
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

TEST(Samples, LieInTheirRectangleWhereItIsLit)
{
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
        EXPECT_TRUE(x >= light.rect.x0 && x < light.rect.x1 && y >= light.rect.y0 && y < light.rect.y1) << q << ' ' << i;
        EXPECT_GT(cube.flux_of(cube.texel(at.face, x, y)).x, 0) << q << ' ' << i;
        EXPECT_NEAR(glm::length(sample.direction), 1, 1e-12);
      }
  }
}

TEST(Samples, OfGreyLightAreAllAsStrong)
{
  const CubeMap cube = noise(16, 5);
  const Segmentation lights = cut(cube, 24);
  const std::vector<LightSample> samples = sample_lights(lights, cube);
  for (std::size_t i = 0; i < lights.lights.size(); ++i)
    for (const LightSample& sample : samples_of(samples, i)) EXPECT_NEAR(sample.flux.x / lights.lights[i].flux.x * 1024, 1, 1e-9) << i;
}

TEST(Samples, AreAtMostThreeThousandthsOfAChannel)
{
  for (const test::NamedMap& map : test::synthetic_maps()) {
    const CubeMap cube = make_cube_map(map.map);
    const Segmentation lights = cut(cube, 24);
    const std::vector<LightSample> samples = sample_lights(lights, cube);
    for (std::size_t i = 0; i < lights.lights.size(); ++i)
      for (const LightSample& sample : samples_of(samples, i))
        for (int c = 0; c < 3; ++c) EXPECT_LT(sample.flux[c], 3.0001 / 1024 * lights.lights[i].flux[c]) << map.name << ' ' << i;
  }
}

/// 4096 lights of 1024 samples would be 4 million rays.
TEST(Samples, OfVeryManyLightsAreFewerEach)
{
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

/// An even face: 32 x 32 cells, and 1024 columns and rows that each have one sample. An edge along s or t meets them one by one.
TEST(Samples, OfAnEvenSquareHaveARowAndAColumnEach)
{
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
std::vector<LightSample> even_samples(const Segmentation& lights, const CubeMap& cube)
{
  std::vector<LightSample> samples;
  for (const Region& light : lights.lights) {
    const double width = light.rect.width() / 32.0, height = light.rect.height() / 32.0;
    for (int i = 0; i < 1024; ++i) {
      const int column = i % 32, row = i / 32;
      const double left = light.rect.x0 + width * column, top = light.rect.y0 + height * row;
      LightSample sample;
      sample.direction =
          glm::normalize(position({light.face, 2 * (left + width / 2) / cube.size - 1, 2 * (top + height / 2) / cube.size - 1}));
      for (int y = static_cast<int>(top); y < top + height; ++y)
        for (int x = static_cast<int>(left); x < left + width; ++x)
          sample.flux += (std::min(top + height, y + 1.0) - std::max<double>(top, y)) *
                         (std::min(left + width, x + 1.0) - std::max<double>(left, x)) * cube.flux_of(cube.texel(light.face, x, y));
      samples.push_back(sample);
    }
  }
  return samples;
}

/// Every texel of a light, in 4 x 4 parts.
std::vector<LightSample> texels_of(const Region& light, const CubeMap& cube)
{
  std::vector<LightSample> texels;
  for (int y = 4 * light.rect.y0; y < 4 * light.rect.y1; ++y)
    for (int x = 4 * light.rect.x0; x < 4 * light.rect.x1; ++x)
      texels.push_back({glm::normalize(position({light.face, middle(x, 4 * cube.size), middle(y, 4 * cube.size)})),
                        cube.flux_of(cube.texel(light.face, x / 4, y / 4)) / 16.0});
  return texels;
}

/// What a ball that is seen as a disc about a direction leaves of the light.
glm::dvec3 left_behind(const glm::dvec3& ball, double radius_deg, std::span<const LightSample> samples)
{
  const double edge = std::cos(radius_deg * test::pi / 180);
  glm::dvec3 sum(0);
  for (const LightSample& sample : samples)
    if (glm::dot(sample.direction, ball) < edge) sum += sample.flux;
  return sum;
}

struct Errors {
  double sum = 0, count = 0, largest = 0;
  void add(double error)
  {
    sum += error;
    ++count;
    largest = std::max(largest, error);
  }
  double mean() const { return sum / count; }
};

/// Errors are in parts of all the map's light: of the lights that the ball hides a part of, and of all lights together.
TEST(Samples, FindWhatABallHides)
{
  Errors of_lights, of_all, even_of_lights, even_of_all;
  for (const test::NamedMap& map : test::synthetic_maps()) {
    const CubeMap cube = make_cube_map(map.map);
    const Segmentation lights = cut(cube, 24);
    const std::vector<LightSample> samples = sample_lights(lights, cube), even = even_samples(lights, cube);
    std::vector<std::vector<LightSample>> texels;
    for (const Region& light : lights.lights) texels.push_back(texels_of(light, cube));
    for (int k = 0; k < 48; ++k) {
      // Spread over the sphere; every fourth is before the strongest light.
      const auto strongest = std::ranges::max_element(lights.lights, {}, [](const Region& light) { return light.flux.y; });
      const double height = 1 - (2 * k + 1) / 48.0, turn = 2.4 * k, radius_deg = 2.0 + 4 * (k % 7);
      const glm::dvec3 spread(std::sqrt(1 - height * height) * std::cos(turn), height, std::sqrt(1 - height * height) * std::sin(turn));
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

// The lights that passes draw of a sky: they cover each light's region evenly, and leave out what is hidden.

/// A map as few lights, and the mean of what passes draw of them.
struct Sky {
  CubeMap cube;
  Segmentation lights;
  Occlusion occlusion;

  Sky(const scene::Environment& map, int q)
      : cube(make_cube_map(map)), lights(segment(cube, {.lights = q})), occlusion(test::bake_context(), lights, cube)
  {
  }

  /// of(light): a sum over lights, in the mean over passes 1..passes.
  template <class Of>
  double mean(std::uint32_t passes, const Of& of) const
  {
    double sum = 0;
    for (std::uint32_t pass = 1; pass <= passes; ++pass)
      for (const VisibleLight& light : occlusion.drawn_lights(pass)) sum += of(light);
    return sum / passes;
  }
};

/// Over the part of an even sky about each of twelve axes that lies within some 8 degrees, about as narrow as what a ball lens throws:
/// ((1 + cos) / 2)^100, whose integral over the sphere is 4 pi / 101. Root mean square, as a part of it.
double off_in_lobes(const Sky& sky, std::uint32_t passes)
{
  double squares = 0;
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 axis = scene::even_direction(i, 12);
    const double mean = sky.mean(
        passes, [&](const VisibleLight& light) { return light.flux.y * std::pow((1 + glm::dot(light.direction, axis)) / 2, 100); });
    squares += std::pow(mean * 101 / (4 * pi) - 1, 2) / 12;
  }
  return std::sqrt(squares);
}

// The lobe's variance is 50 times its mean squared, so points by chance would be 20 % off at q = 8 after 150 passes, 10 % after 600, and 12
// % at q = 24 after 150.
TEST(DrawnLights, CoverTheSkyEvenly)
{
  const Sky few(test::uniform_map(64, 32), 8), many(test::uniform_map(64, 32), 24);
  const double first = off_in_lobes(few, 150), later = off_in_lobes(few, 600), more = off_in_lobes(many, 150);
  fmt::print("q = 8: {:.2f} % off after 150 passes, {:.2f} % after 600; q = 24: {:.2f} % after 150\n", 100 * first, 100 * later,
             100 * more);
  EXPECT_LT(first, 0.08);
  EXPECT_LT(later, 0.025);
  EXPECT_LT(more, 0.035);
}

TEST(DrawnLights, HaveTheColourOfTheirRegions)
{
  const Sky sky(test::synthetic_maps(64)[3].map, 24);
  glm::dvec3 all(0);
  for (const Region& light : sky.lights.lights) all += light.flux;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sky.mean(512, [&](const VisibleLight& light) { return light.flux[c]; }) / all[c], 1, 0.002) << c;
}

/// A sky with balls of radius 2 about the object, at these heights: what is seen of its lights, summed.
double seen_between(Sky& sky, const std::vector<double>& heights)
{
  std::string balls;
  for (const double y : heights)
    balls +=
        fmt::format(R"(, {{"shape": {{"type": "sphere", "radius": 2}}, "material": "wall", "transform": {{"translate": [0, {}, 0]}}}})", y);
  const scene::Scene scene = without_caster(scene::load_scene(test::bake_preset(test::glass_ball + balls)), {0});
  tracing::World world = surroundings_world(test::bake_context(), scene);
  double seen = 0;
  for (const VisibleLight& light : sky.occlusion.visible_lights(world, 0, {glm::dvec3(0)})) seen += light.flux.y;
  return seen;
}

// Of a sky with a ball before it, what drawn cells have is what is seen of the lights; none has light that comes from behind the ball.
TEST(DrawnLights, LeaveOutWhatIsHidden)
{
  Sky sky(test::uniform_map(64, 32), 24);
  const double seen = seen_between(sky, {4});
  const double hidden = 2 * pi * (1 - std::sqrt(0.75)); // the ball is 60 degrees wide
  EXPECT_NEAR(seen, 4 * pi - hidden, 0.002 * 4 * pi);
  EXPECT_NEAR(sky.mean(1024, [](const VisibleLight& light) { return light.flux.y; }), seen, 0.002 * 4 * pi);
  EXPECT_EQ(sky.mean(64, [](const VisibleLight& light) { return light.direction.y > std::cos(0.51) ? light.flux.y : 0; }), 0);
}

// Two balls leave a belt 1.6 degrees wide: a few cells of a light. Many are drawn before one of those is.
TEST(DrawnLights, FindTheFewThatAreSeen)
{
  Sky sky(test::uniform_map(64, 32), 24);
  const double height = 2.0002;
  const double seen = seen_between(sky, {height, -height}), half_belt = std::acos(2 / height);
  EXPECT_NEAR(seen, 4 * pi * std::sin(half_belt), 0.3 * seen);
  EXPECT_NEAR(sky.mean(64, [](const VisibleLight& light) { return light.flux.y; }), seen, 1e-6 * seen);
  EXPECT_EQ(
      sky.mean(64, [&](const VisibleLight& light) { return std::abs(light.direction.y) > 1.001 * std::sin(half_belt) ? light.flux.y : 0; }),
      0);
}

} // namespace nephroid::samples_test
