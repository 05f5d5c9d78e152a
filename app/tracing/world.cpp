// SPDX-License-Identifier: Apache-2.0
#include "tracing/world.h"

namespace nephroid::tracing {

std::uint64_t tree_bytes(const scene::Bvh& bvh) { return bytes_of(bvh.nodes) + bytes_of(bvh.blocks); }

void upload_surfaces(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, SceneBuffers& b)
{
  b.nodes = compute::Buffer(context, "tree nodes", bvh.nodes);
  b.blocks = compute::Buffer(context, "tree triangles", bvh.blocks);
  b.primitives = compute::Buffer(context, "triangles", device_primitives(scene));
}

SceneBuffers upload(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, const SceneTables& tables)
{
  const WavelengthTables& w = tables.wavelengths;
  SceneBuffers b;
  upload_surfaces(context, scene, bvh, b);
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
