// SPDX-License-Identifier: Apache-2.0
// Which cells a film of layers has for what a survey saw, how many are promised, and how photons are dealt for lights to come.
#include "scene/scene.h"
#include "spectral/relight/layer_film.h"
#include "spectral/relight/layer_light.h"
#include "tests/support/presets.h"
#include "tests/support/test.h"

namespace nephroid::layer_cells_test {

using namespace nephroid::spectral;

std::vector<int> reflectors_of(const LayerCells& cells, std::size_t pixel)
{
  std::vector<int> list;
  for (int i = cells.first[pixel]; i < cells.first[pixel + 1]; ++i) list.push_back(cells.cells[static_cast<std::size_t>(i)].reflector);
  return list;
}

TEST(LayerCells, APixelHasWhatItAndItsNeighboursSeeTheMostSeenFirst)
{
  // One row of five pixels with two samples each; the last pixel sees nothing, nor does its neighbour.
  const std::vector<int> seen{0, 0, 0, 1, 1, 1, -1, -1, -1, -1};
  const LayerCells cells = make_layer_cells({seen, 5, 1, 2, 2}, 100, false);
  EXPECT_THAT(reflectors_of(cells, 0), ElementsAre(0, 1));
  EXPECT_THAT(reflectors_of(cells, 1), ElementsAre(0, 1));
  EXPECT_THAT(reflectors_of(cells, 2), ElementsAre(1, 0)) << "its own before its neighbour's";
  EXPECT_THAT(reflectors_of(cells, 3), ElementsAre(1));
  EXPECT_THAT(reflectors_of(cells, 4), ElementsAre());
  const LayerCells all = make_layer_cells({seen, 5, 1, 2, 2}, 100, true);
  EXPECT_THAT(reflectors_of(all, 4), ElementsAre(1)) << "light that falls there all the same has a place";
}

TEST(LayerCells, CellsOfOneReflectorFillWholeBlocksAndNoTwoAreTheSame)
{
  std::vector<int> seen;
  for (int i = 0; i < 40 * 30; ++i) seen.push_back(i * 7919 % 5);
  const LayerCells cells = make_layer_cells({seen, 40, 30, 1, 5}, 5000, true);
  std::set<int> numbers;
  for (const shared::LayerCell& cell : cells.cells) {
    EXPECT_TRUE(numbers.insert(cell.cell).second);
    EXPECT_EQ(cells.reflector_of_block.at(static_cast<std::size_t>(cell.cell / LAYER_BLOCK)), cell.reflector);
  }
  EXPECT_LE(cells.count(), padded_cells(cells.cells.size(), 5));
}

TEST(LayerCells, WhereThereAreTooManyEveryPixelKeepsTheOneItSeesMost)
{
  std::vector<int> seen;
  for (int i = 0; i < 20 * 20; ++i) seen.insert(seen.end(), {i % 3, i % 3, (i + 1) % 3});
  const LayerCells cells = make_layer_cells({seen, 20, 20, 3, 3}, 500, true);
  EXPECT_EQ(cells.cells.size(), 500u);
  for (std::size_t i = 0; i < 400; ++i) EXPECT_EQ(reflectors_of(cells, i).at(0), static_cast<int>(i) % 3) << i;
}

shared::DeviceCamera camera_along_minus_z(int pixels)
{
  shared::DeviceCamera camera{};
  camera.right = {1, 0, 0, 0};
  camera.up = {0, 1, 0, 0};
  camera.forward = {0, 0, -1, 0};
  camera.tan_x = camera.tan_y = 0.5f;
  camera.width = camera.height = pixels;
  return camera;
}

TEST(BentCells, CountPixelsThatMaySeeASphere)
{
  // A sphere of radius 1 at distance 10 fills a disc of radius tan(asin(1 / 10)) of the square of edge 1: pi 0.1005^2 = 0.0317, and two
  // pixels of 1 / 400 beyond: 0.035.
  const std::vector<scene::Sphere> far{{{0, 0, -10}, 1}};
  const std::size_t cells = bent_cells(camera_along_minus_z(400), far);
  EXPECT_GE(cells, 2 * 0.0317 * 160000);
  EXPECT_LE(cells, 2 * 0.037 * 160000 + 8192);
  EXPECT_EQ(bent_cells(camera_along_minus_z(400), std::vector<scene::Sphere>{{{0, 0, 10}, 1}}), 0u) << "behind the camera";
  EXPECT_EQ(bent_cells(camera_along_minus_z(10), std::vector<scene::Sphere>{{{0, 0, 0.5f}, 1}}), 200u + 8192u) << "about it";
}

TEST(LayerEmitters, HalfOfThePhotonsGoEvenlyHalfByThePresentLight)
{
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

TEST(LayerWeights, AddUpToTheColourOfTheReflectorUnderTheLight)
{
  tracing::WavelengthTables tables;
  tables.reflector_count = 2;
  tables.clusters.resize(3);
  for (int w = 0; w < optics::wavelength_count; ++w) tables.clusters[static_cast<std::size_t>(w * 7 % 3)].push_back(w);
  tables.reflectance.assign(2 * optics::wavelength_count, 1.0f);
  for (int w = 0; w < optics::wavelength_count; ++w) tables.reflectance[static_cast<std::size_t>(optics::wavelength_count + w)] = 0.25f;
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

} // namespace nephroid::layer_cells_test
