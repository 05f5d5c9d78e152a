// SPDX-License-Identifier: Apache-2.0
// photons/stretch.h: what a splat is stretched along, without a device.
#include "tests/support/test.h"
#include "tracing/wavelength_tables.h"

namespace nephroid::stretch_test {

using tracing::make_stretch_tables;
using tracing::StretchParameter;

const std::vector<bool> all_lit(optics::wavelength_count, true);

/// One object a curve.
scene::Scene scene_of(const std::vector<optics::Spectrum>& curves) {
  scene::Scene scene;
  for (const optics::Spectrum& n : curves) {
    scatter::Material material{.type = scatter::Material::Type::dielectric, .n = n};
    scene::Object object{.material = static_cast<int>(scene.materials.size())};
    scene.materials.push_back(material);
    scene.objects.push_back(object);
  }
  return scene;
}

optics::Spectrum curve(double (*n)(double nm)) {
  optics::Spectrum values{};
  for (int w = 0; w < optics::wavelength_count; ++w) values[static_cast<std::size_t>(w)] = n(optics::wavelength_nm(w));
  return values;
}

double cauchy(double nm) { return 1.7 + 15000 / (nm * nm); }
double crown(double nm) { return 1.5 + 5000 / (nm * nm); }
double constant(double) { return 1.33; }
double staircase(double nm) { return nm < 500 ? 1.9 : 1.7; }
double valley(double nm) { return 1.6 + 1e-6 * (nm - 580) * (nm - 580); }

std::vector<std::vector<int>> each_alone() {
  std::vector<std::vector<int>> clusters;
  for (int w = 0; w < optics::wavelength_count; ++w) clusters.push_back({w});
  return clusters;
}

TEST(Stretch, FollowsTheIndexOfOneCurveAndTheWavelengthOfSeveral) {
  EXPECT_EQ(tracing::stretch_parameter(scene_of({})), StretchParameter::none);
  EXPECT_EQ(tracing::stretch_parameter(scene_of({curve(constant)})), StretchParameter::none);
  EXPECT_EQ(tracing::stretch_parameter(scene_of({curve(cauchy), curve(constant), curve(cauchy)})),
            StretchParameter::index);
  EXPECT_EQ(tracing::stretch_parameter(scene_of({curve(cauchy), curve(crown)})), StretchParameter::wavelength);
}

TEST(Stretch, OfOneCurveSIsTheIndexOfRefraction) {
  const tracing::StretchTables tables =
      make_stretch_tables(scene_of({curve(cauchy), curve(constant)}), each_alone(), all_lit);
  ASSERT_EQ(tables.index_slope.size(), 2u * 401);
  EXPECT_EQ(tables.index_slope[0], 1);
  EXPECT_EQ(tables.index_slope[1], 0);
  for (std::size_t w = 1; w + 1 < 401; ++w) {
    EXPECT_NEAR(tables.stretch_place[w].x, cauchy(380.0 + double(w)) - cauchy(580), 1e-8);
    EXPECT_EQ(tables.stretch_place[w].y, tables.stretch_place[w - 1].x);
    EXPECT_EQ(tables.stretch_place[w].z, tables.stretch_place[w + 1].x);
    EXPECT_EQ(tables.stretch_span[w].x, tables.stretch_place[w].x);
    EXPECT_EQ(tables.stretch_span[w].y, tables.stretch_place[w].z); // n falls
    EXPECT_EQ(tables.stretch_span[w].z, tables.stretch_place[w].y);
  }
  EXPECT_NEAR(tables.stretch_place[0].y - tables.stretch_place[0].x,
              tables.stretch_place[0].x - tables.stretch_place[0].z,
              1e-8); // on beyond the end
}

TEST(Stretch, OfSeveralCurvesTheSlopesAreThoseOfTheCurves) {
  const tracing::StretchTables tables =
      make_stretch_tables(scene_of({curve(cauchy), curve(crown)}), {{198, 199, 200, 201, 202}}, all_lit);
  EXPECT_NEAR(tables.index_slope[0], -2 * 15000 / std::pow(580.0, 3), 2e-8);
  EXPECT_NEAR(tables.index_slope[1], -2 * 5000 / std::pow(580.0, 3), 1e-8);
  EXPECT_NEAR(tables.stretch_span[0].x, 0, 1e-12);
  EXPECT_EQ(tables.stretch_span[0].y, -3);
  EXPECT_EQ(tables.stretch_span[0].z, 3);
}

TEST(Stretch, NothingLiesBetweenTheSidesOfAJump) {
  const tracing::StretchTables tables = make_stretch_tables(scene_of({curve(staircase)}), each_alone(), all_lit);
  EXPECT_EQ(tables.stretch_place[119].z, tables.stretch_place[119].x); // 499 nm
  EXPECT_EQ(tables.stretch_place[120].y, tables.stretch_place[120].x);
  EXPECT_NEAR(tables.stretch_place[119].x - tables.stretch_place[120].x, 0.2, 1e-7);
}

TEST(Stretch, AnExtremeOfACurveIsNoJump) {
  const tracing::StretchTables tables = make_stretch_tables(scene_of({curve(valley)}), each_alone(), all_lit);
  for (std::size_t w = 1; w < 401; ++w) EXPECT_EQ(tables.stretch_place[w].y, tables.stretch_place[w - 1].x) << w;
}

TEST(Stretch, ASpanHoldsTheLitWavelengthsOnlyAndDarkClustersHaveNone) {
  std::vector<bool> lit = all_lit;
  lit[10] = lit[11] = lit[20] = false;
  const tracing::StretchTables tables = make_stretch_tables(scene_of({curve(cauchy)}), {{9, 10, 11}, {20}, {30}}, lit);
  ASSERT_EQ(tables.stretch_span.size(), 2u);
  EXPECT_EQ(tables.stretch_span[0].z, tables.stretch_place[9].y);
  EXPECT_EQ(tables.stretch_span[0].y, tables.stretch_place[9].z);
  EXPECT_NEAR(tables.stretch_span[0].x,
              (tables.stretch_place[9].x + tables.stretch_place[10].x + tables.stretch_place[11].x) / 3,
              1e-8); // as the mean index
}

TEST(Stretch, RunsAreOfNeighboursAndLoseNoWavelength) {
  const auto runs = tracing::split_into_runs({{5, 7, 6, 1}, {2, 3}, {4}});
  const std::vector<std::vector<int>> expected{{1}, {2, 3}, {4}, {5, 6, 7}};
  EXPECT_EQ(runs, expected);
}

} // namespace nephroid::stretch_test
