// SPDX-License-Identifier: Apache-2.0
// Caustics in the air about glass against photons in the same medium (medium_photons.h), as pictures.
// Light in a medium around an object that sends it evenly to all sides: then what a path from the eye collects is an
// integral with a closed form.
#include "environment/light/distant_lights.h"
#include "environment/view/renderer.h"
#include "image/image.h"
#include "tests/environment/bakes.h"
#include "tests/environment/medium_photons.h"

namespace nephroid::volume_photons_test {

using environment::Bake;
using Picture = std::vector<double>;

constexpr double pi = std::numbers::pi;

struct Phase {
  std::string settings;
  std::function<double(double)> of;
};
const Phase isotropic{R"("anisotropy": 0)", [](double) { return 1 / (4 * pi); }};
const Phase rayleigh{R"("phase": "rayleigh")", [](double c) { return 3 / (16 * pi) * (1 + c * c); }};
Phase henyey_greenstein(double g) {
  return {fmt::format(R"("anisotropy": {})", g),
          [g](double c) { return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * c, 1.5)); }};
}

constexpr double largest = 4, impact = 2; ///< radius of the largest sphere; how near the path comes to the middle
constexpr double even = 0.25 * 255 / 256; ///< E r^2 over size^2, everywhere: stored as it is

/// As if the object sent light evenly to all sides.
Bake even_bake(double size) {
  Bake bake;
  bake.map.side = 128;
  bake.size = size;
  bake.radii = {1.1, 2, largest};
  bake_by(bake, [](std::size_t, double, const glm::dvec3&) { return glm::dvec3(even); });
  return bake;
}

/// The layer "volume" for light of 1 W/m^2 of the lamp's Y.
Picture seen(const preset::Preset& p, const environment::BakeTask& bake_task, const Bake& bake, int passes) {
  const scene::Scene scene = scene::load_scene(p);
  environment::RenderTask task =
      environment::make_render_task(p, scene, scene::build_bvh(scene.geometry), bake_task.caster);
  const double light = task.lamps.at(0).irradiance.y;
  environment::Caustics caustics(bake, bake_context());
  environment::Renderer renderer(std::move(task), 1, 1, bake_context());
  renderer.set_caustics(caustics);
  while (renderer.passes() < passes) renderer.advance();
  const environment::Renderer::Layer volume = renderer.layers().back();
  EXPECT_STREQ(volume.name, "volume");
  Picture y;
  for (std::size_t i = 1; i < volume.rgb.size(); i += 3) y.push_back(volume.rgb[i] / light);
  return y;
}

/// Radiance of the layer "volume" for light of 1 W/m^2 of the lamp's Y, along a path past a ball of radius 1.
/// about_z_deg: how far around the ball the path is.
double seen(const std::string& settings, const std::string& others = "", double about_z_deg = 0) {
  const double x = impact * std::cos(glm::radians(about_z_deg)), y = impact * std::sin(glm::radians(about_z_deg));
  const preset::Preset p = preset::parse_preset(fmt::format(R"({{"engine": "environment", "environment": {{{}}},
      "scene": {{"camera": {{"position": [{}, {}, 10], "target": [{}, {}, 0], "fov_deg": 0.01, "resolution": [4, 4]}},
        "materials": {{"glass": {{"type": "dielectric", "dispersion": 1.5}}, "wall": {{"type": "diffuse"}}}},
        "lights": [{{"type": "directional", "direction": [0, -1, 0]}}], "objects": [{}{}]}}}})",
                                                            settings, x, y, x, y, glass_ball, others),
                                                "own.json");
  const environment::BakeTask bake_task = environment::make_task(p);
  const Picture picture = seen(p, bake_task, even_bake(bake_task.caster.size), 8);
  return std::accumulate(picture.begin(), picture.end(), 0.0) / static_cast<double>(picture.size());
}

/// Of 1 / (impact^2 + t^2) times the phase function and what is left on the way to the eye, at t from `begin` to `end`
/// along the path, whose nearest place to the middle is t = 0, 10 units from the eye. phase: of the cosine.
template <class Phase>
double expected(double extinction, double begin, double end, const Phase& phase) {
  const int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = begin + (end - begin) * (i + 0.5) / steps, r2 = impact * impact + t * t;
    sum += phase(-t / std::sqrt(r2)) * std::exp(-extinction * (10 + t)) / r2;
  }
  return extinction * 4 * even * sum * (end - begin) / steps;
}

const double half_chord = std::sqrt(largest * largest - impact * impact);

TEST(Volume, AThinMediumScattersEvenly) {
  // The integral of 1 / (b^2 + t^2) over the chord of 2 * 60 degrees is 2 pi / 3 / b.
  const double thin = 1e-5, closed = thin * 4 * even / (4 * pi) * (2 * pi / 3 / impact);
  EXPECT_NEAR(expected(thin, -half_chord, half_chord, isotropic.of), closed, 1e-3 * closed);
  EXPECT_NEAR(seen(R"("extinction": 1e-5)"), closed, 0.005 * closed);
  EXPECT_NEAR(seen(R"("extinction": 1e-5, "albedo": 0.5)"), 0.5 * closed, 0.005 * closed);
}

TEST(Volume, WhatTheMediumTakesOnTheWayIsLost) {
  const double wanted = expected(0.3, -half_chord, half_chord, isotropic.of);
  EXPECT_NEAR(seen(R"("extinction": 0.3)"), wanted, 0.005 * wanted);
}

// Towards the eye the path's direction is reversed: light that goes away from the eye has to turn back. The path is in
// none of the planes where a sphere's map has its edges: beside those the mean way of neighbouring texels is off by up
// to a texel's half.
TEST(Volume, PhaseFunctionsAreTheirFormulas) {
  const double on = expected(0.2, -half_chord, half_chord, henyey_greenstein(0.6).of),
               air = expected(0.2, -half_chord, half_chord, rayleigh.of);
  EXPECT_NEAR(seen(R"("extinction": 0.2, "anisotropy": 0.6)", "", 25), on, 0.03 * on); // half a texel of the baked map
  EXPECT_NEAR(seen(R"("extinction": 0.2, "phase": "rayleigh")", "", 25), air, 0.005 * air);
}

// A screen between the object and the farther half of the path. The cube of what stands around has 128 texels a side.
TEST(Volume, WhatStandsBeforeThePlaceHidesIt) {
  const std::string screen = R"(, {"shape": {"type": "quad", "size": [10, 1, 10]}, "material": "wall",
                                   "transform": {"translate": [1.5, 0, -5], "rotate_deg": [0, 0, 90]}})";
  const double wanted = expected(0.1, -half_chord, 0, isotropic.of);
  EXPECT_NEAR(seen(R"("extinction": 0.1)", screen), wanted, 0.02 * wanted);
}

// Caustics in the air about glass against photons in the same medium (medium_photons.h), as pictures.

double rel_l2(const Picture& a, const Picture& b) {
  double difference = 0, length = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    length += b[i] * b[i];
  }
  return std::sqrt(difference / length);
}
double sum_of(const Picture& picture) {
  double sum = 0;
  for (const double value : picture) sum += value;
  return sum;
}

struct Spheres {
  int count = 16, directions = 26, resolution = 360, photons = 1 << 17;
};

preset::Preset preset_of(const MediumScene& s, const Phase& phase, const Spheres& spheres) {
  const std::string screen =
      s.screen_y
          ? fmt::format(
                R"(, {{"shape": {{"type": "quad", "size": [{}, 1, {}]}}, "material": "wall", "transform": {{"translate": [0, {}, 0]}}}})",
                2 * s.screen_half, 2 * s.screen_half, *s.screen_y)
          : "";
  const double side = 2 * std::max({s.axes.x, s.axes.y, s.axes.z});
  return preset::parse_preset(fmt::format(R"({{"engine": "environment",
      "environment": {{"spheres": {}, "directions": {}, "resolution": {}, "reach": {}, "photons": {}, "extinction": {}, {}}},
      "scene": {{"camera": {{"position": [{}, {}, {}], "target": [0, 0, 0], "fov_deg": {}, "resolution": [{}, {}]}},
        "materials": {{"glass": {{"type": "dielectric", "dispersion": {}}}, "wall": {{"type": "diffuse", "reflectance": 0}}}},
        "lights": [{{"type": "directional", "direction": [{}, {}, {}]}}],
        "objects": [{{"shape": {{"type": "sphere", "radius": 1}}, "material": "glass", "transform": {{"scale": [{}, {}, {}]}}}}{}]}}}})",
                                          spheres.count, spheres.directions, spheres.resolution, s.largest / side,
                                          spheres.photons, s.extinction, phase.settings, s.eye.x, s.eye.y, s.eye.z,
                                          s.fov_deg, s.size, s.size, s.n, s.light.x, s.light.y, s.light.z, s.axes.x,
                                          s.axes.y, s.axes.z, screen),
                              "own.json");
}

/// Of the directions about one light alone: the others stay black.
Bake bake_for(const preset::Preset& preset, const glm::dvec3& light) {
  environment::BakeTask task = environment::make_task(preset);
  const std::vector<environment::NearDirection> near =
      environment::near_directions(light, static_cast<int>(task.directions.size()));
  Bake whole = task.empty_bake();
  whole.directions = task.directions;
  whole.resize(task.directions.size());
  std::vector<glm::dvec3> wanted;
  for (const environment::NearDirection& direction : near)
    wanted.push_back(task.directions[static_cast<std::size_t>(direction.direction)]);
  const Bake made = bake_of(preset, wanted);
  const auto copy = [&](const auto& from, auto& to) {
    const std::size_t items = from.size() / near.size();
    for (std::size_t i = 0; i < near.size(); ++i)
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * items), items,
                  to.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(near[i].direction) * items));
  };
  copy(made.texels, whole.texels);
  copy(made.blocks, whole.blocks);
  return whole;
}

/// Where NEPHROID_VOLUME_PICTURES names a folder, pictures are larger and are written there.
const char* pictures_folder() { return std::getenv("NEPHROID_VOLUME_PICTURES"); }

/// Both beside each other, as bright that one pixel of a hundred is too bright.
void draw(const std::string& name, std::size_t size, const std::vector<Picture>& beside) {
  Picture sorted = beside[0];
  std::ranges::sort(sorted);
  const double white = sorted[sorted.size() * 99 / 100];
  std::vector<float> rgb;
  for (std::size_t row = 0; row < size; ++row)
    for (const Picture& picture : beside)
      for (std::size_t column = 0; column < size; ++column)
        for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(picture[row * size + column] / white));
  const int pixels = static_cast<int>(size);
  image::write_png(std::filesystem::path(pictures_folder()) / (name + ".png"), pixels * static_cast<int>(beside.size()),
                   pixels, rgb);
}

struct Compared {
  double rel_l2 = 0, power = 0; ///< power: of all pixels, over the reference's
};

/// With each of these spheres. photons: of the references.
std::vector<Compared> compare(const std::string& name, MediumScene s, const Phase& phase,
                              const std::vector<Spheres>& each = {{}}, int photons = 1 << 16) {
  if (pictures_folder()) {
    s.size = 256;
    photons *= 32;
  }
  s.phase = phase.of;
  s.light = glm::normalize(s.light);
  const Picture real = MediumPhotons(s).picture(photons, 1), again = MediumPhotons(s).picture(photons, 2);
  const double noise = rel_l2(again, real);
  EXPECT_LT(noise, 0.08);
  std::vector<Compared> result;
  for (const Spheres& spheres : each) {
    const preset::Preset p = preset_of(s, phase, spheres);
    // a beam that is narrower than a step is met by chance
    const Picture baked = seen(p, environment::make_task(p), bake_for(p, s.light), 32);
    if (pictures_folder())
      draw(fmt::format("{}-{}-{}", name, spheres.count, spheres.directions), static_cast<std::size_t>(s.size),
           {real, baked});
    result.push_back({rel_l2(baked, real), sum_of(baked) / sum_of(real)});
    fmt::print("{}, s = {}, {} directions: rel_l2 {:.3f} (noise {:.3f}), power {:.3f}\n", name, spheres.count,
               spheres.directions, result.back().rel_l2, noise, result.back().power);
  }
  return result;
}

void expect_near(const Compared& c, double rel_l2, double power) {
  EXPECT_LT(c.rel_l2, rel_l2);
  EXPECT_NEAR(c.power, 1, power);
}

// What is left is where light goes several ways in one texel, and what lies between spheres.
TEST(VolumePhotons, ABall) {
  const std::vector<Compared> by_count = compare("ball", {}, isotropic, {{.count = 8}, {.count = 16}, {.count = 32}});
  for (const Compared& c : by_count) expect_near(c, &c == by_count.data() ? 0.17 : 0.14, 0.045);
}

TEST(VolumePhotons, PhaseFunctions) {
  expect_near(compare("forward", {}, henyey_greenstein(0.7), {{}}, 1 << 17)[0], 0.28, 0.1);
  expect_near(compare("rayleigh", {}, rayleigh)[0], 0.19, 0.06);
}

// Its caustics are not those of another direction turned: more directions are nearer.
TEST(VolumePhotons, AnEllipsoid) {
  const MediumScene s{.axes = {1, 0.7, 0.85}, .light = {0.3, -1, 0.2}};
  const std::vector<Compared> by_directions =
      compare("ellipsoid", s, isotropic, {{.directions = 26}, {.directions = 98}});
  expect_near(by_directions[0], 0.36, 0.09);
  expect_near(by_directions[1], 0.26, 0.06);
}

// It stands in the beam. What it hides from the middle is dark, though some light goes by aslant.
TEST(VolumePhotons, AScreenInTheBeam) {
  expect_near(compare("screen", {.screen_y = -2, .screen_half = 0.5}, isotropic)[0], 0.19, 0.09);
}

} // namespace nephroid::volume_photons_test
