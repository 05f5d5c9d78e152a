// SPDX-License-Identifier: Apache-2.0
// Sums over wavelengths (kernels/tracing/attenuation.h) over the engine's own tables, against double precision.
#include "check/device_arrays.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "spectral/checks/render.h"
#include "spectral/checks/scene_parts.h"
#include "spectral/tables/run_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::check {
namespace {

using Int4 = std::array<int, 4>; // light, cluster, reflector, attenuator

/// Daylight through dispersive glass onto a patch that is not grey.
tracing::WavelengthTables tables()
{
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

/// What attenuated_sum gives for every cluster at every length of glass with absorption `coefficient` in 1/m.
std::vector<float4> sums(const compute::Context& context, const tracing::WavelengthTables& t, const std::vector<float>& coefficient,
                         const std::vector<float>& lengths)
{
  std::vector<Int4> which;
  std::vector<float> crossed;
  for (const float length : lengths)
    for (int c = 0; c < static_cast<int>(t.clusters.size()); ++c) {
      which.push_back({0, c, 0, length > 0 ? 0 : -1});
      crossed.push_back(length);
    }
  const compute::Buffer<float4> out(context, "sums", which.size());
  run_over(context, "attenuated", which.size(),
           {{"first", on_device(context, "first", t.cluster_first)},
            {"wavelengths", on_device(context, "wavelengths", t.cluster_wavelengths)},
            {"coefficient", on_device(context, "coefficient", coefficient)},
            {"light_xyz", on_device(context, "light", t.light_xyz)},
            {"reflectance", on_device(context, "reflectance", t.reflectance)},
            {"in", on_device(context, "which", which)},
            {"lengths", on_device(context, "lengths", crossed)},
            {"out", out}});
  return out.read();
}

double relative(double got, double truth) { return std::abs(got / truth - 1); }

Result whole_spectrum(const compute::Context& context, std::uint64_t)
{
  const tracing::WavelengthTables t = tables();
  double x = 0, y = 0, z = 0, share = 0;
  for (const float4& s : sums(context, t, std::vector<float>(optics::wavelength_count), {0})) x += s.x, y += s.y, z += s.z, share += s.w;
  optics::Spectrum reflected = optics::illuminant("D65");
  const optics::Spectrum patch = optics::colorchecker_patch("orange");
  for (std::size_t i = 0; i < reflected.size(); ++i) reflected[i] *= patch[i];
  const optics::Colour truth = optics::to_xyz(reflected);
  const double worst = std::max({relative(x, truth[0]), relative(y, truth[1]), relative(z, truth[2]), relative(share, 1)});
  return judged(worst, 2e-6, "",
                fmt::format("daylight on an orange patch summed over {} clusters: share and XYZ, against 401 wavelengths on the host",
                            t.clusters.size()));
}

/// Terms are positive, so a sum is as exact as its terms: an exponent e is off by a few e 2^-24, here up to 18, and so is exp(-e).
Result beer_lambert(const compute::Context& context, std::uint64_t)
{
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
        truth[0] += left * rho * l.x, truth[1] += left * rho * l.y, truth[2] += left * rho * l.z, truth[3] += left * l.w;
      }
      const float4& s = got[item++];
      for (const double error : {relative(s.x, truth[0]), relative(s.y, truth[1]), relative(s.w, truth[3])})
        worst = error <= worst ? worst : error;
      if (truth[2] > 0) worst = std::max(worst, relative(s.z, truth[2])); // the eye's blue ends at 650 nm
    }
  return judged(
      worst, 1e-5, "",
      fmt::format("what {} clusters keep after 0.1 mm to 1.5 m of absorbing glass, against exp(-4 pi k s / lambda)", t.clusters.size()));
}

} // namespace

Checks spectral_checks()
{
  return {{"spectra: clusters add up to the light", whole_spectrum}, {"spectra: absorption after Beer and Lambert", beer_lambert}};
}

} // namespace nephroid::check
