// SPDX-License-Identifier: Apache-2.0
#include "tracing/world.h"

namespace nephroid::tracing {
namespace {

/// glm vectors of three floats or unsigned are three plain numbers in a row.
template <class T, class V>
compute::Buffer<T> upload_triples(const compute::Context& context, const char* name, const std::vector<V>& items)
{
  static_assert(sizeof(V) == 3 * sizeof(T));
  return compute::Buffer<T>(context, name, std::span<const T>(reinterpret_cast<const T*>(items.data()), 3 * items.size()));
}

/// As kernels/tracing/surface.h reads them: of an ellipsoid, where in the tree's blocks it is.
std::vector<glm::uvec3> corners_of_primitives(const scene::Mesh& mesh, const scene::Bvh& bvh)
{
  std::vector<glm::uvec3> corners = mesh.triangles;
  for (std::size_t i = 0; i < mesh.ellipsoids.size(); ++i)
    corners.emplace_back(bvh.ellipsoid_places[i], ~0u, mesh.ellipsoids[i].inwards ? 1u : 0u);
  return corners;
}

} // namespace

std::uint64_t tree_bytes(const scene::Bvh& bvh) { return bytes_of(bvh.nodes) + bytes_of(bvh.blocks); }

std::uint64_t surface_bytes(const scene::Scene& scene)
{
  const scene::Mesh& mesh = scene.geometry;
  return bytes_of(mesh.triangles) + bytes_of(mesh.positions) + bytes_of(mesh.normals) + bytes_of(scene.object_of_primitive);
}

void upload_surfaces(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, SceneBuffers& b)
{
  b.nodes = compute::Buffer(context, "tree nodes", bvh.nodes);
  b.blocks = compute::Buffer(context, "tree triangles", bvh.blocks);
  b.positions = upload_triples<float>(context, "vertex positions", scene.geometry.positions);
  b.normals = upload_triples<float>(context, "vertex normals", scene.geometry.normals);
  b.corners = upload_triples<std::uint32_t>(context, "triangle corners", corners_of_primitives(scene.geometry, bvh));
}

SceneBuffers upload(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, const SceneTables& tables)
{
  const WavelengthTables& w = tables.wavelengths;
  SceneBuffers b;
  upload_surfaces(context, scene, bvh, b);
  b.object_of_primitive = compute::Buffer(context, "object of each primitive", scene.object_of_primitive);
  b.objects = compute::Buffer(context, "objects", tables.objects);
  b.materials = compute::Buffer(context, "materials", tables.materials);
  b.lights = compute::Buffer(context, "lights", tables.lights);
  b.targets = compute::Buffer(context, "targets", tables.targets);
  b.index_of_cluster = compute::Buffer(context, "index of refraction of each cluster", w.index_of_cluster);
  b.index_of_wavelength = compute::Buffer(context, "index of refraction of each wavelength", w.index_of_wavelength);
  b.wavelength_cdf = compute::Buffer(context, "choice of a wavelength", w.wavelength_cdf);
  b.index_slope = compute::Buffer(context, "slope of the index of refraction", tables.stretch.index_slope);
  b.stretch_place = compute::Buffer(context, "stretch of each wavelength", tables.stretch.place);
  b.stretch_span = compute::Buffer(context, "stretch of each cluster", tables.stretch.span);
  b.coefficient = compute::Buffer(context, "attenuation", w.coefficient);
  b.reflectance = compute::Buffer(context, "reflectance", w.reflectance);
  b.cluster_cdf = compute::Buffer(context, "cluster choice", w.cluster_cdf);
  b.cluster_first = compute::Buffer(context, "cluster starts", w.cluster_first);
  b.cluster_wavelengths = compute::Buffer(context, "cluster wavelengths", w.cluster_wavelengths);
  b.light_xyz = compute::Buffer(context, "light spectra", w.light_xyz);
  b.reflected_xyz = compute::Buffer(context, "reflected colours by cluster", w.reflected_xyz);
  const SkyTables none, &sky = tables.sky ? *tables.sky : none;
  b.sky_cdf = compute::Buffer(context, "environment as a light, choice of a texel", sky.cdf);
  b.sky_colour = compute::Buffer(context, "environment as a light", sky.colour);
  b.reflected_xyz_all = compute::Buffer(context, "reflected colours", w.reflected_xyz_all);
  return b;
}

World make_world(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, const SceneTables& tables,
                 const compute::Defines& defines, std::uint64_t seed)
{
  World world{context,
              upload(context, scene, bvh, tables),
              tables.scene,
              tables.sky ? tables.sky->size : shared::DeviceBackground{},
              tables.wavelengths.reflector_count,
              defines,
              {}};
  world.scene.root = bvh.root;
  world.seed = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  return world;
}

} // namespace nephroid::tracing
