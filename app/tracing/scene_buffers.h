// SPDX-License-Identifier: Apache-2.0
// The tables of scene_tables.h on a device.
#pragma once
#include "compute/compute.h"
#include "scene/bvh.h"
#include "tracing/scene_tables.h"

#include <span>
#include <vector>

namespace nephroid::tracing {

struct SceneBuffers {
  compute::Buffer<float> nodes, blocks, positions, normals;
  compute::Buffer<std::uint32_t> corners, object_of_primitive;
  compute::Buffer<shared::DeviceObject> objects;
  compute::Buffer<shared::DeviceMaterial> materials;
  compute::Buffer<shared::DeviceLight> lights;
  compute::Buffer<shared::DeviceTarget> targets;
  compute::Buffer<float> index_of_cluster, index_of_wavelength, wavelength_cdf, index_slope, coefficient, reflectance, cluster_cdf, sky_cdf,
      sky_colour;
  compute::Buffer<int> cluster_first, cluster_wavelengths;
  compute::Buffer<shared::float4> light_xyz, reflected_xyz, reflected_xyz_all, stretch_place, stretch_span;
};

/// One table. Throws as upload.
template <class T>
compute::Buffer<T> upload_vector(const compute::Context& context, const char* name, const std::vector<T>& items)
{
  return compute::Buffer<T>(context, name, std::span<const T>(items));
}

/// What a scene's tree and its triangles take, in bytes.
std::uint64_t tree_bytes(const scene::Bvh& bvh);
std::uint64_t surface_bytes(const scene::Scene& scene);

/// Of the tables those that say where surfaces are; the others stay. Throws as upload.
void upload_surfaces(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, SceneBuffers& buffers);

/// Throws failed where the device has not enough memory.
SceneBuffers upload(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh, const SceneTables& tables);

} // namespace nephroid::tracing
