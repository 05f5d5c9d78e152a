// SPDX-License-Identifier: Apache-2.0
#include "environment/occlusion/surroundings.h"

#include "optics/wavelength.h"
#include "scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nephroid::environment {
namespace {

/// Adds objects to a scene, each with the vertices that its triangles use.
class Copier {
public:
  Copier(const scene::Scene& from, scene::Scene& to) : from_(from), to_(to), places_(from.geometry.positions.size(), nowhere) {}

  void add(const scene::Object& object)
  {
    scene::Object added = object;
    added.first_triangle = static_cast<std::uint32_t>(to_.geometry.triangles.size());
    added.first_ellipsoid = static_cast<std::uint32_t>(to_.geometry.ellipsoids.size());
    for (const glm::uvec3& triangle : triangles_of(from_, object))
      to_.geometry.triangles.emplace_back(place_of(triangle.x), place_of(triangle.y), place_of(triangle.z));
    for (const scene::Ellipsoid& ellipsoid : ellipsoids_of(from_, object)) to_.geometry.ellipsoids.push_back(ellipsoid);
    to_.objects.push_back(added);
  }

private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t place_of(std::uint32_t vertex)
  {
    std::uint32_t& place = places_[vertex];
    if (place == nowhere) {
      place = static_cast<std::uint32_t>(to_.geometry.positions.size());
      to_.geometry.positions.push_back(from_.geometry.positions[vertex]);
      to_.geometry.normals.push_back(from_.geometry.normals[vertex]);
    }
    return place;
  }

  const scene::Scene& from_;
  scene::Scene& to_;
  std::vector<std::uint32_t> places_; ///< of each vertex in the new scene
};

bool is_one_of(const std::vector<std::size_t>& caster, std::size_t object) { return std::ranges::count(caster, object) > 0; }

/// Without the caster, and with the others' new numbers.
std::vector<int> renumbered(const std::vector<int>& objects, const std::vector<std::size_t>& caster)
{
  std::vector<int> result;
  for (const int object : objects) {
    const auto index = static_cast<std::size_t>(object);
    if (!is_one_of(caster, index))
      result.push_back(object - static_cast<int>(std::ranges::count_if(caster, [&](std::size_t c) { return c < index; })));
  }
  return result;
}

} // namespace

scene::Scene without_caster(const scene::Scene& scene, const std::vector<std::size_t>& caster)
{
  scene::Scene result;
  result.source = scene.source;
  result.metres_per_unit = scene.metres_per_unit;
  result.origin = scene.origin;
  result.camera = scene.camera;
  result.camera.inside = renumbered(scene.camera.inside, caster);
  result.materials = scene.materials;
  Copier copier(scene, result);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (!is_one_of(caster, i)) copier.add(scene.objects[i]);
  for (const auto count : {&scene::Object::triangle_count, &scene::Object::ellipsoid_count})
    for (std::uint32_t i = 0; i < result.objects.size(); ++i)
      result.object_of_primitive.insert(result.object_of_primitive.end(), result.objects[i].*count, i);
  return result;
}

tracing::World surroundings_world(const compute::Context& context, const scene::Scene& surroundings)
{
  const scene::Bvh bvh = scene::build_bvh(surroundings.geometry);
  return tracing::make_world(context, surroundings, bvh, tracing::make_scene_tables(surroundings, {optics::all_wavelengths()}, {}),
                             scene::tree_defines(bvh), 0);
}

} // namespace nephroid::environment
