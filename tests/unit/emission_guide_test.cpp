// SPDX-License-Identifier: Apache-2.0
// Where photons and samples go: what is learned about where photons matter, the cells that a film of layers has, the
// pixels in which a path may meet glass.
#include "photons/effort/emitters.h"
#include "photons/pixel_surfaces.h"
#include "photons/relight/layer_film.h"
#include "photons/relight/layer_light.h"
#include "scene/ray.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/presets.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::emission_guide_test {

using photons::EmissionGuide;
using namespace nephroid::photons;

constexpr std::size_t guide_cells = GUIDE_CELLS;
constexpr double even = 1.0 / guide_cells;
constexpr double dark_part = 0.15; // of the photons, spread evenly whatever was learned

std::size_t cell_at(std::size_t x, std::size_t y, std::size_t z) { return (x * GUIDE_BINS_Y + y) * GUIDE_BINS_Z + z; }

/// The chance of each cell of a light, as the three cdfs of kernels/photons/guide.h give it.
std::vector<double> chances(const EmissionGuide& guide, std::size_t light = 0) {
  const auto table = guide.table().begin() + static_cast<std::ptrdiff_t>(light * GUIDE_FLOATS);
  const auto difference = [&](std::size_t cdf, std::size_t i) {
    return static_cast<double>(table[static_cast<std::ptrdiff_t>(cdf + i)]) -
           (i > 0 ? static_cast<double>(table[static_cast<std::ptrdiff_t>(cdf + i - 1)]) : 0.0);
  };
  std::vector<double> result(guide_cells);
  for (std::size_t x = 0; x < GUIDE_BINS_X; ++x)
    for (std::size_t y = 0; y < GUIDE_BINS_Y; ++y)
      for (std::size_t z = 0; z < GUIDE_BINS_Z; ++z)
        result[cell_at(x, y, z)] =
            difference(0, x) * difference(GUIDE_BINS_X + x * GUIDE_BINS_Y, y) *
            difference(GUIDE_BINS_X + GUIDE_BINS_X * GUIDE_BINS_Y + (x * GUIDE_BINS_Y + y) * GUIDE_BINS_Z, z);
  return result;
}

/// The moments of a pass of `photons` photons, of which one that is sent evenly adds f[cell] / photons, in `unit`s:
/// those of a cell are photons * chance, and each adds f / (photons * chance * cells).
std::vector<std::int64_t> moments_of(const std::vector<double>& f, const std::vector<double>& chance, double photons,
                                     double unit) {
  std::vector<std::int64_t> moments(guide_cells);
  for (std::size_t c = 0; c < guide_cells; ++c) {
    const double one = f[c] / (photons * chance[c] * guide_cells);
    moments[c] = std::llround(photons * chance[c] * one * one / unit);
  }
  return moments;
}

TEST(EmissionGuide, IsEvenToBeginWith) {
  const EmissionGuide guide(2);
  ASSERT_EQ(guide.table().size(), 2u * GUIDE_FLOATS);
  for (const std::size_t light : {0u, 1u}) {
    const std::vector<double> chance = chances(guide, light);
    // A quantum of 2^-24 in each of three cdfs of 16 is 1e-6 of a chance.
    for (const double value : chance) EXPECT_NEAR(value, even, 4e-6 * even);
  }
}

// Where nothing was added anywhere, there is nothing to learn.
TEST(EmissionGuide, StaysEvenInTheDark) {
  EmissionGuide guide(1);
  guide.learn(std::vector<std::int64_t>(guide_cells, 0), std::vector<double>{1000}, 2);
  for (const double value : chances(guide)) EXPECT_NEAR(value, even, 4e-6 * even);
}

// What was learned first is not pooled with what comes after: the chances are those of the second alone.
TEST(EmissionGuide, ForgetsWhatItIsTold) {
  EmissionGuide guide(1), other(1);
  std::vector<double> first(guide_cells, 0.0), second(guide_cells, 1.0);
  for (std::size_t c = 0; c < guide_cells / 4; ++c) first[c] = 100;
  guide.learn(moments_of(first, chances(guide), 1e6, 1e-12), std::vector<double>{1e6}, 1);
  const std::vector<double> chance = chances(guide);
  guide.forget();
  EXPECT_EQ(chances(guide), chance) << "until there is more";
  guide.learn(std::vector<std::int64_t>(guide_cells, 0), std::vector<double>{1e6}, 1);
  EXPECT_EQ(chances(guide), chance) << "and nothing is no more";
  guide.forget();
  guide.learn(moments_of(second, chance, 1e6, 1e-14), std::vector<double>{1e6}, 1);
  for (const double value : chances(guide)) EXPECT_NEAR(value, even, 0.05 * even);
}

// Cells of one x are alike, so the blur over y and z changes nothing: those of x < 4 with f = 3, those of x >= 12 with
// f = 1, the others dark. The chance goes as f: 3/4 and 1/4 of 85 %, over 1024 cells each, and 15 % over all.
TEST(EmissionGuide, GoesByTheRootOfTheMeanSquare) {
  EmissionGuide guide(1);
  std::vector<double> f(guide_cells, 0.0);
  for (std::size_t c = 0; c < guide_cells / 4; ++c) f[c] = 3, f[guide_cells - 1 - c] = 1;
  const double bright = dark_part * even + (1 - dark_part) * 0.75 / (guide_cells / 4.0),
               dim = dark_part * even + (1 - dark_part) * 0.25 / (guide_cells / 4.0), dark = dark_part * even;
  const auto expect_learned = [&](const char* when) {
    const std::vector<double> chance = chances(guide);
    for (std::size_t c = 0; c < guide_cells; ++c)
      ASSERT_NEAR(chance[c], f[c] == 3 ? bright : f[c] == 1 ? dim : dark, 1e-4 * chance[c]) << when << ", cell " << c;
  };
  const double photons = 1e6, unit = 1e-18;
  guide.learn(moments_of(f, std::vector<double>(guide_cells, even), photons, unit), std::vector<double>{photons}, 1);
  expect_learned("from even photons");
  // What guided photons show is the same f: those of a cell that comes more often count less each.
  guide.learn(moments_of(f, chances(guide), photons, unit), std::vector<double>{photons}, 1);
  expect_learned("from guided photons");
}

// One bright cell: half of its chance stays in the middle of a blur of 1 2 1 in y and in z, so a quarter; z goes round,
// y does not.
TEST(EmissionGuide, NeighboursLearnFromEachOther) {
  for (const std::size_t y : {0u, 7u}) {
    EmissionGuide guide(1);
    std::vector<std::int64_t> moments(guide_cells, 0);
    moments[cell_at(5, y, 0)] = 1 << 20;
    guide.learn(moments, std::vector<double>{1e5}, 1);
    const std::vector<double> chance = chances(guide);
    const auto learned = [&](std::size_t at_y, std::size_t z) {
      return (chance[cell_at(5, at_y, z)] - dark_part * even) / (1 - dark_part);
    };
    const double at_edge = y == 0 ? 0.75 : 0.5; // what would go below y = 0 stays
    EXPECT_NEAR(learned(y, 0), at_edge * 0.5, 1e-5);
    EXPECT_NEAR(learned(y, 1), at_edge * 0.25, 1e-5);
    EXPECT_NEAR(learned(y, GUIDE_BINS_Z - 1), at_edge * 0.25, 1e-5);
    EXPECT_NEAR(learned(y + 1, 0), 0.25 * 0.5, 1e-5);
    EXPECT_NEAR(chance[cell_at(4, y, 0)], dark_part * even, 1e-4 * even); // of another x: another target
  }
}

// Moments over 18 orders of magnitude, several allocations, two lights of which one is dark: every chance is above 0 by
// what is spread evenly, and they are all there is. So with the density chance * cells that a photon is divided by
// (kernels/photons/guide.h), the mean of any f over guided photons is sum chance * f / (chance * cells), the even mean.
TEST(EmissionGuide, EveryCellKeepsAChance) {
  EmissionGuide guide(2);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(0, 18);
  for (int deal = 0; deal < 5; ++deal) {
    std::vector<std::int64_t> moments(2 * guide_cells, 0);
    for (std::size_t c = 0; c < guide_cells; ++c)
      if (random() % 3 == 0) moments[c] = static_cast<std::int64_t>(std::pow(10.0, exponent(random)));
    guide.learn(moments, std::vector<double>{200000, 5}, std::exp2(deal));
    for (const std::size_t light : {0u, 1u}) {
      const std::vector<double> chance = chances(guide, light);
      EXPECT_NEAR(std::accumulate(chance.begin(), chance.end(), 0.0), 1, 1e-12);
      EXPECT_GT(*std::min_element(chance.begin(), chance.end()), 0.99 * dark_part * even);
    }
    for (const double value : chances(guide, 1)) EXPECT_NEAR(value, even, 4e-6 * even);
  }
}

TEST(EmissionGuide, IsSavedWhole) {
  std::vector<std::int64_t> first(guide_cells, 3), second(guide_cells, 1);
  first[100] = 1 << 30;
  second[2000] = 1 << 30;
  EmissionGuide guide(1);
  guide.learn(first, std::vector<double>{1000}, 2);
  const std::vector<std::byte> bytes = test::saved<tracing::Archive>(guide);
  EmissionGuide other(1);
  EXPECT_TRUE(test::load<tracing::Archive>(other, bytes));
  EXPECT_EQ(other.table(), guide.table());
  guide.learn(second, std::vector<double>{1000}, 2);
  other.learn(second, std::vector<double>{1000}, 2);
  EXPECT_EQ(other.table(), guide.table());
}

// A run without effort `variance` has no guide.
TEST(EmissionGuide, MayBeOfNoLight) {
  EmissionGuide guide(0);
  EXPECT_TRUE(guide.table().empty());
}

std::vector<int> reflectors_of(const LayerCells& cells, std::size_t pixel) {
  std::vector<int> list;
  for (int i = cells.first[pixel]; i < cells.first[pixel + 1]; ++i)
    list.push_back(cells.cells[static_cast<std::size_t>(i)].reflector);
  return list;
}

TEST(LayerCells, APixelHasWhatItAndItsNeighboursSeeTheMostSeenFirst) {
  // One row of five pixels with two samples each; the last pixel sees nothing, nor does its neighbour.
  const std::vector<int> seen{0, 0, 0, 1, 1, 1, -1, -1, -1, -1};
  const LayerCells cells = make_layer_cells({seen, 5, 1, 2, 2}, 100, EmptyPixel::no_cell);
  EXPECT_THAT(reflectors_of(cells, 0), ElementsAre(0, 1));
  EXPECT_THAT(reflectors_of(cells, 1), ElementsAre(0, 1));
  EXPECT_THAT(reflectors_of(cells, 2), ElementsAre(1, 0)) << "its own before its neighbour's";
  EXPECT_THAT(reflectors_of(cells, 3), ElementsAre(1));
  EXPECT_THAT(reflectors_of(cells, 4), ElementsAre());
  const LayerCells all = make_layer_cells({seen, 5, 1, 2, 2}, 100, EmptyPixel::a_cell);
  EXPECT_THAT(reflectors_of(all, 4), ElementsAre(1)) << "light that falls there all the same has a place";
}

TEST(LayerCells, CellsOfOneReflectorFillWholeBlocksAndNoTwoAreTheSame) {
  std::vector<int> seen;
  for (int i = 0; i < 40 * 30; ++i) seen.push_back(i * 7919 % 5);
  const LayerCells cells = make_layer_cells({seen, 40, 30, 1, 5}, 5000, EmptyPixel::a_cell);
  std::set<int> numbers;
  for (const shared::LayerCell& cell : cells.cells) {
    EXPECT_TRUE(numbers.insert(cell.cell).second);
    EXPECT_EQ(cells.reflector_of_block.at(static_cast<std::size_t>(cell.cell / LAYER_BLOCK)), cell.reflector);
  }
  EXPECT_LE(cells.count(), padded_cells(cells.cells.size(), 5));
}

TEST(LayerCells, WhereThereAreTooManyEveryPixelKeepsTheOneItSeesMost) {
  std::vector<int> seen;
  for (int i = 0; i < 20 * 20; ++i) seen.insert(seen.end(), {i % 3, i % 3, (i + 1) % 3});
  const LayerCells cells = make_layer_cells({seen, 20, 20, 3, 3}, 500, EmptyPixel::a_cell);
  EXPECT_EQ(cells.cells.size(), 500u);
  for (std::size_t i = 0; i < 400; ++i) EXPECT_EQ(reflectors_of(cells, i).at(0), static_cast<int>(i) % 3) << i;
}

shared::DeviceCamera camera_along_minus_z(int pixels) {
  return {.right = {1, 0, 0, 0},
          .up = {0, 1, 0, 0},
          .forward = {0, 0, -1, 0},
          .tan_x = 0.5f,
          .tan_y = 0.5f,
          .width = pixels,
          .height = pixels};
}

TEST(BentCells, CountPixelsThatMaySeeASphere) {
  // A sphere of radius 1 at distance 10 fills a disc of radius tan(asin(1 / 10)) of the square of edge 1: pi 0.1005^2 =
  // 0.0317, and two pixels of 1 / 400 beyond: 0.035.
  const std::vector<scene::Sphere> far{{{0, 0, -10}, 1}};
  const std::size_t cells = bent_cells(camera_along_minus_z(400), far);
  EXPECT_GE(cells, 2 * 0.0317 * 160000);
  EXPECT_LE(cells, 2 * 0.037 * 160000 + 8192);
  EXPECT_EQ(bent_cells(camera_along_minus_z(400), std::vector<scene::Sphere>{{{0, 0, 10}, 1}}), 0u)
      << "behind the camera";
  EXPECT_EQ(bent_cells(camera_along_minus_z(10), std::vector<scene::Sphere>{{{0, 0, 0.5f}, 1}}), 200u + 8192u)
      << "about it";
}

TEST(LayerEmitters, HalfOfThePhotonsGoEvenlyHalfByThePresentLight) {
  RunTables tables;
  for (int c = 0; c < 4; ++c) tables.wavelengths.clusters.push_back({100 * c, 100 * c + 1});
  tables.towards_targets_w = {0.1, 0.1, 0};
  LayerLight light;
  light.spectra.assign(3, optics::Spectrum{});
  light.spectra[0][200] = 1; // all of the only light that is on is in cluster 2, at 580 nm
  light.spectra[1][100] = light.spectra[2][100] = 1;
  light.power = {5, 0, 7};
  const std::vector<shared::DeviceEmitter> emitters = layer_emitters(light, tables, 16008);
  ASSERT_EQ(emitters.size(), 8u) << "the dark light has photons too, the one that reaches no target has none";
  for (const shared::DeviceEmitter& e : emitters) {
    const bool lit = e.light == 0 && e.cluster == 2;
    EXPECT_NEAR(e.photon_count, lit ? 9000 : 1000, 2) << e.light << " " << e.cluster;
    EXPECT_NEAR(e.share, lit ? 5.0 / 7 : 0, 1e-6) << "in units of the strongest";
  }
}

TEST(LayerWeights, AddUpToTheColourOfTheReflectorUnderTheLight) {
  tracing::WavelengthTables tables{.reflector_count = 2};
  tables.clusters.resize(3);
  for (int w = 0; w < optics::wavelength_count; ++w) tables.clusters[static_cast<std::size_t>(w * 7 % 3)].push_back(w);
  tables.reflectance.assign(2 * optics::wavelength_count, 1.0f);
  for (int w = 0; w < optics::wavelength_count; ++w)
    tables.reflectance[static_cast<std::size_t>(optics::wavelength_count + w)] = 0.25f;
  LayerLight light;
  light.spectra.assign(1, optics::Spectrum{});
  light.spectra[0].fill(1.0 / optics::wavelength_count);
  light.power = {3};
  light.white = 2;
  const LayerWeights weights = layer_weights(light, tables);
  const optics::Colour white = optics::xyz_to_linear_srgb(optics::to_xyz(light.spectra[0]));
  ASSERT_EQ(weights.clusters.size(), 6u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(weights.whole[0][k], 1.5 * white[k], 1e-9);
    EXPECT_NEAR(weights.whole[1][k], 0.25 * 1.5 * white[k], 1e-9);
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += weights.clusters[2 * c][k];
    EXPECT_NEAR(sum, weights.whole[0][k], 1e-9);
  }
}

constexpr int width = 60, height = 40;

/// A small ball and a large tilted mirror over a floor.
preset::Preset ball_and_mirror(const preset::Vec3& eye) {
  preset::Preset p;
  p.source = "p.json";
  p.scene.materials["wall"];
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["glass"].type = preset::Material::Type::dielectric;
  p.scene.objects = {
      shape_object("floor", preset::Shape::Type::quad, "wall", {.scale = {40, 1, 40}}),
      shape_object("ball", preset::Shape::Type::sphere, "glass", {.translate = {0.3, 0.6, 0}}),
      shape_object("mirror", preset::Shape::Type::quad, "mirror", {{3, 1, 9}, {20, 30, -70}, {-3, 1.5, 0}})};
  p.scene.camera = {.position = eye, .target = {0, 0.5, 0}, .resolution = {width, height}};
  return p;
}

TEST(GlassPixels, AreAllThatAPathMayMeetGlassIn) {
  // From far away, from close by, and with the mirror reaching past the camera.
  for (const preset::Vec3& eye : {preset::Vec3{2, 3, 8}, {0.4, 0.9, 1.2}, {-2.2, 2, 3}}) {
    const scene::Scene scene = scene::load_scene(ball_and_mirror(eye));
    const scene::Bvh bvh = scene::build_bvh(scene.geometry);
    const scene::Camera& c = scene.camera;
    std::vector<bool> listed(width * height, false), met(width * height, false);
    for (const std::uint32_t pixel : photons::glass_pixels(scene)) listed[pixel] = true;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0, 1);
    for (int i = 0; i < 200000; ++i) {
      const double x = width * place(random), y = height * place(random);
      const glm::dvec3 way = glm::dvec3(c.forward) + (2 * x / width - 1) * c.tan_x * glm::dvec3(c.right) +
                             (1 - 2 * y / height) * c.tan_y * glm::dvec3(c.up);
      const auto hit = scene::closest_hit(bvh, c.position, way);
      if (hit && scene.object_of_primitive[hit->primitive] != 0)
        met[static_cast<std::size_t>(static_cast<int>(y) * width + static_cast<int>(x))] = true;
    }
    int more = 0, all = 0;
    for (std::size_t i = 0; i < met.size(); ++i) {
      EXPECT_TRUE(listed[i] || !met[i]) << i % width << ", " << i / width;
      more += listed[i] && !met[i];
      all += met[i];
    }
    EXPECT_GT(all, 50);
    EXPECT_LT(more, all); // what stands behind the ball counts, and outlines
  }
}

TEST(GlassPixels, AreNoneWhereNoGlassIsInView) {
  preset::Preset p = ball_and_mirror({2, 3, 8});
  p.scene.camera.target = {4, 5, 16};
  EXPECT_TRUE(photons::glass_pixels(scene::load_scene(p)).empty());
}

} // namespace nephroid::emission_guide_test
