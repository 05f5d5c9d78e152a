// SPDX-License-Identifier: Apache-2.0
// Photons through plates and prisms, against Snell's and Fresnel's closed forms.
#include "compute/compute.h"
#include "optics/colour.h"
#include "optics/dispersion.h"
#include "optics/fresnel.h"
#include "scene/scene.h"
#include "spectral/engine.h"
#include "tests/support/closed_form.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace nephroid;
using namespace nephroid::test;

namespace {

// ---- Plate -----------------------------------------------------------------------------------------------------------------
// Light that meets a plate at theta is partly reflected at the first face, R; of what goes in, 1 - R leaves at the second face and
// R goes back, and so on: T = (1 - R)^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R). A pencil of 0.01 degrees crosses a plate of
// 40 m x 1 mm x 40 m that lies in y = 0; a floor below catches what goes through.
double plate_transmittance(double theta_deg, double n, unsigned photons, double* emitted)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("plate", box(40, 1e-3, 40), "glass"), object("floor", quad(400, 400), "white", at({0, -1, 0}))};
  const double s = std::sin(theta_deg * degree), c = std::cos(theta_deg * degree);
  // The pencil's start is 0.1 m from where it meets the plate, so that at 89 degrees it is still narrow there.
  p.scene.lights.push_back(pencil({-0.1 * s, 0.5e-3 + 0.1 * c, 0}, {s, -c, 0}, 0.01));
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.spectral.photons_per_pass = static_cast<int>(photons);
  p.spectral.max_surfaces = 200;
  const job::EnergyBalance e = render(p).energy;
  const double t = e.deposited_w / e.emitted_w;
  *emitted = e.emitted_w;
  EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-9 * e.emitted_w);
  EXPECT_EQ(e.missed_w, 0);
  EXPECT_EQ(e.lost_w, 0);
  return t;
}

class Plate : public testing::TestWithParam<int> {};

TEST_P(Plate, TransmittanceIsFresnels)
{
  const double theta = GetParam(), n = 1.5;
  constexpr unsigned photons = 1 << 20;
  double emitted;
  const double measured = plate_transmittance(theta, n, photons, &emitted);
  const double r = optics::fresnel_reflectance(std::cos(theta * degree), 1, n);
  expect_share("plate: transmittance at " + std::to_string(GetParam()) + " degrees", measured, (1 - r) / (1 + r), photons);
  EXPECT_NEAR(emitted, 1, 1e-4); // the whole pencil
}

INSTANTIATE_TEST_SUITE_P(Degrees, Plate, testing::Values(0, 10, 20, 30, 40, 50, 56, 60, 65, 70, 75, 80, 84, 86, 88, 89));

// A plate that absorbs, at normal incidence, tau = exp(-4 pi k d / lambda) a crossing: T = (1 - R)^2 tau / (1 - R^2 tau^2).
// The dispersion file N-SF66 gives n and k; d = 0.05 m lets 3 % through at 400 nm.
TEST(AbsorbingPlate, TransmittanceFollowsBeerAndLambert)
{
  preset::Preset p = empty_preset(16);
  preset::Material absorbing;
  absorbing.type = preset::Material::Type::dielectric;
  absorbing.dispersion.type = preset::Dispersion::Type::file;
  absorbing.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml";
  p.scene.materials["glass"] = absorbing;
  p.scene.materials["white"] = white();
  p.scene.objects = {object("plate", box(1, 0.05, 1), "glass"), object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.spectral.photons_per_pass = 1 << 18;
  p.spectral.method = preset::Spectral::Method::brute_force;
  const optics::DispersionCurve curve = optics::load_dispersion(absorbing.dispersion.file);
  for (const double nm : {400.0, 436.0, 500.0, 660.0}) {
    p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05, nm)};
    const optics::IndexSample s = curve.sample(nm);
    const double r = std::pow((*s.n - 1) / (*s.n + 1), 2), tau = std::exp(-4 * M_PI * *s.k * 0.05 / (nm * 1e-9));
    const double truth = std::pow(1 - r, 2) * tau / (1 - r * r * tau * tau);
    const job::EnergyBalance e = render(p).energy;
    const double measured = e.deposited_w / e.emitted_w;
    // Each photon that gets through carries tau, so the count's error is that of the number of those.
    expect_truth("absorbing plate: transmittance at " + std::to_string(static_cast<int>(nm)) + " nm", measured, truth,
                 sigmas * std::sqrt(truth * tau / p.spectral.photons_per_pass));
    EXPECT_NEAR(e.deposited_w + e.absorbed_w + e.escaped_w, e.emitted_w, 1e-6);
  }
}

// ---- Prism -----------------------------------------------------------------------------------------------------------------
// A pencil meets a 60 degree prism of N-SF11 near minimum deviation and lands on a screen. In the plane of incidence:
// entry face and exit face each make half the apex angle with the prism's axis of symmetry, so with the angle of incidence i1
// sin r1 = sin(i1) / n, r2 = A - r1, sin i2 = n sin r2, and the deviation is i1 + i2 - A.
struct Landing {
  double row = 0, column = 0, flux = 0;
};

/// The centre of the light within 4 pixels of the brightest one: reflections inside the prism land elsewhere.
Landing centroid(const job::Snapshot& snapshot)
{
  const job::Layer& picture = layer(snapshot, "caustic");
  const int width = snapshot.picture->width, height = snapshot.picture->height;
  const auto luminance = [&](int row, int column) {
    const std::size_t i = 3 * static_cast<std::size_t>(row * width + column);
    return optics::linear_srgb_to_xyz({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]})[1];
  };
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

using Point = std::array<double, 2>; // (x, z)

/// Where a ray in the plane y = 0 crosses the line through a and b.
Point crossing(const Point& o, const Point& d, const Point& a, const Point& b)
{
  const double ex = b[0] - a[0], ez = b[1] - a[1];
  const double t = ((a[0] - o[0]) * ez - (a[1] - o[1]) * ex) / (d[0] * ez - d[1] * ex);
  return {o[0] + t * d[0], o[1] + t * d[1]};
}

/// Snell's law in the plane: unit direction d, unit normal n against it.
Point refracted(const Point& d, const Point& n, double eta)
{
  const double c = -(d[0] * n[0] + d[1] * n[1]), t = std::sqrt(1 - eta * eta * (1 - c * c));
  return {eta * d[0] + (eta * c - t) * n[0], eta * d[1] + (eta * c - t) * n[1]};
}

TEST(Prism, NineWavelengthsLandWhereSnellSays)
{
  // The prism's cross section in (x, z): apex at (0, s cos 30 / 2), base corners at (+-s / 2, -s cos 30 / 2), s = 0.1 m, about y.
  const double side = 0.1, up = side * std::cos(30 * degree) / 2;
  const Point apex{0, up}, left{-side / 2, -up}, right{side / 2, -up};
  const Point normal_left{-std::cos(30 * degree), std::sin(30 * degree)}, normal_right{std::cos(30 * degree), std::sin(30 * degree)};

  preset::Preset p = empty_preset();
  p.scene.camera.resolution = {1024, 64};
  preset::Material material;
  material.type = preset::Material::Type::dielectric;
  material.absorption = false;
  material.dispersion.type = preset::Dispersion::Type::file;
  material.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF11.yml";
  p.scene.materials["glass"] = material;
  p.scene.materials["white"] = white();
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.side = side;
  prism.apex_deg = 60;
  prism.height = 0.1;
  // The screen: the plane z = -1, seen from the prism's side. The pencil comes from the left at 62 degrees to the entry face.
  const double i1 = 62 * degree, screen_z = -1;
  p.scene.objects = {object("prism", prism, "glass"), object("screen", quad(4, 4), "white", at({0, 0, screen_z}, {90, 0, 0}))};
  const Point inward{std::cos(30 * degree), -std::sin(30 * degree)}; // against the entry face's normal
  // Rotated about y by i1 from the inward normal, towards the apex side.
  const Point d0{inward[0] * std::cos(i1) - inward[1] * std::sin(i1), inward[0] * std::sin(i1) + inward[1] * std::cos(i1)};
  const Point meets{(apex[0] + left[0]) / 2, (apex[1] + left[1]) / 2};
  const Point from{meets[0] - 0.2 * d0[0], meets[1] - 0.2 * d0[1]};
  p.spectral.method = preset::Spectral::Method::brute_force;
  p.spectral.photons_per_pass = 1 << 15;
  const optics::DispersionCurve curve = optics::load_dispersion(material.dispersion.file);

  const auto landing_x = [&](double nm) {
    const double n = *curve.sample(nm).n;
    const Point inside = refracted(d0, normal_left, 1 / n);
    const Point exit = crossing(meets, inside, apex, right);
    const Point out = refracted(inside, {-normal_right[0], -normal_right[1]}, n);
    return exit[0] + (screen_z - exit[1]) / out[1] * out[0];
  };
  // The camera stands in front of the screen's lit part: nine colours across 1024 pixels.
  const double x_red = landing_x(700), x_blue = landing_x(400), middle = (x_red + x_blue) / 2, width = 1.3 * std::abs(x_blue - x_red);
  p.scene.camera.position = {middle, 0.5, screen_z + 1.5};
  p.scene.camera.target = {middle, 0, screen_z};
  const double distance = std::hypot(0.5, 1.5);
  p.scene.camera.fov_deg = 2 * std::atan(width / 2 / distance * 64 / 1024) / degree;

  double last_column = 0, worst = 0;
  int order = 0;
  for (int i = 0; i < 9; ++i) {
    const double nm = 400 + 37.5 * i;
    const double whole_nm = std::round(nm);
    p.scene.lights = {pencil({from[0], 0, from[1]}, {d0[0], 0, d0[1]}, 0.005, whole_nm)};
    const Landing landing = centroid(render(p));
    ASSERT_GT(landing.flux, 0) << whole_nm << " nm";
    const double column = 512 + (landing_x(whole_nm) - middle) / width * 1024;
    EXPECT_NEAR(landing.column, column, 1) << whole_nm << " nm";
    worst = std::max(worst, std::abs(landing.column - column));
    EXPECT_NEAR(landing.row, 32, 1);
    if (i > 0) {
      const int direction = landing.column > last_column ? 1 : -1;
      EXPECT_TRUE(order == 0 || direction == order) << "colours out of order at " << whole_nm << " nm";
      order = direction;
    }
    last_column = landing.column;
  }
  // Violet is bent most. The prism bends light towards its base, which is at -z, so violet lands nearest the prism's foot: smallest x.
  EXPECT_LT(x_blue, x_red);
  EXPECT_EQ(order, 1);
  record("prism: farthest of nine wavelengths from its place, pixels", worst, 0, 1);
}

// ---- Nested dielectrics ----------------------------------------------------------------------------------------------------
// Two overlapping boxes of one glass are one box: T of a plate as thick as both. A box of air inside a box of glass, of higher
// priority, makes two plates, whose intensities combine as T = (1 - R) / (1 + 3 R) (four interfaces, no interference).
TEST(Nested, OverlappingBoxesOfOneGlassAreOne)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(1.8);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("upper", box(1, 0.1, 1), "glass", at({0, 0.04, 0})),
                     object("lower", box(1, 0.1, 1), "glass", at({0, -0.04, 0})), object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05)};
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.spectral.photons_per_pass = 1 << 18;
  const job::EnergyBalance e = render(p).energy;
  const double r = std::pow(0.8 / 2.8, 2), truth = (1 - r) / (1 + r);
  expect_share("nested: transmittance of overlapping boxes of one glass", e.deposited_w / e.emitted_w, truth, 1 << 18);
}

TEST(Nested, AirInsideGlassMakesTwoPlates)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(1.8);
  p.scene.materials["air"] = glass(1);
  p.scene.materials["white"] = white();
  p.scene.objects = {object("block", box(1, 0.3, 1), "glass"), object("bubble", box(0.5, 0.1, 0.5), "air"),
                     object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.objects[1].priority = 1;
  p.scene.lights = {pencil({0, 1, 0}, {0, -1, 0}, 0.05)};
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.spectral.photons_per_pass = 1 << 18;
  p.spectral.max_surfaces = 200;
  const job::EnergyBalance e = render(p).energy;
  const double r = std::pow(0.8 / 2.8, 2), truth = (1 - r) / (1 + 3 * r);
  expect_share("nested: transmittance of a bubble of air in glass", e.deposited_w / e.emitted_w, truth, 1 << 18);
}

// ---- Contact ---------------------------------------------------------------------------------------------------------------
// Glass that stands exactly on a floor, on a mirror or on other glass: a gap of air is left, so nothing is lost, and the closed forms
// are those of plates in air. Both orders of the objects, because ties are broken by it.
double standing_on(const preset::Object& below, const char* catcher, bool glass_first)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["white"] = white();
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["mirror"].reflectance.value = 1;
  const preset::Object box_on_top = object("standing", box(1, 1, 1), "glass", at({0, -1.5, 0}));
  p.scene.objects = glass_first ? std::vector{box_on_top, below} : std::vector{below, box_on_top};
  p.scene.objects.push_back(object("catcher", quad(400, 400), "white", std::string(catcher) == "above" ? at({0, 5, 0}) : at({0, -5, 0})));
  p.scene.lights = {pencil({0.1, 1, 0.07}, {0, -1, 0}, 0.05)};
  p.scene.camera.position = {0, 3, 0};
  p.scene.camera.up = {0, 0, -1};
  p.spectral.photons_per_pass = 1 << 17;
  p.spectral.max_surfaces = 200;
  const job::EnergyBalance e = render(p).energy;
  EXPECT_EQ(e.lost_w, 0);
  return e.deposited_w / e.emitted_w;
}

TEST(Contact, NoLightIsLostBetweenTouchingSurfaces)
{
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

// A point light in the middle of a glass cube: of each face's light the part inside the critical cone gets out, the rest bounces
// for ever between the faces. With n = 2 the cones about the six faces do not overlap, and light that enters no cone never does.
TEST(TotalReflection, ACubeKeepsWhatIsOutsideItsCones)
{
  preset::Preset p = empty_preset(16);
  const double n = 2;
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["white"] = white();
  preset::Shape room = box(10, 10, 10);
  room.inwards = true;
  p.scene.objects = {object("cube", box(0.2, 0.2, 0.2), "glass"), object("room", room, "white")};
  preset::Light light;
  light.spectrum = line(550);
  p.scene.lights = {light};
  constexpr int photons = 1 << 16;
  p.spectral.photons_per_pass = photons;
  p.spectral.max_surfaces = 300;
  const job::EnergyBalance e = render(p).energy;
  // Inside a cone a photon comes back to a face of the same kind at the same angle until it is let out: all of it leaves.
  const double critical = *optics::critical_angle_deg(n, 1) * degree, truth = 6 * (1 - std::cos(critical)) / 2;
  expect_share("total reflection: light that leaves a cube of n = 2", e.deposited_w / e.emitted_w, truth, photons);
  expect_share("total reflection: light that stays in it", e.lost_w / e.emitted_w, 1 - truth, photons);
  EXPECT_NEAR(e.emitted_w, 1, 1e-6);
}

} // namespace
