// SPDX-License-Identifier: Apache-2.0
#include "run/import/gltf_lights.h"

#include "base/error.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scene/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::run {
namespace {

constexpr double most_lumens = 683; ///< a watt at 555 nm, by the definition of the candela
using std::numbers::pi;

glm::dvec3 to_glm(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }

double sum(const optics::Spectrum& spectrum)
{
  double all = 0;
  for (const double value : spectrum) all += value;
  return all;
}

} // namespace

double lumens_per_watt(const optics::Spectrum& spectrum) { return most_lumens * optics::to_xyz(spectrum)[1] / sum(spectrum); }

LightColour light_colour(const std::array<double, 3>& rgb)
{
  std::array<double, 3> colour = rgb;
  for (double& c : colour) c = std::clamp(c, 0.0, 1e6);
  const double luminance = optics::linear_srgb_to_xyz(colour)[1];
  LightColour light; // D65
  const double largest = std::max({colour[0], colour[1], colour[2]}), least = std::min({colour[0], colour[1], colour[2]});
  if (!(largest > 0)) return light; // black: no watts
  if (largest - least < 1e-3 * largest) {
    light.watts_per_lumen = luminance / lumens_per_watt(optics::illuminant("D65"));
    return light;
  }
  optics::Spectrum spectrum{};
  for (std::size_t i = 0; i < spectrum.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) spectrum[i] += colour[c] / largest * optics::primary_spectra()[c][i];
  light.spectrum.type = preset::LightSpectrum::Type::table;
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10) // power cannot be negative, so saturated colours become a little paler
    light.spectrum.table.push_back({static_cast<double>(nm), std::max(0.0, spectrum[static_cast<std::size_t>(nm - optics::first_nm)])});
  light.watts_per_lumen = luminance / lumens_per_watt(scene::make_light_spectrum(light.spectrum, "spectrum"));
  return light;
}

preset::Light light_of(const GltfValue& value, const glm::dmat4& to_world, const std::string& name, std::vector<std::string>& notes)
{
  preset::Light light;
  const std::string type = value.text("type");
  const LightColour colour = light_colour(value.numbers<3>("color", {1, 1, 1}));
  const double intensity = std::max(0.0, value.number("intensity", 1));
  light.spectrum = colour.spectrum;
  light.position = vec3(glm::dvec3(to_world[3]));
  const glm::dvec3 forward = -glm::dvec3(to_world[2]);
  light.direction = glm::length(forward) > 0 ? vec3(glm::normalize(forward)) : preset::Vec3{0, 0, -1};
  if (type == "point") {
    light.power_w = 4 * pi * intensity * colour.watts_per_lumen; // candela over the whole sphere
  } else if (type == "spot") {
    const GltfValue spot = value.object("spot");
    const double outer = std::clamp(spot.number("outerConeAngle", pi / 4), 1e-3, pi / 2), inner = spot.number("innerConeAngle", 0);
    light.type = preset::Light::Type::spot;
    light.half_angle_deg = outer * 180 / pi;
    light.power_w = 2 * pi * (1 - std::cos(outer)) * intensity * colour.watts_per_lumen; // candela over the cone's solid angle
    if (inner < 0.99 * outer)
      notes.push_back(fmt::format("light '{}' fades towards the edge of its cone in the file and does not here", name));
  } else if (type == "directional") {
    light.type = preset::Light::Type::directional;
    light.irradiance_w_m2 = intensity * colour.watts_per_lumen;
  } else
    throw bad_input(value.where() / "type", "is \"" + type + "\"", "expected point, spot or directional");
  light.power_w = std::min(light.power_w, 1e9);
  light.irradiance_w_m2 = std::min(light.irradiance_w_m2, 1e9);
  if (value.has("range")) notes.push_back(fmt::format("light '{}' ends at a range in the file and does not here", name));
  return light;
}

double luminous_irradiance(const preset::Light& light, const glm::dvec3& at)
{
  const double seen = lumens_per_watt(scene::make_light_spectrum(light.spectrum, "spectrum")) / most_lumens;
  if (light.type == preset::Light::Type::directional) return light.irradiance_w_m2 * seen;
  const glm::dvec3 way = at - to_glm(light.position);
  const bool spot = light.type == preset::Light::Type::spot;
  const double solid_angle = spot ? 2 * pi * (1 - std::cos(light.half_angle_deg * pi / 180)) : 4 * pi;
  return light.power_w * seen / (solid_angle * std::max(glm::dot(way, way), 1e-6));
}

} // namespace nephroid::run
