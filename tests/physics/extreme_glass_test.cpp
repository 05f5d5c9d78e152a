// SPDX-License-Identifier: Apache-2.0
// Extreme materials: indices of refraction at and around 1 and far from it, curves with steps and poles, absorption
// without end, nested and total reflection. docs/notebook/extremes.md sums it up.
#include "optics/fresnel.h"
#include "photons/clusters/clusters.h"
#include "tests/support/extremes.h"

namespace nephroid::extreme_glass_test {

constexpr int photons = 1 << 17;

/// A plate in y = 0 under a pencil of 0.01 degrees that meets it at theta. The pencil starts 0.1 m from there.
preset::Preset plate(double n, double theta_deg, double thickness = 1e-3) {
  preset::Preset p = over_floor(photons);
  p.scene.materials["glass"] = glass(n);
  p.scene.objects.push_back(object("plate", box(40, thickness, 40), "glass"));
  const double s = std::sin(theta_deg * degree), c = std::cos(theta_deg * degree);
  p.scene.lights = {pencil({-0.1 * s, thickness / 2 + 0.1 * c, 0}, {s, -c, 0}, 0.01)};
  return p;
}

/// T = (1 - R)^2 (1 + R^2 + ...) = (1 - R) / (1 + R).
double plate_transmittance(double cos_i, double n_outside, double n) {
  const double r = optics::fresnel_reflectance(cos_i, n_outside, n);
  return (1 - r) / (1 + r);
}

/// The mean of f(cos theta') over the pencil's cone, whose rays meet the plate at theta' = theta + a r cos(phi).
template <class F>
double mean_over_pencil(double theta_deg, const F& f) {
  constexpr int rings = 256, spokes = 64;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < spokes; ++k) {
      const double r = std::sqrt((i + 0.5) / rings), phi = 2 * M_PI * (k + 0.5) / spokes;
      sum += f(std::cos((theta_deg + 0.01 * r * std::cos(phi)) * degree));
    }
  return sum / (rings * spokes);
}

Outcome plate_is_fresnels(double n, double theta_deg, double thickness = 1e-3) {
  const double truth = mean_over_pencil(theta_deg, [&](double cos_i) { return plate_transmittance(cos_i, 1, n); });
  return share(deposited(plate(n, theta_deg, thickness)), truth, photons);
}

/// A gap of air, or of a glass of index n, across a block of glass that holds the light and the floor. What the gap
/// reflects is caught by a mirror that reflects nothing.
Outcome gap_in_glass(double n_block, double n_gap, double theta_deg) {
  preset::Preset p = plate(n_gap, theta_deg);
  p.scene.materials["block"] = glass(n_block);
  p.scene.materials["black"] = check::mirror(0);
  p.scene.objects[1].priority = 1;
  p.scene.objects.push_back(object("block", box(900, 10, 900), "block"));
  p.scene.objects.push_back(object("trap", quad(40, 40), "black", at({0, 2, 0})));
  const double truth =
      mean_over_pencil(theta_deg, [&](double cos_i) { return plate_transmittance(cos_i, n_block, n_gap); });
  return share(deposited(p), truth, photons);
}

preset::Material table_glass(const std::vector<std::array<double, 2>>& rows) {
  preset::Material m = glass(1.5);
  m.dispersion.type = preset::Dispersion::Type::table;
  m.dispersion.table = rows;
  return m;
}

std::size_t clusters_of(const preset::Material& material, double threshold_deg) {
  preset::Preset p = over_floor(1);
  p.scene.materials["glass"] = material;
  const scene::Scene scene = scene::load_scene(p);
  for (const scatter::Material& m : scene.materials)
    if (m.name == "glass")
      return photons::cluster_wavelengths(m.n, threshold_deg, photons::ClusterMethod::optimal).clusters.size();
  return 0;
}

preset::Material n_sf66() {
  preset::Material m = glass(1.5);
  m.absorption = false;
  m.dispersion.type = preset::Dispersion::Type::file;
  m.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml";
  return m;
}

/// A plate 2 mm thick whose glass has n = 1.5 and this k: T = (1 - R)^2 tau / (1 - R^2 tau^2), tau = exp(-4 pi k d /
/// lambda).
Outcome absorbing_plate(double k) {
  const TemporaryFolder folder;
  preset::Preset p = plate(1.5, 0, 2e-3);
  preset::Material m = n_sf66();
  m.absorption = true;
  m.dispersion.file = write_constant_nk(folder.path() / "glass.yml", 1.5, k);
  p.scene.materials["glass"] = m;
  const double tau = std::exp(-4 * M_PI * k * 2e-3 / 550e-9), r = 0.04,
               truth = (1 - r) * (1 - r) * tau / (1 - r * r * tau * tau);
  const photons::EnergyBalance e = photons::energy_of(render(p));
  const double back = r + (1 - r) * (1 - r) * r * tau * tau / (1 - r * r * tau * tau);
  return both(share(e.deposited_w / e.emitted_w, truth, photons),
              share(e.absorbed_w / e.emitted_w, 1 - truth - back, photons));
}

/// `count` nested boxes, the innermost 0.1 m across, each of the same glass of n = 1.5 but the outermost ones larger;
/// the light inside.
preset::Preset nested(int count) {
  preset::Preset p = over_floor(photons);
  p.scene.materials["glass"] = glass(1.5);
  for (int i = 0; i < count; ++i)
    p.scene.objects.push_back(object("", box(0.1 + 0.1 * i, 0.1 + 0.1 * i, 0.1 + 0.1 * i), "glass"));
  p.scene.lights = {pencil({0.001, 0, 0.002}, {0, -1, 0}, 0.01)};
  return p;
}

/// The largest relative error of 1 - R on the device, against double, around an angle of incidence: of the formulas
/// alone, from the float nearest to cos, or of a direction whose three components are rounded, at a plate turned by 30
/// degrees.
double transmission_error(double theta_deg, double n, bool turned) {
  const TestKernels kernels(R"(
#include "kernels/scatter/fresnel.h"
#include "kernels/tracing/work_item.h"
kernel void bend(global const float4* direction, global const float4* normal, float n, global float* transmitted)
{
  const int i = work_item();
  const float cos_i = -dot(direction[i].xyz, normal[i].xyz);
  transmitted[i] = 1.0f - fresnel_reflectance(cos_i, refracted_cosine(cos_i, 1.0f / n), 1.0f, n);
}
)");
  std::vector<shared::float4> directions, normals;
  std::vector<double> truth;
  for (int i = 0; i < 1024; ++i) {
    const double theta = (theta_deg - 1e-4 * (90 - theta_deg) * i) * degree, turn = turned ? 30 * degree : 0;
    // Out of the plane as well, so that no component is a round number.
    const double across = turned ? 0.3 : 0, s = std::sin(theta) * std::cos(across), c = std::cos(theta),
                 z = std::sin(theta) * std::sin(across);
    const glm::dvec3 d(s * std::cos(turn) + c * std::sin(turn), s * std::sin(turn) - c * std::cos(turn), z);
    directions.push_back({float(d.x), float(d.y), float(d.z), 0});
    normals.push_back({float(-std::sin(turn)), float(std::cos(turn)), 0, 0});
    truth.push_back(1 - optics::fresnel_reflectance(turned ? c : double(float(c)), 1, n));
  }
  const compute::Buffer<shared::float4> d(kernels.context(), "d", std::span<const shared::float4>(directions)),
      m(kernels.context(), "n", std::span<const shared::float4>(normals));
  compute::Buffer<float> out(kernels.context(), "out", truth.size());
  kernels.kernel("bend").run(truth.size(), 64,
                             {{"direction", d}, {"normal", m}, {"n", static_cast<float>(n)}, {"transmitted", out}});
  const std::vector<float> gave = out.read();
  double worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) worst = std::max(worst, std::abs(gave[i] / truth[i] - 1));
  return worst;
}

const std::vector<Extreme> extremes = {
    {"DigitsAt89", "relative error of 1 - R at 89 degrees, from an exact cosine", "double",
     [] { return at_most(transmission_error(89, 1.5, false), 1e-5); }},
    {"DigitsAt89999", "at 89.999 degrees", "double; 1 - R is 1e-4 there, a float's spacing below 1 is 6e-8",
     [] { return at_most(transmission_error(89.999, 1.5, false), 4e-3); }},
    {"DigitsTurned89", "the same from a rounded direction at a plate turned by 30 degrees, 89 degrees",
     "cos = 0.017, rounded by some 1e-7", [] { return at_most(transmission_error(89, 1.5, true), 2e-5); }},
    {"DigitsTurned89999", "at 89.999 degrees", "cos = 1.7e-5, rounded by some 1e-7: two digits are left",
     [] { return at_most(transmission_error(89.999, 1.5, true), 2e-2); }},
    {"IndexOfOne", "n exactly 1, 45 degrees", "n = 1 bends and reflects nothing",
     [] { return exactly(deposited(plate(1, 45)), 1); }},
    {"IndexOfOneAndAFloat", "n = 1 + 1e-7, 89.9 degrees", "Fresnel, in double",
     [] { return plate_is_fresnels(1 + 1e-7, 89.9); }},
    {"IndexJustAboveOne", "n = 1 + 1e-4, 89.5 degrees", "Fresnel, in double",
     [] { return plate_is_fresnels(1 + 1e-4, 89.5); }},
    {"IndexJustBelowOne", "n = 1 - 1e-4, 89 degrees (critical angle 89.19)", "Fresnel, in double",
     [] { return plate_is_fresnels(1 - 1e-4, 89); }},
    {"IndexOfFour", "n = 4, 60 degrees", "Fresnel", [] { return plate_is_fresnels(4, 60); }},
    {"IndexOfAHundred", "n = 100, 0 degrees: 49 reflections in the mean", "Fresnel",
     [] { return plate_is_fresnels(100, 0); }},
    {"IndexOfAHalf", "n = 0.5, 29 degrees (critical angle 30)", "Fresnel", [] { return plate_is_fresnels(0.5, 29); }},
    {"IndexOfAHalfTotal", "n = 0.5, 30.1 degrees", "total reflection: nothing",
     [] { return exactly(deposited(plate(0.5, 30.1)), 0); }},
    {"CriticalAngle", "n = 0.5 at the critical angle itself, half of the pencil beyond it",
     "Fresnel, mean over the pencil", [] { return plate_is_fresnels(0.5, 30); }},
    {"Grazing", "n = 1.5, 89.9 degrees", "Fresnel, mean over the pencil", [] { return plate_is_fresnels(1.5, 89.9); }},
    {"GapOfAir", "light and floor inside glass of n = 1.8, a gap of air at 33 degrees (critical angle 33.75)",
     "Fresnel", [] { return gap_in_glass(1.8, 1, 33); }},
    {"GapOfAirTotal", "the same at 34 degrees", "total reflection: nothing", [] { return gap_in_glass(1.8, 1, 34); }},
    {"GapOfTheSame", "a plate inside glass of its own n", "nothing is there",
     [] { return gap_in_glass(1.8, 1.8, 60); }},
    {"FlatCurve", "n(lambda) flat, threshold 1e-9 degrees", "nothing changes: one cluster",
     [] {
       return exactly(static_cast<double>(clusters_of(table_glass({{380, 1.5}, {780, 1.5}}), 1e-9)), 1);
     }},
    {"Staircase", "n(lambda) a staircase of two steps", "the two steps, and the jump in a cluster of its own",
     [] {
       return exactly(
           static_cast<double>(clusters_of(table_glass({{380, 1.9}, {550, 1.9}, {551, 1.5}, {780, 1.5}}), 0.05)), 3);
     }},
    {"OneBadSample", "n(lambda) = 1.5 but 90 at 550 nm", "the bad wavelength alone: two clusters",
     [] {
       return exactly(static_cast<double>(
                          clusters_of(table_glass({{380, 1.5}, {549, 1.5}, {550, 90}, {551, 1.5}, {780, 1.5}}), 0.05)),
                      2);
     }},
    {"BadSampleRefused", "n(lambda) with a 0", "no such glass",
     [] {
       return refused_json(
           R"("scene":{"materials":{"g":{"type":"dielectric","dispersion":{"type":"table","table":[[380,1.5],[550,0]]}}}})",
           "/scene/materials/g/dispersion/table/1/1: is 0; expected a number from 0.01 to 100");
     }},
    {"Pole", "n(lambda) with a pole at 500 nm", "n^2 is negative beside it",
     [] {
       preset::Preset p = over_floor(1);
       p.source = "p.json";
       preset::Material m = glass(1.5);
       m.dispersion.type = preset::Dispersion::Type::sellmeier;
       m.dispersion.b = {1};
       m.dispersion.c_um2 = {0.25};
       p.scene.materials["glass"] = m;
       return refused(
           [&] { scene::load_scene(p); },
           "p.json#/scene/materials/glass/dispersion: sellmeier: the formula of sellmeier gives no number at 380 nm: "
           "n^2 is negative "
           "or infinite there; expected n^2 above 0; check the coefficients: does a resonance lie inside the range?");
     }},
    {"ThresholdTiny", "threshold 1e-9 degrees, N-SF66", "each wavelength alone",
     [] { return exactly(static_cast<double>(clusters_of(n_sf66(), 1e-9)), 401); }},
    {"ThresholdHuge", "threshold 89.9999 degrees, N-SF66", "all in one",
     [] { return exactly(static_cast<double>(clusters_of(n_sf66(), 89.9999)), 1); }},
    {"ThresholdZero", "threshold 0", "refused",
     [] {
       return refused_json(R"("spectral":{"threshold_deg":0})",
                           "/spectral/threshold_deg: is 0; expected a number above 0 and below 90 degrees");
     }},
    {"ThresholdNinety", "threshold 90", "refused",
     [] {
       return refused_json(R"("spectral":{"threshold_deg":90})",
                           "/spectral/threshold_deg: is 90; expected a number above 0 and below 90 degrees");
     }},
    {"AbsorbsNothing", "k = 0", "a plate of clear glass", [] { return absorbing_plate(0); }},
    {"AbsorbsAll", "k = 1e-2: exp(-457)", "nothing gets through, all but the first reflection is absorbed",
     [] { return absorbing_plate(1e-2); }},
    {"AbsorbsBeyondNumbers", "k = 1e30: exp(-infinity)", "the same", [] { return absorbing_plate(1e30); }},
    {"EightGlasses", "8 nested glasses of one n around the light", "one surface: T = (1 - R) / (1 - R^2)",
     [] { return share(deposited(nested(8)), 1 / 1.04, photons); }},
    {"NineGlasses", "9 nested glasses", "refused",
     [] {
       preset::Preset p = nested(9);
       p.source = "p.json";
       return refused([&] { render(p); }, "p.json#/scene/lights/0/position: is inside 9 dielectric objects; expected "
                                          "at most 8 around one point; move it, or take some "
                                          "of them away");
     }},
};

class Glass : public testing::TestWithParam<Extreme> {};
TEST_P(Glass, IsRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Glass, testing::ValuesIn(extremes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_glass_test
