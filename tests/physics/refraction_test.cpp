// SPDX-License-Identifier: Apache-2.0
// Photons through plates and blocks, against closed forms. A clear plate, a prism and air inside glass are checks of
// `nephroid check`.
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "preset/read.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

namespace nephroid::refraction_test {

/// Glass of this index and a white material, photons through up to 200 surfaces, seen from 5 m above.
preset::Preset seen_from_above(double n, int photons) {
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  spectral::settings(p).photons_per_pass = photons;
  spectral::settings(p).max_surfaces = 200;
  return p;
}

// A plate that absorbs, at normal incidence, tau = exp(-4 pi k d / lambda) a crossing: T = (1 - R)^2 tau / (1 - R^2
// tau^2). The dispersion file N-SF66 gives n and k; d = 0.05 m lets 3 % through at 400 nm.
TEST(AbsorbingPlate, TransmittanceFollowsBeerAndLambert) {
  preset::Preset p = empty_preset(16);
  preset::Material absorbing;
  absorbing.type = preset::Material::Type::dielectric;
  absorbing.dispersion.type = preset::Dispersion::Type::file;
  absorbing.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml";
  p.scene.materials["glass"] = absorbing;
  p.scene.materials["white"] = white();
  p.scene.objects = {object("plate", box(1, 0.05, 1), "glass"),
                     object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  spectral::settings(p).photons_per_pass = 1 << 18;
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  const optics::DispersionCurve curve = optics::load_dispersion(absorbing.dispersion.file);
  for (const double nm : {400.0, 436.0, 500.0, 660.0}) {
    p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05, nm)};
    const optics::IndexSample s = curve.sample(nm);
    const double r = std::pow((*s.n - 1) / (*s.n + 1), 2), tau = std::exp(-4 * M_PI * *s.k * 0.05 / (nm * 1e-9));
    const double truth = std::pow(1 - r, 2) * tau / (1 - r * r * tau * tau);
    const photons::EnergyBalance e = photons::energy_of(render(p));
    const double measured = e.deposited_w / e.emitted_w;
    // Each photon that gets through carries tau, so the count's error is that of the number of those.
    expect_truth("absorbing plate: transmittance at " + std::to_string(static_cast<int>(nm)) + " nm", measured, truth,
                 sigmas * std::sqrt(truth * tau / spectral::settings(p).photons_per_pass));
    EXPECT_NEAR(e.deposited_w + e.absorbed_w + e.escaped_w, e.emitted_w, 1e-6);
  }
}

// Two overlapping boxes of one glass are one box: T of a plate as thick as both.
TEST(Nested, OverlappingBoxesOfOneGlassAreOne) {
  preset::Preset p = seen_from_above(1.8, 1 << 18);
  p.scene.objects = {object("upper", box(1, 0.1, 1), "glass", at({0, 0.04, 0})),
                     object("lower", box(1, 0.1, 1), "glass", at({0, -0.04, 0})),
                     object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05)};
  const photons::EnergyBalance e = photons::energy_of(render(p));
  const double r = std::pow(0.8 / 2.8, 2), truth = (1 - r) / (1 + r);
  expect_share("nested: transmittance of overlapping boxes of one glass", e.deposited_w / e.emitted_w, truth, 1 << 18);
}

// Glass that stands exactly on a floor, on a mirror or on other glass: a gap of air is left, so nothing is lost, and
// the closed forms are those of plates in air. Both orders of the objects, because ties are broken by it.
double standing_on(const preset::Object& below, const char* catcher, bool glass_first) {
  preset::Preset p = seen_from_above(1.5, 1 << 17);
  p.scene.materials["mirror"] = check::mirror(1);
  const preset::Object box_on_top = object("standing", box(1, 1, 1), "glass", at({0, -1.5, 0}));
  p.scene.objects = glass_first ? std::vector{box_on_top, below} : std::vector{below, box_on_top};
  p.scene.objects.push_back(
      object("catcher", quad(400, 400), "white", std::string(catcher) == "above" ? at({0, 5, 0}) : at({0, -5, 0})));
  p.scene.lights = {pencil({0.1, 1, 0.07}, {0, -1, 0}, 0.05)};
  p.scene.camera.position = {0, 3, 0};
  const photons::EnergyBalance e = photons::energy_of(render(p));
  EXPECT_EQ(e.lost_w, 0);
  return e.deposited_w / e.emitted_w;
}

TEST(Contact, NoLightIsLostBetweenTouchingSurfaces) {
  const double r = 0.04, sigma = 1.0 / std::sqrt(1 << 17);
  for (const bool glass_first : {true, false}) {
    const preset::Object floor = object("floor", quad(40, 40), "white", at({0, -2, 0}));
    EXPECT_NEAR(standing_on(floor, "below", glass_first), (1 - r) / (1 + r), sigmas * 0.3 * sigma);
    // All light comes back from a mirror, and goes up to the catcher whatever the glass reflects on its way.
    const preset::Object mirror = object("mirror", quad(40, 40), "mirror", at({0, -2, 0}));
    EXPECT_NEAR(standing_on(mirror, "above", glass_first), 1, 1e-4);
    const preset::Object more_glass = object("more glass", box(1, 1, 1), "glass", at({0, -2.5, 0}));
    EXPECT_NEAR(standing_on(more_glass, "below", glass_first), (1 - r) / (1 + 3 * r), sigmas * 0.35 * sigma);
  }
}

// A point light in the middle of a glass cube: of each face's light the part inside the critical cone gets out, the
// rest bounces for ever between the faces. With n = 2 the cones about the six faces do not overlap, and light that
// enters no cone never does.
TEST(TotalReflection, ACubeKeepsWhatIsOutsideItsCones) {
  preset::Preset p = empty_preset(16);
  const double n = 2;
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  preset::Shape room = box(10, 10, 10);
  room.inwards = true;
  p.scene.objects = {object("cube", box(0.2, 0.2, 0.2), "glass"), object("room", room, "white")};
  p.scene.lights = {{.spectrum = line(550)}};
  constexpr int photons = 1 << 16;
  spectral::settings(p).photons_per_pass = photons;
  spectral::settings(p).max_surfaces = 300;
  const photons::EnergyBalance e = photons::energy_of(render(p));
  // Inside a cone a photon comes back to a face of the same kind at the same angle until it is let out: all of it
  // leaves.
  const double critical = std::asin(1 / n), truth = 6 * (1 - std::cos(critical)) / 2;
  expect_share("total reflection: light that leaves a cube of n = 2", e.deposited_w / e.emitted_w, truth, photons);
  expect_share("total reflection: light that stays in it", e.lost_w / e.emitted_w, 1 - truth, photons);
  EXPECT_NEAR(e.emitted_w, 1, 1e-6);
}

// A cut stone sends light round and round. What ends inside is missing from the picture, and the run says so.
TEST(TotalReflection, AStoneLosesNoLightAndARunSaysWhereItIsLost) {
  preset::Preset p = preset::read_preset("spectral/brilliant");
  p.scene.camera.resolution = {16, 16};
  p.stop.passes = 1;
  const job::Snapshot whole = render(p);
  const photons::EnergyBalance e = photons::energy_of(whole);
  EXPECT_LT(e.lost_w, 1e-4 * e.emitted_w);
  EXPECT_THAT(whole.warnings, testing::IsEmpty());
  spectral::settings(p).max_surfaces = 32;
  EXPECT_THAT(render(p).warnings, testing::ElementsAre(testing::HasSubstr("is missing from the picture")));
}

} // namespace nephroid::refraction_test
