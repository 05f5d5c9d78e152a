// SPDX-License-Identifier: Apache-2.0
// The white furnace: where the same radiance L comes from everywhere, nothing that takes no light can be seen, because
// radiance is kept along a ray: Fresnel's two parts of it add up to one, and n^2 goes in and comes out.
//
// Six area lights, the faces of a cube, shine inwards, or an environment of one colour does. A small diffuse receiver
// inside gets pi L and sends rho L back. Glass or a mirror above hides a part of the lights (the direct layer gets
// darker) and sends as much (the caustic layer): the sum stays rho L. One thing is missing: a way from the receiver
// through the glass and back to it should end at the receiver's own radiance, which neither layer has (that is
// interreflection). Its share r is measured apart: an area light in the receiver's place, and what comes back to it. So
// direct + caustic = rho L (1 - r).
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::white_furnace_test {

constexpr double cube = 3, receiver_side = 0.4, reflectance = 0.7, radiance = 1;
constexpr int groups = 6, group = 4; // pixels are looked at in squares of 4 x 4, of which there are 6 x 6
const Screen receiver_view{{0, -0.75, 0}, receiver_side, groups* group};

preset::Light area_light(const preset::Vec3& position, const preset::Vec3& direction, double side) {
  return {.type = preset::Light::Type::area,
          .spectrum = line(550),
          .power_w = radiance * M_PI * side * side,
          .position = position,
          .direction = direction,
          .size = {side, side},
          .up = {direction[1], direction[2], direction[0]}};
}

preset::Preset furnace(const std::vector<preset::Object>& things) {
  preset::Preset p = empty_preset();
  p.scene.materials["receiver"] = white(reflectance);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["dense"] = glass(2.4);
  p.scene.materials["air"] = glass(1);
  p.scene.materials["flint"] = glass(1);
  p.scene.materials["flint"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["flint"].dispersion.file = "N-SF66.yml";
  p.scene.materials["flint"].absorption = false;
  p.scene.materials["mirror"] = check::mirror(1);
  p.scene.objects = things;
  p.scene.objects.push_back(
      object("receiver", quad(receiver_side, receiver_side), "receiver", at(receiver_view.centre)));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      preset::Vec3 position{0, 0, 0}, direction{0, 0, 0};
      position[static_cast<std::size_t>(axis)] = side * cube / 2;
      direction[static_cast<std::size_t>(axis)] = -side;
      p.scene.lights.push_back(area_light(position, direction, cube));
    }
  receiver_view.fill(p.scene.camera, 0.1);
  spectral::settings(p).direct = true;
  spectral::settings(p).photons_per_pass = 1 << 15;
  spectral::settings(p).max_surfaces = 400;
  p.stop.passes = 32;
  return p;
}

/// r, as a mean over the receiver.
double returning_share(preset::Preset p) {
  preset::Vec3 above = receiver_view.centre;
  above[1] += 1e-4;
  p.scene.lights = {area_light(above, {0, 1, 0}, receiver_side)};
  spectral::settings(p).direct = false;
  p.stop.passes = 4;
  return photons::energy_of(render(p)).deposited_w / p.scene.lights[0].power_w;
}

preset::Object ball(const std::string& name, double radius, const std::string& material, double x,
                    preset::Object::Normals normals, int priority = 0) {
  preset::Shape shape;
  shape.radius = radius;
  preset::Object o = object(name, shape, material, at({x, 0, 0}));
  o.normals = normals;
  o.priority = priority;
  return o;
}

struct Furnace {
  const char* name;
  std::vector<preset::Object> things;
  bool sky = false; ///< an environment instead of area lights
};

/// White, so that all luminance is that of its radiance.
void put_under_a_sky(preset::Preset& p) {
  p.scene.lights.clear();
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->radiance = radiance;
  p.scene.environment->lights = true;
}

std::vector<Furnace> furnaces() {
  using enum preset::Object::Normals;
  preset::Shape stone;
  stone.type = preset::Shape::Type::brilliant;
  stone.radius = 0.5;
  return {{"glass_ball", {ball("ball", 0.5, "glass", 0, smooth)}},
          {"diamond", {object("stone", stone, "dense", at({0, 0, 0}, {30, 10, 0}))}},
          {"nested",
           {ball("ball", 0.5, "glass", 0, smooth), ball("core", 0.2, "dense", 0.2, faceted, 1),
            ball("bubble", 0.15, "air", -0.2, smooth, 2)}},
          {"mirror", {ball("ball", 0.4, "mirror", 0, smooth)}},
          {"glass_ball_under_a_sky", {ball("ball", 0.5, "glass", 0, smooth)}, true},
          {"dispersing_ball_under_a_sky", {ball("ball", 0.5, "flint", 0, smooth)}, true},
          {"plate_under_a_sky", {object("plate", box(1.2, 0.2, 1.2), "glass")}, true},
          {"mirror_under_a_sky", {ball("ball", 0.4, "mirror", 0, smooth)}, true}};
}

class WhiteFurnace : public testing::TestWithParam<Furnace> {};

TEST_P(WhiteFurnace, NothingInItCanBeSeen) {
  preset::Preset p = furnace(GetParam().things);
  const double of_a_watt = GetParam().sky ? 1 : optics::to_xyz(spectrum_of(p.scene.lights[0]))[1],
               r = returning_share(p);
  const double truth = reflectance * radiance * of_a_watt;
  if (GetParam().sky) put_under_a_sky(p);
  EXPECT_LT(r, 0.04);
  photons::EnergyBalance energy;
  constexpr std::size_t squares = groups * groups;
  const std::vector<Estimate> estimates = render_passes(p, [&](const job::Snapshot& snapshot) {
    energy = photons::energy_of(snapshot);
    std::vector<double> figures(squares + 2, 0.0); // the squares, their mean, the mean of the direct layer
    const std::vector<double> direct = luminance(layer(snapshot, "direct")),
                              caustic = luminance(layer(snapshot, "caustic"));
    for (std::size_t i = 0; i < receiver_view.count(); ++i) {
      const std::size_t wide = groups * group, square = i / wide / group * groups + i % wide / group;
      const double sum = (direct[i] + caustic[i]) / truth;
      figures[square] += sum / (group * group);
      figures[squares] += sum / static_cast<double>(receiver_view.count());
      figures[squares + 1] += direct[i] / truth / static_cast<double>(receiver_view.count());
    }
    return figures;
  });
  // What is lost after 400 interfaces is missing from the caustic layer; r's own noise is some percent of it.
  const double lost = energy.emitted_w > 0 ? energy.lost_w / energy.emitted_w : 0, slack = lost + 0.03 * r;
  EXPECT_LT(lost, 1e-3);
  const Estimate& mean = estimates[squares];
  const std::string name = std::string("white furnace, ") + GetParam().name;
  expect_truth(name + ": mean radiance / (rho L (1 - r))", mean.mean / (1 - r), 1, tolerance(mean) + slack);
  record(name + ": share r that would come back, of it", r, 0, 0.04);
  record(name + ": of the radiance, the direct layer has", estimates[squares + 1].mean, 1, 1);
  EXPECT_LT(estimates[squares + 1].mean, 0.9); // the thing hides a good part of the lights
  double smallest = 1, z2 = 0;
  for (std::size_t i = 0; i < squares; ++i) { // r differs from place to place
    smallest = std::min(smallest, p_value(estimates[i], 1 - r, r + lost));
    z2 += std::pow(estimates[i].mean - (1 - r), 2) / estimates[i].variance / squares;
  }
  EXPECT_GT(sidak(smallest, squares), false_alarm);
  record(name + ": mean z^2 of squares", z2, 1, 2);
}

INSTANTIATE_TEST_SUITE_P(Things, WhiteFurnace, testing::ValuesIn(furnaces()),
                         [](const testing::TestParamInfo<Furnace>& parameter) {
                           return std::string(parameter.param.name);
                         });

// Helmholtz' reciprocity: light finds its way back. A patch A of radiance L sends to a patch B the power L G / n_A^2,
// where G is the sum over all ways between them of n^2 dA cos(theta) d(omega) times what Fresnel and absorption leave;
// that quantity is the same at both ends of a way and in both directions (Nicodemus 1963, "Radiance"). So swapping
// light and receiver gives the same power per radiance, but for the n^2 of the media that they are in; and paths from
// the eye find the radiance that photons carry.

/// A rectangle that shines or receives: u and v are its full edges' lengths, `up` runs along v.
struct Patch {
  preset::Vec3 centre, normal, up;
  double u, v;
  preset::Vec3 rotate_deg; // turns a quad that faces +y to face along normal, with its z along up
};

preset::Light shining(const Patch& patch) {
  preset::Light light;
  light.type = preset::Light::Type::area;
  light.spectrum = line(550);
  light.position = patch.centre;
  for (std::size_t i = 0; i < 3; ++i) light.position[i] += 1e-4 * patch.normal[i];
  light.direction = patch.normal;
  light.up = patch.up;
  light.size = {patch.u, patch.v};
  light.power_w = M_PI * patch.u * patch.v; // radiance 1
  return light;
}

/// The power that patch `to`, square, gets on its front from patch `from`, of radiance 1. Both are there as opaque
/// surfaces.
Estimate transfer(preset::Preset p, const Patch& from, const Patch& to, double camera_distance) {
  p.scene.lights = {shining(from)};
  for (const Patch* patch : {&from, &to})
    p.scene.objects.push_back(object("patch", quad(patch->u, patch->v), "white", at(patch->centre, patch->rotate_deg)));
  p.scene.objects.back().name = "other patch";
  const Screen screen{to.centre, to.u, 4};
  screen.fill(p.scene.camera, camera_distance);
  for (std::size_t i = 0; i < 3; ++i) p.scene.camera.position[i] = to.centre[i] + camera_distance * to.normal[i];
  p.scene.camera.up = to.up;
  return render_passes(p, [&](const job::Snapshot& snapshot) {
    const std::vector<double> power = watts(snapshot, "caustic", screen, spectrum_of(p.scene.lights[0]));
    return std::vector{std::accumulate(power.begin(), power.end(), 0.0)};
  })[0];
}

preset::Preset glass_between() {
  preset::Preset p = empty_preset();
  p.scene.materials["white"] = white();
  spectral::settings(p).photons_per_pass = 1 << 15;
  spectral::settings(p).max_surfaces = 200;
  p.stop.passes = 64;
  return p;
}

/// figure / other * factor = 1, within the noise of both.
void expect_equal(const std::string& what, const Estimate& figure, const Estimate& other, double factor,
                  double bias = 0) {
  Estimate ratio = figure;
  ratio.mean = figure.mean / other.mean * factor;
  ratio.variance =
      std::pow(ratio.mean, 2) * (figure.variance / std::pow(figure.mean, 2) + other.variance / std::pow(other.mean, 2));
  expect_truth(what, ratio.mean, 1, tolerance(ratio) + bias);
  EXPECT_LT(tolerance(ratio), 0.1) << what;
}

// A faceted stone of absorbing glass between a small patch beside it and a larger one below: nothing is symmetric here.
TEST(Reciprocity, LightAndReceiverMayChangePlaces) {
  const TemporaryFolder folder;
  preset::Preset p = glass_between();
  p.scene.materials["glass"] = glass(1.7);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file =
      write_constant_nk(folder.path() / "glass.yml", 1.7, 0.5 * 550e-9 / (4 * M_PI)); // 0.5 / m
  preset::Shape stone;
  stone.type = preset::Shape::Type::brilliant;
  stone.radius = 0.5;
  p.scene.objects = {object("stone", stone, "glass", at({0, 0, 0}, {35, 20, 0}))};
  const Patch beside{{0.7, 0, 0}, {-1, 0, 0}, {0, 0, 1}, 0.5, 0.5, {0, 0, 90}},
      below{{0, -0.8, 0}, {0, 1, 0}, {0, 0, 1}, 0.8, 0.8, {0, 0, 0}};
  expect_equal("reciprocity: transfer through a stone, there and back", transfer(p, beside, below, 0.1),
               transfer(p, below, beside, 0.1), 1);
}

// One patch inside a block of glass: into the glass goes n^2 times what comes out of it per radiance.
TEST(Reciprocity, InsideGlassRadianceCountsOverTheSquareOfTheIndex) {
  constexpr double n = 1.8;
  preset::Preset p = glass_between();
  p.scene.materials["glass"] = glass(n);
  p.scene.objects = {object("block", box(2, 1, 2), "glass", at({0, -0.5, 0}))};
  const Patch inside{{0, -0.6, 0}, {0, 1, 0}, {0, 0, 1}, 0.5, 0.5, {0, 0, 0}},
      above{{0.2, 0.5, 0}, {0, -1, 0}, {0, 0, 1}, 0.6, 0.6, {180, 0, 0}};
  expect_equal("reciprocity: into glass over out of it, times 1 / n^2", transfer(p, above, inside, 0.2),
               transfer(p, inside, above, 0.2), 1 / (n * n));
}

/// The irradiance at a point that faces +y from what a camera there sees within 38 degrees each way: of a pixel
/// cos(theta) d(omega) is cos^4(theta) times its area on the plane at distance 1.
Estimate seen_irradiance(preset::Preset p, const preset::Vec3& from) {
  const Screen view{{0, 0, 0}, 2 * std::tan(38 * degree), 48}; // on the plane at distance 1
  view.fill(p.scene.camera, 1);
  p.scene.camera.position = from;
  p.scene.camera.target = {from[0], from[1] + 1, from[2]};
  return render_passes(p, [&](const job::Snapshot& snapshot) {
    const std::vector<double> y = luminance(layer(snapshot, "direct"));
    double irradiance = 0;
    for (int row = 0; row < view.pixels; ++row)
      for (int column = 0; column < view.pixels; ++column)
        irradiance += y[static_cast<std::size_t>(row * view.pixels + column)] * view.pixel_area() /
                      std::pow(1 + std::pow(view.x(column), 2) + std::pow(view.z(row), 2), 2);
    return std::vector{irradiance / optics::to_xyz(spectrum_of(p.scene.lights[0]))[1]};
  })[0];
}

// A receiver below glass and a patch of radiance L above, which see each other through the glass only. Photons: the
// patch is an area light. Eye: the patch is a diffuse surface in parallel light, which makes the same radiance, and a
// camera in the receiver's place looks at it through the glass; what it sees, times cos(theta) d(omega), is the
// irradiance there. Cameras stand on the places of Gauss' quadrature over the receiver.
TEST(Reciprocity, TheEyeSeesThroughGlassWhatPhotonsBring) {
  preset::Preset base = glass_between();
  base.scene.materials["glass"] = glass(1.6);
  preset::Shape ball;
  ball.radius = 0.5;
  const Patch patch{{0, 0.9, 0}, {0, -1, 0}, {0, 0, 1}, 0.5, 0.5, {180, 0, 0}};
  constexpr double side = 0.3;
  const preset::Vec3 receiver{0, -1, 0};
  for (const bool smooth : {true, false}) {
    preset::Preset photons = base;
    photons.scene.objects = {smooth ? object("ball", ball, "glass")
                                    : object("block", box(0.7, 0.5, 0.7), "glass", at({0, 0, 0}, {15, 0, 20}))};
    photons.scene.objects[0].normals = smooth ? preset::Object::Normals::smooth : preset::Object::Normals::faceted;
    preset::Preset eye = photons;
    const Estimate by_photons = transfer(photons, patch, {receiver, {0, 1, 0}, {0, 0, 1}, side, side, {0, 0, 0}}, 0.1);

    eye.scene.objects.push_back(object("patch", quad(patch.u, patch.v), "white", at(patch.centre, patch.rotate_deg)));
    eye.scene.lights = {parallel_light({1, 0.7, 0})}; // it passes the glass at 0.59 and more
    eye.scene.lights[0].irradiance_w_m2 = M_PI * std::hypot(1, 0.7) / 0.7;
    spectral::settings(eye).direct = true;
    spectral::settings(eye).caustic = false;
    eye.stop.passes = 4;
    constexpr std::array<double, 4> place{-0.8611363116, -0.3399810436, 0.3399810436, 0.8611363116},
        weight{0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226}; // Gauss and Legendre, of four points
    Estimate by_eye;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        eye.seed = base.seed + 4 * i + j;
        const Estimate one =
            seen_irradiance(eye, {receiver[0] + place[i] * side / 2, receiver[1], receiver[2] + place[j] * side / 2});
        by_eye.mean += one.mean * side * side * weight[i] * weight[j];
        by_eye.variance += one.variance * std::pow(side * side * weight[i] * weight[j], 2);
        by_eye.degrees += one.degrees;
      }
    // What the quadrature may be off by where a facet's image ends on the receiver.
    expect_equal(std::string("reciprocity: photons over eye paths, through a ") +
                     (smooth ? "smooth ball" : "faceted block"),
                 by_photons, by_eye, 1, 0.005);
  }
}

} // namespace nephroid::white_furnace_test
