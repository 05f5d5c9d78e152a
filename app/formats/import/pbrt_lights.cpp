// SPDX-License-Identifier: Apache-2.0
// PBRT's lights and surroundings.
#include "base/error.h"
#include "base/files.h"
#include "formats/import/pbrt_scene.h"
#include "formats/import/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::formats {

namespace {

using std::numbers::pi;

std::string map_name(const PbrtParameters& p) { return p.text("filename", p.text("mapname", "")); }

double luminance(const glm::dvec3& rgb) { return glm::dot(rgb, {0.2126, 0.7152, 0.0722}); }

/// Version 4 has squares, 3 latitude and longitude about z. lux: the illuminance that is wanted; else 0 or less.
void add_infinite(PbrtScene& scene, const PbrtParameters& p, const glm::dmat4& to_world, const DescribedColour& colour,
                  double lux) {
  DescribedSurroundings& s = scene.d.surroundings.emplace();
  s.where = p.where;
  s.colour = linear_srgb_of(colour);
  const std::string name = map_name(p);
  if (name.empty()) {
    if (lux > 0) s.scale = lux / pi;
    return;
  }
  s.file = scene.file.find(name, p.where);
  if (!is_there(s.file)) throw bad_input(p.where, "the picture " + s.file.string() + " is not there");
  s.is_equal_area = !p.find("mapname");
  require_inverse(to_world, p.where);
  s.to_world = glm::dmat3(to_world);
  if (!s.is_equal_area) // its middle is -x, and -y is to the right of that
    s.to_world = s.to_world * glm::dmat3(0, 1, 0, 0, 0, 1, -1, 0, 0);
  if (lux > 0) scene.d.note(p.where, "its illuminance is left out: the picture counts as it is");
  s.scale = luminance(s.colour);
  if (s.colour.x != s.colour.y || s.colour.x != s.colour.z)
    scene.d.note(p.where, "the colour that the picture is multiplied by is left out: its luminance counts");
}

} // namespace

/// The luminance of a white of 1 is 1 in version 4, which divides a light by the luminance of its spectrum.
void add_pbrt_light(PbrtScene& scene, const std::string& type, const PbrtParameters& p, const glm::dmat4& to_world) {
  DescribedLight light;
  light.where = p.where;
  const glm::dvec3 from = p.vector("from", {0, 0, 0}), to = p.vector("to", {0, 0, 1});
  light.position = glm::dvec3(to_world * glm::dvec4(from, 1));
  light.direction = glm::dmat3(to_world) * (to - from);
  light.colour = pbrt_light_colour(scene, p, type == "distant" || type == "infinite" ? "L" : "I");
  const auto given = [&](const char* name) { return std::max(p.number(name, 0), 0.0); };
  if (type == "point") {
    if (const double power = given("power"); power > 0) light.colour = light.colour * (power / (4 * pi));
  } else if (type == "spot") {
    light.type = preset::Light::Type::spot;
    const double cone = std::clamp(p.number("coneangle", 30), 0.01, 90.0);
    const double start = std::clamp(cone - p.number("conedeltaangle", 5), 0.0, cone);
    const double low = std::cos(glm::radians(cone)), high = std::cos(glm::radians(start));
    light.half_angle_deg = same_power_half_angle_deg(cone, [&](double a) {
      const double t = high > low ? std::clamp((std::cos(a) - low) / (high - low), 0.0, 1.0) : 1;
      return t * t * (3 - 2 * t);
    });
    if (const double power = given("power"); power > 0)
      light.colour = light.colour * (power / (2 * pi * (1 - std::cos(glm::radians(light.half_angle_deg)))));
    if (start < cone) scene.d.note(p.where, "the spot's fading edge is left out: a sharp cone has its power");
  } else if (type == "distant") {
    light.type = preset::Light::Type::directional;
    if (const double lux = given("illuminance"); lux > 0) light.colour = light.colour * lux;
  } else if (type == "infinite" && scene.d.surroundings) {
    return scene.d.note(p.where, "a second light infinite is left out");
  } else if (type == "infinite") {
    add_infinite(scene, p, to_world, light.colour, given("illuminance"));
    return;
  } else if (type == "goniometric") {
    const std::string name = map_name(p);
    if (const double power = given("power"); power > 0)
      light.colour = light.colour * (power / (4 * pi));
    else if (!name.empty())
      try {
        light.colour = light.colour * luminance(mean_of_map(scene.file.find(name, p.where), !p.find("mapname")));
      } catch (const Error& error) {
        scene.d.note(p.where, "the light's picture is left out: " + error.line());
      }
    scene.d.note(p.where, "the light shines to all sides alike: the pattern of its picture is left out");
  } else
    return scene.d.note(p.where, "the light " + type + " is left out");
  scene.d.lights.push_back(light);
}

} // namespace nephroid::formats
