// SPDX-License-Identifier: Apache-2.0
// What an absorbing ball takes out of parallel light. A ray at h = R sin(i) has chords of length l = 2 R cos(t), sin(t) = sin(i) / n. A
// share 1 - F enters; each chord leaves e = exp(-a l) of it, of which F stays inside:
//   absorbed = (1 - F) (1 - e) (1 + F e + (F e)^2 + ...) = (1 - F) (1 - e) / (1 - F e),
// and the ball absorbs as a disc of area Q pi R^2 does, Q = integral of absorbed 2 sin(i) cos(i) di: the absorption efficiency of
// geometrical optics (van de Hulst, Light Scattering by Small Particles, 12.3). For n = 1 the chords are distributed like l / (2 R^2), and
//   Q = 1 - 2 (1 - (1 + tau) exp(-tau)) / tau^2, tau = 2 R a.
#include "optics/fresnel.h"
#include "tests/support/closed_form.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::absorption_test {

constexpr double radius = 0.05; // m

double efficiency(double n, double per_metre)
{
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

TEST(AbsorbingBall, TakesWhatItsChordsTake)
{
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
      p.scene.objects = {object("ball", ball, "glass"), object("floor", quad(1, 1), "white", at({0, -1, 0}))}; // it catches some: no matter
      p.scene.objects[0].normals = preset::Object::Normals::smooth;
      p.scene.lights = {parallel_light({0.3, -1, 0.2})};
      spectral::settings(p).photons_per_pass = 1 << 17;
      spectral::settings(p).max_surfaces = 100;
      const spectral::EnergyBalance e = spectral::energy_of(render(p));
      const double area = M_PI * radius * radius, q = efficiency(n, per_metre);
      // Photons carry w each and lose a share A <= 1, so the sum's variance is at most w times the power absorbed. The facets' shadow
      // is smaller than the sphere's by up to 8e-4 and their chords are shorter by 3e-4.
      const double photon_w = directional_photon_w(p, spectral::settings(p).photons_per_pass);
      expect_truth(fmt::format("absorbing ball: efficiency, n = {}, 2 R a = {}", n, tau), e.absorbed_w / area, q,
                   sigmas * std::sqrt(q * area * photon_w) / area + 1e-3 * q);
      EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-9 * e.emitted_w);
      EXPECT_LE(e.lost_w, 1e-4 * e.emitted_w);
    }
}

} // namespace nephroid::absorption_test
