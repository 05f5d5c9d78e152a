// SPDX-License-Identifier: Apache-2.0
// Lamps with photometry, meshes that shine and rectangles with a picture, against closed forms: what reaches a floor
// from them, by direct light, by photons and by tiles, and how much they send in all.
#include "image/image.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace nephroid::lamps_test {

using photons::Settings;
using Type = preset::Light::Type;

/// How the light is worked out.
enum class By { direct, photons, tiles };

std::string name_of(const testing::TestParamInfo<By>& parameter) {
  static const char* const names[] = {"direct", "photons", "tiles"};
  return names[static_cast<int>(parameter.param)];
}

/// The floor y = 0, of reflectance 1, about (0, 0), a square of 1 m of it; below a sheet of n = 1 for photons.
preset::Preset floor_below(const preset::Light& lamp, By by) {
  preset::Preset p = empty_preset(16);
  p.scene.materials = {{"white", white()}, {"black", white(0)}, {"nothing", glass(1)}};
  p.scene.objects = {object("floor", quad(10, 10), "white")};
  if (by != By::direct)
    for (const double x : {-2.0, 2.0}) // two targets
      p.scene.objects.push_back(object(fmt::format("sheet {}", x), box(4, 0.01, 8), "nothing", at({x, 0.6, 0})));
  p.scene.lights = {lamp};
  p.scene.camera = {.position = {0, 0.5, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .fov_deg = 90};
  p.scene.camera.resolution = {16, 16};
  Settings& s = spectral::settings(p);
  s.direct = by == By::direct;
  s.caustic = by != By::direct;
  if (by == By::tiles) s.estimator = Settings::Estimator::tiles;
  s.photons_per_pass = 1 << 19;
  p.stop.passes = by == By::direct ? 512 : 8;
  return p;
}

/// Irradiance of the floor at the middle of each pixel, of the light's 1 W of 550 nm.
template <class Irradiance>
std::vector<double> floor_of(const Irradiance& irradiance) {
  const double y = optics::to_xyz(spectrum_of({.spectrum = line(550)}))[1] / M_PI;
  std::vector<double> picture;
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 16; ++column)
      picture.push_back(irradiance((column + 0.5) / 16 - 0.5, (row + 0.5) / 16 - 0.5) * y);
  return picture;
}

std::vector<double> rendered(const preset::Preset& p) {
  return luminance(layer(render(p), spectral::settings(p).direct ? "direct" : "caustic"));
}

struct Ratio {
  double mean = 0, worst = 0;
};
Ratio ratio_of(const std::vector<double>& figure, const std::vector<double>& truth) {
  Ratio ratio;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ratio.mean += figure[i] / truth[i] / static_cast<double>(truth.size());
    ratio.worst = std::max(ratio.worst, std::abs(figure[i] / truth[i] - 1));
  }
  return ratio;
}

/// An IES file of type C. intensity: of gamma and C in radians; every 2 degrees of gamma to 180, every 10 of C.
template <class Intensity>
std::string ies(const Intensity& intensity) {
  constexpr double degree = M_PI / 180;
  std::string text = "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 1000 1 91 37 1 2 0 0 0\n1 1 10\n";
  for (int g = 0; g <= 180; g += 2) text += fmt::format("{}{}", g, g % 20 == 18 ? '\n' : ' ');
  for (int c = 0; c <= 360; c += 10) text += fmt::format("{}{}", c, c == 360 ? '\n' : ' ');
  for (int c = 0; c <= 360; c += 10)
    for (int g = 0; g <= 180; g += 2)
      text += fmt::format("{:.9g}{}", intensity(g * degree, c * degree), g == 180 ? '\n' : ' ');
  return text;
}

preset::Light lamp_of(const std::string& file) {
  preset::Light lamp{.spectrum = line(550), .power_w = 5, .position = {0.1, 1, -0.2}};
  lamp.photometry = file;
  return lamp;
}

class Lamps : public testing::TestWithParam<By> {};
INSTANTIATE_TEST_SUITE_P(By, Lamps, testing::Values(By::direct, By::photons, By::tiles), name_of);

/// Of the light, for photons' noise: 4 * 10^6 photons of a lamp a meter above 100 m^2 are some 5000 a pixel.
double worst_of(By by) { return by == By::direct ? 0.02 : 0.15; }

// A lamp of intensity cos^3 has P 4 cos^3(gamma) / (2 pi) W/sr. The file's lines between two angles are off by 1e-3.
TEST_P(Lamps, CosinesOfAFile) {
  const TemporaryFolder folder;
  preset::Light lamp = lamp_of(
      folder.write("cos3.ies", ies([](double gamma, double) { return std::pow(std::max(std::cos(gamma), 0.0), 3); })));
  const glm::dvec3 down = glm::normalize(glm::dvec3(0.3, -1, 0.2));
  lamp.direction = {0.6, -2, 0.4};
  const std::vector<double> truth = floor_of([&](double x, double z) {
    const glm::dvec3 way = glm::dvec3(x, 0, z) - glm::dvec3(0.1, 1, -0.2);
    const double d = glm::length(way), cosine = glm::dot(way, down) / d;
    return 5 * 4 * std::pow(cosine, 3) / (2 * M_PI) / (d * d * d);
  });
  const Ratio r = ratio_of(rendered(floor_below(lamp, GetParam())), truth);
  expect_truth("photometry: light of cos^3 over its closed form", r.mean, 1, GetParam() == By::direct ? 3e-3 : 0.01);
  EXPECT_LT(r.worst, worst_of(GetParam()));
}

// 1 + sin(C) / 2 sends most at C = 90 degrees, counterclockwise from `up` seen from above: from +z by way of +x.
TEST_P(Lamps, PlanesOfAFileTurnCounterclockwise) {
  const TemporaryFolder folder;
  preset::Light lamp = lamp_of(folder.write("turned.ies", ies([](double, double c) { return 1 + 0.5 * std::sin(c); })));
  lamp.position = {0.01, 0.8, 0.01};
  const std::vector<double> truth = floor_of([&](double x, double z) {
    const double aside = std::hypot(x - 0.01, z - 0.01), d = std::hypot(aside, 0.8);
    return 5 / (4 * M_PI) * (1 + 0.5 * (x - 0.01) / aside) * 0.8 / (d * d * d);
  });
  std::vector<double> picture = rendered(floor_below(lamp, GetParam())), smooth_truth, smooth;
  for (std::size_t i = 0; i < truth.size(); ++i) // about the middle the truth jumps within a pixel
    if (const std::size_t row = i / 16, column = i % 16; row < 6 || row > 9 || column < 6 || column > 9)
      smooth_truth.push_back(truth[i]), smooth.push_back(picture[i]);
  const Ratio r = ratio_of(smooth, smooth_truth);
  expect_truth("photometry: light of 1 + sin(C) / 2 over its closed form", r.mean, 1, 0.01);
  EXPECT_LT(r.worst, worst_of(GetParam()));
}

/// A panel of 0.5 m by 0.3 m, 0.9 m above the floor and tilted.
preset::Light panel() {
  return {.type = Type::area,
          .spectrum = line(550),
          .power_w = 5,
          .position = {0.1, 0.9, -0.1},
          .direction = {0, -std::cos(0.5), std::sin(0.5)},
          .size = {0.5, 0.3},
          .up = {0, std::sin(0.5), std::cos(0.5)}};
}

/// The light of an object, which is black.
preset::Preset floor_below_mesh(preset::Object shining, By by) {
  preset::Light lamp{.type = Type::mesh, .spectrum = line(550), .power_w = 5};
  lamp.object = shining.name = "shining";
  shining.material = "black";
  preset::Preset p = floor_below(lamp, by);
  p.scene.objects.push_back(shining);
  return p;
}

// The two triangles of a rectangle that shine are the area light in its place.
TEST_P(Lamps, ARectangleOfTrianglesIsAnAreaLight) {
  preset::Object rectangle = object("", quad(0.5, 0.3), "");
  rectangle.transform = at({0.1, 0.9, -0.1}, {180 - 0.5 * 180 / M_PI, 0, 0});
  preset::Preset truth = floor_below(panel(), By::direct);
  truth.stop.passes = 4096;
  const Ratio r = ratio_of(rendered(floor_below_mesh(rectangle, GetParam())), rendered(truth));
  expect_truth("mesh light: two triangles over an area light", r.mean, 1, 0.01);
  EXPECT_LT(r.worst, worst_of(GetParam()) + 0.02);
}

// A Lambertian sphere lights what sees all of it as a point in its centre.
TEST_P(Lamps, ASphereIsAPoint) {
  const std::vector<double> truth = floor_of([&](double x, double z) {
    const double d = std::hypot(x - 0.1, 0.9, z + 0.1);
    return 5 / (4 * M_PI) * 0.9 / (d * d * d);
  });
  preset::Preset p = floor_below_mesh(object("", check::ball(0.2), "", at({0.1, 0.9, -0.1})), GetParam());
  if (GetParam() == By::direct) p.stop.passes = 8192;
  const Ratio r = ratio_of(rendered(p), truth);
  // Tiles have some 700 places on it, of which half look away.
  expect_truth("mesh light: a sphere over a point", r.mean, 1, GetParam() == By::tiles ? 0.03 : 0.01);
  EXPECT_LT(r.worst, worst_of(GetParam()) + 0.1); // some 5 % of noise in direct light
}

// What shines sends its light from its surface, whatever that is of.
TEST(MeshLight, OfGlassShinesAsABlackOneDoes) {
  preset::Preset p = floor_below_mesh(object("", check::ball(0.2), "", at({0.1, 0.9, -0.1})), By::direct);
  p.stop.passes = 1024;
  const std::vector<double> black = rendered(p);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects.back().material = "glass";
  expect_truth("mesh light: a ball of glass over a black one", ratio_of(rendered(p), black).mean, 1, 0.01);
}

// A rectangle of which the lower half of its picture is black is an area light of its upper half.
TEST_P(Lamps, APictureShinesWhereItIsBright) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "half.png";
  std::vector<float> rgb;
  for (int row = 0; row < 4; ++row)
    for (int k = 0; k < 9; ++k) rgb.push_back(row < 2 ? 0.5f : 0.0f);
  image::write_png(file, 3, 4, rgb);
  preset::Light with_picture = panel(), half = panel();
  with_picture.picture = file.string();
  half.size[1] /= 2;
  for (std::size_t axis = 0; axis < 3; ++axis) half.position[axis] += half.up[axis] * 0.3 / 4;
  preset::Preset truth = floor_below(half, By::direct);
  truth.stop.passes = 4096;
  const Ratio r = ratio_of(rendered(floor_below(with_picture, GetParam())), rendered(truth));
  expect_truth("picture of a light: a white half over an area light", r.mean, 1, 0.01);
  EXPECT_LT(r.worst, worst_of(GetParam()) + 0.02);
}

// A ball of n = 1 about what shines catches all of it: the power is that of the preset, whatever the shape.
TEST(MeshLight, SendsItsPower) {
  const TemporaryFolder folder;
  preset::Object tetrahedron;
  tetrahedron.mesh = folder.write("t.obj", "v 0 0 0\nv 0.4 0 0\nv 0 0.3 0\nv 0 0 0.9\n"
                                           "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  preset::Object ellipsoid = object("", check::ball(0.3), "");
  ellipsoid.transform.scale = {1, 0.2, 2.5};
  for (const preset::Object& shining : {tetrahedron, ellipsoid}) {
    preset::Preset p = floor_below_mesh(shining, By::photons);
    p.scene.objects.erase(p.scene.objects.begin(), p.scene.objects.begin() + 3); // the floor and the sheets
    p.scene.objects.push_back(object("around", check::ball(2), "nothing"));
    const photons::EnergyBalance energy = photons::energy_of(render(p));
    expect_truth("mesh light: W of 5 W that it sends", energy.emitted_w, 5, 0.02);
    expect_truth("mesh light: W of 5 W that a convex body catches itself", energy.missed_w, 0, 1e-3);
  }
}

// A ball of 0.5 m that shines with 5 W has the radiance 5 / (pi 4 pi 0.5^2): in the middle of the picture, seen past
// nothing, through a pane, in a mirror, and in a frosted mirror, where highlights have it and what paths meet must not
// add to them. A lamp of plastic, polished or rough, is as bright less what its coat reflects, 4 % straight on.
TEST(Lamps, AreSeen) {
  const double y = optics::to_xyz(spectrum_of({.spectrum = line(550)}))[1], radiance = 5 * y / (M_PI * M_PI);
  const auto seen = [&](const preset::Material* between, const preset::Material& lamp = white(0)) {
    preset::Preset p = empty_preset(16);
    p.scene.materials = {{"black", lamp}};
    p.scene.objects = {object("ball", check::ball(0.5), "black", at({0, 2, 0}))};
    p.scene.lights = {{.type = Type::mesh, .spectrum = line(550), .power_w = 5, .object = "ball"}};
    p.scene.camera = {.position = {0, 0, 0}, .target = {0, 1, 0}, .up = {0, 0, -1}, .fov_deg = 5};
    p.scene.camera.resolution = {16, 16};
    if (between) {
      p.scene.materials["between"] = *between;
      const bool is_pane = between->type == preset::Material::Type::dielectric;
      p.scene.objects.push_back(object("between", quad(20, 20), "between", at({0, is_pane ? 1.0 : -1.0, 0})));
      if (!is_pane) p.scene.camera.target = {0, -1, 0};
      if (!is_pane) p.scene.camera.fov_deg = 2;
    }
    spectral::settings(p).direct = true;
    p.stop.passes = 256;
    if (between && between->roughness > 0) { // a place of the lamp is seldom where a facet shows it
      p.scene.camera.resolution = {64, 64};
      spectral::settings(p).pixel_samples = 256;
    }
    const std::vector<double> picture = luminance(layer(render(p), "direct"));
    return std::accumulate(picture.begin(), picture.end(), 0.0) / static_cast<double>(picture.size()) / radiance;
  };
  expect_truth("a ball that shines, its radiance seen directly", seen(nullptr), 1, 1e-5);
  preset::Material pane = glass(1.5);
  pane.thin = true;
  expect_truth("the same through a pane, (1 - R) / (1 + R)", seen(&pane), 0.96 / 1.04, 0.01);
  preset::Material mirror{.type = preset::Material::Type::mirror};
  mirror.reflectance.value = 0.8;
  expect_truth("the same in a mirror", seen(&mirror), 0.8, 1e-5);
  mirror.roughness = 0.1; // facets within some degrees, of a ball of 19
  expect_truth("the same in a frosted mirror", seen(&mirror), 0.8, 0.02);
  preset::Material plastic{.type = preset::Material::Type::plastic};
  plastic.reflectance.value = 0;
  expect_truth("a ball of plastic, seen directly", seen(nullptr, plastic), 0.96, 1e-3);
  expect_truth("the same in a frosted mirror", seen(&mirror, plastic), 0.8 * 0.96, 0.02);
  mirror.roughness = 0;
  plastic.roughness = 0.3;
  expect_truth("a ball of rough plastic in a polished mirror", seen(&mirror, plastic), 0.8 * 0.96, 0.02);
}

// Kernels made for a scene, with other lights beside, make what general kernels make.
TEST(Lamps, KernelsOfTheirOwnMakeTheSamePicture) {
  const TemporaryFolder folder;
  preset::Preset p = floor_below_mesh(object("", check::box(0.1, 0.1, 0.1), "", at({0.3, 0.4, 0.1})), By::direct);
  p.scene.lights.push_back(lamp_of(folder.write("even.ies", ies([](double, double) { return 2.0; }))));
  p.stop.passes = 4;
  EXPECT_EQ(layer(render(p), "direct").rgb,
            layer(render(*specialised_job_of(p, tracing::LeaveOut{.all = true})), "direct").rgb);
}

} // namespace nephroid::lamps_test
