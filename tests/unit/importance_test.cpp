// SPDX-License-Identifier: Apache-2.0
// The importance of wavelengths (4.15) in scenes whose surroundings have a closed form: one material all round, and
// rectangles whose solid angles are known.
#include "optics/spectrum.h"
#include "spectral/settings.h"
#include "tests/support/plans.h"

namespace nephroid::importance_test {

using photons::WavelengthImportance;
using Effort = photons::Settings::Effort;
using optics::Spectrum;
using std::numbers::pi;

preset::Material patch(const std::string& name) {
  preset::Material m;
  m.reflectance.type = preset::Reflectance::Type::patch;
  m.reflectance.patch = name;
  return m;
}

preset::Shape room(double x, double y, double z) {
  preset::Shape s = box(x, y, z);
  s.inwards = true;
  return s;
}

preset::Light lamp(const preset::LightSpectrum& spectrum, double power_w = 1) {
  return {.spectrum = spectrum, .power_w = power_w, .position = {0.3, 1.5, 0.2}};
}

preset::LightSpectrum illuminant(const std::string& name) { return {.illuminant = name}; }

/// A glass ball of radius 0.5 about the origin in a room of 6 x 4 x 5 of `wall`, under one lamp F2.
preset::Preset ball_in_a_room(const preset::Material& wall) {
  preset::Preset p = empty_preset();
  p.source = "p.json";
  spectral::settings(p).effort = Effort::importance;
  p.scene.materials = {{"glass", glass(1.5)}, {"wall", wall}};
  p.scene.objects = {object("room", room(6, 4, 5), "wall"), object("ball", check::ball(0.5), "glass")};
  p.scene.lights = {lamp(illuminant("F2"))};
  return p;
}

/// The product of spectra divided by its largest value.
template <class... Spectra>
Spectrum normalised_product(const Spectra&... factors) {
  Spectrum product;
  for (std::size_t w = 0; w < product.size(); ++w) product[w] = (factors[w] * ...);
  const double largest = *std::max_element(product.begin(), product.end());
  for (double& value : product) value /= largest;
  return product;
}

void expect_near(const Spectrum& u, const Spectrum& expected, double tolerance) {
  for (std::size_t w = 0; w < u.size(); ++w)
    ASSERT_NEAR(u[w], expected[w], tolerance) << optics::wavelength_nm(static_cast<int>(w)) << " nm";
}

/// L* of a reflectance under a light.
double lightness_under(const Spectrum& light, const Spectrum& reflectance) {
  double reflected = 0, white = 0;
  for (std::size_t w = 0; w < light.size(); ++w) {
    reflected += light[w] * optics::cie_1931().y[w] * reflectance[w];
    white += light[w] * optics::cie_1931().y[w];
  }
  return 116 * std::cbrt(reflected / white) - 16; // above 8 / 903.3, which all here are
}

// One material all round: ghat = 1 and L is the same at every wavelength, so u = l ybar m but for a factor.
TEST(Importance, InARoomOfOneMaterialIsLightTimesEyeTimesReflectance) {
  const WavelengthImportance result = importance_of(ball_in_a_room(patch("orange")));
  const Spectrum light = optics::illuminant("F2"), orange = optics::colorchecker_patch("orange");
  expect_near(result.u, normalised_product(light, optics::cie_1931().y, orange), 1e-12);
  ASSERT_EQ(result.surroundings.size(), 1u);
  EXPECT_EQ(result.surroundings[0].material, 1); // "glass", "wall"
  EXPECT_EQ(result.surroundings[0].share, 1);
  EXPECT_NEAR(result.surroundings[0].lightness, lightness_under(light, orange), 1e-9);
}

/// Solid angle of the rectangle [x0, x1] x [z0, z1] at height 0 seen from (px, h, pz): the corner at (x, z) from the
/// foot of the perpendicular adds +- atan(x z / (h sqrt(x^2 + z^2 + h^2))).
double rectangle_solid_angle(double x0, double x1, double z0, double z1, const glm::dvec3& p) {
  const auto corner = [&](double x, double z) { return std::atan2(x * z, p.y * std::sqrt(x * x + z * z + p.y * p.y)); };
  const double a = x0 - p.x, b = x1 - p.x, c = z0 - p.z, d = z1 - p.z;
  return std::abs(corner(b, d) - corner(a, d) - corner(b, c) + corner(a, c));
}

/// The share that the sheet of the test below fills, as the mean over the nine points of a box; its corners are drawn
/// in by a thousandth.
double sheet_share(const glm::dvec3& centre, const glm::dvec3& half) {
  double sum = 0;
  for (int i = 0; i < 9; ++i) {
    const double to_corner = i == 8 ? 0 : 0.999;
    const glm::dvec3 p = centre + to_corner * half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    sum += rectangle_solid_angle(-1, 2, -1.4, 0.6, p + glm::dvec3(0, 1.9, 0)) / (4 * pi);
  }
  return sum / 9;
}

TEST(Importance, RectanglesFillASphereAroundAPoint) {
  double sum = 0; // the six sides of a cube of edge 2 seen from a point inside, turned to lie below it
  const glm::dvec3 p(0.3, -0.2, 0.5);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double u = p[(axis + 1) % 3], v = p[(axis + 2) % 3];
      sum += rectangle_solid_angle(-1, 1, -1, 1, {u, std::abs(p[axis] - side), v});
    }
  EXPECT_NEAR(sum, 4 * pi, 1e-12);
}

/// Of 9 x 2048 directions; the shares below are off by 2e-4, as many random directions would be by 2e-3.
constexpr double share_tolerance = 1e-3;

// A sheet just above the floor hides the floor from everywhere else; glass before it is looked through, and so is the
// ball itself.
TEST(Importance, OfTwoMaterialsGoesByTheirSolidAngles) {
  preset::Preset p = ball_in_a_room(patch("cyan"));
  p.scene.materials["sheet"] = patch("red");
  p.scene.objects.push_back(object("sheet", quad(3, 2), "sheet", at({0.5, -1.9, -0.4})));
  const double share = sheet_share(glm::dvec3(0), glm::dvec3(0.5));
  const WavelengthImportance result = importance_of(p);
  ASSERT_EQ(result.surroundings.size(), 2u); // "glass", "sheet", "wall"
  EXPECT_EQ(result.surroundings[0].material, 1);
  EXPECT_NEAR(result.surroundings[0].share, share, share_tolerance);
  EXPECT_NEAR(result.surroundings[1].share, 1 - share, share_tolerance);

  const Spectrum light = optics::illuminant("F2"), red = optics::colorchecker_patch("red"),
                 cyan = optics::colorchecker_patch("cyan");
  Spectrum mixed;
  for (std::size_t w = 0; w < mixed.size(); ++w)
    mixed[w] = red[w] * lightness_under(light, red) * share + cyan[w] * lightness_under(light, cyan) * (1 - share);
  expect_near(result.u, normalised_product(light, optics::cie_1931().y, mixed), 0.005);

  p.scene.materials["pane"] = glass(1.7);
  p.scene.objects.push_back(object("pane", box(4, 0.2, 3), "pane", at({0, -1.2, 0})));
  const WavelengthImportance through = importance_of(p);
  ASSERT_EQ(through.surroundings.size(), 2u); // now "glass", "pane", "sheet", "wall"
  EXPECT_NEAR(through.surroundings[0].share, (share + sheet_share({0, -1.2, 0}, {2, 0.1, 1.5})) / 2, share_tolerance);
}

// A small ball in a closet of its own and a large one in a hall count alike.
TEST(Importance, EveryCausticObjectCountsAlike) {
  preset::Preset p = ball_in_a_room(patch("blue"));
  p.scene.materials["closet"] = patch("yellow");
  p.scene.objects.push_back(object("bead", check::ball(0.05), "glass", at({2, 0, 0})));
  p.scene.objects.push_back(object("closet", room(0.2, 0.2, 0.2), "closet", at({2, 0, 0})));
  const WavelengthImportance result = importance_of(p);
  ASSERT_EQ(result.surroundings.size(), 2u);
  // The closet fills half; of the ball's rays it takes what it hides of the wall: a cube of edge 0.2 at 2, at most 0.3
  // % of the sphere.
  EXPECT_NEAR(result.surroundings[0].share, 0.5, 0.003);
}

// (4.15) has m_i(lambda): a gold wall takes u from blue and leaves it to red, just as a diffuse one of its reflectance
// does.
TEST(Importance, OfAMirrorGoesByItsReflectanceAtEachWavelength) {
  preset::Material gold = check::mirror(0);
  gold.reflectance.type = preset::Reflectance::Type::table;
  gold.reflectance.table = {{380, 0.38}, {480, 0.38}, {560, 0.82}, {780, 0.97}};
  const WavelengthImportance result = importance_of(ball_in_a_room(gold));
  const auto over_white = [&](int nm) { // what the wall makes of light and eye
    const auto w = static_cast<std::size_t>(nm - 380);
    return result.u[w] / (optics::illuminant("F2")[w] * optics::cie_1931().y[w]);
  };
  EXPECT_NEAR(over_white(450) / over_white(560), 0.38 / 0.82, 1e-9);
  EXPECT_NEAR(over_white(670) / over_white(560), 0.895 / 0.82, 1e-9); // halfway from 560 to 780 nm
  gold.type = preset::Material::Type::diffuse;
  const WavelengthImportance matt = importance_of(ball_in_a_room(gold));
  EXPECT_EQ(result.u, matt.u);
  EXPECT_EQ(result.surroundings.at(0).lightness, matt.surroundings.at(0).lightness);
}

// Where mirrors throw the caustics, what they see around them counts and not they themselves.
TEST(Importance, OfMirrorsAloneGoesByWhatIsAroundThem) {
  preset::Preset p = ball_in_a_room(patch("green"));
  p.scene.materials["glass"] = check::mirror(0.9);
  const WavelengthImportance result = importance_of(p);
  ASSERT_EQ(result.surroundings.size(), 1u);
  EXPECT_EQ(result.surroundings[0].material, 1);
  expect_near(result.u,
              normalised_product(optics::illuminant("F2"), optics::cie_1931().y, optics::colorchecker_patch("green")),
              1e-12);
}

TEST(Importance, WithoutGeometryCountsEveryMaterialInUseAlike) {
  preset::Preset p = ball_in_a_room(patch("cyan"));
  p.scene.materials["hidden"] = patch("red");
  p.scene.materials["unused"] = patch("green");
  p.scene.objects.push_back(object("outside", quad(1, 1), "hidden", at({0, 9, 0})));
  spectral::settings(p).importance.geometry = false;
  const WavelengthImportance result = importance_of(p);
  const Spectrum light = optics::illuminant("F2"), red = optics::colorchecker_patch("red"),
                 cyan = optics::colorchecker_patch("cyan");
  ASSERT_EQ(result.surroundings.size(), 2u);
  EXPECT_EQ(result.surroundings[0].share, 1);
  Spectrum mixed;
  for (std::size_t w = 0; w < mixed.size(); ++w)
    mixed[w] = red[w] * lightness_under(light, red) + cyan[w] * lightness_under(light, cyan);
  expect_near(result.u, normalised_product(light, optics::cie_1931().y, mixed), 1e-12);
  spectral::settings(p).importance.geometry = true;
  EXPECT_EQ(importance_of(p).surroundings.size(), 1u);
}

// Two lines at equal distances in a white room: u at each is ybar times the watts that go towards the ball.
TEST(Importance, AddsLightsByThePowerTheySendTowardsTheGlass) {
  preset::Preset p = ball_in_a_room(white());
  p.scene.lights = {lamp(line(500), 3), lamp(line(600), 1), lamp(line(450), 0)};
  const Spectrum& eye = optics::cie_1931().y;
  Spectrum u = importance_of(p).u;
  EXPECT_NEAR(u[120] / u[220], 3 * eye[120] / eye[220], 1e-9);
  EXPECT_EQ(u[70], 0);
  // A spot puts the same watts into a cone of 60 degrees, a quarter of the sphere, and the ball is in it.
  p.scene.lights[1].type = preset::Light::Type::spot;
  p.scene.lights[1].direction = {-0.3, -1.5, -0.2};
  p.scene.lights[1].half_angle_deg = 60;
  u = importance_of(p).u;
  EXPECT_NEAR(u[120] / u[220], 3 * eye[120] / (4 * eye[220]), 1e-6);
  p.scene.lights[1].direction = {0, 1, 0}; // away from the ball
  EXPECT_EQ(importance_of(p).u[220], 0);
}

// Radziszewski, Boryczko and Alda 2009, as the thesis gives it: cosh(0.0072 x 158) = 1.71993.
TEST(Importance, OfRadziszewskiIsFixed) {
  preset::Preset p = ball_in_a_room(patch("blue"));
  spectral::settings(p).effort = Effort::radziszewski;
  const WavelengthImportance result = importance_of(p);
  EXPECT_TRUE(result.surroundings.empty());
  EXPECT_EQ(result.u[538 - 380], 1);
  EXPECT_NEAR(result.u[0], 0.338048, 1e-6);
  EXPECT_NEAR(result.u[450 - 380], 0.685810, 1e-6);
  EXPECT_NEAR(result.u[400], 0.115452, 1e-6);
  for (int d = 1; d <= 158; ++d)
    EXPECT_NEAR(result.u[static_cast<std::size_t>(158 - d)], result.u[static_cast<std::size_t>(158 + d)], 1e-12);
}

TEST(Importance, OfOtherEffortsNeedsNoSurroundings) {
  preset::Preset p = ball_in_a_room(white(0));
  const Spectrum light = optics::illuminant("F2");
  const optics::ColourMatching& eye = optics::cie_1931();
  Spectrum all;
  for (std::size_t w = 0; w < all.size(); ++w) all[w] = eye.x[w] + eye.y[w] + eye.z[w];
  for (const Effort effort : {Effort::automatic, Effort::power, Effort::variance}) {
    spectral::settings(p).effort = effort;
    expect_near(importance_of(p).u, normalised_product(light, all), 1e-12);
  }
  for (const Effort effort : {Effort::equal, Effort::random}) {
    spectral::settings(p).effort = effort;
    EXPECT_THAT(importance_of(p).u, Each(1));
  }
}

std::string refusal_of_importance(const preset::Preset& p) {
  return refusal_of([&] { importance_of(p); });
}

TEST(Importance, ThatIsZeroEverywhereIsRefusedWithTheReason) {
  preset::Preset p = ball_in_a_room(white(0));
  EXPECT_THAT(refusal_of_importance(p),
              StartsWith("p.json#/spectral/effort: the importance (4.15) is 0 at every wavelength: "));
  EXPECT_THAT(refusal_of_importance(p),
              HasSubstr("nothing around the caustic objects reflects a wavelength that the lights have"));
  p = ball_in_a_room(white());
  p.scene.lights[0].power_w = 0;
  EXPECT_THAT(refusal_of_importance(p), HasSubstr("no light sends power towards the caustic objects"));
  p.scene.lights.clear();
  EXPECT_THAT(refusal_of_importance(p), HasSubstr("no light sends power"));
  p = ball_in_a_room(white());
  p.scene.objects.erase(p.scene.objects.begin());
  EXPECT_THAT(refusal_of_importance(p), HasSubstr("the caustic objects see nothing that diffuses or mirrors light"));
  spectral::settings(p).importance.geometry = false;
  EXPECT_THAT(refusal_of_importance(p), HasSubstr("no object diffuses or mirrors light"));
  p = ball_in_a_room(white());
  p.scene.objects.pop_back();
  EXPECT_THAT(refusal_of_importance(p), HasSubstr("no object is of glass or a mirror"));
  // A wall that reflects red alone under a light that has none of it.
  preset::Material red = white();
  red.reflectance.type = preset::Reflectance::Type::table;
  red.reflectance.table = {{599, 0}, {600, 1}};
  p = ball_in_a_room(red);
  p.scene.lights = {lamp(line(500))};
  EXPECT_THAT(refusal_of_importance(p), HasSubstr("reflects a wavelength that the lights have"));
}

TEST(Importance, OfAClusterIsTheLargestOrTheMean) {
  Spectrum u{};
  u[3] = 0.25, u[4] = 1, u[5] = 0.5;
  const std::vector<std::vector<int>> clusters{{3, 4, 5, 6}, {0}, {5, 3}};
  using Cluster = photons::Importance::Cluster;
  EXPECT_THAT(photons::cluster_importance(u, clusters, Cluster::maximum), ElementsAre(1, 0, 0.5));
  EXPECT_THAT(photons::cluster_importance(u, clusters, Cluster::mean), ElementsAre(0.4375, 0, 0.375));
}

// ceil(u N), and never two turns in one pass, so that sppm can take them as the passes go by.
TEST(Iterations, GrowByAtMostOneAPass) {
  EXPECT_EQ(photons::iterations(0, 1000), 0);
  EXPECT_EQ(photons::iterations(1e-9, 1), 1);
  EXPECT_EQ(photons::iterations(0.5, 3), 2);
  EXPECT_EQ(photons::iterations(1, preset::max_passes), preset::max_passes);
  for (int i = 0; i <= 1000; ++i) {
    const double u = i == 1000 ? std::nextafter(1.0, 0.0) : std::pow(i / 999.0, 3);
    std::int64_t before = photons::iterations(u, 0);
    EXPECT_EQ(before, 0);
    for (std::int64_t p = 1; p <= 3000; ++p) {
      const std::int64_t now = photons::iterations(u, p);
      ASSERT_TRUE(now == before || now == before + 1) << u << " " << p;
      ASSERT_GE(static_cast<double>(now), u * static_cast<double>(p));
      before = now;
    }
  }
}

} // namespace nephroid::importance_test
