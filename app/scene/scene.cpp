// SPDX-License-Identifier: Apache-2.0
// Puts the scene together: materials, then objects in place, then the lights and the camera, which need to know the
// objects.
#include "scene/scene.h"

#include "scatter/spectra.h"
#include "scene/heights.h"
#include "scene/move.h"
#include "scene/object_mesh.h"
#include "scene/placement.h"
#include "scene/sky.h"
#include "scene/states.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace nephroid::scene {
namespace {

void check_names(const std::vector<preset::Object>& objects, const Location& where) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].name.empty()) continue;
    const auto [entry, added] = first.try_emplace(objects[i].name, i);
    if (!added)
      throw bad_input(where / i / "name", fmt::format("'{}' is also object {}", objects[i].name, entry->second),
                      "expected a name of its own");
  }
}

std::string label_of(const preset::Object& object, std::size_t index) {
  return object.name.empty() ? fmt::format("object {}", index) : fmt::format("object '{}'", object.name);
}

/// An object on its way: still in its own coordinates.
struct Pending {
  std::shared_ptr<const Mesh> mesh;
  Placement placement;
  Bounds bounds; ///< in the preset's coordinates
  int material = 0;
  Location where;
};

/// The middle of what bends light, or of everything where nothing does.
glm::dvec3 choose_origin(const std::vector<Pending>& pending, const Scene& scene, const preset::Camera& camera) {
  std::optional<Bounds> bending, all;
  for (const Pending& object : pending) {
    all = all ? enclosing(*all, object.bounds) : object.bounds;
    if (!is_matt(scene.materials[static_cast<std::size_t>(object.material)].type))
      bending = bending ? enclosing(*bending, object.bounds) : object.bounds;
  }
  if (bending) return 0.5 * bending->low + 0.5 * bending->high;
  return all ? 0.5 * all->low + 0.5 * all->high : to_dvec3(camera.target);
}

void append(Scene& scene, const Mesh& mesh) {
  Mesh& all = scene.geometry;
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
  all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
  for (const glm::uvec3& triangle : mesh.triangles) all.triangles.push_back(triangle + first);
  all.ellipsoids.insert(all.ellipsoids.end(), mesh.ellipsoids.begin(), mesh.ellipsoids.end());
  all.texcoords.insert(all.texcoords.end(), mesh.texcoords.begin(), mesh.texcoords.end());
}

/// damaged: what the preset wants done about it. Throws bad_input at the object where that is `refuse`.
void tell_damages(Scene& scene, const std::vector<Damage>& damages, preset::Scene::DamagedMeshes damaged,
                  const std::string& label, const Location& where) {
  for (const Damage& damage : damages) {
    const std::string what = fmt::format("{}: {}", label, damage.what);
    if (damaged == preset::Scene::DamagedMeshes::refuse)
      throw bad_input(where, what, "expected a closed mesh that faces outwards",
                      "mend it, or set scene.damaged_meshes to \"report\"");
    scene.warnings.push_back(damage.done.empty() ? what : what + "; " + damage.done);
  }
}

void add_object(Scene& scene, const preset::Object& object, const Pending& pending,
                preset::Scene::DamagedMeshes damaged) {
  const std::string label = label_of(object, scene.objects.size());
  const scatter::Material& material = scene.materials[static_cast<std::size_t>(pending.material)];
  const bool dielectric = is_body(material);
  using Normals = preset::Object::Normals;
  PlacedMesh placed = place(*pending.mesh, pending.placement, pending.bounds, scene.origin, dielectric,
                            object.normals == Normals::smooth ? object.crease_deg : 180, pending.where);
  for (const std::string& warning : placed.warnings) scene.warnings.push_back(fmt::format("{}: {}", label, warning));
  tell_damages(scene, placed.damages, damaged, label, pending.where);
  if (scene.geometry.triangles.size() + placed.mesh.triangles.size() > max_triangles)
    throw bad_input(pending.where, fmt::format("the scene has more than {} triangles", max_triangles));
  if (!has_pictures(material))
    placed.mesh.texcoords.clear();
  else if (placed.mesh.texcoords.size() != placed.mesh.triangles.size() || placed.mesh.triangles.empty())
    throw bad_input(pending.where, fmt::format("{} has a texture, but no u, v", label),
                    "expected a mesh with texture coordinates, or a shape that is no sphere",
                    "unwrap it in another program, or take the texture away");

  Object result;
  result.name = object.name;
  result.material = pending.material;
  result.priority = object.priority;
  const bool gives_normals = object.mesh ? placed.has_own_normals : object.shape->pillow != 0;
  result.smooth = !placed.mesh.triangles.empty() &&
                  (object.normals == Normals::smooth || (object.normals == Normals::given && gives_normals));
  result.first_vertex = static_cast<std::uint32_t>(scene.geometry.positions.size());
  result.vertex_count = static_cast<std::uint32_t>(placed.mesh.positions.size());
  result.first_triangle = static_cast<std::uint32_t>(scene.geometry.triangles.size());
  result.triangle_count = static_cast<std::uint32_t>(placed.mesh.triangles.size());
  result.first_ellipsoid = static_cast<std::uint32_t>(scene.geometry.ellipsoids.size());
  result.ellipsoid_count = static_cast<std::uint32_t>(placed.mesh.ellipsoids.size());
  result.bounds = placed.bounds;
  result.closed = placed.closed;
  result.first_texcoords = static_cast<std::uint32_t>(scene.geometry.texcoords.size());
  append(scene, placed.mesh);
  scene.objects.push_back(result);
}

} // namespace

double scene_radius(const Scene& scene) {
  double radius = 0;
  for (const Object& object : scene.objects)
    radius = std::max<double>(radius, glm::length(object.bounds.centre) + object.bounds.radius);
  return radius;
}

bool any_material(const Scene& scene, bool (*is)(const scatter::Material&)) {
  return std::ranges::any_of(scene.objects, [&](const Object& object) { return is(material_of(scene, object)); });
}

std::vector<int> dielectrics_around(const Scene& scene, const glm::dvec3& p) {
  std::vector<std::pair<double, int>> found;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!is_body(material_of(scene, object))) continue;
    if (glm::distance(p, glm::dvec3(object.bounds.centre)) > object.bounds.radius) continue;
    double volume = signed_volume(scene.geometry, object.first_triangle, object.triangle_count);
    bool inside = winding_number(scene.geometry, object.first_triangle, object.triangle_count, p) > 0.5;
    for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object)) {
      volume += volume_of(ellipsoid);
      inside = inside || contains(ellipsoid, p);
    }
    if (inside) found.emplace_back(-volume, static_cast<int>(i));
  }
  std::sort(found.begin(), found.end());
  std::vector<int> result;
  for (const auto& [volume, object] : found) result.push_back(object);
  return result;
}

namespace {

FileFinder finder_of(const preset::Preset& preset) {
  return FileFinder(std::filesystem::path(preset.source).parent_path());
}

void add_materials(const preset::Preset& preset, const FileFinder& finder, Scene& scene) {
  const Location where = Location(preset.source) / "scene" / "materials";
  for (const auto& [name, material] : preset.scene.materials)
    scene.materials.push_back(
        scatter::make_material(name, material, finder, where / name, scene.warnings, scene.range));
}

/// The environment is one of them. The objects stand.
void add_lights(const preset::Preset& preset, const FileFinder& finder, Scene& scene) {
  const Location where = Location(preset.source) / "scene";
  for (std::size_t i = 0; i < preset.scene.lights.size(); ++i)
    add_light(preset.scene.lights[i], finder, where / "lights" / i, scene);
  if (const auto& environment = preset.scene.environment) {
    if (std::optional<Light> sun = make_sun(*environment, scene.range)) scene.lights.push_back(std::move(*sun));
    scene.environment = make_environment(*environment, finder, where / "environment", scene.warnings, scene.range);
    if (scene.environment->lights) scene.lights.push_back(make_environment_light(*scene.environment));
  }
  warn_of_faint_lights(scene);
}

} // namespace

bool reaches_beyond_visible(const preset::Preset& preset) {
  const auto& environment = preset.scene.environment;
  return (environment && environment->type == preset::Environment::Type::sky && !is_night(*environment)) ||
         std::ranges::any_of(preset.scene.lights,
                             [](const preset::Light& light) { return scatter::reaches_beyond(light.spectrum); });
}

Scene in_range(const Scene& scene, const preset::Preset& preset, optics::SpectralRange range) {
  Scene made = scene;
  made.range = range;
  made.materials.clear();
  made.lights.clear();
  made.environment.reset();
  made.warnings.clear();
  const FileFinder finder = finder_of(preset);
  add_materials(preset, finder, made);
  add_lights(preset, finder, made);
  return made;
}

Scene load_scene(const preset::Preset& preset, const Watch& watch) {
  const FileFinder finder = finder_of(preset);
  const Location where = Location(preset.source) / "scene";
  Scene scene;
  scene.source = preset.source;
  scene.metres_per_unit = preset::metres(preset.unit);
  add_materials(preset, finder, scene);
  check_names(preset.scene.objects, where / "objects");
  // Each file is read once, however many objects name it and however large it is.
  std::map<std::filesystem::path, std::shared_ptr<const Mesh>> meshes;
  const auto mesh_of = [&](const preset::Object& object, std::size_t index) {
    const Location at = where / "objects" / index;
    if (object.shape && has_heights(*object.shape))
      return std::make_shared<const Mesh>(make_heights(*object.shape, scene.metres_per_unit, finder, at / "shape",
                                                       label_of(object, index), scene.warnings));
    if (object.shape) return std::make_shared<const Mesh>(make_shape(*object.shape));
    return deformed_mesh(object, at, [&](const std::string& name, const Location& place) {
      const std::filesystem::path file = finder.find(name, place);
      if (!meshes.contains(file)) meshes[file] = load_mesh_once(file, watch);
      return meshes[file];
    });
  };
  std::vector<Pending> pending;
  for (std::size_t i = 0; i < preset.scene.objects.size(); ++i) {
    const preset::Object& object = preset.scene.objects[i];
    const Location object_where = where / "objects" / i;
    const auto material =
        std::ranges::find(scene.materials, object.material, &scatter::Material::name) - scene.materials.begin();
    const std::shared_ptr<const Mesh> mesh = mesh_of(object, i);
    const Placement placement = make_placement(object.transform, *mesh);
    pending.push_back(
        {mesh, placement, placed_bounds(*mesh, placement, object_where), static_cast<int>(material), object_where});
  }
  watch.begin("looking at the objects");
  scene.origin = choose_origin(pending, scene, preset.scene.camera);
  for (std::size_t i = 0; i < pending.size(); ++i) {
    add_object(scene, preset.scene.objects[i], pending[i], preset.scene.damaged_meshes);
    pending[i].mesh.reset(); // a large scene is not held twice
  }
  for (const auto count : {&Object::triangle_count, &Object::ellipsoid_count})
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
      scene.object_of_primitive.insert(scene.object_of_primitive.end(), scene.objects[i].*count, i);
  const std::vector<std::size_t> first = first_copies(preset.scene);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i] != i)
      scene.warnings.push_back(fmt::format("{} is a copy of {} in the same place; remove one of them",
                                           label_of(preset.scene.objects[i], i),
                                           label_of(preset.scene.objects[first[i]], first[i])));
  part_touching(scene, first);
  add_lights(preset, finder, scene);
  scene.camera = make_camera(preset.scene.camera, scene);
  return scene;
}

std::span<const glm::uvec3> triangles_of(const Scene& scene, const Object& object) {
  const std::span<const glm::uvec3> all = scene.geometry.triangles;
  if (object.first_triangle > all.size() || object.triangle_count > all.size() - object.first_triangle)
    throw failed(scene.source, fmt::format("object '{}' has triangles that the scene does not hold", object.name),
                 fmt::format("expected triangles {} to {} among {}", object.first_triangle,
                             std::uint64_t{object.first_triangle} + object.triangle_count, all.size()));
  return all.subspan(object.first_triangle, object.triangle_count);
}

std::span<const glm::vec3> vertices_of(const Scene& scene, const Object& object) {
  const std::span<const glm::vec3> positions = scene.geometry.positions;
  if (object.first_vertex > positions.size() || object.vertex_count > positions.size() - object.first_vertex)
    throw failed(scene.source, fmt::format("object '{}' has vertices that the scene does not hold", object.name));
  return positions.subspan(object.first_vertex, object.vertex_count);
}

std::span<const Ellipsoid> ellipsoids_of(const Scene& scene, const Object& object) {
  const std::span<const Ellipsoid> all = scene.geometry.ellipsoids;
  if (object.first_ellipsoid + object.ellipsoid_count > all.size())
    throw failed(scene.source, fmt::format("object '{}' has ellipsoids that the scene does not hold", object.name));
  return all.subspan(object.first_ellipsoid, object.ellipsoid_count);
}

Bounds enclosing(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

Bounds bounds_of(const Ellipsoid& ellipsoid) {
  const glm::dvec3 centre = ellipsoid.centre, half = half_extent(ellipsoid);
  return {centre - half, centre + half};
}

Bounds bounds_of(const Scene& scene, const Object& object) {
  Bounds bounds;
  for (const glm::dvec3 p : vertices_of(scene, object)) bounds = enclosing(bounds, {p, p});
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object)) bounds = enclosing(bounds, bounds_of(ellipsoid));
  return bounds;
}

std::optional<Plane> plane_of(const Scene& scene, const Object& object) {
  if (object.triangle_count == 0) return std::nullopt;
  const glm::uvec3 first = triangles_of(scene, object).front();
  const auto corner = [&](std::uint32_t vertex) { return glm::dvec3(scene.geometry.positions[vertex]); };
  Plane plane{corner(first.x),
              glm::normalize(glm::cross(corner(first.y) - corner(first.x), corner(first.z) - corner(first.x))), 0};
  double largest = 0, highest = 0;
  for_each_corner(scene, object, [&](const glm::dvec3& p) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    highest = std::max(highest, std::abs(plane.height(p)));
  });
  plane.tolerance = 1e-6 * largest;
  return highest <= plane.tolerance ? std::optional(plane) : std::nullopt;
}

} // namespace nephroid::scene
