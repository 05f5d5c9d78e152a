// SPDX-License-Identifier: Apache-2.0
// The white furnace: where the same radiance L comes from everywhere, nothing that takes no light can be seen, because radiance is kept
// along a ray: Fresnel's two parts of it add up to one, and n^2 goes in and comes out.
//
// Six area lights, the faces of a cube, shine inwards, or an environment of one colour does. A small diffuse receiver inside gets pi L and
// sends rho L back. Glass or a mirror above hides a part of the lights (the direct layer gets darker) and sends as much (the caustic
// layer): the sum stays rho L. One thing is missing: a way from the receiver through the glass and back to it should end at the receiver's
// own radiance, which neither layer has (that is interreflection). Its share r is measured apart: an area light in the receiver's place,
// and what comes back to it. So direct + caustic = rho L (1 - r).
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::white_furnace_test {

constexpr double cube = 3, receiver_side = 0.4, reflectance = 0.7, radiance = 1;
constexpr int groups = 6, group = 4; // pixels are looked at in squares of 4 x 4, of which there are 6 x 6
const Screen screen{{0, -0.75, 0}, receiver_side, groups* group};

preset::Light area_light(const preset::Vec3& position, const preset::Vec3& direction, double side)
{
  preset::Light light;
  light.type = preset::Light::Type::area;
  light.spectrum = line(550);
  light.position = position;
  light.direction = direction;
  light.up = {direction[1], direction[2], direction[0]};
  light.size = {side, side};
  light.power_w = radiance * M_PI * side * side;
  return light;
}

preset::Preset furnace(const std::vector<preset::Object>& things)
{
  preset::Preset p = empty_preset();
  p.scene.materials["receiver"] = white(reflectance);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["dense"] = glass(2.4);
  p.scene.materials["air"] = glass(1);
  p.scene.materials["flint"] = glass(1);
  p.scene.materials["flint"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["flint"].dispersion.file = "N-SF66.yml";
  p.scene.materials["flint"].absorption = false;
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["mirror"].reflectance.value = 1;
  p.scene.objects = things;
  p.scene.objects.push_back(object("receiver", quad(receiver_side, receiver_side), "receiver", at(screen.centre)));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      preset::Vec3 position{0, 0, 0}, direction{0, 0, 0};
      position[static_cast<std::size_t>(axis)] = side * cube / 2;
      direction[static_cast<std::size_t>(axis)] = -side;
      p.scene.lights.push_back(area_light(position, direction, cube));
    }
  screen.fill(p.scene.camera, 0.1);
  spectral::settings(p).direct = true;
  spectral::settings(p).photons_per_pass = 1 << 15;
  spectral::settings(p).max_surfaces = 400;
  p.stop.passes = 64;
  return p;
}

/// r, as a mean over the receiver.
double returning_share(preset::Preset p)
{
  preset::Vec3 above = screen.centre;
  above[1] += 1e-4;
  p.scene.lights = {area_light(above, {0, 1, 0}, receiver_side)};
  spectral::settings(p).direct = false;
  p.stop.passes = 4;
  return spectral::energy_of(render(p)).deposited_w / p.scene.lights[0].power_w;
}

preset::Object ball(const std::string& name, double radius, const std::string& material, double x, preset::Object::Normals normals,
                    int priority = 0)
{
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
void put_under_a_sky(preset::Preset& p)
{
  p.scene.lights.clear();
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->radiance = radiance;
  p.scene.environment->lights = true;
}

std::vector<Furnace> furnaces()
{
  using enum preset::Object::Normals;
  preset::Shape stone;
  stone.type = preset::Shape::Type::brilliant;
  stone.radius = 0.5;
  return {
      {"glass_ball", {ball("ball", 0.5, "glass", 0, smooth)}},
      {"diamond", {object("stone", stone, "dense", at({0, 0, 0}, {30, 10, 0}))}},
      {"nested",
       {ball("ball", 0.5, "glass", 0, smooth), ball("core", 0.2, "dense", 0.2, faceted, 1), ball("bubble", 0.15, "air", -0.2, smooth, 2)}},
      {"mirror", {ball("ball", 0.4, "mirror", 0, smooth)}},
      {"glass_ball_under_a_sky", {ball("ball", 0.5, "glass", 0, smooth)}, true},
      {"dispersing_ball_under_a_sky", {ball("ball", 0.5, "flint", 0, smooth)}, true},
      {"plate_under_a_sky", {object("plate", box(1.2, 0.2, 1.2), "glass")}, true},
      {"mirror_under_a_sky", {ball("ball", 0.4, "mirror", 0, smooth)}, true}};
}

class WhiteFurnace : public testing::TestWithParam<Furnace> {};

TEST_P(WhiteFurnace, NothingInItCanBeSeen)
{
  preset::Preset p = furnace(GetParam().things);
  const double of_a_watt = GetParam().sky ? 1 : optics::to_xyz(spectrum_of(p.scene.lights[0]))[1], r = returning_share(p);
  const double truth = reflectance * radiance * of_a_watt;
  if (GetParam().sky) put_under_a_sky(p);
  EXPECT_LT(r, 0.04);
  spectral::EnergyBalance energy;
  constexpr std::size_t squares = groups * groups;
  const std::vector<Estimate> estimates = render_passes(p, [&](const job::Snapshot& snapshot) {
    energy = spectral::energy_of(snapshot);
    std::vector<double> figures(squares + 2, 0.0); // the squares, their mean, the mean of the direct layer
    const std::vector<double> direct = luminance(layer(snapshot, "direct")), caustic = luminance(layer(snapshot, "caustic"));
    for (std::size_t i = 0; i < screen.count(); ++i) {
      const std::size_t wide = groups * group, square = i / wide / group * groups + i % wide / group;
      const double sum = (direct[i] + caustic[i]) / truth;
      figures[square] += sum / (group * group);
      figures[squares] += sum / static_cast<double>(screen.count());
      figures[squares + 1] += direct[i] / truth / static_cast<double>(screen.count());
    }
    return figures;
  });
  // What is lost after 400 interfaces is missing from the caustic layer; r's own noise is some percent of it.
  const double lost = energy.lost_w / energy.emitted_w, slack = lost + 0.03 * r;
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
                         [](const testing::TestParamInfo<Furnace>& parameter) { return std::string(parameter.param.name); });

} // namespace nephroid::white_furnace_test
