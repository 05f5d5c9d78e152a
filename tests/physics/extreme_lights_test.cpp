// SPDX-License-Identifier: Apache-2.0
// Extreme lights and mirrors: powers from 1e-30 W, beams of 0.01 degrees, lights in glass and on it, rectangles of
// every size, reflectances of 0 and 1. docs/notebook/extremes.md sums it up.
#include "spectral/settings.h"
#include "tests/support/extremes.h"

namespace nephroid::extreme_lights_test {

constexpr int photons = 1 << 17;

/// Power P gives P times the picture of 1 W.
Outcome power_scales(double watts) {
  preset::Preset p = ball_over_lit_floor();
  const job::Snapshot truth = render(p);
  p.scene.lights[0].power_w = watts;
  const job::Snapshot gave = render(p);
  EXPECT_EQ(photons::energy_of(gave).refused_contributions, 0u);
  return at_most(largest_difference(gave.picture->rgb, truth.picture->rgb, 1 / watts), 1e-6);
}

/// A beam straight down on mirrors or glass.
preset::Preset beam(const preset::Vec3& from, const preset::Vec3& direction) {
  preset::Preset p = over_floor(photons);
  p.source = "p.json";
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["mirror"] = mirror(1);
  p.scene.lights = {pencil(from, direction, 0.01)};
  return p;
}

/// Colour of the floor under a black body, as x + y of CIE 1931.
Outcome blackbody(double kelvin) {
  preset::Preset p = lit_floor(1);
  p.scene.lights[0].spectrum = {};
  p.scene.lights[0].spectrum.type = preset::LightSpectrum::Type::blackbody;
  p.scene.lights[0].spectrum.temperature_k = kelvin;
  const job::Snapshot snapshot = render(p);
  const auto& rgb = layer(snapshot, "direct").rgb;
  const optics::Colour gave = optics::linear_srgb_to_xyz({rgb[0], rgb[1], rgb[2]});
  // Planck: lambda^-5 / (exp(c2 / (lambda T)) - 1), over the colour matching functions, in long double.
  long double xyz[3] = {0, 0, 0};
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const long double nm = optics::wavelength_nm(i),
                      power = std::pow(780 / nm, 5.0L) / std::expm1(1.438776877e7L / (nm * kelvin));
    const optics::ColourMatching& eye = optics::cie_1931();
    const auto w = static_cast<std::size_t>(i);
    xyz[0] += power * eye.x[w], xyz[1] += power * eye.y[w], xyz[2] += power * eye.z[w];
  }
  const long double sum = xyz[0] + xyz[1] + xyz[2];
  const double gave_sum = gave[0] + gave[1] + gave[2];
  return both(near(gave[0] / gave_sum, static_cast<double>(xyz[0] / sum), 1e-5),
              near(gave[1] / gave_sum, static_cast<double>(xyz[1] / sum), 1e-5));
}

const std::vector<Extreme> extremes = {
    {"Power1em30", "a lamp of 1e-30 W", "light is linear: 1e-30 times the picture of 1 W",
     [] { return power_scales(1e-30); }},
    {"Power1e9", "a lamp of 1e9 W", "the same", [] { return power_scales(1e9); }},
    {"PowerZero", "a lamp of 0 W", "black",
     [] {
       auto p = ball_over_lit_floor();
       p.scene.lights[0].power_w = 0;
       return black(p);
     }},
    {"HugeBesideTiny", "a lamp of 1e9 W and one of 1e-6 W", "said: fixed point cannot hold both",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights.push_back(p.scene.lights[0]);
       p.scene.lights[0].power_w = 1e-6;
       p.scene.lights[1].power_w = 1e9;
       return warns(p, "light 0: is 1e-15 of the strongest light, less than the film's numbers resolve: what it lights "
                       "alone is noise; render "
                       "it in a run of its own");
     }},
    {"LaserBesideLamp",
     "a spot of 0.01 degrees (1.6e8 times as bright) pointing away from the floor that a lamp lights",
     "I cos / d^2 of the lamp",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights.push_back(pencil({0, 1, 0}, {0, 1, 0}, 0.01));
       return share_of_one(mean_irradiance(p), irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI)), 2e-3);
     }},
    {"LampNearFloor", "a lamp 1 mm above a floor of 10 m", "I cos / d^2 over the 8 mm below it",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights[0].position = {0, 0.001, 0};
       Screen screen{{0, 0, 0}, 8e-3, 16};
       screen.fill(p.scene.camera, 0.5);
       spectral::settings(p).pixel_samples = p.stop.passes.emplace(64);
       return share_of_one(mean_irradiance(p), irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI), 8e-3),
                           0.02);
     }},
    {"BlackBody300", "a black body of 300 K", "Planck's law in long double", [] { return blackbody(300); }},
    {"BlackBody1e6", "a black body of 1e6 K", "the same", [] { return blackbody(1e6); }},
    {"NoPower", "a light's spectrum that is all zero", "refused",
     [] {
       return refused_json(
           R"("scene":{"lights":[{"type":"point","spectrum":{"type":"table","table":[[380,0],[780,0]]}}]})",
           "/scene/lights/0/spectrum/table: has no power at any wavelength; expected at least one power above 0");
     }},
    {"OneLine", "a spectrum of one line", "I cos / d^2",
     [] {
       auto p = lit_floor();
       return share_of_one(mean_irradiance(p), irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI)), 2e-3);
     }},
    {"TwoLines", "two lines", "the mean of the pictures of each",
     [] {
       preset::Preset p = ball_over_lit_floor();
       double sum = 0;
       for (const double nm : {450.0, 620.0})
         p.scene.lights[0].spectrum = line(nm), sum += mean_y(render(p), "direct") / 2;
       p.scene.lights[0].spectrum.table = {{450, 1}, {620, 1}};
       return share_of_one(mean_y(render(p), "direct"), sum, 1e-5);
     }},
    {"SpotOf180", "a spot of 180 degrees", "a point light",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights[0].type = preset::Light::Type::spot;
       p.scene.lights[0].half_angle_deg = 180;
       return share_of_one(mean_irradiance(p), irradiance_of_point(p.scene.lights[0].position, 1 / (4 * M_PI)), 2e-3);
     }},
    {"SpotOfACentidegree", "a spot of 0.01 degrees", "all of its power falls into its circle",
     [] {
       preset::Preset p = lit_floor();
       Screen screen{{0, 0, 0}, 1e-3, 16};
       screen.fill(p.scene.camera, 0.5);
       p.scene.lights[0] = pencil({0, 1, 0}, {0, -1, 0}, 0.01);
       spectral::settings(p).pixel_samples = 64;
       p.stop.passes = 64;
       return share_of_one(mean_irradiance(p) * 1e-6, 1, 0.06);
     }},
    {"AreaTiny", "an area light of 1e-6 m", "a point of intensity P cos / pi",
     [] {
       preset::Preset p = lit_floor(1);
       p.scene.camera.fov_deg = 0.1;
       p.scene.lights[0].type = preset::Light::Type::area;
       p.scene.lights[0].position = {0, 1, 0};
       p.scene.lights[0].size = {1e-6, 1e-6};
       return share_of_one(mean_irradiance(p), 1 / M_PI, 1e-4);
     }},
    {"AreaHuge", "an area light of 1e4 m, 3 m above the floor",
     "an endless plane, irradiance = exitance; said that its noise has no bounds",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights[0].type = preset::Light::Type::area;
       p.scene.lights[0].position = {0, 3, 0};
       p.scene.lights[0].size = {1e4, 1e4};
       return warns(p, "light 0: is 707 times as wide as the scene: nearly all of its samples are too far away to "
                       "matter, and the picture is dark "
                       "but for rare bright dots; make it smaller, or take directional light");
     }},
    {"AreaWide", "an area light of 60 m, 3 m above the floor", "the form factor of a rectangle, by quadrature",
     [] {
       preset::Preset p = lit_floor();
       p.scene.lights[0].type = preset::Light::Type::area;
       p.scene.lights[0].position = {0, 3, 0};
       p.scene.lights[0].size = {60, 60};
       p.scene.lights[0].power_w = 3600;
       spectral::settings(p).pixel_samples = p.stop.passes.emplace(1 << 13);
       // cos^2 / (pi d^2) over the rectangle, from the middle: samples of 1/4 m.
       double sum = 0;
       for (double x = -29.875; x < 30; x += 0.25)
         for (double z = -29.875; z < 30; z += 0.25) sum += 0.0625 * 9 / (M_PI * std::pow(x * x + z * z + 9, 2));
       return share_of_one(mean_irradiance(p), sum, 0.07);
     }},
    {"ParallelToPlate", "directional light parallel to a plate", "Fresnel at its edge: nothing is lost",
     [] {
       preset::Preset p = over_floor(photons);
       p.scene.materials["glass"] = glass(1.5);
       p.scene.objects.push_back(object("plate", box(1, 0.1, 1), "glass"));
       p.scene.objects.push_back(object("wall", quad(100, 100), "white", at({5, 0, 0}, {0, 0, 90})));
       p.scene.lights = {parallel_light({1, 0, 0})};
       const photons::EnergyBalance e = photons::energy_of(render(p));
       // 1 m x 0.1 m of edge, T = (1 - R) / (1 + R), and the floor is never reached.
       return near(e.deposited_w, 0.1 * 0.96 / 1.04, 0.007);
     }},
    {"LightInGlass", "a lamp in the middle of a glass ball in a room", "all of its light gets out",
     [] {
       preset::Preset p = empty_preset(16);
       p.scene.materials["white"] = white();
       p.scene.materials["glass"] = glass(1.5);
       p.scene.objects = {object("room", box(4, 4, 4), "white"), object("ball", sphere(0.5), "glass")};
       p.scene.objects[0].shape->inwards = true;
       p.scene.objects[1].normals = preset::Object::Normals::smooth;
       p.scene.lights.resize(1);
       p.scene.camera.position = {0, 0, 1.5};
       return near(deposited(p), 1, 1e-4);
     }},
    {"LightOnGlass", "a lamp exactly on the face of a glass box", "between a lamp just inside and one just outside",
     [] {
       const auto at_height = [](double y) {
         preset::Preset p = beam({0.01, y, 0.02}, {0, -1, 0});
         p.scene.objects.push_back(object("box", box(1, 1, 1), "glass"));
         return deposited(p);
       };
       const double inside = at_height(0.5 - 1e-3), outside = at_height(0.5 + 1e-3), on = at_height(0.5);
       const double tolerance = sigmas * std::sqrt(0.08 / photons);
       return near(on, std::abs(on - inside) < std::abs(on - outside) ? inside : outside, tolerance);
     }},
    {"MirrorOfZero", "a mirror of reflectance 0", "everything is absorbed",
     [] {
       preset::Preset p = beam({0.01, 2, 0.02}, {0, -1, 0});
       p.scene.materials["mirror"] = mirror(0);
       p.scene.objects.push_back(object("mirror", quad(1, 1), "mirror"));
       const photons::EnergyBalance e = photons::energy_of(render(p));
       return exactly(e.absorbed_w / e.emitted_w, 1);
     }},
    {"HallOfMirrors", "two parallel mirrors of 0.9, 32 surfaces", "0.9^32 is left and lost",
     [] {
       preset::Preset p = beam({0.01, 0, 0.02}, {0, -1, 0});
       p.scene.materials["mirror"] = mirror(0.9);
       spectral::settings(p).max_surfaces = 32;
       for (const double y : {-0.5, 0.5}) p.scene.objects.push_back(object("", quad(1, 1), "mirror", at({0, y, 0})));
       const photons::EnergyBalance e = photons::energy_of(render(p));
       return near(e.lost_w / e.emitted_w, std::pow(0.9, 32), 1e-6);
     }},
    {"HallOfPerfectMirrors", "two perfect parallel mirrors, 1024 surfaces", "everything is left and lost",
     [] {
       preset::Preset p = beam({0.01, 0, 0.02}, {0, -1, 0});
       spectral::settings(p).photons_per_pass = 1 << 12;
       spectral::settings(p).max_surfaces = 1024;
       for (const double y : {-0.5, 0.5}) p.scene.objects.push_back(object("", quad(1, 1), "mirror", at({0, y, 0})));
       const photons::EnergyBalance e = photons::energy_of(render(p));
       return exactly(e.lost_w / e.emitted_w, 1);
     }},
    {"OneSurface", "max_surfaces 1 for a plate", "R goes back, the rest is lost",
     [] {
       preset::Preset p = beam({0.01, 2, 0.02}, {0, -1, 0});
       spectral::settings(p).max_surfaces = 1;
       p.scene.objects.push_back(object("plate", box(1, 0.1, 1), "glass"));
       const photons::EnergyBalance e = photons::energy_of(render(p));
       return share(e.lost_w / e.emitted_w, 0.96, photons);
     }},
    {"Diamond", "n = 2.42, a prism that sends light back: total reflection",
     "R + (1 - R)^2 + ... comes back: nothing gets through",
     [] {
       preset::Preset p = beam({0.01, 2, 0.02}, {0, -1, 0});
       p.scene.materials["glass"] = glass(2.42);
       preset::Shape prism;
       prism.type = preset::Shape::Type::prism;
       prism.apex_deg = 90;
       p.scene.objects.push_back(object("prism", prism, "glass", at({0, 0, 0}, {90, 0, 0})));
       return exactly(deposited(p), 0);
     }},
    {"Corner", "three mirrors that send light back", "it comes back where it came from, all of it",
     [] {
       preset::Preset p = beam({1, 1.2, 1.3}, {-1, -1, -1});
       p.scene.objects = {object("wall", quad(0.5, 0.5), "white", at({1.6, 1.4, 1.3}))};
       p.scene.objects.push_back(object("", quad(2, 2), "mirror", at({1, 0, 1})));
       p.scene.objects.push_back(object("", quad(2, 2), "mirror", at({0, 1, 1}, {0, 0, -90})));
       p.scene.objects.push_back(object("", quad(2, 2), "mirror", at({1, 1, 0}, {90, 0, 0})));
       return exactly(deposited(p), 1);
     }},
};

class Lights : public testing::TestWithParam<Extreme> {};
TEST_P(Lights, AreRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Lights, testing::ValuesIn(extremes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_lights_test
