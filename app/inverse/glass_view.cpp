// SPDX-License-Identifier: Apache-2.0
#include "inverse/glass_view.h"

#include "inverse/bending.h"
#include "inverse/light.h"
#include "optics/colour.h"
#include "preset/read.h"
#include "scatter/spectra.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

constexpr double irradiance = 1000; ///< the sun's
constexpr double reflectance = 0.8, ground_reflectance = 0.25;
constexpr double fov_deg = 30;
constexpr double widest_disc_deg = 10; ///< that a directional light may have
constexpr int view_height = 600, least_width = 600, most_width = 1800;

/// From one object's middle to the next, so that light beside a receiver falls beside the others, too. Light on its way
/// to a mirror passes beside the others' receivers.
double spacing(const Layout& layout) {
  const double aside = layout.is_mirror() ? std::abs(flat_slope(layout.light.sines).x) * layout.distances.back() : 0;
  return 1.4 * 2 * layout.half_room().x + aside;
}

double column(const Layout& layout, std::size_t receiver) {
  return (static_cast<double>(receiver) - (static_cast<double>(layout.distances.size()) - 1) / 2) * spacing(layout);
}

preset::Object object_over(const Layout& layout, std::size_t receiver) {
  preset::Object object;
  object.name = fmt::format("object over receiver {}", receiver + 1);
  object.mesh = "object.obj";
  object.material = layout.is_mirror() ? "mirror" : "glass";
  object.transform.translate = {column(layout, receiver), 0, 0};
  return object;
}

/// A rectangle that faces the light.
preset::Object screen(const std::string& name, const glm::dvec2& size, const glm::dvec3& at) {
  preset::Object quad;
  quad.name = quad.material = name;
  quad.shape.emplace();
  quad.shape->type = preset::Shape::Type::quad;
  quad.shape->size = {size.x, 1, size.y};
  quad.transform.rotate_deg = {90, 0, 0};
  quad.transform.translate = scene::to_vec3(at);
  return quad;
}

preset::Object receiver_at(const Layout& layout, std::size_t receiver) {
  preset::Object quad = screen("receiver", layout.receiver,
                               glm::dvec3(column(layout, receiver), 0, -layout.distances[receiver]) +
                                   glm::dvec3(layout.offset(receiver), 0));
  quad.name = fmt::format("receiver {}", receiver + 1);
  return quad;
}

/// Half of the rectangle in the plane of the front through which light comes straight to a receiver.
glm::dvec2 half_lit(const Layout& layout, const glm::dvec3& falls) {
  glm::dvec2 half(0);
  for (std::size_t j = 0; j < layout.distances.size(); ++j)
    half = glm::max(
        half, glm::abs(layout.offset(j) + glm::dvec2(falls) / falls.z * (layout.distances[j] + layout.thickness)) +
                  layout.receiver / 2.0);
  return half;
}

/// Dark strips around the object, a screen with a hole for it, that stop what would pass it and reach a receiver.
std::vector<preset::Object> mask(const Layout& layout, std::size_t receiver, const glm::dvec3& falls) {
  const glm::dvec2 inner = layout.size / 2.0, wanted = glm::max(half_lit(layout, falls), inner),
                   outer(std::min(wanted.x, spacing(layout) / 2), wanted.y);
  std::vector<preset::Object> strips;
  for (const int axis : {0, 1})
    for (const int side : {-1, 1}) {
      glm::dvec2 size, middle(0);
      size[axis] = outer[axis] - inner[axis];
      size[1 - axis] = 2 * (axis == 0 ? outer : inner)[1 - axis];
      middle[axis] = side * (inner[axis] + size[axis] / 2);
      if (!(size[axis] > 1e-6 * inner[axis])) continue;
      strips.push_back(
          screen("ground", size, glm::dvec3(column(layout, receiver), 0, layout.thickness) + glm::dvec3(middle, 0)));
      strips.back().name = fmt::format("mask {} over receiver {}", strips.size(), receiver + 1);
    }
  return strips;
}

/// Dark, and much larger than what stands over it: what glass is seen against.
preset::Object ground(const Layout& layout) {
  const double side = 4 * (spacing(layout) * static_cast<double>(layout.distances.size()) + layout.distances.back());
  return screen("ground", {side, side},
                {0, 0, -layout.distances.back() - 0.2 * std::max(layout.size.x, layout.size.y)});
}

/// The line from a receiver's far edge to the camera passes the mask's near edge, or the object's, where it rises by
/// the distance over half of both and the receiver's offset.
double elevation(const Layout& layout, const glm::dvec3& falls) {
  const double near = std::max(layout.size.y / 2, layout.is_mirror() ? 0 : half_lit(layout, falls).y);
  double free = glm::half_pi<double>();
  for (std::size_t j = 0; j < layout.distances.size(); ++j)
    free = std::min(free, std::atan2(layout.distances[j], near + layout.receiver.y / 2 + layout.offset(j).y));
  return std::clamp(0.85 * free, glm::radians(20.0), glm::radians(50.0));
}

/// The corners of all objects and receivers.
std::vector<glm::dvec3> corners_of(const Layout& layout) {
  std::vector<glm::dvec3> corners;
  const auto add = [&](const glm::dvec3& middle, const glm::dvec2& size) {
    for (const glm::dvec2& side : {glm::dvec2(-1, -1), {-1, 1}, {1, -1}, {1, 1}})
      corners.push_back(middle + glm::dvec3(side * size / 2.0, 0));
  };
  for (std::size_t j = 0; j < layout.distances.size(); ++j) {
    add({column(layout, j), 0, 0}, layout.size);
    add({column(layout, j), 0, layout.thickness}, layout.size);
    add(glm::dvec3(column(layout, j), 0, -layout.distances[j]) + glm::dvec3(layout.offset(j), 0), layout.receiver);
  }
  return corners;
}

preset::Camera camera(const Layout& layout, const glm::dvec3& falls) {
  const double up = elevation(layout, falls);
  const glm::dmat3 axes{1, 0, 0, 0, std::sin(up), std::cos(up), 0, -std::cos(up), std::sin(up)}; // right, up, back
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& corner : corners_of(layout)) {
    low = glm::min(low, corner * axes);
    high = glm::max(high, corner * axes);
  }
  const glm::dvec3 room = high - low, target = axes * ((low + high) / 2.0);
  preset::Camera camera;
  camera.fov_deg = fov_deg;
  camera.resolution = {std::clamp(static_cast<int>(view_height * room.x / room.y), least_width, most_width),
                       view_height};
  const double aspect = static_cast<double>(camera.resolution[0]) / view_height;
  const double away = 1.05 * std::max(room.y, room.x / aspect) / 2 / std::tan(glm::radians(fov_deg / 2)) + room.z / 2;
  camera.target = scene::to_vec3(target);
  camera.position = scene::to_vec3(target + away * axes[2]);
  camera.up = {0, 0, 1};
  return camera;
}

/// The preset's index, with its file, if any, where it is found from every folder.
preset::Dispersion dispersion_of(const preset::Preset& preset) {
  preset::Dispersion index = settings(preset).index;
  const std::filesystem::path source(preset.source);
  if (index.type == preset::Dispersion::Type::file)
    index.file = std::filesystem::absolute(
                     scatter::find_dispersion(index.file, FileFinder(source.parent_path()), Location(preset.source)))
                     .string();
  return index;
}

preset::Material glass(const Layout& layout, const preset::Preset& preset) {
  preset::Material material;
  material.type = preset::Material::Type::dielectric;
  if (layout.spectrum)
    material.dispersion = dispersion_of(preset);
  else
    material.dispersion.n = layout.n;
  return material;
}

/// The light's own, or that of the judge's band, in which colours part.
preset::LightSpectrum spectrum_of(const Layout& layout, const Settings& s) {
  preset::LightSpectrum spectrum = s.light.spectrum.value_or(preset::LightSpectrum{});
  if (!layout.spectrum || layout.coloured()) return spectrum;
  const double half = std::max(s.band_nm, 1.0) / 2;
  spectrum.type = preset::LightSpectrum::Type::table;
  spectrum.table = {{s.wavelength_nm - half, 1}, {s.wavelength_nm + half, 1}};
  return spectrum;
}

/// Of a disc that blurs as much as the judge's light and rough surface do: scatter has the variance of a disc of twice
/// its radius.
double disc_deg(const Layout& layout) {
  return glm::degrees(2 * std::atan(glm::length(glm::dvec2(layout.disc(layout.light), 2 * layout.scatter))));
}

/// What of the judge's light the view has otherwise.
std::string otherwise(const Layout& layout, const Settings& s) {
  std::string said;
  if (layout.scatter > 0)
    said += fmt::format(". {} is polished here: a wider sun stands for the scatter_deg of {:g}",
                        layout.is_mirror() ? "The mirror" : "Glass", s.scatter_deg);
  if (const double disc = disc_deg(layout); disc > widest_disc_deg)
    said +=
        fmt::format(". The disc of {:.3g} degrees would blur more than this one of {:g} does", disc, widest_disc_deg);
  if (layout.round) said += ". Light passes the corners beside the round object";
  return said;
}

} // namespace

std::string glass_view(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset) {
  const preset::LightSpectrum spectrum = spectrum_of(layout, settings(preset));
  // The luminance without its factor.
  const double luminous_part = optics::to_xyz(scatter::make_light_spectrum(spectrum, Location(preset.source)))[1];
  double brightest = 0; // over light that is spread evenly
  for (const Target& target : targets) brightest = std::max(brightest, *std::max_element(target.begin(), target.end()));
  brightest *= static_cast<double>(layout.cell_count());
  glm::dvec3 falls = light_ray(layout, {0, 0, layout.entry()}).direction;
  if (layout.is_mirror()) falls.z = -falls.z; // it is folded
  preset::Preset view;                        // the engine that renders is the default
  view.description = (preset.name.empty() ? "The object" : preset.name) +
                     (layout.is_mirror() ? " as a mirror" : " as glass") + " over its receivers" +
                     otherwise(layout, settings(preset));
  view.unit = preset::Preset::Unit::mm;
  view.white = irradiance * std::abs(falls.z) * luminous_part * reflectance / glm::pi<double>() * brightest;
  view.stop.seconds = 60;
  preset::Scene& scene = view.scene;
  scene.camera = camera(layout, falls);
  scene.materials["receiver"].reflectance.value = reflectance;
  if (layout.is_mirror())
    scene.materials["mirror"].type = preset::Material::Type::mirror;
  else {
    scene.materials["glass"] = glass(layout, preset);
    scene.materials["ground"].reflectance.value = ground_reflectance;
    scene.objects.push_back(ground(layout));
  }
  for (std::size_t j = 0; j < layout.distances.size(); ++j) {
    scene.objects.push_back(receiver_at(layout, j));
    scene.objects.push_back(object_over(layout, j));
    if (layout.is_mirror()) continue; // what passes it falls on the receivers' backs
    for (preset::Object& strip : mask(layout, j, falls)) scene.objects.push_back(std::move(strip));
  }
  preset::Light sun;
  sun.type = preset::Light::Type::directional;
  sun.spectrum = spectrum;
  sun.irradiance_w_m2 = irradiance;
  sun.direction = scene::to_vec3(falls);
  sun.angular_diameter_deg = std::min(disc_deg(layout), widest_disc_deg);
  scene.lights.push_back(sun);
  scene.environment.emplace(); // what glass reflects
  scene.environment->type = preset::Environment::Type::constant;
  scene.environment->radiance = (layout.is_mirror() ? 0.05 : 0.3) * view.white.value(); // no ground hides a mirror's
  return preset::to_json(view) + "\n";
}

} // namespace nephroid::inverse
