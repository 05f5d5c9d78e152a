// SPDX-License-Identifier: Apache-2.0
// Presets of engine 2 built in a test, and their bakes.
#pragma once
#include "environment/bake/baker.h"
#include "preset/read.h"
#include "tests/support/test_kernels.h"

namespace nephroid::test {

/// One for all tests of a program: opening a device takes a second.
inline const compute::Context& bake_context() {
  static const compute::Context context = compute::Context::open(device_options());
  return context;
}

inline const std::string glass_ball =
    R"({"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "glass"})";

/// Materials glass (n = 1.5), mirror and wall, these objects, and overrides as of --set.
inline preset::Preset bake_preset(const std::string& objects = glass_ball, const preset::Overrides& overrides = {}) {
  return preset::parse_preset(
      R"({"engine": "environment", "white": 1, "scene": {"camera": {"resolution": [64, 64]}, "materials": {
    "glass": {"type": "dielectric", "dispersion": 1.5}, "mirror": {"type": "mirror", "reflectance": 1}, "wall": {"type": "diffuse"}},
    "objects": [)" +
          objects + "]}}",
      "own.json", overrides);
}

/// Of the first of the directions alone, or of another one; of all of them where `direction` is empty.
inline environment::Bake bake_of(const preset::Preset& preset, std::vector<glm::dvec3> directions = {}) {
  environment::BakeTask task = environment::make_task(preset);
  if (!directions.empty()) task.directions = std::move(directions);
  environment::Baker baker(task, bake_context());
  while (!baker.finished()) baker.advance();
  return baker.take();
}

/// Bakes 26 directions by formula, as if all light came from the middle. of(direction of the bake, radius, place on its
/// sphere): E r^2 over size^2, linear sRGB.
template <class Of>
void bake_by(environment::Bake& bake, const Of& of) {
  bake.directions = environment::light_directions(26);
  bake.resize(26);
  std::vector<environment::TexelLight> light(bake.map.texels());
  for (std::size_t i = 0; i < 26; ++i)
    for (std::size_t sphere = 0; sphere < bake.radii.size(); ++sphere) {
      for (std::size_t t = 0; t < light.size(); ++t) {
        const glm::dvec3 place = bake.map.direction(t);
        light[t] = {of(i, bake.radii[sphere], place), place};
      }
      bake.store(i, sphere, light);
    }
}

/// Sum over a sphere of E r^2 over size^2 times the solid angle: the power through it, for each channel.
inline glm::dvec3 power_through(const environment::Bake& bake, std::size_t direction, std::size_t sphere) {
  glm::dvec3 sum(0);
  for (std::size_t t = 0; t < bake.map.texels(); ++t) sum += bake.at(direction, sphere, t) * bake.map.solid_angle();
  return sum;
}

/// Euclidean distance of two maps over the length of the second; first channel. place(t): the texel of `a` that is
/// texel t of `b`.
template <class Expected>
double relative_distance(const environment::Bake& bake, std::size_t direction, std::size_t sphere,
                         const Expected& expected) {
  double difference = 0, length = 0;
  for (std::size_t t = 0; t < bake.map.texels(); ++t) {
    const double wanted = expected(t), off = bake.at(direction, sphere, t).x - wanted;
    difference += off * off;
    length += wanted * wanted;
  }
  return std::sqrt(difference / length);
}

} // namespace nephroid::test
