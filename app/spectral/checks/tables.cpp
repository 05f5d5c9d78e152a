// SPDX-License-Identifier: Apache-2.0
// Kernels' results with the engine's own tables.
#include "check/device_arrays.h"
#include "optics/spectrum.h"
#include "photons/tables/run_tables.h"
#include "spectral/checks/render.h"
#include "spectral/checks/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::check {
namespace {

using std::numbers::pi;

// Sums over wavelengths (kernels/tracing/throughput.h) with the engine's own tables, against double precision.
using Int4 = std::array<int, 4>; // light, cluster, reflector, attenuator

/// Tables of daylight through dispersive glass onto a patch that is not grey.
tracing::WavelengthTables tables() {
  preset::Preset p = empty_preset();
  preset::Material dispersive = glass(1.7);
  dispersive.dispersion.type = preset::Dispersion::Type::cauchy;
  dispersive.dispersion.coefficients = {1.65, 0.03};
  p.scene.materials["glass"] = dispersive;
  p.scene.materials["patch"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["patch"].reflectance.patch = "orange";
  p.scene.objects = {object("ball", ball(1), "glass", at({0, 2, 0})), object("floor", quad(4, 4), "patch")};
  p.scene.lights.resize(1);
  p.scene.lights[0].position = {0, 5, 0};
  return device_tables(p).wavelengths;
}

/// What is left of every cluster at every length of glass with absorption `coefficient` in 1/m.
std::vector<float4> sums(const compute::Context& context, const tracing::WavelengthTables& t,
                         const std::vector<float>& coefficient, const std::vector<float>& lengths) {
  std::vector<Int4> which;
  std::vector<float> crossed;
  for (const float length : lengths)
    for (int c = 0; c < static_cast<int>(t.clusters.size()); ++c) {
      which.push_back({0, c, 0, length > 0 ? 0 : -1});
      crossed.push_back(length);
    }
  const compute::Buffer<float4> out(context, "sums", which.size());
  run_kernel(context, "attenuated", which.size(),
             {{"first", compute::Buffer(context, "first", t.cluster_first)},
              {"wavelengths", compute::Buffer(context, "wavelengths", t.cluster_wavelengths)},
              {"coefficient", compute::Buffer(context, "coefficient", coefficient)},
              {"light_xyz", compute::Buffer(context, "light", t.light_xyz)},
              {"reflectance", compute::Buffer(context, "reflectance", t.reflectance)},
              {"in", compute::Buffer(context, "which", which)},
              {"lengths", compute::Buffer(context, "lengths", crossed)},
              {"out", out}});
  return out.read();
}

double relative(double got, double truth) { return std::abs(got / truth - 1); }

Result whole_spectrum(const compute::Context& context, std::uint64_t) {
  const tracing::WavelengthTables t = tables();
  double x = 0, y = 0, z = 0, share = 0;
  for (const float4& s : sums(context, t, std::vector<float>(optics::wavelength_count), {0}))
    x += s.x, y += s.y, z += s.z, share += s.w;
  optics::Spectrum reflected = optics::illuminant("D65");
  const optics::Spectrum patch = optics::colorchecker_patch("orange");
  for (std::size_t i = 0; i < reflected.size(); ++i) reflected[i] *= patch[i];
  const optics::Colour truth = optics::to_xyz(reflected);
  const double worst =
      std::max({relative(x, truth[0]), relative(y, truth[1]), relative(z, truth[2]), relative(share, 1)});
  return judged(
      worst, 2e-6, "",
      fmt::format(
          "daylight on an orange patch summed over {} clusters: share and XYZ, against 401 wavelengths on the host",
          t.clusters.size()));
}

/// Terms are positive, so a sum is as exact as they: exp(-e), with e up to 18 here, is off by a few e 2^-24.
Result beer_lambert(const compute::Context& context, std::uint64_t) {
  const tracing::WavelengthTables t = tables();
  std::vector<float> coefficient;
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const double k = 2e-7 * (1.5 + std::sin(0.05 * i)); // absorbs as 10 m of good glass do, in waves over the spectrum
    coefficient.push_back(static_cast<float>(4 * std::numbers::pi * k / (optics::wavelength_nm(i) * 1e-9)));
  }
  const std::vector<float> lengths{1e-4f, 1e-2f, 0.1f, 0.5f, 1, 1.5f};
  const std::vector<float4> got = sums(context, t, coefficient, lengths);
  double worst = 0;
  std::size_t item = 0;
  for (const float length : lengths)
    for (const std::vector<int>& cluster : t.clusters) {
      double truth[4] = {};
      for (const int w : cluster) {
        const auto i = static_cast<std::size_t>(w);
        const double left = std::exp(-double(coefficient[i]) * length), rho = t.reflectance[i];
        const float4& l = t.light_xyz[i];
        truth[0] += left * rho * l.x, truth[1] += left * rho * l.y, truth[2] += left * rho * l.z,
            truth[3] += left * l.w;
      }
      const float4& s = got[item++];
      for (const double error : {relative(s.x, truth[0]), relative(s.y, truth[1]), relative(s.w, truth[3])})
        worst = worse(worst, error);
      if (truth[2] > 0) worst = std::max(worst, relative(s.z, truth[2])); // the eye's blue ends at 650 nm
    }
  return judged(
      worst, 1e-5, "",
      fmt::format("what {} clusters keep after 0.1 mm to 1.5 m of absorbing glass, against exp(-4 pi k s / lambda)",
                  t.clusters.size()));
}

// kernels/lights/lights.h: the photons of a light towards spheres carry the power that the light sends there, also
// where the spheres overlap. Errors are in standard deviations of the photons' own spread.

constexpr std::size_t photon_count = 1 << 17;

struct Photon {
  double watts; ///< power of the whole light if this were its only photon
  double direction[3];
};

/// Emits photons of the preset's light towards spheres about its place; a sphere is x, y, z from there, and its radius.
std::vector<Photon> emit(const compute::Context& context, std::uint64_t seed, const preset::Light& light,
                         std::vector<float4> spheres) {
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("ball", ball(1), "glass", at({0, 0, 0})),
                     object("wall", quad(20, 20), "white", at({0, -2, 0}))};
  p.scene.lights = {light};
  photons::RunTables tables = device_tables(p);
  shared::DeviceLight& on_host = tables.lights.at(0);
  const float4 place = on_host.type == LIGHT_DIRECTIONAL ? float4{} : on_host.as.point.position; // all rows begin so
  std::vector<shared::DeviceTarget> targets;
  for (const float4& s : spheres) targets.push_back({{s.x + place.x, s.y + place.y, s.z + place.z, s.w}});
  on_host.first_target = 0;
  on_host.target_count = static_cast<int>(targets.size());
  const compute::Buffer<float4> out(context, "photons", 2 * photon_count);
  run_kernel(context, "emissions", photon_count,
             {{"lights", compute::Buffer(context, "lights", tables.lights)},
              {"light", 0},
              {"targets", compute::Buffer(context, "targets", targets)},
              {"scene", tables.scene},
              {"seed", device_seed(seed)},
              {"out", out}});
  const std::vector<float4> got = out.read();
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < got.size(); i += 2)
    photons.push_back({got[i].w * tables.power_unit, {got[i + 1].x, got[i + 1].y, got[i + 1].z}});
  return photons;
}

/// The mean's distance from the truth in standard errors, to which single precision adds 2e-6 of the truth.
template <class Value>
double z_of(const std::vector<Photon>& photons, const Value& value, double truth) {
  double sum = 0, squares = 0;
  const auto count = static_cast<double>(photons.size());
  for (const Photon& photon : photons) {
    const double v = value(photon);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / count, variance = std::max(squares / count - mean * mean, 0.0) / count;
  return (mean - truth) / std::sqrt(variance + std::pow(2e-6 * truth, 2));
}

double watts_of(const Photon& photon) { return photon.watts; }
double one_minus_cos(double sine) { return 1 - std::sqrt(1 - sine * sine); }

/// A sphere along +z, one in its shadow, one apart along -x.
const std::vector<float4> three_spheres{{0, 0, 3, 1}, {0.2f, 0, 6, 0.5f}, {-2, 0, 0, 0.5f}};

Result judged_in_sigma(double z, std::string detail) { return judged(z, 6, "sigma", std::move(detail)); }

Result point(const compute::Context& context, std::uint64_t seed) {
  preset::Light light;
  light.position = {0, 8, 0};
  light.power_w = 7;
  const double truth = 7 * (one_minus_cos(1 / 3.0) + one_minus_cos(0.25)) / 2;
  return judged_in_sigma(
      z_of(emit(context, seed, light, three_spheres), watts_of, truth),
      fmt::format(
          "{} photons towards three spheres, one in another's shadow, against power times their solid angle over 4 pi",
          photon_count));
}

/// The steradians that two cones share, with half angles a and b and `between` their axes: for every angle t from the
/// second's axis, the part of the circle that the first holds, by the midpoint rule.
double shared_steradians(double a, double b, double between) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps * b,
                 least = (std::cos(a) - std::cos(t) * std::cos(between)) / (std::sin(t) * std::sin(between));
    sum += 2 * std::acos(std::clamp(least, -1.0, 1.0)) * std::sin(t) * b / steps;
  }
  return sum;
}

Result spot(const compute::Context& context, std::uint64_t seed) {
  preset::Light wide, narrow;
  wide.type = narrow.type = preset::Light::Type::spot;
  wide.position = narrow.position = {0, 8, 0};
  wide.direction = narrow.direction = {0, 0, 1};
  wide.power_w = narrow.power_w = 7;
  wide.half_angle_deg = 60;
  narrow.half_angle_deg = 5;
  // The wide cone holds two spheres and its edge crosses the third. The narrow one lies inside the first sphere.
  const std::vector<float4> spheres{three_spheres[0], three_spheres[1], {-std::sqrt(3.0f), 0, 1, 0.5f}};
  const double cone = 2 * pi * (1 - std::cos(pi / 3)), apart = shared_steradians(pi / 3, std::asin(0.25), pi / 3);
  const double z =
      z_of(emit(context, seed, wide, spheres), watts_of, 7 * (2 * pi * one_minus_cos(1 / 3.0) + apart) / cone);
  const double z_narrow = z_of(emit(context, seed, narrow, spheres), watts_of, 7);
  return judged_in_sigma(worse(z_narrow, z),
                         "a cone of 60 degrees about three spheres, one across its edge, and one of 5 degrees inside a "
                         "sphere, against power "
                         "times the part of the cone");
}

Result directional(const compute::Context& context, std::uint64_t seed) {
  preset::Light light;
  light.type = preset::Light::Type::directional;
  light.direction = {0, -0.8, 0.6};
  light.irradiance_w_m2 = 3;
  // The second sphere lies in the first one's shadow, the third apart.
  const double truth = 3 * pi * (1 + 0.49);
  return judged_in_sigma(
      z_of(emit(context, seed, light, {{0, 0, 0, 1}, {0, -2.4f, 1.8f, 0.5f}, {5, 0, 0, 0.7f}}), watts_of, truth),
      "photons towards three spheres, one in another's shadow, against irradiance times the area of the shadow");
}

Result area(const compute::Context& context, std::uint64_t seed) {
  preset::Light light;
  light.type = preset::Light::Type::area;
  light.position = {0, 8, 0};
  light.direction = {0, -1, 0};
  light.size = {0.5, 0.25};
  light.power_w = 7;
  // From inside a sphere the whole power counts; the cosine law makes its mean cosine 2/3.
  const std::vector<Photon> photons = emit(context, seed, light, {{0, 0, 0, 5}});
  const double z = z_of(photons, watts_of, 7);
  const double z_cosine = z_of(
      photons, [](const Photon& p) { return -p.watts * p.direction[1]; }, 7 * 2.0 / 3);
  return judged_in_sigma(worse(z_cosine, z),
                         "photons in all directions, against the whole power and a mean cosine of 2/3");
}

} // namespace

Checks table_checks() {
  return {{"spectra: clusters add up to the light", whole_spectrum},
          {"spectra: absorption after Beer and Lambert", beer_lambert},
          {"emission: point light", point},
          {"emission: spot", spot},
          {"emission: directional light", directional},
          {"emission: area light", area}};
}

} // namespace nephroid::check
