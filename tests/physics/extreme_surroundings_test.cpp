// SPDX-License-Identifier: Apache-2.0
// Extreme surroundings: backgrounds from 1e-30 to 1e9 and with one bright texel, bad texels, walls that reflect
// nothing, nearly all and all, glass that absorbs all, single pixels and photons. docs/notebook/extremes.md sums it up.
#include "image/image.h"
#include "spectral/settings.h"
#include "tests/support/extreme_waves.h"

namespace nephroid::extreme_surroundings_test {

/// One colour behind a ball of glass, of which the camera sees both.
preset::Preset ball_before_sky(double radiance, int pixels = 8) {
  preset::Preset p = empty_preset(pixels);
  p.source = "p.json";
  spectral::settings(p).caustic = false;
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(8);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects = {object("ball", sphere(0.3), "glass")};
  p.scene.camera.position = {0, 0, 2};
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->colour = {0.2, 0.5, 0.9};
  p.scene.environment->radiance = radiance;
  return p;
}

/// The picture at this radiance, over that, is the picture at 1.
Outcome radiance_scales(double radiance) {
  const job::Snapshot gave = render(ball_before_sky(radiance)), right = render(ball_before_sky(1));
  EXPECT_EQ(photons::energy_of(gave).refused_contributions, 0u);
  return at_most(largest_difference(gave.picture->rgb, right.picture->rgb, 1 / radiance), 1e-6);
}

/// Surroundings of 64 x 32 texels of 1 (or another value), one of which, at the top left, is `texel`. The camera looks
/// straight ahead, away from that one.
preset::Preset one_texel(const TemporaryFolder& folder, float texel, float others = 1) {
  constexpr int width = 64, height = 32;
  std::vector<float> rgb(3 * width * height, others);
  rgb[0] = rgb[1] = rgb[2] = texel;
  preset::Preset p = ball_before_sky(1);
  p.scene.objects.clear();
  p.scene.environment->type = preset::Environment::Type::file;
  p.scene.environment->file = (folder.path() / "sky.exr").string();
  image::write_exr(p.scene.environment->file, {width, height, {"R", "G", "B"}, rgb, {}});
  return p;
}

/// What is seen beside the bright texel, all around it.
Outcome beside(float texel, double tolerance) {
  const TemporaryFolder folder;
  return near(mean_xyz(render(one_texel(folder, texel)), "background")[1], 1, tolerance);
}

/// In the middle of that texel, whose centre is 1/64 of a turn left of +z and 1/64 of half a turn from the top;
/// bilinear there to 1 %.
Outcome into(float texel, double tolerance) {
  const TemporaryFolder folder;
  preset::Preset p = one_texel(folder, texel);
  const double azimuth = 2 * M_PI * (0.5 / 64 - 0.5), zenith = M_PI * 0.5 / 32;
  p.scene.camera.position = {0, 0, 0};
  p.scene.camera.target = {std::sin(zenith) * std::sin(azimuth), std::cos(zenith),
                           -std::sin(zenith) * std::cos(azimuth)};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 0.01;
  const job::Snapshot snapshot = render(p);
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  return near(mean_xyz(snapshot, "background")[1] / double(texel), 1, tolerance);
}

Outcome texel_refused(float texel, const std::string& fault) {
  const TemporaryFolder folder;
  const preset::Preset p = one_texel(folder, texel);
  try {
    render(p);
  } catch (const Error& error) {
    std::string line = error.line();
    const std::string path = p.scene.environment->file,
                      wanted = "sky.exr: red of the texel in row 0, column 0 (from 0) " + fault +
                               "; expected radiances of 0 or more; mend the picture";
    if (line.starts_with(path)) line = "sky.exr" + line.substr(path.size());
    return {"refused: `" + line + "`", "refused", line == wanted};
  }
  return {"no refusal", "refused", false};
}

/// A closed sphere of 2 m whose wall reflects rho, and a light of 1 W in it. Every order of reflection is even: after k
/// of them the irradiance is P rho^k / (4 pi R^2), so with at most m surfaces before the last E = P / (4 pi R^2) (rho +
/// rho^2 + ... + rho^m).
preset::Preset furnace(double rho, int max_surfaces, int photons = 1 << 12) {
  preset::Preset p = empty_preset(8);
  p.source = "p.json";
  spectral::settings(p).caustic = false;
  spectral::settings(p).indirect = true;
  preset::Shape room = check::ball(2);
  room.inwards = true;
  p.scene.materials["wall"] = white(rho);
  p.scene.objects = {object("room", room, "wall")};
  p.scene.lights.resize(1);
  p.scene.lights[0].spectrum = line(550);
  p.scene.lights[0].position = {0.9, 0.5, 0.3};
  p.scene.camera.position = {0, 0, 1.5};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.fov_deg = 90;
  spectral::settings(p).max_surfaces = max_surfaces;
  spectral::settings(p).indirect_photons_per_pass = photons;
  p.stop.passes = 32;
  return p;
}

Outcome furnace_is_even(const preset::Preset& p) {
  const double rho = p.scene.materials.at("wall").reflectance.value;
  double sum = 0;
  for (int k = 1; k <= spectral::settings(p).max_surfaces; ++k) sum += std::pow(rho, k);
  const double y = optics::to_xyz(optics::light_lines(p.scene.lights[0].spectrum.table))[1];
  const std::vector<Estimate> gave = colour_by_passes(p, "indirect");
  const double truth = sum / (16 * M_PI) * rho / M_PI * y;
  return near(gave[1].mean / truth, 1, tolerance(gave[1]) / truth + 1e-3);
}

/// White surroundings seen through a plate 1 mm thick with this k: mean Y of the picture, half of which the plate
/// fills.
Outcome through_absorbing_glass(double k) {
  const TemporaryFolder folder;
  preset::Preset p = ball_before_sky(1);
  preset::Material m = glass(1.5);
  m.dispersion.type = preset::Dispersion::Type::file;
  m.dispersion.file = write_constant_nk(folder.path() / "glass.yml", 1.5, k);
  p.scene.materials["glass"] = m;
  p.scene.environment->colour = {1, 1, 1};
  p.scene.objects = {object("plate", box(9, 9, 1e-3), "glass")};
  const double gave = mean_xyz(render(p), "background")[1];
  return near(gave, 0.04, 0.03); // what its face reflects of them: Fresnel's 0.04 and, aslant, little more
}

const std::vector<Extreme> extremes = {
    {"Radiance1em30", "a background of radiance 1e-30", "1e-30 times that of 1", [] { return radiance_scales(1e-30); }},
    {"Radiance1e9", "of 1e9", "1e9 times that of 1", [] { return radiance_scales(1e9); }},
    {"Radiance1e30", "of 1e30", "refused",
     [] {
       return refused_json(R"("scene":{"environment":{"type":"constant","colour":[1,1,1],"radiance":1e30}})",
                           "/scene/environment/radiance: is 1e+30; expected a number from 0 to 1000000000 W/(m^2 sr)");
     }},
    {"RadianceZero", "of 0", "black", [] { return black(ball_before_sky(0)); }},
    {"AllBlack", "a map all black", "black",
     [] {
       const TemporaryFolder folder;
       return black(one_texel(folder, 0, 0));
     }},
    {"BesideMillion", "one texel of 1e6 among 1, looking beside it", "their value", [] { return beside(1e6f, 1e-4); }},
    {"IntoMillion", "looking into it", "its value, but for bilinear lookup", [] { return into(1e6f, 0.01); }},
    {"Beside1e30", "one texel of 1e30 among 1", "said: fixed point cannot hold both",
     [] {
       const TemporaryFolder folder;
       return warns(
           one_texel(folder, 1e30f),
           "environment sky.exr: half of its values above 0 are below 2e-27 of its mean, less than the film's numbers "
           "resolve, and look black or are noise; clip its brightest texels");
     }},
    {"Into1e30", "looking into it", "the same", [] { return into(1e30f, 0.01); }},
    {"Into3e38", "looking into one of 3e38", "the same", [] { return into(3e38f, 0.01); }},
    {"TexelNaN", "a texel that is not a number", "refused",
     [] { return texel_refused(std::numeric_limits<float>::quiet_NaN(), "is not a number"); }},
    {"TexelInfinite", "an infinite texel", "refused",
     [] { return texel_refused(std::numeric_limits<float>::infinity(), "is infinite"); }},
    {"TexelNegative", "a texel of -1e6 among 1", "refused", [] { return texel_refused(-1e6f, "is negative"); }},
    {"TexelBelowNothing", "a texel of -1e-30 among 1", "said, and taken as 0",
     [] {
       const TemporaryFolder folder;
       return warns(one_texel(folder, -1e-30f),
                    "environment sky.exr: 3 values are below 0, in sum 5e-34 of all its light; they are taken as 0");
     }},
    {"SkyThroughBlackGlass", "white surroundings through 1 mm of glass with k = 1e12: exp(-infinity)",
     "only what its face reflects", [] { return through_absorbing_glass(1e12); }},
    {"SkyInOnePixel", "a picture of one pixel, seen through a ball", "a white furnace keeps its colour",
     [] {
       preset::Preset p = ball_before_sky(1, 1);
       p.scene.camera.fov_deg = 5;
       return near(mean_xyz(render(p), "background")[1], 0.2 * 0.2126 + 0.5 * 0.7152 + 0.9 * 0.0722, 1e-3);
     }},
    {"FurnaceBlack", "indirect light, walls that reflect 0", "black", [] { return black(furnace(0, 32)); }},
    {"FurnaceNearlyBlack", "walls that reflect 0.01", "rho + rho^2 + ...",
     [] { return furnace_is_even(furnace(0.01, 32, 1 << 16)); }},
    {"FurnaceNearlyWhite", "walls that reflect 0.999, 1024 surfaces", "rho + rho^2 + ... + rho^1024",
     [] { return furnace_is_even(furnace(0.999, 1024, 1 << 7)); }},
    {"FurnaceWhite", "walls that reflect all, 64 surfaces", "64: every order is as bright as the first",
     [] { return furnace_is_even(furnace(1, 64, 1 << 9)); }},
    {"FurnaceOnePhoton", "one photon a pass, 4096 passes, walls that reflect 0.9", "rho + rho^2 + ...",
     [] {
       preset::Preset p = furnace(0.9, 256, 1);
       p.stop.passes = 4096;
       return furnace_is_even(p);
     }},
    {"FurnaceOnePixel", "a picture of one pixel", "the same",
     [] {
       preset::Preset p = furnace(0.9, 256);
       p.scene.camera.resolution = {1, 1};
       return furnace_is_even(p);
     }},
};

class Surroundings : public testing::TestWithParam<Extreme> {};
TEST_P(Surroundings, IsRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Surroundings, testing::ValuesIn(extremes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_surroundings_test
