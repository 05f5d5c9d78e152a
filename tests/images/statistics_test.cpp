// SPDX-License-Identifier: Apache-2.0
// Five small scenes against stored means and variances of the same rendering with other seeds: who changes a kernel
// sees whether a picture changed by more than its noise, or its noise did. README.md beside this file: how the stored
// pictures are made.
#include "photons/pixel_surfaces.h"
#include "preset/read.h"
#include "spectral/engine.h"
#include "tests/support/render.h"
#include "tests/support/stored_statistics.h"

namespace nephroid::statistics_test {

constexpr int stored_renders = 64;
constexpr std::uint64_t first_stored_seed = 1'000'001, fresh_seed = 7;

/// 16 passes of 2^13 photons and 16 samples a pixel: under a second. What the stored statistics are of is said here
/// rather than left to the engine's defaults: splats of independent photons, each for a whole cluster.
void make_small(preset::Preset& p) {
  p.scene.camera.resolution = {stored_size, stored_size};
  spectral::settings(p).threshold_deg = 0.2;
  spectral::settings(p).photons_per_pass = 1 << 13;
  spectral::settings(p).pixel_samples = 16;
  spectral::settings(p).direct = true;
  spectral::settings(p).estimator = photons::Settings::Estimator::splat;
  spectral::settings(p).jitter = spectral::settings(p).low_discrepancy = false;
  spectral::settings(p).effort = photons::Settings::Effort::power;
  spectral::settings(p).smoothing = photons::Settings::Smoothing::off;
  p.stop = {};
  p.stop.passes = 16;
  p.white = 1;
}

preset::Preset shipped(const std::string& name) {
  preset::Preset p = preset::read_preset(name);
  make_small(p);
  for (preset::Object& object : p.scene.objects)
    if (object.shape) object.shape->segments = std::min(object.shape->segments, 128);
  return p;
}

/// Glass that absorbs red and blue: k as a table is in dispersion files only, so a shipped material with absorption
/// serves.
preset::Material absorbing_glass() {
  preset::Material m = glass(1.5);
  m.dispersion.type = preset::Dispersion::Type::file;
  m.dispersion.file = "materials/rhodamine-6G-Seckin.yml";
  return m;
}

/// A pane of dye and a glass ball with a bubble and with a water ball that overlaps its side, between a tinted mirror
/// and coloured walls.
preset::Preset nested() {
  preset::Preset p = empty_preset(stored_size);
  p.unit = preset::Preset::Unit::cm;
  p.scene.materials = {{"dye", absorbing_glass()}, {"glass", glass(1.6)}, {"water", glass(1.33)}, {"air", glass(1)},
                       {"floor", white()},         {"wall", white(0.5)},  {"mirror", white(0.7)}};
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["mirror"].reflectance.type = preset::Reflectance::Type::table;
  p.scene.materials["mirror"].reflectance.table = {{400, 0.3}, {600, 0.95}};
  p.scene.materials["wall"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["wall"].reflectance.patch = "bluish green";
  preset::Shape ball, bubble, drop;
  ball.radius = 1;
  bubble.radius = 0.4;
  drop.radius = 0.7;
  p.scene.objects = {object("ball", ball, "glass", at({0, 1.2, 0})),
                     object("bubble", bubble, "air", at({0.2, 1.4, 0.1})),
                     object("drop", drop, "water", at({1.1, 1, 0.2})),
                     object("pane", box(1.2, 0.0002, 1.2), "dye", at({-1.8, 0.8, 0.5}, {0, 0, 20})),
                     object("mirror", quad(2.5, 2.5), "mirror", at({0.3, 1.2, -2}, {70, 0, 10})),
                     object("floor", quad(12, 12), "floor"),
                     object("wall", quad(12, 12), "wall", at({-3.5, 0, 0}, {0, 0, -90}))};
  for (std::size_t i = 0; i < 3; ++i) p.scene.objects[i].normals = preset::Object::Normals::smooth;
  p.scene.objects[1].priority = 2;
  p.scene.objects[2].priority = 1;
  p.scene.lights = {{.power_w = 5, .position = {0.6, 6, 2.5}}};
  p.scene.camera.position = {1, 5, 7};
  p.scene.camera.target = {-0.3, 0.4, 0};
  p.scene.camera.fov_deg = 42;
  make_small(p);
  return p;
}

/// A brilliant under a panel of light and the sun.
preset::Preset diamond_under_a_panel() {
  preset::Preset p = empty_preset(stored_size);
  p.unit = preset::Preset::Unit::mm;
  preset::Material stone = glass(2.4);
  stone.dispersion.type = preset::Dispersion::Type::file;
  stone.dispersion.file = "materials/diamond-Peter.yml";
  p.scene.materials = {{"diamond", stone}, {"ground", white(0.8)}};
  preset::Shape brilliant;
  brilliant.type = preset::Shape::Type::brilliant;
  brilliant.radius = 3;
  p.scene.objects = {object("stone", brilliant, "diamond", at({0, 4, 0}, {10, 0, 5})),
                     object("ground", quad(60, 60), "ground")};
  preset::Light panel, sun;
  panel.type = preset::Light::Type::area;
  panel.position = {8, 18, -6};
  panel.direction = {-8, -14, 6};
  panel.size = {5, 2};
  panel.power_w = 0.01;
  sun.type = preset::Light::Type::directional;
  sun.spectrum.illuminant = "A";
  sun.direction = {0.4, -1, 0.3};
  sun.irradiance_w_m2 = 4;
  p.scene.lights = {panel, sun};
  p.scene.camera.position = {0, 14, 24};
  p.scene.camera.target = {0, 1, 0};
  p.scene.camera.fov_deg = 40;
  make_small(p);
  return p;
}

struct Case {
  std::string name;
  preset::Preset (*preset)();
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

/// Without the direct layer: the lamp is so close to a wall that what glass shows of the wall now and then is far
/// brighter than all else, too seldom for its variance to be known from the stored renders.
preset::Preset bunny() {
  preset::Preset p = shipped("first-light");
  spectral::settings(p).direct = false;
  return p;
}

const std::vector<Case> cases{{"bunny", bunny},
                              {"prism", [] { return shipped("spectral/prism"); }},
                              {"ball_lens", [] { return shipped("spectral/ball-lens"); }},
                              {"nested", nested},
                              {"diamond", diamond_under_a_panel}};

XyzPicture to_xyz(const std::vector<float>& rgb) {
  XyzPicture picture(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const optics::Colour xyz = optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) picture[i + c] = xyz[c];
  }
  return picture;
}

/// A scene that is loaded once and rendered with many seeds.
class Renderer {
public:
  explicit Renderer(preset::Preset preset)
      : preset_(std::move(preset)), scene_(scene::load_scene(preset_)), bvh_(scene::build_bvh(scene_.geometry)),
        plan_(spectral::make_plan(preset_, scene_, bvh_)) {}

  job::Snapshot render(std::uint64_t seed) {
    preset_.seed = seed;
    const auto job = photons::make_job(preset_, scene_, bvh_, plan_, shared_context());
    while (!job->finished()) job->advance();
    return job->snapshot();
  }
  int samples() const { return *plan_.settings.pixel_samples; }

private:
  preset::Preset preset_;
  scene::Scene scene_;
  scene::Bvh bvh_;
  photons::RunPlan plan_;
};

std::filesystem::path stored_file(const std::string& name) {
  return std::filesystem::path(NEPHROID_SOURCE_DIR "/tests/images/stored") / (name + ".exr");
}

/// Writes what a person needs to see why a comparison failed, and returns the folder: beside this test program.
std::filesystem::path write_artefacts(const std::string& name, const job::Picture& picture,
                                      const StoredStatistics& stored, const Comparison& comparison) {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "failed" / name;
  std::filesystem::create_directories(folder);
  std::vector<float> reference, signs;
  const std::vector<double>& mean = stored.levels[0].mean;
  for (std::size_t i = 0; i < mean.size(); i += 3) {
    for (const double value : optics::xyz_to_linear_srgb({mean[i], mean[i + 1], mean[i + 2]}))
      reference.push_back(static_cast<float>(value));
    // z of Y: too bright is red, too dark blue, full at 5 standard deviations.
    const float z = comparison.z[i + 1] / 5;
    signs.insert(signs.end(), {std::max(z, 0.0f), 0.0f, std::max(-z, 0.0f)});
  }
  const auto write = [&](const std::string& file, const std::vector<float>& rgb, bool shown) {
    image::write_exr(folder / (file + ".exr"), {stored_size, stored_size, {"R", "G", "B"}, rgb, {}});
    if (shown) image::write_png(folder / (file + ".png"), stored_size, stored_size, rgb);
  };
  write("image", picture.rgb, true);
  write("reference", reference, true);
  write("z_of_XYZ", comparison.z, false);
  image::write_png(folder / "z_of_Y.png", stored_size, stored_size, signs);
  std::ofstream(folder / "p-values.txt") << fmt::format(
      "worst block: p = {:.3g}, {}\nmean of clipped z^2: {:.4f}, stored {:.4f} +- {:.4f}, p = {:.3g}\n",
      comparison.block_p, comparison.worst, comparison.z2, stored.mean_z2, stored.standard_deviation_z2,
      comparison.z2_p);
  return folder;
}

class StoredPicture : public testing::TestWithParam<Case> {};

TEST_P(StoredPicture, HasTheStoredMeanAndVariance) {
  const StoredStatistics stored = read_statistics(stored_file(GetParam().name));
  const job::Snapshot snapshot = Renderer(GetParam().preset()).render(fresh_seed);
  const Comparison comparison = compare(to_xyz(snapshot.picture->rgb), stored);
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  EXPECT_GT(comparison.block_p, false_alarm) << comparison.worst;
  EXPECT_GT(comparison.z2_p, false_alarm) << "mean of clipped z^2 " << comparison.z2 << ", stored " << stored.mean_z2
                                          << " +- " << stored.standard_deviation_z2;
  if (HasFailure())
    ADD_FAILURE() << "image, reference, z and p-values are in "
                  << write_artefacts(GetParam().name, *snapshot.picture, stored, comparison);
}

// Tiles have another noise and the same mean, but for the bias of what light does within a tile: a few hundredths of
// the noise that a picture of points has here.
class StoredMean : public StoredPicture {};
TEST_P(StoredMean, IsThatOfTiles) {
  preset::Preset p = GetParam().preset();
  spectral::settings(p).estimator = photons::Settings::Estimator::tiles;
  spectral::settings(p).photons_per_pass = 1 << 16;
  const job::Snapshot snapshot = Renderer(p).render(fresh_seed);
  const StoredStatistics stored = read_statistics(stored_file(GetParam().name));
  XyzPicture picture = to_xyz(snapshot.picture->rgb);
  for (const std::size_t pixel : photons::glass_pixels(scene::load_scene(p))) // paths from the eye show these
    std::copy_n(stored.levels[0].mean.begin() + std::ptrdiff_t(3 * pixel), 3,
                picture.begin() + std::ptrdiff_t(3 * pixel));
  const Comparison comparison = compare(picture, stored);
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  EXPECT_GT(comparison.block_p, false_alarm) << comparison.worst;
}

// The test itself: a picture that is 6 % brighter, one whose rows have moved by one, one with a single far too bright
// pixel and one with twice the noise are found out in every scene.
TEST_P(StoredPicture, IsToldFromWrongOnes) {
  const StoredStatistics stored = read_statistics(stored_file(GetParam().name));
  const XyzPicture right = to_xyz(Renderer(GetParam().preset()).render(fresh_seed + 1).picture->rgb);
  XyzPicture bright = right, moved = right, spotted = right, noisy = right;
  std::rotate(moved.begin(), moved.begin() + 3 * stored_size, moved.end());
  const std::vector<double>& mean = stored.levels[0].mean;
  const std::size_t spot = 3 * static_cast<std::size_t>(stored_size * stored_size / 2 + stored_size / 2);
  for (std::size_t i = 0; i < right.size(); ++i) {
    bright[i] *= 1.06;
    noisy[i] = mean[i] + 2 * (right[i] - mean[i]);
  }
  spotted[spot + 1] = 6 * *std::max_element(mean.begin(), mean.end());
  EXPECT_LT(compare(bright, stored).block_p, false_alarm);
  EXPECT_LT(compare(moved, stored).block_p, false_alarm);
  EXPECT_LT(compare(spotted, stored).block_p, false_alarm);
  EXPECT_LT(compare(noisy, stored).z2_p, false_alarm);
}

// Not run by itself: makes the stored pictures again.
TEST_P(StoredPicture, DISABLED_IsMadeAgain) {
  Renderer renderer(GetParam().preset());
  std::vector<XyzPicture> renders;
  std::vector<XyzPicture> caustics;
  for (int i = 0; i < stored_renders; ++i) {
    const job::Snapshot snapshot = renderer.render(first_stored_seed + static_cast<std::uint64_t>(i));
    renders.push_back(to_xyz(snapshot.picture->rgb));
    caustics.push_back(to_xyz(layer(snapshot, "caustic").rgb));
  }
  // A photon adds about variance / mean to its pixel, and exactly that where it came alone; a sample of the direct
  // layer what the brightest surface sends to the eye: each of the four paths through glass adds at most three quarters
  // of that, because its cluster was chosen in proportion to X + Y + Z.
  const StoredStatistics::Level photons = make_statistics(caustics, {}).levels[0],
                                pixels = make_statistics(renders, {}).levels[0];
  std::array<double, 3> largest{};
  for (std::size_t i = 0; i < pixels.mean.size(); ++i) {
    double& l = largest[i % 3];
    l = std::max(l, (pixels.mean[i] - photons.mean[i]) / renderer.samples());
    if (photons.mean[i] > 0) l = std::max(l, photons.variance[i] / photons.mean[i]);
  }
  write_statistics(stored_file(GetParam().name), make_statistics(renders, largest));
}

// Not run by itself: twenty more seeds must pass, and none of them by a hair.
TEST_P(StoredPicture, DISABLED_PassesWithTwentySeeds) {
  const StoredStatistics stored = read_statistics(stored_file(GetParam().name));
  Renderer renderer(GetParam().preset());
  for (std::uint64_t seed = 101; seed <= 120; ++seed) {
    const Comparison comparison = compare(to_xyz(renderer.render(seed).picture->rgb), stored);
    fmt::print("{} seed {}: p of the worst block {:.2g}, of mean z^2 {:.2g}\n", GetParam().name, seed,
               comparison.block_p, comparison.z2_p);
    EXPECT_GT(comparison.block_p, 1e-6) << "seed " << seed << ": " << comparison.worst;
    EXPECT_GT(comparison.z2_p, 1e-6) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, StoredPicture, testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });
// All but the prism: it is stored as a line for each cluster, and tiles make one band of it
// (tests/physics/spectral_differentials_test.cpp).
INSTANTIATE_TEST_SUITE_P(Scenes, StoredMean, testing::Values(cases[0], cases[2], cases[3], cases[4]),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::statistics_test
