// SPDX-License-Identifier: Apache-2.0
// Photons through plates and prisms, against Snell's and Fresnel's closed forms.
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "optics/fresnel.h"
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

// ---- Plate
// ----------------------------------------------------------------------------------------------------------------- A
// pencil of 0.01 degrees crosses a plate of 40 m x 1 mm x 40 m that lies in y = 0; a floor below catches what goes
// through.
photons::EnergyBalance through_plate(double theta_deg, double n, int photons) {
  preset::Preset p = seen_from_above(n, photons);
  p.scene.objects = {object("plate", box(40, 1e-3, 40), "glass"),
                     object("floor", quad(400, 400), "white", at({0, -1, 0}))};
  const double s = std::sin(theta_deg * degree), c = std::cos(theta_deg * degree);
  // The pencil's start is 0.1 m from where it meets the plate, so that at 89 degrees it is still narrow there.
  p.scene.lights.push_back(pencil({-0.1 * s, 0.5e-3 + 0.1 * c, 0}, {s, -c, 0}, 0.01));
  const photons::EnergyBalance e = photons::energy_of(render(p));
  EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-9 * e.emitted_w);
  EXPECT_EQ(e.missed_w, 0);
  EXPECT_EQ(e.lost_w, 0);
  return e;
}

class Plate : public testing::TestWithParam<int> {};

TEST_P(Plate, TransmittanceIsFresnels) {
  constexpr double n = 1.5;
  constexpr int photons = 1 << 20;
  const photons::EnergyBalance e = through_plate(GetParam(), n, photons);
  expect_share("plate: transmittance at " + std::to_string(GetParam()) + " degrees", e.deposited_w / e.emitted_w,
               check::plate_transmittance(GetParam() * degree, n), photons);
  EXPECT_NEAR(e.emitted_w, 1, 1e-4); // the whole pencil
}

INSTANTIATE_TEST_SUITE_P(Degrees, Plate,
                         testing::Values(0, 10, 20, 30, 40, 50, 56, 60, 65, 70, 75, 80, 84, 86, 88, 89));

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

// ---- Prism
// ----------------------------------------------------------------------------------------------------------------- A
// pencil meets a 60 degree prism of N-SF11 near minimum deviation and lands on a screen where check::prism_path says.
struct Landing {
  double row = 0, column = 0, flux = 0;
};

/// The centre of the light within 4 pixels of the brightest one: reflections inside the prism land elsewhere.
Landing centroid(const job::Snapshot& snapshot) {
  const job::Layer& picture = layer(snapshot, "caustic");
  const int width = snapshot.picture->width, height = snapshot.picture->height;
  const auto luminance = [&](int row, int column) { return check::luminance(picture, width, row, column); };
  int top = 0, left = 0;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      if (luminance(row, column) > luminance(top, left)) top = row, left = column;
  Landing sum;
  for (int row = std::max(top - 4, 0); row <= std::min(top + 4, height - 1); ++row)
    for (int column = std::max(left - 4, 0); column <= std::min(left + 4, width - 1); ++column) {
      const double y = luminance(row, column);
      sum.row += y * (row + 0.5);
      sum.column += y * (column + 0.5);
      sum.flux += y;
    }
  return {sum.row / sum.flux, sum.column / sum.flux, sum.flux};
}

constexpr double prism_side = 0.1, screen_z = -1;

/// Its axis along y, lit from the left at 62 degrees to the entry face; the camera is to be put before the screen.
preset::Preset prism_before_screen(const std::string& glass_file) {
  preset::Preset p = empty_preset();
  preset::Material& material = p.scene.materials["glass"] = glass(1);
  material.absorption = false;
  material.dispersion.type = preset::Dispersion::Type::file;
  material.dispersion.file = glass_file;
  p.scene.materials["white"] = white();
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.side = prism.height = prism_side;
  prism.apex_deg = 60;
  p.scene.objects = {object("prism", prism, "glass"),
                     object("screen", quad(4, 4), "white", at({0, 0, screen_z}, {90, 0, 0}))};
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  spectral::settings(p).photons_per_pass = 1 << 15;
  return p;
}

TEST(Prism, NineWavelengthsLandWhereSnellSays) {
  const std::string glass_file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF11.yml";
  preset::Preset p = prism_before_screen(glass_file);
  const optics::DispersionCurve curve = optics::load_dispersion(glass_file);
  const auto path = [&](double nm) {
    return check::prism_path(prism_side, 62 * degree, *curve.sample(nm).n, screen_z);
  };
  // The camera stands in front of the screen's lit part: nine colours across 1024 pixels.
  const double x_red = path(700).landing_x, x_blue = path(400).landing_x, middle = (x_red + x_blue) / 2,
               width = 1.3 * (x_red - x_blue);
  // Violet is bent most. The prism bends light towards its base, which is at -z, so violet lands nearest the prism's
  // foot: smallest x.
  ASSERT_LT(x_blue, x_red);
  p.scene.camera.resolution = {1024, 64};
  p.scene.camera.position = {middle, 0.5, screen_z + 1.5};
  p.scene.camera.target = {middle, 0, screen_z};
  p.scene.camera.fov_deg = 2 * std::atan(width / 2 / std::hypot(0.5, 1.5) * 64 / 1024) / degree;

  double last_column = 0, worst = 0;
  for (int i = 0; i < 9; ++i) {
    const double nm = std::round(400 + 37.5 * i);
    const check::PrismPath truth = path(nm);
    p.scene.lights = {pencil({truth.from_x, 0, truth.from_z}, {truth.direction_x, 0, truth.direction_z}, 0.005, nm)};
    const Landing landing = centroid(render(p));
    ASSERT_GT(landing.flux, 0) << nm << " nm";
    const double column = 512 + (truth.landing_x - middle) / width * 1024;
    EXPECT_NEAR(landing.column, column, 1) << nm << " nm";
    worst = std::max(worst, std::abs(landing.column - column));
    EXPECT_NEAR(landing.row, 32, 1);
    EXPECT_GT(landing.column, last_column) << "colours out of order at " << nm << " nm";
    last_column = landing.column;
  }
  record("prism: farthest of nine wavelengths from its place, pixels", worst, 0, 1);
}

// ---- Nested dielectrics
// ---------------------------------------------------------------------------------------------------- Two overlapping
// boxes of one glass are one box: T of a plate as thick as both. A box of air inside a box of glass, of higher
// priority, makes two plates, whose intensities combine as T = (1 - R) / (1 + 3 R) (four interfaces, no interference).
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

TEST(Nested, AirInsideGlassMakesTwoPlates) {
  preset::Preset p = seen_from_above(1.8, 1 << 18);
  p.scene.materials["air"] = glass(1);
  p.scene.objects = {object("block", box(1, 0.3, 1), "glass"), object("bubble", box(0.5, 0.1, 0.5), "air"),
                     object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.objects[1].priority = 1;
  p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05)};
  const photons::EnergyBalance e = photons::energy_of(render(p));
  const double r = std::pow(0.8 / 2.8, 2), truth = (1 - r) / (1 + 3 * r);
  expect_share("nested: transmittance of a bubble of air in glass", e.deposited_w / e.emitted_w, truth, 1 << 18);
}

// ---- Contact
// --------------------------------------------------------------------------------------------------------------- Glass
// that stands exactly on a floor, on a mirror or on other glass: a gap of air is left, so nothing is lost, and the
// closed forms are those of plates in air. Both orders of the objects, because ties are broken by it.
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

} // namespace nephroid::refraction_test
