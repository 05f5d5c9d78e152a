// SPDX-License-Identifier: Apache-2.0
// kernels/spectral/photons.cl against an independent tracer on Embree, pixel by pixel within the noise of both.
#include "tests/support/reference_photons.h"
#include "tests/support/render.h"
#include "tests/support/statistics.h"
#include "tests/support/test.h"

namespace nephroid::photons_test {

/// A smooth ball, a diamond and a mirror above a coloured floor, of dispersive glass; a point light.
preset::Preset glass_preset()
{
  preset::Preset p = empty_preset(24);
  p.unit = preset::Preset::Unit::cm;
  preset::Material dispersive = glass(1.7);
  dispersive.dispersion.type = preset::Dispersion::Type::cauchy;
  dispersive.dispersion.coefficients = {1.65, 0.03};
  p.scene.materials["glass"] = dispersive;
  p.scene.materials["floor"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["floor"].reflectance.patch = "orange";
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["mirror"].reflectance.value = 1;
  preset::Shape ball, diamond;
  ball.radius = 1;
  diamond.type = preset::Shape::Type::brilliant;
  diamond.radius = 1;
  p.scene.objects = {object("ball", ball, "glass", at({-1.5, 1.5, 0})), object("diamond", diamond, "glass", at({1.5, 1.5, 0}, {20, 0, 15})),
                     object("mirror", quad(2, 2), "mirror", at({0, 1.5, -2}, {75, 0, 0})), object("floor", quad(40, 40), "floor")};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  preset::Light light;
  light.position = {0.5, 6, 3};
  light.power_w = 10;
  p.scene.lights = {light};
  p.scene.camera.position = {0, 9, 9};
  p.scene.camera.target = {0, 0, -0.5};
  p.scene.camera.fov_deg = 40;
  spectral::settings(p).threshold_deg = 1;
  spectral::settings(p).photons_per_pass = 1 << 16;
  return p;
}

/// What the other scene does not have: flint that absorbs, most of all violet; a core of denser glass and a bubble of air in it, one that
/// overlaps the surface, of three priorities; a coloured mirror; faceted and smooth.
preset::Preset nested_preset()
{
  preset::Preset p = glass_preset();
  p.unit = preset::Preset::Unit::m;
  preset::Material& flint = p.scene.materials["flint"];
  flint.type = preset::Material::Type::dielectric;
  flint.dispersion.type = preset::Dispersion::Type::file;
  flint.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml";
  p.scene.materials["dense"] = glass(2.2);
  p.scene.materials["air"] = glass(1);
  p.scene.materials["mirror"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["mirror"].reflectance.patch = "yellow green";
  preset::Shape core, bubble;
  core.radius = 0.5;
  bubble.radius = 0.35;
  preset::Object mirror = p.scene.objects[2], floor = p.scene.objects[3];
  mirror.shape->size = {4, 1, 4};
  p.scene.objects = {p.scene.objects[0],
                     object("block", box(1.6, 1.2, 1.6), "flint", at({1.4, 1.5, 0}, {15, 30, 0})),
                     object("core", core, "dense", at({-1.2, 1.6, 0.4})),
                     object("bubble", bubble, "air", at({1.2, 2.0, 0.2})),
                     mirror,
                     floor};
  p.scene.objects[0].material = "flint";
  p.scene.objects[2].priority = 1;
  p.scene.objects[3].priority = 2;
  p.scene.objects[3].normals = preset::Object::Normals::smooth;
  return p;
}

struct Moments {
  double mean = 0, variance_of_mean = 0;
};

class PhotonKernel : public testing::TestWithParam<preset::Preset (*)()> {};

TEST_P(PhotonKernel, AgreesWithAnIndependentTracerInEveryPixel)
{
  preset::Preset p = GetParam()();
  constexpr int runs = 24;
  const std::size_t values = 3 * 24 * 24;
  std::vector<Moments> kernel(values);
  double absorbed = 0;
  for (int run = 0; run < runs; ++run) {
    p.seed = static_cast<std::uint64_t>(run + 1);
    const job::Snapshot snapshot = render(p);
    absorbed = spectral::energy_of(snapshot).absorbed_w / spectral::energy_of(snapshot).emitted_w;
    const job::Layer& caustic = layer(snapshot, "caustic");
    for (std::size_t i = 0; i < values; i += 3) {
      const optics::Colour xyz = optics::linear_srgb_to_xyz({caustic.rgb[i], caustic.rgb[i + 1], caustic.rgb[i + 2]});
      for (std::size_t c = 0; c < 3; ++c) {
        kernel[i + c].mean += xyz[c] / runs;
        kernel[i + c].variance_of_mean += xyz[c] * xyz[c] / runs;
      }
    }
  }
  for (Moments& m : kernel) m.variance_of_mean = std::max(m.variance_of_mean - m.mean * m.mean, 0.0) / (runs - 1);

  const scene::Scene scene = scene::load_scene(p);
  const spectral::RunTables tables = spectral::make_lit_tables(p, scene, scene::build_bvh(scene.geometry), {});
  constexpr int photons = 1'500'000;
  const ReferenceFilm film = ReferencePhotons(scene, tables, 99).trace(photons);

  double sum_z2 = 0, smallest_p = 1, sum_kernel = 0, sum_reference = 0;
  int lit = 0;
  for (std::size_t i = 0; i < values; ++i) {
    const double mean = film.sum[i / 3][static_cast<int>(i % 3)];
    const double variance = film.sum_of_squares[i / 3][static_cast<int>(i % 3)] - mean * mean / photons;
    sum_kernel += kernel[i].mean;
    sum_reference += mean;
    const double total = variance + kernel[i].variance_of_mean;
    if (!(variance > 0) || !(kernel[i].variance_of_mean > 0) || mean * mean / variance < 30) continue; // fewer than 30 photons
    const double z = (kernel[i].mean - mean) / std::sqrt(total);
    sum_z2 += z * z;
    smallest_p = std::min(smallest_p, bernstein(z, 1, 0, runs - 1));
    ++lit;
  }
  ASSERT_GT(lit, 300);
  // Sums over the picture are known to better than 0.2 %.
  EXPECT_NEAR(sum_kernel / sum_reference, 1, 0.01);
  // Student's t with 23 degrees of freedom has variance 23 / 21, and its square the variance 2.8; the three channels of a pixel move
  // together, so about lit / 3 are independent. Six standard deviations.
  EXPECT_NEAR(sum_z2 / lit, 1.05, 6 * std::sqrt(2.8 * 3 / lit));
  EXPECT_GT(sidak(smallest_p, lit), false_alarm);
  RecordProperty("lit", lit);
  RecordProperty("absorbed_share", std::to_string(absorbed));
  RecordProperty("mean_z2", std::to_string(sum_z2 / lit));
}

INSTANTIATE_TEST_SUITE_P(Scenes, PhotonKernel, testing::Values(glass_preset, nested_preset),
                         [](const auto& parameter) { return std::string(parameter.index == 0 ? "dispersion" : "absorption_and_nesting"); });

// What a run adds up may not depend on how its steps are cut: the job cuts them by the clock, so two runs differ in that.
TEST(Photons, SameSeedSameBitsAnotherSeedNot)
{
  preset::Preset p = glass_preset();
  p.stop.passes = 3;
  spectral::settings(p).direct = true;
  const job::Snapshot first = render(p), second = render(p);
  EXPECT_EQ(first.picture->rgb, second.picture->rgb);
  p.seed = 2;
  EXPECT_NE(first.picture->rgb, render(p).picture->rgb);
}

} // namespace nephroid::photons_test
