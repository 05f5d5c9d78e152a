// SPDX-License-Identifier: Apache-2.0
// Light in a medium around an object that sends it evenly to all sides: then what a path from the eye collects is an integral with a closed
// form.
#include "environment/bake/bake.h"
#include "environment/view/renderer.h"
#include "tests/environment/bakes.h"
#include "tests/support/test.h"

namespace nephroid::volume_test {

using environment::Bake;

constexpr double largest = 4, impact = 2; ///< radius of the largest sphere; how near the path comes to the middle
constexpr double even = 0.25;             ///< E r^2 over size^2, everywhere

/// As if the object sent light evenly to all sides.
Bake even_bake(double size)
{
  Bake bake;
  bake.map.side = 128;
  bake.size = size;
  bake.radii = {1.1, 2, largest};
  bake.directions = environment::light_directions(26);
  bake.baked.resize(26);
  bake.halves.assign(26 * bake.direction_items(), environment::to_half(even / Bake::unit));
  make_radial(bake);
  return bake;
}

/// Radiance of the layer "volume" for light of 1 W/m^2 of the lamp's Y, along a path past a ball of radius 1. about_z_deg: how far around
/// the ball the path is.
double seen(const std::string& settings, const std::string& others = "", double about_z_deg = 0)
{
  const double x = impact * std::cos(glm::radians(about_z_deg)), y = impact * std::sin(glm::radians(about_z_deg));
  const preset::Preset p = preset::parse_preset(fmt::format(R"({{"engine": "environment", "environment": {{{}}},
      "scene": {{"camera": {{"position": [{}, {}, 10], "target": [{}, {}, 0], "fov_deg": 0.01, "resolution": [4, 4]}},
        "materials": {{"glass": {{"type": "dielectric", "dispersion": 1.5}}, "wall": {{"type": "diffuse"}}}},
        "lights": [{{"type": "directional", "direction": [0, -1, 0]}}], "objects": [{}{}]}}}})",
                                                            settings, x, y, x, y, glass_ball, others),
                                                "own.json");
  const scene::Scene scene = scene::load_scene(p);
  const environment::BakeTask bake_task = environment::make_task(p);
  environment::RenderTask task = environment::make_render_task(p, scene, scene::build_bvh(scene.geometry), bake_task.caster);
  const double light = task.lamps.at(0).irradiance.y;
  environment::Caustics caustics(even_bake(bake_task.caster.size), bake_context());
  environment::Renderer renderer(std::move(task), caustics, 1, 1, bake_context());
  while (renderer.passes() < 8) renderer.step();
  const std::shared_ptr<const job::Picture> picture = renderer.picture();
  EXPECT_EQ(picture->layers.back().name, "volume");
  double sum = 0;
  for (std::size_t pixel = 0; pixel < 16; ++pixel) sum += picture->layers.back().rgb[3 * pixel + 1] / 16;
  return sum / light;
}

/// Of 1 / (impact^2 + t^2) times the phase function and what is left on the way to the eye, at t from `begin` to `end` along the path,
/// whose nearest place to the middle is t = 0, 10 units from the eye. phase: of the cosine.
template <class Phase>
double expected(double extinction, double begin, double end, const Phase& phase)
{
  const int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = begin + (end - begin) * (i + 0.5) / steps, r2 = impact * impact + t * t;
    sum += phase(-t / std::sqrt(r2)) * std::exp(-extinction * (10 + t)) / r2;
  }
  return extinction * 4 * even * sum * (end - begin) / steps;
}

const double half_chord = std::sqrt(largest * largest - impact * impact);
constexpr double pi = std::numbers::pi;
double isotropic(double) { return 1 / (4 * pi); }

TEST(Volume, AThinMediumScattersEvenly)
{
  // The integral of 1 / (b^2 + t^2) over the chord of 2 * 60 degrees is 2 pi / 3 / b.
  const double thin = 1e-5, closed = thin * 4 * even / (4 * pi) * (2 * pi / 3 / impact);
  EXPECT_NEAR(expected(thin, -half_chord, half_chord, isotropic), closed, 1e-3 * closed);
  EXPECT_NEAR(seen(R"("extinction": 1e-5)"), closed, 0.005 * closed);
  EXPECT_NEAR(seen(R"("extinction": 1e-5, "albedo": 0.5)"), 0.5 * closed, 0.005 * closed);
}

TEST(Volume, WhatTheMediumTakesOnTheWayIsLost)
{
  const double wanted = expected(0.3, -half_chord, half_chord, isotropic);
  EXPECT_NEAR(seen(R"("extinction": 0.3)"), wanted, 0.005 * wanted);
}

// Towards the eye the path's direction is reversed: light that goes away from the eye has to turn back. The path is in none of the planes
// where a sphere's map has its edges: beside those the mean way of neighbouring texels is off by up to a texel's half.
TEST(Volume, PhaseFunctionsAreTheirFormulas)
{
  const auto forward = [](double cosine) { return (1 - 0.36) / (4 * pi * std::pow(1 + 0.36 - 1.2 * cosine, 1.5)); };
  const auto rayleigh = [](double cosine) { return 3 / (16 * pi) * (1 + cosine * cosine); };
  const double on = expected(0.2, -half_chord, half_chord, forward), air = expected(0.2, -half_chord, half_chord, rayleigh);
  EXPECT_NEAR(seen(R"("extinction": 0.2, "anisotropy": 0.6)", "", 25), on, 0.03 * on); // half a texel of the baked map
  EXPECT_NEAR(seen(R"("extinction": 0.2, "phase": "rayleigh")", "", 25), air, 0.005 * air);
}

// A screen between the object and the farther half of the path. The cube of what stands around has 128 texels a side.
TEST(Volume, WhatStandsBeforeThePlaceHidesIt)
{
  const std::string screen = R"(, {"shape": {"type": "quad", "size": [10, 1, 10]}, "material": "wall",
                                   "transform": {"translate": [1.5, 0, -5], "rotate_deg": [0, 0, 90]}})";
  const double wanted = expected(0.1, -half_chord, 0, isotropic);
  EXPECT_NEAR(seen(R"("extinction": 0.1)", screen), wanted, 0.02 * wanted);
}

} // namespace nephroid::volume_test
