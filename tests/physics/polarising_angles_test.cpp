// SPDX-License-Identifier: Apache-2.0
// Two angles at which Fresnel's equations do something exact: the critical angle, beyond which nothing goes through, and Brewster's, at
// which light polarised in the plane of incidence is not reflected. Photons meet a single interface here (max_surfaces 1): what is
// deposited on a catcher came straight from it.
#include "optics/fresnel.h"
#include "tests/support/closed_form.h"
#include "tests/support/test_kernels.h"

namespace nephroid::polarising_angles_test {

constexpr int photons = 1 << 19;

/// A block of glass below y = 0, light that meets its upper face at the origin, from below (1) or from above (-1), and a catcher above.
double share_above(double theta, double n, double from_below)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("block", box(2, 2, 2), "glass", at({0, -1, 0})), object("catcher", quad(400, 400), "white", at({0, 0.01, 0}))};
  // A ray that leaves at cos(t) = 1e-3 meets a catcher at 0.01 within 10 m. Light from above starts below the catcher.
  const double s = 0.008 * std::sin(theta), c = 0.008 * std::cos(theta);
  p.scene.lights = {pencil({-s, -c * from_below, 0}, {s, c * from_below, 0}, 1e-6)};
  spectral::settings(p).photons_per_pass = photons;
  spectral::settings(p).max_surfaces = 1;
  const spectral::EnergyBalance e = spectral::energy_of(render(p));
  EXPECT_NEAR(e.emitted_w, 1, 1e-6);
  return e.deposited_w / e.emitted_w;
}

// sin(t) = n sin(theta) reaches 1 at the critical angle. A little before it, by delta, cos(t)^2 = 1 - n^2 sin^2(theta) is about
// 2 delta sqrt(n^2 - 1), so that a few photons of a thousand still go through at delta = 1e-6, and none beyond. Directions in single
// precision are off by up to 1.5e-7, which is how sharp the edge can be.
TEST(CriticalAngle, PhotonsAreTotallyReflectedBeyondItAndNotBefore)
{
  constexpr double rounding = 1.5e-7;
  for (const double n : {1.1, 1.5, 2.417}) {
    const double critical = std::asin(1 / n);
    for (const double beyond : {1e-6, 1e-5, 1e-3}) {
      EXPECT_EQ(share_above(critical + beyond, n, 1), 0) << n << " at " << beyond << " beyond";
      const auto transmittance = [&](double before) { return 1 - optics::fresnel_reflectance(std::cos(critical - before), n, 1); };
      const double truth = transmittance(beyond), band = transmittance(beyond + rounding) - transmittance(beyond - rounding);
      expect_share(fmt::format("critical angle: transmittance {:g} rad before it, n = {}", beyond, n), share_above(critical - beyond, n, 1),
                   truth, photons, band);
    }
  }
}

// tan(theta) = n: refracted and reflected ray are at right angles, and the reflected amplitude of light polarised in the plane of
// incidence, (n cos(theta) - cos(t)) / (n cos(theta) + cos(t)), is 0 because cos(t) = sin(theta) = n cos(theta). With that the other one is
// (cos(theta) - n cos(t)) / (cos(theta) + n cos(t)) = (1 - n^2) / (1 + n^2), and of unpolarised light half its square is reflected.
TEST(BrewstersAngle, HalfOfTheOtherPolarisationIsReflected)
{
  for (const double n : {1.1, 1.5, 2.417}) {
    const double truth = std::pow((1 - n * n) / (1 + n * n), 2) / 2;
    expect_share(fmt::format("Brewster's angle: reflectance, n = {}", n), share_above(std::atan(n), n, -1), truth, photons);
    expect_truth(fmt::format("Brewster's angle: reflectance by optics/fresnel.h, n = {}", n),
                 optics::fresnel_reflectance(std::cos(std::atan(n)), 1, n), truth, 1e-15);
  }
}

// kernels/tracing/fresnel.h in single precision: its unpolarised R less half of R_s = ((cos(theta) - n cos(t)) / (cos(theta) + n
// cos(t)))^2, which a double works out from the same cosine, leaves half of R_p: nothing at Brewster's angle.
TEST(BrewstersAngle, TheKernelReflectsNothingPolarisedInThePlane)
{
  const TestKernels kernels(R"(
#include "kernels/tracing/fresnel.h"
kernel void reflectances(global const float4* in, global float4* out, uint count)
{
  const uint i = get_global_id(0);
  if (i < count) out[i] = (float4)(fresnel_reflectance(in[i].x, refracted_cosine(in[i].x, in[i].y / in[i].z), in[i].y, in[i].z));
}
)");
  using Float4 = std::array<float, 4>;
  std::vector<Float4> in;
  for (int i = 0; i <= 300; ++i) {
    const float n = 1 + 0.01f * static_cast<float>(i);
    in.push_back({static_cast<float>(std::cos(std::atan(double(n)))), 1, n, 0});
  }
  const compute::Buffer<Float4> from(kernels.context(), "in", std::span<const Float4>(in));
  compute::Buffer<Float4> to(kernels.context(), "out", in.size());
  kernels.kernel("reflectances").run(in.size(), 64, {{"in", from}, {"out", to}, {"count", static_cast<std::uint32_t>(in.size())}});
  const std::vector<Float4> out = to.read();
  double worst_p = 0, worst = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double cos_i = in[i][0], n = in[i][2], cos_t = *optics::refracted_cosine(cos_i, 1, n);
    const double s = std::pow((cos_i - n * cos_t) / (cos_i + n * cos_t), 2);
    worst_p = std::max(worst_p, std::abs(2 * out[i][0] - s));
    worst = std::max(worst, std::abs(out[i][0] - optics::fresnel_reflectance(cos_i, 1, n)));
  }
  expect_truth("Brewster's angle: largest R_p of the kernel, n = 1 to 4", worst_p, 0, 4e-7);
  expect_truth("Brewster's angle: kernel against optics/fresnel.h, n = 1 to 4", worst, 0, 2e-7);
}

} // namespace nephroid::polarising_angles_test
