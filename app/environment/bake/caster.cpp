// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/caster.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/nearest.h"
#include "scene/corners.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <type_traits>

namespace nephroid::environment {
namespace {

Place object_place(const std::string& source) { return Place(source) / "environment" / "object"; }

bool casts(const preset::Preset& preset, const preset::Object& object)
{
  const auto material = preset.scene.materials.find(object.material);
  return material != preset.scene.materials.end() && material->second.type != preset::Material::Type::diffuse;
}

/// Squared distance of the origin from a triangle: to its plane where the foot lies in it, else to the nearest edge.
double distance2(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const auto beyond = [&](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(glm::cross(q - p, -p), normal) < 0; };
  if (glm::dot(normal, normal) > 0 && !beyond(a, b) && !beyond(b, c) && !beyond(c, a)) {
    const double height = glm::dot(a, normal);
    return height * height / glm::dot(normal, normal);
  }
  const auto edge2 = [](const glm::dvec3& p, const glm::dvec3& q) {
    const glm::dvec3 way = q - p;
    const double length2 = glm::dot(way, way), along = length2 > 0 ? std::clamp(-glm::dot(p, way) / length2, 0.0, 1.0) : 0;
    const glm::dvec3 foot = p + along * way;
    return glm::dot(foot, foot);
  };
  return std::min({edge2(a, b), edge2(b, c), edge2(c, a)});
}

/// Fills nearest, farthest, middle_inside. An ellipsoid is an object of its own, so its centre is the middle.
void measure(Caster& caster)
{
  const scene::Scene& s = caster.scene;
  const scene::Object& object = s.objects.front();
  double nearest2 = std::numeric_limits<double>::max(), farthest2 = 0;
  const auto corner = [&](std::uint32_t vertex) { return glm::dvec3(s.geometry.positions[vertex]); };
  for (const glm::uvec3& t : triangles_of(s, object)) {
    nearest2 = std::min(nearest2, distance2(corner(t.x), corner(t.y), corner(t.z)));
    for (int i = 0; i < 3; ++i) farthest2 = std::max(farthest2, glm::dot(corner(t[i]), corner(t[i])));
  }
  caster.nearest = std::sqrt(nearest2);
  caster.farthest = std::sqrt(farthest2);
  caster.middle_inside = scene::winding_number(s.geometry, object.first_triangle, object.triangle_count, glm::dvec3(0)) > 0.5;
  for (const scene::Ellipsoid& ellipsoid : ellipsoids_of(s, object)) {
    caster.nearest = scene::shortest_half_axis(ellipsoid);
    caster.farthest = scene::longest_half_axis(ellipsoid);
    caster.middle_inside = true;
  }
}

/// The preset of the object alone. Photons of white light have the wavelengths of D65, and what each counts baker.cpp's white_light says.
preset::Preset alone(const preset::Preset& preset, std::size_t index)
{
  preset::Preset made;
  made.source = preset.source;
  made.unit = preset.unit;
  made.scene.damaged_meshes = preset.scene.damaged_meshes;
  preset::Object object = preset.scene.objects[index];
  object.transform.rotate_deg = object.transform.translate = {0, 0, 0};
  object.priority = 0;
  made.scene.materials[object.material] = preset.scene.materials.at(object.material);
  made.scene.objects = {object};
  preset::Light sun;
  sun.type = preset::Light::Type::directional;
  made.scene.lights = {sun};
  return made;
}

template <class T>
std::uint64_t hash_items(const T& items, std::uint64_t hash)
{
  using Item = std::remove_cvref_t<decltype(items[0])>;
  static_assert(std::is_standard_layout_v<Item>);
  return hash_of({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)}, hash);
}

} // namespace

std::size_t caster_index(const preset::Preset& preset)
{
  const std::string& wanted = settings(preset).object;
  std::vector<std::string> candidates;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < preset.scene.objects.size(); ++i) {
    const preset::Object& object = preset.scene.objects[i];
    if (!casts(preset, object)) continue;
    if (!object.name.empty()) candidates.push_back(object.name);
    if (wanted.empty() || object.name == wanted) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  const std::string names =
      candidates.empty() ? "an object of glass or a mirror with a name" : fmt::format("one of {}", fmt::join(candidates, ", "));
  if (found.size() > 1)
    throw bad_input(object_place(preset.source),
                    fmt::format("is not given, and {} objects of the scene are of glass or mirrors", found.size()), "expected " + names);
  if (wanted.empty())
    throw bad_input(object_place(preset.source), "no object of the scene is of glass or a mirror, so there are no caustics",
                    "expected such an object", "add one, or give an object another material");
  const bool diffuse = std::ranges::any_of(preset.scene.objects, [&](const preset::Object& o) { return o.name == wanted; });
  const std::string near = nearest(wanted, candidates);
  throw bad_input(object_place(preset.source),
                  fmt::format("'{}' is {}", wanted, diffuse ? "neither of glass nor a mirror" : "no object of the scene"),
                  "expected " + names, near.empty() ? "" : fmt::format("did you mean '{}'?", near));
}

Caster make_caster(const preset::Preset& preset)
{
  const std::size_t index = caster_index(preset);
  Caster caster;
  caster.objects = {index};
  caster.scene = scene::load_scene(alone(preset, index));
  const scene::Object& object = caster.scene.objects.front();
  caster.name = object.name.empty() ? fmt::format("object {}", index) : fmt::format("object '{}'", object.name);
  if (is_empty(object)) throw bad_input(Place(preset.source) / "scene" / "objects" / index, "has no surface", "expected one to bake");
  const scene::Bounds box = bounds_of(caster.scene, object);
  const glm::dvec3 sides = box.high - box.low;
  caster.size = std::max({sides.x, sides.y, sides.z});
  measure(caster);
  return caster;
}

std::vector<double> sphere_radii(const Settings& settings, const Caster& caster, const std::string& source)
{
  const double largest = settings.reach * caster.size, smallest = std::max(1.001 * caster.nearest, 0.05 * caster.size);
  if (largest < 1.001 * caster.farthest)
    throw bad_input(Place(source) / "environment" / "reach",
                    fmt::format("is {}: a sphere of radius {:.4g} does not enclose {}, which reaches {:.4g} from its middle",
                                settings.reach, largest, caster.name, caster.farthest),
                    fmt::format("expected at least {:.3g}", std::ceil(1001 * caster.farthest / caster.size) / 1000));
  std::vector<double> radii;
  for (int i = 0; i < settings.spheres; ++i) {
    const double part = static_cast<double>(i) / (settings.spheres - 1);
    radii.push_back(smallest + (largest - smallest) * (settings.radii == Settings::Radii::quadratic ? part * part : part));
  }
  return radii;
}

std::uint64_t bake_key(const preset::Preset& preset, const Caster& caster)
{
  const Settings& s = settings(preset);
  std::uint64_t hash = hash_of(fmt::format("{} {} {} {} {} {} {} {} {}", s.directions, s.spheres, static_cast<int>(s.radii), s.reach,
                                           s.resolution, s.photons, preset.seed, preset.leave_out, caster.scene.metres_per_unit));
  const scene::Mesh& mesh = caster.scene.geometry;
  const scene::Object& object = caster.scene.objects.front();
  hash = hash_items(mesh.positions, hash);
  hash = hash_items(mesh.triangles, hash);
  if (object.smooth) hash = hash_items(mesh.normals, hash);
  for (const scene::Ellipsoid& e : mesh.ellipsoids) {
    hash = hash_items(e.half_axes, hash);
    hash = hash_of(e.inwards ? "inwards" : "outwards", hash);
  }
  const scene::Material& material = material_of(caster.scene, object);
  hash = hash_of(fmt::format("{} {} {}", static_cast<int>(material.type), object.smooth, material.absorbs), hash);
  for (const optics::Spectrum* spectrum : {&material.n, &material.k, &material.reflectance}) hash = hash_items(*spectrum, hash);
  return hash;
}

} // namespace nephroid::environment
