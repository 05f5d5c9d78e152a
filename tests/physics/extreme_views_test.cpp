// SPDX-License-Identifier: Apache-2.0
// Extreme views and settings: counts of one and far too many, pictures of one pixel and of 1 x 4096, telescopes,
// cameras in glass, in a mirror, in a surface and close to it, any white. docs/notebook/extremes.md sums it up.
#include "spectral/settings.h"
#include "tests/support/extreme_waves.h"

namespace nephroid::extreme_views_test {

using Estimator = photons::Settings::Estimator;
using Effort = photons::Settings::Effort;

/// Looking at a wall from far away through a telescope: the picture of a white square of 1 m on black, which fills half
/// of it.
Outcome telescope(double distance) {
  preset::Preset p = lit_floor(32);
  p.scene.objects = {object("floor", quad(0.5, 0.5), "white")};
  p.scene.lights[0].type = preset::Light::Type::directional;
  p.scene.lights[0].direction = {0, -1, 0};
  const preset::Vec3 way{0.48 * distance, 0.8 * distance, 0.36 * distance};
  p.scene.camera.position = way;
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 2 * std::atan(0.5 / distance) / degree;
  const job::Snapshot snapshot = render(p);
  const std::vector<double> y = luminance(layer(snapshot, "direct"));
  // E / pi everywhere on the square; it fills 0.25 m^2 cos(36.87 degrees) of 1 m^2.
  const double white_y = optics::to_xyz(optics::light_lines(p.scene.lights[0].spectrum.table))[1] / M_PI;
  double seen = 0;
  for (const double v : y) seen += v / white_y / static_cast<double>(y.size());
  // 64 pixels lie at the edges, each with an error of at most 1/2 / sqrt(16), in all 6 sigmas 0.006.
  return near(seen, 0.25 * 0.8, 0.006);
}

const std::vector<Extreme> extremes = {
    {"PhotonsOne", "one photon a pass, 2000 passes", "the caustic of many photons",
     [] {
       preset::Preset p = ball_over_lit_floor(), many = p;
       spectral::settings(p).direct = spectral::settings(many).direct = false;
       spectral::settings(p).photons_per_pass = 1;
       p.stop.passes = 1 << 13;
       // 8192 photons at 1 / 401 of a wavelength each; the ball's share of them lands in the picture.
       return share_of_one(mean_y(render(p), "caustic"), mean_y(render(many), "caustic"), 0.15);
     }},
    {"PhotonsFarTooMany", "2^31 photons a pass", "refused",
     [] {
       return refused_json(R"("spectral":{"photons_per_pass":2147483648})",
                           "/spectral/photons_per_pass: is 2147483648; expected a whole number from 1 to 16777216");
     }},
    {"PassesZero", "0 passes", "refused",
     [] {
       return refused_json(R"("stop":{"passes":0})", "/stop/passes: is 0; expected a whole number from 1 to 1048576");
     }},
    {"SurfacesFarTooMany", "max_surfaces 1025", "refused",
     [] {
       return refused_json(R"("spectral":{"max_surfaces":1025})",
                           "/spectral/max_surfaces: is 1025; expected a whole number from 1 to 1024");
     }},
    {"OnePixel", "a picture of one pixel", "I cos / d^2, mean over it",
     [] {
       auto p = lit_floor(1);
       p.stop.passes = spectral::settings(p).pixel_samples = 1 << 12;
       return share_of_one(mean_irradiance(p), irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI)), 0.05);
     }},
    {"OneByFourThousand", "a picture of 1 x 4096", "the mean over it of a square one's middle column",
     [] {
       preset::Preset p = lit_floor();
       p.scene.camera.resolution = {1, 4096};
       double sum = 0;
       for (int i = 0; i < 4096; ++i) {
         const double z = (i + 0.5) / 4096 - 0.5 + 0.2, d2 = 0.01 + 1 + z * z;
         sum += 1 / (4 * M_PI) / (d2 * std::sqrt(d2)) / 4096;
       }
       return share_of_one(mean_irradiance(p), sum, 2e-3);
     }},
    {"NothingInView", "a camera that looks away", "black",
     [] {
       auto p = ball_over_lit_floor();
       p.scene.camera.target = {0, 4, 0.001};
       return black(p);
     }},
    {"Fov179", "a field of view of 179.9 degrees", "the floor's own edge: 10 m of 4584 m are lit",
     [] {
       preset::Preset p = lit_floor(1);
       p.scene.camera.fov_deg = 179.9;
       spectral::settings(p).pixel_samples = p.stop.passes.emplace(1 << 14);
       p.scene.objects[0].shape->size = {1000, 1, 1000};
       p.scene.lights[0].type = preset::Light::Type::directional;
       p.scene.lights[0].direction = {0, -1, 0};
       const double side = 2 * 2 * std::tan(89.95 * degree);
       return near(mean_irradiance(p), 1e6 / (side * side), sigmas * std::sqrt(0.05 / (1 << 14)));
     }},
    {"Telescope1e2", "a telescope 100 m away", "the square's projected area", [] { return telescope(1e2); }},
    {"Telescope5e4", "a telescope 57 km away, 0.001 degrees", "the same", [] { return telescope(5.7e4); }},
    {"White1em12", "white = 1e-12", "1e12 times the picture",
     [] {
       auto p = lit_floor();
       const auto a = render(p);
       p.white = 1e-12;
       return at_most(largest_difference(render(p).picture->rgb, a.picture->rgb, 1e-12), 1e-6);
     }},
    {"White1e12", "white = 1e12", "1e-12 times the picture",
     [] {
       auto p = lit_floor();
       const auto a = render(p);
       p.white = 1e12;
       return at_most(largest_difference(render(p).picture->rgb, a.picture->rgb, 1e12), 1e-6);
     }},
    {"DiffuseBlack", "a floor of reflectance 0", "black",
     [] {
       auto p = ball_over_lit_floor();
       p.scene.materials["white"] = white(0);
       return black(p);
     }},
    {"CameraInGlass", "a camera inside a glass box", "radiance n^2 L (1 - R) (1 + R^2 + ...) = n^2 L / (1 + R)",
     [] {
       preset::Preset p = lit_floor(1);
       p.scene.camera.fov_deg = 0.1;
       p.scene.lights[0].type = preset::Light::Type::directional;
       p.scene.lights[0].direction = {1, -1, 0};
       p.scene.materials["glass"] = glass(1.5);
       p.scene.objects.push_back(object("box", box(0.2, 0.2, 0.2), "glass", at({0, 2, 0})));
       spectral::settings(p).caustic = false;
       spectral::settings(p).pixel_samples = p.stop.passes.emplace(1 << 14);
       return near(mean_irradiance(p) * std::sqrt(2.0), 2.25 / 1.04, 0.02);
     }},
    {"CameraInMirrorBall", "a camera inside a mirror ball", "no light gets in: black, and it ends",
     [] {
       auto p = ball_over_lit_floor();
       p.scene.materials["glass"] = mirror(1);
       p.scene.camera.position = {0.3, 0.4, 0.21};
       return black(p);
     }},
    {"CameraAtLight", "a camera at the place of the lamp", "I cos / d^2",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights[0].position = p.scene.camera.position;
       return share_of_one(mean_irradiance(p), irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI)), 2e-3);
     }},
    {"CameraInFloor", "a camera in the plane of the floor, looking along it",
     "a sample that starts in the floor sees nothing or its own foot",
     [] {
       preset::Preset p = lit_floor();
       p.scene.camera.position = {0, 0, 3};
       p.scene.camera.target = {0, 0, 0};
       p.scene.camera.up = {0, 1, 0};
       const double foot = 1 / (4 * M_PI) / std::pow(0.01 + 1 + 3.2 * 3.2, 1.5) / M_PI *
                           optics::to_xyz(optics::light_lines({{{550, 1}}}))[1];
       const std::vector<double> y = luminance(layer(render(p), "direct"));
       const double brightest = *std::max_element(y.begin(), y.end()) / foot;
       return Outcome{fmt::format("0 to {:.4f} of the floor at its foot", brightest), "0 to 1", brightest <= 1.001};
     }},
    {"CameraNearFloor", "a camera 1 mm above the caustic of a floor of 10 m",
     "flux through the picture: that of a camera 1 m above",
     [] {
       preset::Preset p = lit_floor(8);
       p.scene.materials["glass"] = glass(1);
       p.scene.objects.push_back(object("sheet", box(2, 0.01, 2), "glass", at({0, 0.5, 0})));
       spectral::settings(p).direct = false;
       spectral::settings(p).photons_per_pass = 1 << 18;
       p.scene.lights[0].position = {0, 1, 0};
       p.scene.camera.position = {0, 1e-3, 0};
       p.scene.camera.fov_deg = 2 * std::atan(50.0) / degree;
       // 8e-4 W fall on the 10 cm in view: 3300 of the 2^22 photons, so 6.2 sigmas are 0.11.
       return share_of_one(mean_irradiance(p, "caustic"),
                           irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI), 0.1), 0.11);
     }},
};

class Views : public testing::TestWithParam<Extreme> {};
TEST_P(Views, AreRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Views, testing::ValuesIn(extremes),
                         [](const auto& tested) { return tested.param.name; });

// Extreme settings of photon maps: radii from a millionth of a pixel to 10^9 scenes, alpha next to 0 and to 1, single
// photons, single pixels. docs/notebook/extremes.md sums it up.

/// Splats, which have no radius.
const std::vector<Estimate>& truth() {
  static const std::vector<Estimate> colour = colour_by_passes(caustic_of_ball());
  return colour;
}

/// Whole clusters: with jitter a turn in sppm has one wavelength, and a short run is of few colours.
preset::Preset gathered(int passes = 2) {
  preset::Preset p = caustic_of_ball();
  spectral::settings(p).estimator = Estimator::sppm;
  spectral::settings(p).threshold_deg = 2;
  spectral::settings(p).jitter = false;
  p.stop.passes = passes;
  return p;
}

Outcome gathers_the_same(const preset::Preset& p, int runs = 24) {
  return same_colour(colour_by_runs(p, runs), truth(), 0.01);
}

/// The scene `factor` times as large in its own unit of length, with its power.
preset::Preset scaled(preset::Preset p, double factor) {
  const auto grow = [factor](preset::Vec3& v) { v = {factor * v[0], factor * v[1], factor * v[2]}; };
  grow(p.scene.camera.position), grow(p.scene.camera.target), grow(p.scene.lights[0].position);
  for (preset::Object& o : p.scene.objects) grow(o.transform.scale), grow(o.transform.translate);
  return p;
}

std::string notes_of(const preset::Preset& p) {
  std::string lines;
  for (const std::string& note : plan_of(p).notes) lines += (lines.empty() ? "" : " / ") + note;
  return lines;
}

/// The plan notes exactly this line, and the largest number of the picture is finite and at most that share of the
/// caustic's.
Outcome noted(const preset::Preset& p, const std::string& line, double most) {
  const job::Snapshot snapshot = render(p);
  double largest = 0;
  for (const float v : snapshot.picture->rgb)
    largest = std::max(largest, std::isfinite(v) ? std::abs(double(v)) : INFINITY);
  return both(says(notes_of(p), line), at_most(largest / truth()[1].mean, most));
}

const std::vector<Extreme> map_extremes = {
    {"RadiusTiny", "sppm, radius 1e-9 of the scene", "no photon is met",
     [] {
       preset::Preset p = scaled(gathered(), 1000);
       spectral::settings(p).sppm.radius = 1e-6;
       return noted(p,
                    "spectral.sppm.radius: 1e-06 units are 4.42e-09 pixels: hardly a photon lies so near, and caustics "
                    "are black but for "
                    "rare bright dots; choose about 452, two pixels, or leave it out",
                    0);
     }},
    {"RadiusHuge", "sppm, radius 1e9 of the scene", "its light is spread over 1e18 scenes",
     [] {
       preset::Preset p = scaled(gathered(1), 0.01);
       spectral::settings(p).sppm.radius = 1e7;
       spectral::settings(p).photons_per_pass = 1 << 10;
       return noted(p,
                    "spectral.sppm.radius: 10000000 units are 4.42e+09 pixels: caustics are blurred away, and "
                    "gathering is slow; choose "
                    "about 0.00452, two pixels, or leave it out",
                    1e-9);
     }},
    {"RadiusZero", "sppm.radius 0", "refused",
     [] {
       return refused_json(R"("spectral":{"sppm":{"radius":0}})",
                           "/spectral/sppm/radius: is 0; expected a number from 1e-06 to 10000000 length units");
     }},
    {"AlphaTiny", "sppm, alpha 1e-9", "noted: the estimate is right in the mean, but rare bright dots",
     [] {
       preset::Preset p = gathered();
       spectral::settings(p).sppm.alpha = 1e-9;
       return says(
           notes_of(p),
           "spectral.sppm.alpha: 1e-09 shrinks a radius from 2 to 6.32e-05 pixels at its first photons, and hardly "
           "another one lies so near: caustics grow darker from pass to pass; choose 0.667 or so");
     }},
    {"AlphaSmall", "sppm, alpha 0.01", "the caustic of splats",
     [] {
       preset::Preset p = gathered();
       spectral::settings(p).sppm.alpha = 0.01;
       return gathers_the_same(p);
     }},
    {"AlphaAlmostOne", "sppm, alpha 1 - 1e-9: the radius stays", "the same",
     [] {
       preset::Preset p = gathered();
       spectral::settings(p).sppm.alpha = 1 - 1e-9;
       return gathers_the_same(p);
     }},
    {"AlphaOne", "sppm.alpha 1", "refused",
     [] {
       return refused_json(R"("spectral":{"sppm":{"alpha":1}})",
                           "/spectral/sppm/alpha: is 1; expected a number above 0 and below 1");
     }},
    {"OneCluster", "sppm, importance, one cluster", "the caustic of splats",
     [] {
       preset::Preset p = gathered(8);
       spectral::settings(p).threshold_deg = 89.9;
       spectral::settings(p).effort = Effort::importance;
       return gathers_the_same(p);
     }},
    {"OneClusterAtRandom", "sppm, a random cluster of one", "the same",
     [] {
       preset::Preset p = gathered(8);
       spectral::settings(p).threshold_deg = 89.9;
       spectral::settings(p).effort = Effort::random;
       return gathers_the_same(p);
     }},
    {"OnePhoton", "sppm, one photon a pass, 1024 passes", "the same",
     [] {
       preset::Preset p = gathered(1024);
       spectral::settings(p).threshold_deg = 89.9;
       spectral::settings(p).photons_per_pass = 1;
       return gathers_the_same(p);
     }},
    {"OnePixel", "sppm, a picture of one pixel", "the same",
     [] {
       preset::Preset p = gathered(256);
       p.scene.camera.resolution = {1, 1};
       spectral::settings(p).sppm.radius = 0.2;
       spectral::settings(p).photons_per_pass = 1 << 9;
       return gathers_the_same(p);
     }},
};

class Maps : public testing::TestWithParam<Extreme> {};
TEST_P(Maps, IsRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Maps, testing::ValuesIn(map_extremes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_views_test
