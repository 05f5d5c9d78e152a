// SPDX-License-Identifier: Apache-2.0
#include "tracing/world.h"

namespace nephroid::tracing {
namespace {

#define ADD_BYTES(type, name, words) bytes += bytes_of(from.name);
#define UPLOAD(type, name, words) buffers.name = compute::Buffer(context, words, from.name);

std::uint64_t wavelength_bytes(const WavelengthTables& from) {
  std::uint64_t bytes = 0;
  WAVELENGTH_TABLES(ADD_BYTES)
  COLOUR_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t stretch_bytes(const StretchTables& from) {
  std::uint64_t bytes = 0;
  STRETCH_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t object_bytes(const SceneTables& from) {
  std::uint64_t bytes = 0;
  OBJECT_TABLES(ADD_BYTES)
  TARGET_TABLES(ADD_BYTES)
  return bytes;
}

void upload_objects(const compute::Context& context, const SceneTables& from, SceneBuffers& buffers) {
  OBJECT_TABLES(UPLOAD)
  TARGET_TABLES(UPLOAD)
}

void upload_wavelengths(const compute::Context& context, const WavelengthTables& from, SceneBuffers& buffers) {
  WAVELENGTH_TABLES(UPLOAD)
  COLOUR_TABLES(UPLOAD)
}

void upload_stretch(const compute::Context& context, const StretchTables& from, SceneBuffers& buffers) {
  STRETCH_TABLES(UPLOAD)
}

void upload_sky(const compute::Context& context, const SkyTables& from, SceneBuffers& buffers) { SKY_TABLES(UPLOAD) }

} // namespace

std::uint64_t sky_bytes(const SceneTables& tables) {
  if (!tables.sky) return 0;
  const SkyTables& from = *tables.sky;
  std::uint64_t bytes = 0;
  SKY_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t tree_bytes(const scene::Bvh& bvh) { return bytes_of(bvh.nodes) + bytes_of(bvh.blocks); }

std::vector<plan::PlannedBuffer> planned_buffers(const scene::Scene& scene, const scene::Bvh& bvh,
                                                 const SceneTables& tables) {
  std::vector<plan::PlannedBuffer> rows{
      {"tree", tree_bytes(bvh)},
      {"triangles", scene.object_of_primitive.size() * sizeof(DevicePrimitive)},
      {"objects and lights", object_bytes(tables)},
      {"wavelength tables", wavelength_bytes(tables.wavelengths) + stretch_bytes(tables.stretch)}};
  if (tables.sky) rows.push_back({"environment as a light", sky_bytes(tables)});
  return rows;
}

void upload_surfaces(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh,
                     SceneBuffers& buffers) {
  const struct {
    const std::vector<float>&nodes, &blocks;
    std::vector<DevicePrimitive> primitives;
  } from{bvh.nodes, bvh.blocks, device_primitives(scene)};
  GEOMETRY_TABLES(UPLOAD)
}

SceneBuffers upload(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh,
                    const SceneTables& tables) {
  SceneBuffers buffers;
  upload_surfaces(context, scene, bvh, buffers);
  upload_objects(context, tables, buffers);
  upload_wavelengths(context, tables.wavelengths, buffers);
  upload_stretch(context, tables.stretch, buffers);
  static const SkyTables no_sky;
  upload_sky(context, tables.sky ? *tables.sky : no_sky, buffers);
  return buffers;
}

World make_world(const mpi::RankContext& context, const scene::Scene& scene, const scene::Bvh& bvh,
                 const SceneTables& tables, const compute::Defines& defines, std::uint64_t seed) {
  World world{context, upload(context, scene, bvh, tables), tables.scene, defines, {}};
  world.scene.root = bvh.root;
  world.seed = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  return world;
}

} // namespace nephroid::tracing
