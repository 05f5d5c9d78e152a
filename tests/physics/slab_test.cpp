// SPDX-License-Identifier: Apache-2.0
// A plate with parallel faces: light leaves it in the direction it came from, moved aside and weaker, and otherwise as
// it was. A ball that absorbs; radiance inside glass. The critical angle and Brewster's are in `nephroid check`.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::slab_test {

constexpr double plate_n = 1.5;

preset::Preset plate_over_floor(double thickness) {
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(plate_n);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("plate", box(4, thickness, 4), "glass"),
                     object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  return p;
}

// Inside a plate of thickness d a ray that came at theta runs at t, sin(theta) = n sin(t), and gets d tan(t) aside
// instead of d tan(theta): on a floor parallel to the plate it lands d (tan(theta) - tan(t)) short. Light reflected
// inside lands 2 d tan(t) farther, out of view.
TEST(Slab, MovesLightSideways) {
  constexpr double d = 0.1;
  constexpr int photons = 1 << 17;
  for (const double theta_deg : {0.0, 15.0, 30.0, 45.0, 60.0}) {
    preset::Preset p = plate_over_floor(d);
    const double theta = theta_deg * degree, t = std::asin(std::sin(theta) / plate_n),
                 truth = d * (std::tan(theta) - std::tan(t));
    p.scene.lights = {
        pencil({-2 * std::tan(theta), 1, 0}, {std::sin(theta), -std::cos(theta), 0}, 0.02)}; // aims at (0, -1, 0)
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
    // The beam's radius on the floor is below 0.02 degrees * 2 m / cos^2, and a uniform disc's centre is known to
    // radius / 2 / sqrt(N). The tangent's second derivative moves the centre of a cone of half angle a by 2 m
    // tan(theta) / cos^2(theta) a^2 / 4. Squares of 0.2 mm average to 0.2 mm / sqrt(12) a photon.
    const double a = 0.02 * degree, radius = 2 * a / std::pow(std::cos(theta), 2),
                 bend = 2 * std::tan(theta) / std::pow(std::cos(theta), 2) * a * a / 4;
    const double tolerance =
        sigmas * (radius / 2 + screen.pixel_side() / std::sqrt(12.0)) / std::sqrt(0.6 * photons) + bend + 1e-6;
    expect_truth(fmt::format("plate: sideways shift / d at {} degrees", theta_deg), -moment_x / power / d, truth / d,
                 tolerance / d);
    expect_truth(fmt::format("plate: shift across the plane of incidence / d at {} degrees", theta_deg),
                 moment_z / power / d, 0, tolerance / d);
  }
}

// Under a wide plate in parallel light every place gets, after 0, 2, 4... reflections inside, (1 - R)^2 (1 + R^2 + R^4
// + ...) = (1 - R) / (1 + R) of E cos(theta): as uniform as it was.
TEST(Slab, LeavesIrradianceUniform) {
  for (const double theta_deg : {0.0, 50.0, 75.0}) {
    preset::Preset p = plate_over_floor(0.02);
    const double theta = theta_deg * degree;
    p.scene.lights = {parallel_light({std::sin(theta), -std::cos(theta), 0})};
    spectral::settings(p).photons_per_pass = 1 << 20;
    p.stop.passes = 4;
    const Screen screen{{std::tan(theta), -1, 0}, 1.5, 32}; // where light that met the plate's middle lands
    screen.fill(p.scene.camera, 0.5);
    const std::vector<double> picture = watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0]));
    const double r = optics::fresnel_reflectance(std::cos(theta), 1, plate_n), e = std::cos(theta) * (1 - r) / (1 + r);
    const std::vector<double> truth(screen.count(), e * screen.pixel_area());
    expect_agreement(fmt::format("plate: uniform irradiance under it at {} degrees", theta_deg),
                     agreement(picture, truth, directional_photon_w(p, 4.0 * (1 << 20))));
  }
}

// What an absorbing ball takes out of parallel light. A ray at h = R sin(i) has chords of length l = 2 R cos(t), sin(t)
// = sin(i) / n. A share 1 - F enters; each chord leaves e = exp(-a l) of it, of which F stays inside:
//   absorbed = (1 - F) (1 - e) (1 + F e + (F e)^2 + ...) = (1 - F) (1 - e) / (1 - F e),
// and the ball absorbs as a disc of area Q pi R^2 does, Q = integral of absorbed 2 sin(i) cos(i) di: the absorption
// efficiency of geometrical optics (van de Hulst, Light Scattering by Small Particles, 12.3). For n = 1 the chords are
// distributed like l / (2 R^2), and
//   Q = 1 - 2 (1 - (1 + tau) exp(-tau)) / tau^2, tau = 2 R a.

constexpr double radius = 0.05; // m

double efficiency(double n, double per_metre) {
  if (n == 1) {
    const double tau = 2 * radius * per_metre;
    return 1 - 2 * (1 - (1 + tau) * std::exp(-tau)) / (tau * tau);
  }
  constexpr int steps = 100'000; // midpoints in h^2, which 2 sin(i) cos(i) di is the step of
  double q = 0;
  for (int i = 0; i < steps; ++i) {
    const double h = std::sqrt((i + 0.5) / steps), f = optics::ball_ray(h, n, -1).share,
                 e = std::exp(-per_metre * radius * optics::ball_ray(h, n, 0).chord);
    q += (1 - f) * (1 - e) / (1 - f * e) / steps;
  }
  return q;
}

TEST(AbsorbingBall, TakesWhatItsChordsTake) {
  const TemporaryFolder folder;
  for (const double n : {1.0, 1.5, 2.4})
    for (const double tau : {0.01, 1.0, 20.0}) {
      const double per_metre = tau / (2 * radius), k = per_metre * 550e-9 / (4 * M_PI);
      preset::Preset p = empty_preset(16);
      preset::Material& material = p.scene.materials["glass"] = glass(n);
      material.dispersion.type = preset::Dispersion::Type::file;
      material.dispersion.file = write_constant_nk(folder.path() / fmt::format("{}-{}.yml", n, tau), n, k);
      preset::Shape ball;
      ball.radius = radius;
      p.scene.materials["white"] = white();
      p.scene.objects = {object("ball", ball, "glass"),
                         object("floor", quad(1, 1), "white", at({0, -1, 0}))}; // it catches some: no matter
      p.scene.objects[0].normals = preset::Object::Normals::smooth;
      p.scene.lights = {parallel_light({0.3, -1, 0.2})};
      spectral::settings(p).photons_per_pass = 1 << 17;
      spectral::settings(p).max_surfaces = 100;
      const photons::EnergyBalance e = photons::energy_of(render(p));
      const double area = M_PI * radius * radius, q = efficiency(n, per_metre);
      // Photons carry w each and lose a share A <= 1, so the sum's variance is at most w times the power absorbed. The
      // facets' shadow is smaller than the sphere's by up to 8e-4 and their chords are shorter by 3e-4.
      const double photon_w = directional_photon_w(p, spectral::settings(p).photons_per_pass);
      expect_truth(fmt::format("absorbing ball: efficiency, n = {}, 2 R a = {}", n, tau), e.absorbed_w / area, q,
                   sigmas * std::sqrt(q * area * photon_w) / area + 1e-3 * q);
      EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-9 * e.emitted_w);
      EXPECT_LE(e.lost_w, 1e-4 * e.emitted_w);
    }
}

// Radiance changes at an interface: what a path keeps is L / n^2 (Nicodemus 1963, "Radiance"). Paths that enter glass
// and leave it again say nothing of that, because n cancels; so here the lit surface is inside the glass and the eye
// outside.

// A white sheet and a lamp of intensity I = P / (4 pi) inside a block of glass, seen from above along the normal. The
// sheet has the radiance L = I cos(theta) / (pi d^2); of that the eye gets (1 - R) L / n^2 with R = ((n - 1) / (n +
// 1))^2 at normal incidence.
TEST(RadianceInGlass, IsDividedByTheSquareOfTheIndexOnTheWayOut) {
  constexpr double n = 1.5, power = 5;
  preset::Preset p = empty_preset(9);
  p.scene.materials = {{"white", white()}, {"glass", glass(n)}};
  p.scene.objects = {object("block", box(4, 1, 4), "glass"), object("sheet", quad(2, 2), "white", at({0, -0.3, 0}))};
  p.scene.lights = {{.spectrum = {.illuminant = "E"}, .power_w = power, .position = {0.3, 0.2, 0.1}}};
  p.scene.camera.position = {0, 2, 0};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 1; // over 4 cm the radiance is linear to 1e-3, and R that of normal incidence
  spectral::settings(p).direct = true;
  spectral::settings(p).caustic = false;
  p.stop.passes = 64;

  double mean = 0;
  const job::Snapshot snapshot = render(p);
  const std::vector<float>& rgb = layer(snapshot, "direct").rgb;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    mean += optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]})[1] / (9 * 9);

  const double d2 = 0.3 * 0.3 + 0.5 * 0.5 + 0.1 * 0.1, cosine = 0.5 / std::sqrt(d2);
  const double radiance = power / (4 * M_PI) * cosine / d2 / M_PI, reflected = std::pow((n - 1) / (n + 1), 2);
  const double truth = (1 - reflected) * radiance / (n * n) * optics::to_xyz(optics::illuminant("E"))[1];
  // 4 x 64 x 81 paths are reflected with a chance of 4 %: the mean is known to 0.14 %, of which 1 % is seven times.
  EXPECT_NEAR(mean / truth, 1, 0.01);
}

} // namespace nephroid::slab_test
