// SPDX-License-Identifier: Apache-2.0
#include "tracing/omissions.h"

#include "base/counted.h"
#include "lights/lights.h"
#include "preset/choices.h"
#include "scene/scene.h"
#include "tracing/targets.h"
#include "tracing/wavelength_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace nephroid::tracing {
namespace {

using optics::wavelength_count;

constexpr unsigned all_material_types = (1u << MATERIAL_TYPE_COUNT) - 1, all_light_types = (1u << LIGHT_TYPE_COUNT) - 1;

/// False only where all of the object is beyond one side of a plain camera's pyramid, or behind the camera.
bool may_be_in_view(const scene::Scene& scene, const scene::Object& object) {
  if (!scene.camera.is_plain()) return true;
  const scene::Camera& c = scene.camera;
  const glm::dvec3 eye = c.position, right = c.right, up = c.up, forward = c.forward;
  std::array<bool, 5> beyond;
  beyond.fill(true);
  scene::for_each_corner(scene, object, [&](const glm::dvec3& p) {
    const glm::dvec3 way = p - eye;
    const double z = glm::dot(way, forward), x = glm::dot(way, right), y = glm::dot(way, up);
    // Single precision decides which pixel a point is in, so a point outside by less than this counts as inside.
    const double margin = 1e-4 * glm::length(way);
    const double outside[] = {x - c.tan_x * z, -x - c.tan_x * z, y - c.tan_y * z, -y - c.tan_y * z, -z};
    for (std::size_t side = 0; side < beyond.size(); ++side) beyond[side] = beyond[side] && outside[side] > margin;
  });
  return std::ranges::none_of(beyond, [](bool b) { return b; });
}

/// Whether the camera sees all in its view: objects are flat, with the camera and the others on one side of each.
bool nothing_blocks_the_view(const scene::Scene& scene) {
  if (!scene.camera.is_plain()) return false;
  const glm::dvec3 eye = scene.camera.position;
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (may_be_in_view(scene, scene.objects[i])) seen.push_back(i);
  for (const std::size_t i : seen) {
    const std::optional<scene::Plane> plane = scene::plane_of(scene, scene.objects[i]);
    if (!plane) return false;
    const double side = plane->height(eye) > 0 ? 1 : -1;
    if (side * plane->height(eye) <= plane->tolerance) return false;
    for (const std::size_t j : seen) {
      bool behind = false;
      scene::for_each_corner(scene, scene.objects[j], [&](const glm::dvec3& p) {
        behind = behind || side * plane->height(p) < -plane->tolerance;
      });
      if (behind) return false;
    }
  }
  return true;
}

/// Types of material that objects have.
unsigned material_type_bits(const scene::Scene& scene) {
  unsigned bits = 0;
  for (const scene::Object& object : scene.objects)
    bits |= 1u << static_cast<unsigned>(material_of(scene, object).type); // both are of the list MATERIALS
  return bits;
}

/// Types of light that the scene has.
unsigned light_type_bits(const scene::Scene& scene) {
  unsigned bits = 0;
  for (const scene::Light& light : scene.lights) bits |= 1u << lights::type_of(light);
  return bits;
}

bool has_picture(const scene::Light& light) { return light.picture != nullptr; }
bool has_photometry(const scene::Light& light) { return light.photometry != nullptr; }

std::string light_types_reason(unsigned bits) {
  std::vector<std::string_view> names;
  for (const auto& choice : preset::choices<preset::Light::Type>)
    if (bits >> static_cast<int>(choice.value) & 1) names.push_back(choice.name);
  if (bits >> LIGHT_ENVIRONMENT & 1) names.push_back("environment");
  return names.empty() ? "there is no light" : fmt::format("every light is of type {}", fmt::join(names, " or "));
}

} // namespace

bool has_power(const scene::Light& light) { return scene::radiometric(light) > 0; }

std::vector<bool> lit_wavelengths(const scene::Scene& scene) {
  std::vector<bool> lit(wavelength_count, false);
  for (const scene::Light& light : scene.lights)
    for (std::size_t w = 0; w < lit.size(); ++w)
      if (has_power(light) && light.spectrum[w] > 0) lit[w] = true;
  if (std::ranges::none_of(lit, [](bool b) { return b; })) lit.assign(lit.size(), true);
  return lit;
}

ObjectCounts count_objects(const scene::Scene& scene) {
  ObjectCounts counts;
  for (const scene::Object& object : scene.objects) {
    const scatter::Material::Type type = material_of(scene, object).type;
    counts.specular += is_specular(type);
    counts.mirrors += lobes(type) == LOBE_REFLECTION;
    counts.diffuse += is_matt(type);
    counts.smooth += object.smooth;
  }
  return counts;
}

bool may_see_glass_or_mirror(const scene::Scene& scene) {
  if (scene.camera.meter) return false; // it sees its own surface
  return !scene.camera.inside.empty() || std::ranges::any_of(scene.objects, [&](const scene::Object& object) {
    return is_specular(material_of(scene, object).type) && may_be_in_view(scene, object);
  });
}

plan::Decision needed(const std::string& name, std::string reason) {
  return {name, true, std::move(reason), "/leave_out", false};
}

plan::Decision not_needed(const std::string& name, bool leave_out, std::string reason) {
  if (!leave_out) reason += ", but leave_out is false";
  return {name, !leave_out, std::move(reason), "/leave_out", false};
}

std::vector<plan::Decision> data_omissions(const LeaveOut& leave_out, const scene::Scene& scene,
                                           const std::vector<scene::Sphere>& targets) {
  std::vector<plan::Decision> decisions;
  const auto add = [&](const char* name, bool may, std::size_t without, const std::string& reason) {
    if (without > 0) decisions.push_back(not_needed(name, may, reason));
  };
  std::size_t dark = 0, ways = 0, unreached = 0;
  for (const scene::Light& light : scene.lights) {
    dark += !has_power(light);
    for (const scene::Sphere& target : targets) ++ways, unreached += !lights::model(light).reaches(light, target);
  }
  add("dark lights", leave_out.dark_lights, dark,
      fmt::format("{} of {} without power", dark, counted(scene.lights.size(), "light")));
  add("unreached targets", leave_out.unreached_targets, unreached,
      fmt::format("{} of {} from a light to a target {} outside of a spot's cone or behind an area light", unreached,
                  counted(ways, "way"), unreached == 1 ? "is" : "are"));

  const std::vector<bool> lit = lit_wavelengths(scene);
  const auto unlit = static_cast<std::size_t>(std::ranges::count(lit, false));
  add("unlit wavelengths", leave_out.unlit_wavelengths, unlit,
      fmt::format("no light has {} of the {} wavelengths", unlit, lit.size()));
  return decisions;
}

CodeOmissions code_omissions(const LeaveOut& leave_out, const scene::Scene& scene, bool takes_light) {
  const ObjectCounts counts = count_objects(scene);
  const unsigned types = light_type_bits(scene);
  const auto any = [&](bool (*is)(const scatter::Material&)) { return any_material(scene, is); };
  const bool bends = any(scatter::bends), blocked = !nothing_blocks_the_view(scene);
  const bool unsplit = any([](const scatter::Material& material) {
    return lobes(material.type) != LOBE_DIFFUSE && !splits_wavelengths(material);
  });
  const unsigned materials = leave_out.mirrors ? material_type_bits(scene) : all_material_types;
  CodeOmissions omissions;
  // Adds a row, and returns whether its code is compiled.
  const auto has = [&](plan::Decision decision) {
    omissions.decisions.push_back(std::move(decision));
    return omissions.decisions.back().runs;
  };
  const bool occlusion = has(
      blocked ? needed("occlusion", "objects in view may stand before each other")
              : not_needed("occlusion", leave_out.occlusion, "the camera sees flat objects only, none before another"));
  const std::string seen_types = light_types_reason(types);
  const bool every_type = has(types == all_light_types ? needed("light types", seen_types)
                                                       : not_needed("light types", leave_out.light_types, seen_types));
  has(counts.mirrors > 0 ? needed("mirrors", counted(counts.mirrors, "mirror object"))
                         : not_needed("mirrors", leave_out.mirrors, "no object is a mirror"));
  const bool bending =
      has(bends ? needed("bending", "glass has another n than its surroundings, or a coating")
                : not_needed("bending", leave_out.bending, "no glass has another n than 1, and none a coating"));
  const bool attenuation =
      has(takes_light ? needed("attenuation", "glass absorbs, or a surface keeps a part of the light")
          : any(scatter::is_coated)
              ? needed("attenuation", "a coating leaves each wavelength another part")
              : not_needed("attenuation", leave_out.attenuation, "no glass absorbs and no surface is coloured"));
  const bool smooth = has(counts.smooth > 0 ? needed("smooth normals", counted(counts.smooth, "smooth object"))
                          : any(scatter::has_normal_map)
                              ? needed("smooth normals", "a surface has a normal map")
                              : not_needed("smooth normals", leave_out.smooth_normals, "no mesh has smooth normals"));
  const auto flag = [](bool on) { return std::string(on ? "1" : "0"); };
  omissions.defines = {
      {"NEPHROID_OCCLUSION", flag(occlusion)},
      {"NEPHROID_LIGHT_TYPES", std::to_string(every_type ? all_light_types : types)},
      {"NEPHROID_SKY_IS_LIGHT", flag(every_type || (types >> LIGHT_ENVIRONMENT & 1) != 0)},
      {"NEPHROID_DISCS", flag(std::ranges::any_of(scene.lights, scene::has_disc) || !leave_out.light_types)},
      {"NEPHROID_MATERIALS", std::to_string(materials)},
      {"NEPHROID_BENDING", flag(bending)},
      {"NEPHROID_PANES", flag(any(scatter::is_thin) || !leave_out.bending)},
      {"NEPHROID_COATINGS", flag(any(scatter::is_coated) || !leave_out.bending)},
      {"NEPHROID_COATED", flag(any(scatter::is_coated))},
      {"NEPHROID_ROUGH", flag(any(scatter::is_rough) || !leave_out.bending)},
      {"NEPHROID_LIGHT_PICTURES", flag(std::ranges::any_of(scene.lights, has_picture))},
      {"NEPHROID_PHOTOMETRY", flag(std::ranges::any_of(scene.lights, has_photometry))},
      {"NEPHROID_TEXTURES", flag(any(scatter::has_pictures))},
      {"NEPHROID_ROUGHNESS_TEXTURES", flag(any(scatter::has_rough_texture))},
      {"NEPHROID_TINT_TEXTURES", flag(any(scatter::has_tint_texture))},
      {"NEPHROID_NORMAL_MAPS", flag(any(scatter::has_normal_map))},
      {"NEPHROID_TINTS", flag(any(scatter::is_tinted) || !leave_out.attenuation)},
      {"NEPHROID_LOSSES", flag(attenuation)},
      {"NEPHROID_UNSPLIT", flag(unsplit)},
      {"NEPHROID_SMOOTH", flag(smooth)},
      {"NEPHROID_LENS", flag(!scene.camera.is_plain())}};
  return omissions;
}

} // namespace nephroid::tracing
