// SPDX-License-Identifier: Apache-2.0
// A plate with parallel faces: light leaves it in the direction it came from, moved aside and weaker, and otherwise as it was.
#include "optics/fresnel.h"
#include "tests/support/closed_form.h"

namespace nephroid::slab_test {

constexpr double n = 1.5;

preset::Preset plate_over_floor(double thickness)
{
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("plate", box(4, thickness, 4), "glass"), object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  return p;
}

// Inside a plate of thickness d a ray that came at theta runs at t, sin(theta) = n sin(t), and gets d tan(t) aside instead of d tan(theta):
// on a floor parallel to the plate it lands d (tan(theta) - tan(t)) short. Light reflected inside lands 2 d tan(t) farther, out of view.
TEST(Slab, MovesLightSideways)
{
  constexpr double d = 0.1;
  constexpr int photons = 1 << 17;
  for (const double theta_deg : {0.0, 15.0, 30.0, 45.0, 60.0}) {
    preset::Preset p = plate_over_floor(d);
    const double theta = theta_deg * degree, t = std::asin(std::sin(theta) / n), truth = d * (std::tan(theta) - std::tan(t));
    p.scene.lights = {pencil({-2 * std::tan(theta), 1, 0}, {std::sin(theta), -std::cos(theta), 0}, 0.02)}; // aims at (0, -1, 0)
    spectral::settings(p).photons_per_pass = photons;
    const Screen screen{{-truth, -1, 0}, 0.02, 100};
    screen.fill(p.scene.camera, 0.5);
    const std::vector<double> picture = watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0]));
    double power = 0, moment_x = 0, moment_z = 0;
    for (int row = 0; row < screen.pixels; ++row)
      for (int column = 0; column < screen.pixels; ++column) {
        const double w = picture[static_cast<std::size_t>(row * screen.pixels + column)];
        power += w;
        moment_x += w * screen.x(column);
        moment_z += w * screen.z(row);
      }
    // The beam's radius on the floor is below 0.02 degrees * 2 m / cos^2, and a uniform disc's centre is known to radius / 2 / sqrt(N).
    // The tangent's second derivative moves the centre of a cone of half angle a by 2 m tan(theta) / cos^2(theta) a^2 / 4. Squares of 0.2
    // mm average to 0.2 mm / sqrt(12) a photon.
    const double a = 0.02 * degree, radius = 2 * a / std::pow(std::cos(theta), 2),
                 bend = 2 * std::tan(theta) / std::pow(std::cos(theta), 2) * a * a / 4;
    const double tolerance = sigmas * (radius / 2 + screen.pixel_side() / std::sqrt(12.0)) / std::sqrt(0.6 * photons) + bend + 1e-6;
    expect_truth(fmt::format("plate: sideways shift / d at {} degrees", theta_deg), -moment_x / power / d, truth / d, tolerance / d);
    expect_truth(fmt::format("plate: shift across the plane of incidence / d at {} degrees", theta_deg), moment_z / power / d, 0,
                 tolerance / d);
  }
}

// Under a wide plate in parallel light every place gets, after 0, 2, 4... reflections inside, (1 - R)^2 (1 + R^2 + R^4 + ...) =
// (1 - R) / (1 + R) of E cos(theta): as uniform as it was.
TEST(Slab, LeavesIrradianceUniform)
{
  for (const double theta_deg : {0.0, 50.0, 75.0}) {
    preset::Preset p = plate_over_floor(0.02);
    const double theta = theta_deg * degree;
    p.scene.lights = {parallel_light({std::sin(theta), -std::cos(theta), 0})};
    spectral::settings(p).photons_per_pass = 1 << 20;
    p.stop.passes = 4;
    const Screen screen{{std::tan(theta), -1, 0}, 1.5, 32}; // where light that met the plate's middle lands
    screen.fill(p.scene.camera, 0.5);
    const std::vector<double> picture = watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0]));
    const double r = optics::fresnel_reflectance(std::cos(theta), 1, n), e = std::cos(theta) * (1 - r) / (1 + r);
    const std::vector<double> truth(screen.count(), e * screen.pixel_area());
    expect_agreement(fmt::format("plate: uniform irradiance under it at {} degrees", theta_deg),
                     agreement(picture, truth, directional_photon_w(p, 4.0 * (1 << 20))));
  }
}

} // namespace nephroid::slab_test
