// SPDX-License-Identifier: Apache-2.0
// What a polished metal under a varnish reflects, by angle and wavelength, against the bounces in the varnish one by
// one; and where the varnish is not seen.
#include "optics/fresnel.h"
#include "scatter/spectra.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::varnished_metal_test {

preset::Material varnished(const std::string& metal, double n, double tint = 1) {
  preset::Material m;
  m.type = preset::Material::Type::varnished_metal;
  m.metal = metal;
  m.dispersion.n = n;
  m.tint.value = tint;
  return m;
}

/// The part of an inclined pencil's light that is left after a reflection, by the power that reaches the walls of a
/// room. around: index of a block of glass about the place that the pencil meets.
double part_left(const preset::Material& metal, double theta, double nm, const std::optional<double>& around = {}) {
  preset::Preset p = empty_preset(16);
  p.scene.materials["metal"] = metal;
  p.scene.materials["white"] = white();
  preset::Shape room = box(100, 100, 100);
  room.inwards = true;
  p.scene.objects = {object("metal", quad(40, 40), "metal"), object("room", room, "white")};
  if (around) {
    p.scene.materials["glass"] = glass(*around);
    p.scene.objects.push_back(object("block", box(0.04, 0.04, 0.04), "glass"));
  }
  p.scene.lights = {check::inclined_pencil(theta, nm)};
  spectral::settings(p).photons_per_pass = 1 << 12;
  const photons::EnergyBalance e = photons::energy_of(render(p));
  return e.deposited_w / e.emitted_w;
}

/// n + i k of a metal.
std::complex<double> index_of(const std::string& metal, double nm) {
  const optics::IndexSample at = scatter::load_dispersion(metal).sample(nm);
  return {at.n.value(), at.k.value()};
}

/// The varnish reflects R at once. The rest is refracted, and of what comes back to the varnish from below, 1 - R
/// leaves each time and R goes down again. Snell and Fresnel are written out: for a complex index N, r_s = (n cos_i - N
/// cos_t) / (n cos_i + N cos_t) and r_p = (N cos_i - n cos_t) / (N cos_i + n cos_t), with n sin_i = N sin_t.
double mean_reflectance(double n_i, std::complex<double> sine_i, std::complex<double> n_t) {
  const std::complex<double> sine_t = n_i * sine_i / n_t, cos_i = std::sqrt(1.0 - sine_i * sine_i),
                             cos_t = std::sqrt(1.0 - sine_t * sine_t);
  const std::complex<double> s = (n_i * cos_i - n_t * cos_t) / (n_i * cos_i + n_t * cos_t),
                             p = (n_t * cos_i - n_i * cos_t) / (n_t * cos_i + n_i * cos_t);
  return (std::norm(s) + std::norm(p)) / 2;
}

double bounces(const std::string& metal, double n, double tint, double theta, double nm) {
  const double sine = std::sin(theta), r = mean_reflectance(1, sine, n),
               m = mean_reflectance(n, sine / n, index_of(metal, nm));
  double left = r, inside = 1 - r;
  for (int bounce = 0; bounce < 200; ++bounce) {
    inside *= tint * m * tint; // down, at the metal, up
    left += inside * (1 - r);
    inside *= r;
  }
  return left;
}

struct Varnish {
  const char* metal;
  double n, tint;
};

// All photons of a pencil of one wavelength meet the metal at one angle, but for .01 degrees, and keep the same part.
TEST(VarnishedMetal, ReflectsTheSumOfAllBounces) {
  for (const Varnish& v : {Varnish{"gold", 1.5, 1}, {"copper", 1.5, 0.7}, {"silver", 1.9, 0.9}, {"aluminium", 1.3, 0}})
    for (const double nm : {420.0, 550.0, 700.0})
      for (const double theta_deg : {0.0, 30.0, 60.0, 85.0}) {
        const double theta = theta_deg * degree;
        expect_truth(fmt::format("varnished metal: {} below n = {}, tint {}, at {} nm and {} degrees", v.metal, v.n,
                                 v.tint, nm, theta_deg),
                     part_left(varnished(v.metal, v.n, v.tint), theta, nm), bounces(v.metal, v.n, v.tint, theta, nm),
                     2e-5);
      }
}

// A varnish of the index of what is around it reflects nothing and bends nothing: it is the bare metal, in air and in
// glass. Of another index it is not.
TEST(VarnishedMetal, IsBareWhereTheVarnishIsAsWhatIsAround) {
  preset::Material bare = varnished("copper", 1);
  bare.type = preset::Material::Type::conductor;
  for (const double theta_deg : {0.0, 40.0}) {
    const double theta = theta_deg * degree;
    EXPECT_NEAR(part_left(varnished("copper", 1), theta, 500), part_left(bare, theta, 500), 1e-5);
    EXPECT_NEAR(part_left(varnished("copper", 1.5), theta, 500, 1.5), part_left(bare, theta, 500, 1.5), 1e-5);
    EXPECT_GT(std::abs(part_left(varnished("copper", 1.5), theta, 500) - part_left(bare, theta, 500)), 0.01);
  }
}

} // namespace nephroid::varnished_metal_test
