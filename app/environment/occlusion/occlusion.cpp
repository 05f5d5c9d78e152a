// SPDX-License-Identifier: Apache-2.0
#include "environment/occlusion/occlusion.h"

#include <algorithm>

namespace nephroid::environment {
namespace {

double sum(const glm::dvec3& v) { return v.x + v.y + v.z; }

/// Adds one of the objects of another scene.
void add_object(const scene::Scene& from, const scene::Object& object, scene::Scene& to) {
  const auto append = [](auto& values, const auto& others, std::uint32_t first, std::uint32_t count) {
    values.insert(values.end(), others.begin() + first, others.begin() + first + count);
  };
  const scene::Mesh& mesh = from.geometry;
  scene::Mesh& result = to.geometry;
  scene::Object added = object;
  added.first_vertex = static_cast<std::uint32_t>(result.positions.size());
  added.first_triangle = static_cast<std::uint32_t>(result.triangles.size());
  added.first_ellipsoid = static_cast<std::uint32_t>(result.ellipsoids.size());
  added.first_texcoords = static_cast<std::uint32_t>(result.texcoords.size());
  append(result.positions, mesh.positions, object.first_vertex, object.vertex_count);
  append(result.normals, mesh.normals, object.first_vertex, object.vertex_count);
  for (const glm::uvec3& triangle : triangles_of(from, object))
    result.triangles.push_back(triangle - object.first_vertex + added.first_vertex);
  append(result.ellipsoids, mesh.ellipsoids, object.first_ellipsoid, object.ellipsoid_count);
  if (has_pictures(material_of(from, object)))
    append(result.texcoords, mesh.texcoords, object.first_texcoords, object.triangle_count);
  to.objects.push_back(added);
}

bool is_one_of(const std::vector<std::size_t>& caster, std::size_t object) {
  return std::ranges::count(caster, object) > 0;
}

/// The objects without the caster, and with the others' new numbers.
std::vector<int> renumbered(const std::vector<int>& objects, const std::vector<std::size_t>& caster) {
  std::vector<int> result;
  for (const int object : objects) {
    const auto index = static_cast<std::size_t>(object);
    if (!is_one_of(caster, index))
      result.push_back(object -
                       static_cast<int>(std::ranges::count_if(caster, [&](std::size_t c) { return c < index; })));
  }
  return result;
}

} // namespace

std::vector<VisibleLight> whole_lights(const Segmentation& segmentation) {
  std::vector<VisibleLight> lights;
  for (const Region& region : segmentation.lights) lights.push_back({region.flux, region.direction});
  return lights;
}

Occlusion::Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube)
    : whole_(whole_lights(segmentation)), samples_(sample_lights(segmentation, cube)) {
  std::vector<shared::float4> directions;
  for (const LightSample& sample : samples_) directions.push_back(tracing::to_float4(sample.direction));
  directions_ = compute::Buffer(context, "directions of the environment's light", directions);
}

std::vector<VisibleLight> Occlusion::visible_lights(tracing::World& surroundings, double rotate_deg,
                                                    const std::vector<glm::dvec3>& from) {
  if (surroundings.buffers.geometry.size() == 0 || whole_.empty()) return whole_;
  const std::vector<std::uint8_t> is_seen = visibility_.free(surroundings, directions_, rotate_deg, from);
  const std::size_t samples = samples_per_light(whole_.size());
  std::vector<VisibleLight> visible = whole_;
  for (std::size_t light = 0; light < visible.size(); ++light) {
    glm::dvec3 flux(0), all(0), hidden(0);
    for (std::size_t i = samples * light; i < samples * (light + 1); ++i) {
      const LightSample& sample = samples_[i];
      const glm::dvec3 way = sum(sample.flux) * sample.direction;
      all += way;
      if (is_seen[i])
        flux += sample.flux;
      else
        hidden += way;
    }
    if (hidden == glm::dvec3(0)) continue;
    VisibleLight& left = visible[light];
    left.flux = glm::min(flux, left.flux);
    // The samples' mean direction is only nearly the region's, so that is moved by what hiding changes.
    const glm::dvec3 shift = all - hidden != glm::dvec3(0) && flux != glm::dvec3(0)
                                 ? glm::normalize(all - hidden) - glm::normalize(all)
                                 : glm::dvec3(0);
    left.direction = glm::normalize(left.direction + shift);
  }
  return visible;
}

std::vector<std::uint8_t> Visibility::free(tracing::World& surroundings,
                                           const compute::Buffer<shared::float4>& directions, double rotate_deg,
                                           const std::vector<glm::dvec3>& from) {
  if (!kernel_.state || defines_ != surroundings.defines) {
    kernel_ = compute::Program(surroundings.context, "environment/visible.cl", surroundings.defines).kernel("visible");
    defines_ = surroundings.defines;
  }
  if (seen_.size() != directions.size())
    seen_ = compute::Buffer<std::uint8_t>(surroundings.context, "what is seen of the environment", directions.size());
  std::vector<shared::float4> points;
  for (const glm::dvec3& point : from) points.push_back(tracing::to_float4(point));
  const auto count = static_cast<std::uint32_t>(directions.size());
  surroundings.run(kernel_, count, 64,
                   {{"directions", directions},
                    {"seen", seen_},
                    {"count", count},
                    {"points", compute::Buffer(surroundings.context, "points that look at the environment", points)},
                    {"last_point", static_cast<std::uint32_t>(points.size() - 1)},
                    {"turned_x", tracing::to_float4(turned({1, 0, 0}, rotate_deg))},
                    {"turned_z", tracing::to_float4(turned({0, 0, 1}, rotate_deg))}});
  return seen_.read();
}

scene::Scene without_caster(const scene::Scene& scene, const std::vector<std::size_t>& caster) {
  scene::Scene result;
  result.source = scene.source;
  result.metres_per_unit = scene.metres_per_unit;
  result.origin = scene.origin;
  result.camera = scene.camera;
  result.camera.inside = renumbered(scene.camera.inside, caster);
  result.materials = scene.materials;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (!is_one_of(caster, i)) add_object(scene, scene.objects[i], result);
  for (const auto count : {&scene::Object::triangle_count, &scene::Object::ellipsoid_count})
    for (std::uint32_t i = 0; i < result.objects.size(); ++i)
      result.object_of_primitive.insert(result.object_of_primitive.end(), result.objects[i].*count, i);
  return result;
}

tracing::World surroundings_world(const mpi::RankContext& context, const scene::Scene& surroundings) {
  const scene::Bvh bvh = scene::build_bvh(surroundings.geometry);
  return tracing::make_world(context, surroundings, bvh,
                             tracing::make_scene_tables(surroundings, {optics::all_wavelengths()}, {}),
                             scene::tree_defines(bvh), 0);
}

} // namespace nephroid::environment
