// SPDX-License-Identifier: Apache-2.0
// Water and reliefs: closed, their normals those of their heights, their waves as long, as fast and as steep as the
// wind and the depth make them.
#include "scene/heights.h"

#include "image/image.h"
#include "scene/scene.h"
#include "tests/support/test.h"

#include <numbers>

namespace nephroid::heights_test {

using preset::Shape;
using scene::Mesh;
using std::numbers::pi;

std::vector<std::string> warnings;

Mesh made(const Shape& shape, double metres = 1) {
  warnings.clear();
  return scene::make_heights(shape, metres, FileFinder(std::filesystem::path()),
                             Location("a.json", "/scene/objects/0/shape"), "object 'pool'", warnings);
}

Shape pool() { return {.type = Shape::Type::water, .size = {4, 1, 3}, .segments = 128}; }

/// Of the top's vertices, which come first, row by row.
struct Top {
  int columns, rows;
  std::vector<double> heights;

  Top(const Mesh& mesh, const Shape& shape)
      : columns(shape.segments + 1),
        rows(static_cast<int>(std::lround(shape.segments * shape.size[2] / shape.size[0])) + 1) {
    for (int i = 0; i < columns * rows; ++i) heights.push_back(mesh.positions[i].y - shape.size[1] / 2);
  }
  double mean_square() const {
    double sum = 0;
    for (const double h : heights) sum += h * h;
    return sum / static_cast<double>(heights.size());
  }
};

TEST(Heights, WaterIsClosedAndFacesOutwards) {
  Shape shape = pool();
  for (const int segments : {3, 64, 129}) {
    shape.segments = segments;
    const Mesh mesh = made(shape);
    const scene::MeshReport report = scene::inspect(mesh);
    EXPECT_TRUE(report.closed());
    EXPECT_EQ(report.degenerate + report.duplicated, 0u);
    EXPECT_NEAR(report.signed_volume, 12, 0.2);
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.texcoords.size(), mesh.triangles.size());
  }
  shape.inwards = true;
  EXPECT_LT(scene::inspect(made(shape)).signed_volume, 0);
}

TEST(Heights, WithoutWindWaterIsFlat) {
  Shape shape = pool();
  shape.wind_m_s = 0;
  const Top top(made(shape), shape);
  EXPECT_EQ(top.mean_square(), 0);
}

TEST(Heights, NormalsAreThoseOfTheHeights) {
  Shape shape = pool();
  shape.segments = 1024;
  const Mesh mesh = made(shape);
  const Top top(mesh, shape);
  const double step = shape.size[0] / shape.segments;
  double largest = 0;
  for (int j = 1; j + 1 < top.rows; ++j)
    for (int i = 1; i + 1 < top.columns; ++i) {
      const auto at = static_cast<std::size_t>(j * top.columns + i);
      const glm::vec3 n = mesh.normals[at];
      const double x = (top.heights[at + 1] - top.heights[at - 1]) / (2 * step);
      largest = std::max(largest, std::abs(-n.x / n.y - x));
    }
  EXPECT_LT(largest, 0.01); // of slopes up to .4; what is left falls with the square of the step
}

/// Their significant height is 4 sigma, for young wind seas .0016 sqrt(g F) U / g (Hasselmann et al. 1973).
TEST(Heights, WavesAreAsHighAsTheWindAndTheFetchMakeThem) {
  Shape shape = pool();
  shape.size = {200, 50, 200};
  shape.segments = 256;
  shape.wind_m_s = 10;
  shape.fetch_m = 5000;
  double sum = 0;
  constexpr int seeds = 8;
  for (int seed = 0; seed < seeds; ++seed) {
    shape.seed = static_cast<std::uint64_t>(seed);
    sum += Top(made(shape), shape).mean_square() / seeds;
  }
  const double expected = 0.0016 * std::sqrt(9.81 * 5000) * 10 / 9.81;
  EXPECT_NEAR(4 * std::sqrt(sum), expected, 0.15 * expected);
}

/// The steepest of them end where Cox and Munk's mean square is reached.
TEST(Heights, SlopesAreThoseOfTheWind) {
  Shape shape = pool();
  shape.segments = 512;
  double sum = 0;
  constexpr int seeds = 8;
  for (int seed = 0; seed < seeds; ++seed) {
    shape.seed = static_cast<std::uint64_t>(seed);
    const Mesh mesh = made(shape);
    const Top top(mesh, shape);
    for (std::size_t i = 0; i < top.heights.size(); ++i) {
      const glm::dvec3 n = mesh.normals[i];
      sum += (n.x * n.x + n.z * n.z) / (n.y * n.y) / static_cast<double>(top.heights.size()) / seeds;
    }
  }
  const double expected = 0.003 + 0.00512 * shape.wind_m_s;
  EXPECT_NEAR(sum, expected, 0.15 * expected);
}

/// A surface that has moved on looks as it did, moved: the mean of h(x, t) h(x + d, t + T) is largest downwind.
TEST(Heights, WavesGoWithTheWind) {
  Shape shape = pool();
  const Top before(made(shape), shape);
  shape.time_s = 0.05;
  const Top after(made(shape), shape);
  double with = 0, against = 0;
  for (int j = 0; j < before.rows; ++j)
    for (int i = 2; i + 2 < before.columns; ++i) {
      const auto at = static_cast<std::size_t>(j * before.columns + i);
      with += before.heights[at] * after.heights[at + 1];
      against += before.heights[at] * after.heights[at - 1];
    }
  EXPECT_GT(with, 1.05 * against);
}

/// The same water in centimetres.
TEST(Heights, TheUnitIsOfTheShapeNotOfTheSea) {
  Shape metres = pool(), centimetres = pool();
  for (double& edge : centimetres.size) edge *= 100;
  const Top a(made(metres), metres), b(made(centimetres, 0.01), centimetres);
  for (std::size_t i = 0; i < a.heights.size(); ++i) EXPECT_NEAR(100 * a.heights[i], b.heights[i], 1e-4);
}

TEST(Heights, WavesThatReachTheBottomAreRefused) {
  Shape shape = pool();
  shape.size = {4, 0.02, 4};
  shape.wind_m_s = 20;
  EXPECT_THAT(test::refusal_of([&] { made(shape); }),
              HasSubstr("a.json#/scene/objects/0/shape/size/1: is 0.02, and the waves' lowest trough is"));
}

TEST(Heights, WhatIsLeftOutIsSaid) {
  Shape lake = pool();
  made(lake);
  EXPECT_THAT(warnings, IsEmpty());
  lake.size = {400, 10, 400};
  made(lake);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("object 'pool': the longest waves of this wind are 0.2")));
  test::TemporaryFolder folder;
  image::write_exr(folder.path() / "mm.exr", {.width = 2, .height = 1, .channels = {"Y"}, .data = {0, 3}});
  Shape relief{.type = Shape::Type::relief, .picture = (folder.path() / "mm.exr").string()};
  made(relief);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("object 'pool': texture mm.exr: 3 values are outside of 0 to 1")));
}

TEST(Heights, AReliefHasTheHeightsOfItsPicture) {
  test::TemporaryFolder folder;
  image::Image ramp{.width = 4, .height = 1, .channels = {"Y"}, .data = {0, 0.25, 0.5, 0.75}};
  image::write_exr(folder.path() / "ramp.exr", ramp);
  Shape shape{.type = Shape::Type::relief, .size = {4, 1, 1}, .height = 2, .segments = 8};
  shape.picture = (folder.path() / "ramp.exr").string();
  const Mesh mesh = made(shape);
  EXPECT_TRUE(scene::inspect(mesh).closed());
  // Texels' middles are at x = -1.5, -.5, .5 and 1.5; beyond them it is flat.
  for (int i = 0; i <= 8; ++i) {
    const double x = -2 + 0.5 * i, value = std::clamp((x + 1.5) / 4, 0.0, 0.75);
    EXPECT_NEAR(mesh.positions[static_cast<std::size_t>(i)].y, 0.5 + 2 * value, 1e-4);
  }
  const glm::vec3 n = mesh.normals[4];
  EXPECT_NEAR(-n.x / n.y, 0.5, 1e-3); // 2 units over 4
  shape.picture = "nowhere.png";
  EXPECT_THAT(test::refusal_of([&] { made(shape); }), HasSubstr("a.json#/scene/objects/0/shape/picture"));
}

} // namespace nephroid::heights_test
