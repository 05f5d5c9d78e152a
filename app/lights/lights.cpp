// SPDX-License-Identifier: Apache-2.0
#include "lights/lights.h"

#include "preset/choices.h"
#include "scatter/spectra.h"
#include "scene/directions.h"
#include "scene/object_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::lights {

using std::numbers::pi;

const Model& model(int type) {
#define NEPHROID_LIGHT_MODEL(word, NAME, Row, has, sentence) &word(),
  static const Model* const models[] = {ALL_LIGHTS(NEPHROID_LIGHT_MODEL)};
#undef NEPHROID_LIGHT_MODEL
  return *models[type];
}

int type_of(const scene::Light& light) {
  return is_environment(light) ? int{LIGHT_ENVIRONMENT} : static_cast<int>(light.type); // both are of the list
}

shared::DeviceLight row_of(const scene::Light& light) {
  shared::DeviceLight row{};
  row.type = type_of(light);
  row.table = -1;
  model(light).set_row(light, row);
  return row;
}

bool is_parallel(const shared::DeviceLight& row) {
#define NEPHROID_LIGHT_HAS(word, NAME, Row, has, sentence) has,
  constexpr unsigned has_of[] = {ALL_LIGHTS(NEPHROID_LIGHT_HAS)};
#undef NEPHROID_LIGHT_HAS
  return (has_of[row.type] & LIGHT_HAS_IRRADIANCE) != 0;
}

bool is_narrow(const shared::DeviceLight& row) {
  return row.type == LIGHT_SPOT && row.as.spot.one_minus_cos < NARROW_SPOT;
}

double steradians_of(const std::vector<scene::Sphere>& spheres, const glm::dvec3& from) {
  double steradians = 0;
  for (const scene::Sphere& sphere : spheres) {
    const double distance2 = std::pow(glm::length(glm::dvec3(sphere.centre) - from), 2);
    const double sine2 = double(sphere.radius) * sphere.radius / distance2;
    // 1 - cos = sin^2 / (1 + cos), which stays above 0 for a far target
    steradians += sine2 >= 1 ? 4 * pi : 2 * pi * sine2 / (1 + std::sqrt(1 - sine2));
  }
  return steradians;
}

double shadow_m2(const std::vector<scene::Sphere>& spheres, double metres_per_unit) {
  double square_metres = 0;
  for (const scene::Sphere& sphere : spheres)
    square_metres += pi * (double(sphere.radius) * sphere.radius) * metres_per_unit * metres_per_unit;
  return square_metres;
}

double surface_towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres) {
  return light.power_w * std::min(1.0, steradians_of(spheres, light.position) / pi);
}

double Model::towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres, double) const {
  return light.power_w * std::min(1.0, steradians_of(spheres, light.position) / (4 * pi));
}

double Model::irradiance(const scene::Light& light, double metres) const {
  return light.power_w / (4 * pi * metres * metres);
}

std::optional<Punctual> Model::punctual(const scene::Light& light) const {
  return Punctual{"point", light.power_w / (4 * pi), {}};
}

void describe_power(preset::Fields& v, preset::Light& light) {
  v.field("power_w", "Radiant power of 380 to 780 nm.", light.power_w, {.unit = "W", .bounds = preset::power_bounds});
}

void describe_position(preset::Fields& v, preset::Light& light) {
  v.field("position", "Where it is; of an area light its centre.", light.position,
          {.unit = preset::length_unit, .bounds = preset::position_bounds});
}

void describe_direction(preset::Fields& v, preset::Light& light) {
  v.field("direction", "The way the light goes; any length but 0.", light.direction,
          {.bounds = preset::position_bounds});
}

void load_position(const preset::Light& from, const Loading& loading, scene::Light& light) {
  light.power_w = from.power_w;
  const glm::dvec3 position = scene::local_position(from.position, loading.scene, loading.where / "position");
  light.position = position;
  light.inside = dielectrics_around(loading.scene, position);
}

glm::dvec3 vector(const shared::float4& v) { return {v.x, v.y, v.z}; }

std::pair<std::size_t, double> bin_of(const float* cdf, std::size_t count, float number) {
  const auto bin = static_cast<std::size_t>(std::upper_bound(cdf, cdf + count - 1, number) - cdf);
  const double before = bin > 0 ? cdf[bin - 1] : 0;
  return {bin, (number + 0x1p-25 - before) / (cdf[bin] - before)};
}

namespace {

/// A lamp of a size that reaches through a surface has points inside and outside; its photons all start in what is
/// around its centre, or around the first place of a mesh.
void warn_if_straddling(scene::Scene& scene, const scene::Light& light, std::size_t index) {
  if (!has_places(light)) return;
  for (const glm::dvec3& p : model(light).extent(scene, light)) {
    std::vector<int> around = dielectrics_around(scene, p);
    std::erase(around, light.object);
    if (around == light.inside) continue;
    scene.warnings.push_back(
        fmt::format("light {}: reaches through the surface of a dielectric; its rays start in what is around its {}",
                    index, light.object >= 0 ? "first triangle" : "centre"));
    return;
  }
}

/// Places on a rectangle are drawn uniformly. Of one much larger than the scene hardly any is near enough to matter.
void warn_if_wide(scene::Scene& scene, const scene::Light& light, std::size_t index) {
  const double size = std::max(glm::length(light.edge_u), glm::length(light.edge_v)), radius = scene_radius(scene);
  if (preset::has(light.type, LIGHT_HAS_EDGES) && radius > 0 && size > 50 * radius)
    scene.warnings.push_back(fmt::format(
        "light {}: is {:.3g} times as wide as the scene: nearly all of its samples are too far away to matter, "
        "and the picture is dark but for rare bright dots; make it smaller, or take directional light",
        index, size / (2 * radius)));
}

} // namespace
} // namespace nephroid::lights

namespace nephroid {

void preset::describe(Fields& v, Light& light) {
  v.about("Light", "A source of light.");
  v.type("type", "What kind of source.", light.type);
  v.field("spectrum", "A CIE illuminant by name, or an object.", light.spectrum);
  lights::model(static_cast<int>(light.type)).describe(v, light);
}

void scene::add_light(const preset::Light& from, const FileFinder& finder, const Location& where, Scene& scene) {
  Light light;
  light.type = from.type;
  light.spectrum = scatter::make_light_spectrum(from.spectrum, where / "spectrum", scene.range);
  lights::model(light).load(from, {scene, finder, where, scene.warnings}, light);
  if (scene.range != optics::SpectralRange::visible) { // power is given for 380 to 780 nm, and there is more
    const double per_visible = optics::sum_of(light.spectrum);
    for (double& share : light.spectrum) share /= per_visible;
    light.power_w *= per_visible, light.irradiance_w_m2 *= per_visible;
  }
  const std::size_t index = scene.lights.size();
  scene.lights.push_back(std::move(light));
  lights::warn_if_straddling(scene, scene.lights.back(), index);
  lights::warn_if_wide(scene, scene.lights.back(), index);
}

// Films hold some 2^40 between the strongest and the weakest light that is to be seen without noise of their own.
void scene::warn_of_faint_lights(Scene& scene) {
  const double metres = scene_radius(scene) * scene.metres_per_unit;
  const auto typical = [metres](const Light& light) { return lights::model(light).irradiance(light, metres); };
  double strongest = 0;
  for (const Light& light : scene.lights) strongest = std::max(strongest, typical(light));
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const double share = typical(scene.lights[i]) / strongest;
    if (share > 0 && share < 0x1p-30)
      scene.warnings.push_back(fmt::format(
          "{} is {:.2g} of the strongest light, less than the film's numbers resolve: what it lights alone is "
          "noise; render it in a run of its own",
          is_environment(scene.lights[i]) ? "environment:" : fmt::format("light {}:", i), share));
  }
}

} // namespace nephroid
