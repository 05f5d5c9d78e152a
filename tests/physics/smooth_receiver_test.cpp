// SPDX-License-Identifier: Apache-2.0
// Surfaces with smooth normals are lit by these in every layer: light that came through a wide plate (layer "caustic")
// makes the picture that it makes without the plate (layer "direct"), but for what the plate lets through, (1 - R) / (1
// + R) (slab_test.cpp). A photon on its own knows how many of its kind meet a facet, not the normal that the facet is
// meant to have.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::smooth_receiver_test {

constexpr double n = 1.5;
const preset::Vec3 direction = {0.25, -1, 0.15};

/// Of the light's power, through the plate with all its reflections.
double through_plate() {
  const double cosine = 1 / std::sqrt(1 + 0.25 * 0.25 + 0.15 * 0.15), r = optics::fresnel_reflectance(cosine, 1, n);
  return (1 - r) / (1 + r);
}

/// A smooth receiver about the origin, seen aslant from below the plate.
preset::Preset lit_receiver(const preset::Object& receiver, bool plate) {
  preset::Preset p = empty_preset(24);
  p.scene.materials = {{"white", white()}, {"glass", glass(n)}};
  p.scene.objects = {receiver};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  // So wide that light from the plate's own edges lands beside the receiver.
  if (plate) p.scene.objects.push_back(object("plate", box(2.7, 0.1, 2.7), "glass", at({-0.35, 1.4, -0.21})));
  p.scene.lights = {parallel_light(direction)};
  p.scene.camera.position = {0.4, 1.2, 2.5};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.fov_deg = 26;
  spectral::settings(p).direct = !plate;
  spectral::settings(p).caustic = plate;
  spectral::settings(p).photons_per_pass = 1 << 16;
  p.stop.passes = spectral::settings(p).pixel_samples = 32;
  return p;
}

/// Mean Y of blocks of 3 x 3 pixels of the only layer, and of all of them.
std::vector<double> blocks_of(const job::Snapshot& snapshot) {
  const std::vector<double> y = luminance(snapshot.picture->layers.at(0));
  const std::size_t width = static_cast<std::size_t>(snapshot.picture->width), blocks = width / 3;
  std::vector<double> means(blocks * blocks + 1, 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    means[i / width / 3 * blocks + i % width / 3] += y[i] / 9;
    means.back() += y[i] / static_cast<double>(y.size());
  }
  return means;
}

/// The picture through the plate is that without it, times what the plate lets through. bias: what a map's radius may
/// add, as a share.
void expect_lit_as_directly(const std::string& what, const preset::Preset& with_plate, const preset::Preset& without,
                            double bias = 0) {
  std::vector<Estimate> through = render_passes(with_plate, blocks_of);
  const std::vector<Estimate> direct = render_passes(without, blocks_of);
  double brightest = 0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    through[i].mean /= through_plate();
    through[i].variance /= through_plate() * through_plate();
    brightest = std::max(brightest, direct[i].mean);
  }
  EXPECT_GT(brightest, 0.3 / M_PI * optics::to_xyz(spectrum_of(without.scene.lights[0]))[1]) << "the receiver is seen";
  // Blocks that see next to nothing of it get a handful of photons, whose scatter is not known.
  std::vector<double> biases;
  for (const Estimate& e : direct) biases.push_back(std::max(bias * e.mean, 0.005 * brightest));
  biases.back() = bias * direct.back().mean;
  EXPECT_GT(same_expectations(through, direct, biases), false_alarm) << what;
  const double truth = direct.back().mean;
  record(what + ": light of the picture, over its truth", through.back().mean / truth, 1,
         tolerance(through.back()) / truth + bias);
}

TEST(SmoothReceiver, ACoarseRodIsLitAsDirectly) {
  const preset::Object ball = object("receiver", check::rod(0.5, 8), "white");
  for (const bool relight : {false, true}) {
    preset::Preset with_plate = lit_receiver(ball, true), without = lit_receiver(ball, false);
    spectral::settings(with_plate).relight = spectral::settings(without).relight = relight;
    expect_lit_as_directly(relight ? "smooth rod, layers" : "smooth rod", with_plate, without);
  }
}

/// A horizontal square from (-0.4, -0.4) to (0.4, 0.4) with the normals of its corners, in OBJ's lines.
preset::Object square_with_normals(const std::string& name, const std::filesystem::path& folder, const char* normals) {
  const std::filesystem::path file = folder / (name + ".obj");
  std::ofstream(file) << "v -0.4 0 -0.4\nv -0.4 0 0.4\nv 0.4 0 0.4\nv 0.4 0 -0.4\n"
                      << normals << "f 1//1 2//2 3//3\nf 1//1 3//3 4//4\n";
  preset::Object square;
  square.name = name;
  square.mesh = file.string();
  square.material = "white";
  return square;
}

/// Its normals lean outwards: on a flat surface, irradiance falls towards its corners.
preset::Object leaning_square(const std::filesystem::path& folder) {
  return square_with_normals("receiver", folder, "vn -1 1 -1\nvn -1 1 1\nvn 1 1 1\nvn 1 1 -1\n");
}

TEST(SmoothReceiver, ALeaningSquareIsLitAsDirectly) {
  const TemporaryFolder folder;
  const preset::Object square = leaning_square(folder.path());
  expect_lit_as_directly("leaning square", lit_receiver(square, true), lit_receiver(square, false));
}

TEST(SmoothReceiver, PhotonMapsKnowTheNormalsToo) {
  const TemporaryFolder folder;
  const preset::Object square = leaning_square(folder.path());
  preset::Preset with_plate = lit_receiver(square, true), without = lit_receiver(square, false);
  for (preset::Preset* p : {&with_plate, &without}) p->scene.camera.fov_deg = 6; // well inside, where a map has no edge
  spectral::settings(with_plate).estimator = photons::Settings::Estimator::sppm;
  spectral::settings(with_plate).sppm.radius = 0.05;
  expect_lit_as_directly("leaning square, photon maps", with_plate, without, 0.01);
}

/// Its normals all lean by 45 degrees.
preset::Object leaning_tile(const std::filesystem::path& folder) {
  return square_with_normals("tile", folder, "vn 1 1 0\nvn 1 1 0\nvn 1 1 0\nvn 1 1 0\n");
}

// Seen through a window that bends nothing, so that the light is found where it is kept. Runs of other seeds, because
// passes see what those before have left.
TEST(SmoothReceiver, LightOnReceiversKnowsTheNormalsToo) {
  const TemporaryFolder folder;
  const preset::Object tile = leaning_tile(folder.path());
  preset::Preset with_plate = lit_receiver(tile, true), without = lit_receiver(tile, false);
  for (preset::Preset* p : {&with_plate, &without}) {
    p->scene.camera.fov_deg = 6;
    p->scene.materials["air"] = glass(1.00001);
    p->scene.objects.push_back(object("window", box(0.4, 0.4, 0.01), "air", at({0.368, 1.104, 2.3})));
  }
  with_plate.stop.passes = 4;
  spectral::settings(with_plate).estimator = photons::Settings::Estimator::points;
  const Estimate through = render_seeds(with_plate, 24, blocks_of).back(),
                 direct = render_passes(without, blocks_of).back();
  EXPECT_GT(direct.mean, 0);
  expect_truth("leaning tile through a window, over its direct light", through.mean / through_plate() / direct.mean, 1,
               tolerance(through) / through.mean + 0.005);
  EXPECT_LT(tolerance(through) / through.mean, 0.1) << "such a check would see too little";
}

// Light from straight above meets the tile at cos(45 degrees) by its normals, and at 1 by its facets: that much less is
// what it sends on to a wall beside it.
TEST(SmoothReceiver, SendsOnWhatItGetsByItsNormals) {
  const TemporaryFolder folder;
  preset::Preset p = empty_preset(24);
  p.scene.materials = {{"white", white(0.8)}};
  p.scene.objects = {leaning_tile(folder.path()), object("wall", quad(1, 1), "white", at({0.6, 0.5, 0}, {0, 0, 90}))};
  p.scene.objects[0].normals = preset::Object::Normals::faceted;
  p.scene.lights = {parallel_light({0, -1, 0})};
  p.scene.camera.position = {-2, 1, 0};
  p.scene.camera.target = {0.6, 0.5, 0};
  p.scene.camera.fov_deg = 15; // of the wall alone
  spectral::settings(p).caustic = false;
  spectral::settings(p).indirect = true;
  p.stop.passes = 256;
  const Estimate faceted = render_passes(p, blocks_of).back();
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  p.seed = 2;
  const Estimate smooth = render_passes(p, blocks_of).back();
  const double ratio = smooth.mean / faceted.mean, truth = std::cos(45 * degree);
  const double error = (tolerance(smooth) + truth * tolerance(faceted)) / faceted.mean;
  expect_truth("leaning tile: light that it sends on, over a flat one's", ratio, truth, error);
  EXPECT_LT(error, 0.15);
}

} // namespace nephroid::smooth_receiver_test
