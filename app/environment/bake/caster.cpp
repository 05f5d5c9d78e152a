// SPDX-License-Identifier: Apache-2.0
#define GLM_ENABLE_EXPERIMENTAL
#include "environment/bake/caster.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/nearest.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtx/euler_angles.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace nephroid::environment {
namespace {

Place objects_place(const std::string& source) { return Place(source) / "environment" / "objects"; }

[[noreturn]] void refuse_name(const preset::Preset& preset, const std::string& name, const Place& where)
{
  std::vector<std::string> candidates;
  for (const preset::Object& object : preset.scene.objects)
    if (casts(preset, object) && !object.name.empty()) candidates.push_back(object.name);
  const bool diffuse = std::ranges::any_of(preset.scene.objects, [&](const preset::Object& o) { return o.name == name; });
  const std::string near = nearest(name, candidates);
  throw bad_input(where, fmt::format("'{}' is {}", name, diffuse ? "neither of glass nor a mirror" : "no object of the scene"),
                  candidates.empty() ? "expected an object of glass or a mirror with a name"
                                     : fmt::format("expected one of {}", fmt::join(candidates, ", ")),
                  near.empty() ? "" : fmt::format("did you mean '{}'?", near));
}

std::size_t index_of(const preset::Preset& preset, const std::string& name, const Place& where)
{
  const auto& objects = preset.scene.objects;
  const auto found =
      std::ranges::find_if(objects, [&](const preset::Object& o) { return !name.empty() && o.name == name && casts(preset, o); });
  if (found == objects.end()) refuse_name(preset, name, where);
  return static_cast<std::size_t>(found - objects.begin());
}

/// Without the rounding of what was computed in double, and without -0: what is turned and moved together keeps its bits.
double rounded(double value) { return std::round(value * 1e9) * 1e-9 + 0.0; }

/// Of an object in the frame of the first: its rotation R and translation T become R1^-1 R and R1^-1 (T - T1).
preset::Transform in_frame(const preset::Transform& object, const preset::Transform& first)
{
  const glm::dmat3 back = glm::transpose(scene::rotation(first.rotate_deg));
  const auto vector = [](const preset::Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
  const glm::dvec3 translate = back * (vector(object.translate) - vector(first.translate));
  glm::dmat3 turn = back * scene::rotation(object.rotate_deg);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) turn[column][row] = rounded(turn[column][row]);
  // About x, then y, then z, so that the matrix is Z Y X, and glm names the angles in the order of this product.
  glm::dvec3 angles(0);
  glm::extractEulerAngleZYX(glm::dmat4(turn), angles.z, angles.y, angles.x);
  preset::Transform result = object;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<glm::length_t>(k);
    result.rotate_deg[k] = rounded(angles[axis] * 180 / std::numbers::pi);
    result.translate[k] = rounded(translate[axis]);
  }
  return result;
}

/// The preset of these objects alone. Photons have the wavelengths of D65; white_light() says what each counts.
preset::Preset alone(const preset::Preset& preset, const std::vector<std::size_t>& objects)
{
  preset::Preset alone;
  alone.source = preset.source;
  alone.unit = preset.unit;
  alone.scene.damaged_meshes = preset.scene.damaged_meshes;
  for (const std::size_t index : objects) {
    preset::Object object = preset.scene.objects[index];
    object.transform = in_frame(object.transform, preset.scene.objects[objects.front()].transform);
    alone.scene.materials[object.material] = preset.scene.materials.at(object.material);
    alone.scene.objects.push_back(object);
  }
  preset::Light sun;
  sun.type = preset::Light::Type::directional;
  alone.scene.lights = {sun};
  return alone;
}

std::string name_of(const preset::Preset& preset, const std::vector<std::size_t>& objects)
{
  std::vector<std::string> names;
  for (const std::size_t index : objects) {
    const std::string& name = preset.scene.objects[index].name;
    names.push_back(name.empty() ? fmt::format("object {}", index) : fmt::format("object '{}'", name));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

template <class T>
std::uint64_t hash_items(const T& items, std::uint64_t hash)
{
  using Item = std::remove_cvref_t<decltype(items[0])>;
  static_assert(std::is_standard_layout_v<Item>);
  return hash_of({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)}, hash);
}

} // namespace

bool casts(const preset::Preset& preset, const preset::Object& object)
{
  const auto material = preset.scene.materials.find(object.material);
  return material != preset.scene.materials.end() && material->second.type != preset::Material::Type::diffuse;
}

std::vector<std::size_t> caster_objects(const preset::Preset& preset)
{
  const std::vector<std::string>& wanted = settings(preset).objects;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Place where = objects_place(preset.source) / i;
    const std::size_t index = index_of(preset, wanted[i], where);
    if (std::ranges::count(found, index)) throw bad_input(where, fmt::format("'{}' is named twice", wanted[i]), "expected each name once");
    found.push_back(index);
  }
  if (wanted.empty())
    for (std::size_t i = 0; i < preset.scene.objects.size(); ++i)
      if (casts(preset, preset.scene.objects[i])) found.push_back(i);
  if (found.empty())
    throw bad_input(objects_place(preset.source), "no object of the scene is of glass or a mirror, so there are no caustics",
                    "expected such an object", "add one, or give an object another material");
  std::ranges::sort(found);
  return found;
}

Caster make_caster(const preset::Preset& preset)
{
  Caster caster;
  caster.objects = caster_objects(preset);
  caster.name = name_of(preset, caster.objects);
  caster.scene = scene::load_scene(alone(preset, caster.objects));
  scene::Bounds box;
  for (std::size_t i = 0; i < caster.objects.size(); ++i) {
    const scene::Object& object = caster.scene.objects[i];
    if (is_empty(object))
      throw bad_input(Place(preset.source) / "scene" / "objects" / caster.objects[i], "has no surface", "expected one to bake");
    box = enclosing(box, bounds_of(caster.scene, object));
  }
  const glm::dvec3 sides = box.high - box.low;
  caster.size = std::max({sides.x, sides.y, sides.z});
  caster.extent = extent_of(caster.scene);
  return caster;
}

std::vector<double> sphere_radii(const Settings& settings, const Caster& caster, const std::string& source)
{
  const double largest = settings.reach * caster.size, smallest = std::max(1.001 * caster.extent.nearest, 0.05 * caster.size);
  if (largest < 1.001 * caster.extent.farthest)
    throw bad_input(Place(source) / "environment" / "reach",
                    fmt::format("is {}: a sphere of radius {:.4g} does not enclose {}, which reaches {:.4g} from its middle",
                                settings.reach, largest, caster.name, caster.extent.farthest),
                    fmt::format("expected at least {:.3g}", std::ceil(1001 * caster.extent.farthest / caster.size) / 1000));
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
  hash = hash_items(mesh.positions, hash);
  hash = hash_items(mesh.triangles, hash);
  for (const scene::Ellipsoid& e : mesh.ellipsoids) {
    hash = hash_items(e.half_axes, hash);
    hash = hash_of(fmt::format("{} {} {} {}", e.centre.x, e.centre.y, e.centre.z, e.inwards), hash);
  }
  if (std::ranges::any_of(caster.scene.objects, &scene::Object::smooth)) hash = hash_items(mesh.normals, hash);
  for (const scene::Object& object : caster.scene.objects) {
    const scene::Material& material = material_of(caster.scene, object);
    // Of priorities the order alone matters.
    const auto rank = std::ranges::count_if(caster.scene.objects, [&](const scene::Object& o) { return o.priority < object.priority; });
    hash = hash_of(fmt::format("{} {} {} {} {} {}", object.triangle_count, object.ellipsoid_count, static_cast<int>(material.type),
                               object.smooth, material.absorbs, rank),
                   hash);
    for (const optics::Spectrum* spectrum : {&material.n, &material.k, &material.reflectance}) hash = hash_items(*spectrum, hash);
  }
  return hash;
}

// A point that the object has at p without its rotation R and its translation T is at R p + T in the preset.
Placement placement(const preset::Preset& preset, const Caster& caster, const scene::Scene& scene)
{
  const preset::Transform& transform = preset.scene.objects.at(caster.objects.front()).transform;
  const glm::dmat3 turn = scene::rotation(transform.rotate_deg);
  const glm::dvec3 translate(transform.translate[0], transform.translate[1], transform.translate[2]);
  return {turn, turn * caster.scene.origin + translate - scene.origin};
}

} // namespace nephroid::environment
