// SPDX-License-Identifier: Apache-2.0
#include "tracing/world.h"

namespace nephroid::tracing {
namespace {

#define ADD_BYTES(type, name, words) bytes += bytes_of(from.name);
#define UPLOAD(type, name, words) buffers.name = compute::Buffer(context, words, from.name);

std::uint64_t object_bytes(const SceneTables& from) {
  std::uint64_t bytes = 0;
  OBJECT_TABLES(ADD_BYTES)
  TARGET_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t wavelength_bytes(const SceneTables& tables) {
  std::uint64_t bytes = 0;
  const auto add = [&](const WavelengthTables& from) { WAVELENGTH_TABLES(ADD_BYTES) COLOUR_TABLES(ADD_BYTES) };
  const auto add_stretch = [&](const StretchTables& from) { STRETCH_TABLES(ADD_BYTES) };
  add(tables.wavelengths);
  add_stretch(tables.stretch);
  return bytes;
}

} // namespace

std::uint64_t sky_bytes(const SceneTables& tables) {
  if (!tables.sky) return 0;
  const SkyTables& from = *tables.sky;
  std::uint64_t bytes = 0;
  SKY_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t texture_bytes(const SceneTables& tables) {
  if (!tables.textures) return 0;
  const TextureTables& from = *tables.textures;
  std::uint64_t bytes = 0;
  TEXTURE_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t lamp_bytes(const SceneTables& tables) {
  if (!tables.lamps) return 0;
  const LampTables& from = *tables.lamps;
  std::uint64_t bytes = 0;
  LAMP_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t tree_bytes(const scene::Bvh& bvh) { return bytes_of(bvh.nodes) + bytes_of(bvh.blocks); }

std::vector<plan::PlannedBuffer> planned_buffers(const scene::Scene& scene, const scene::Bvh& bvh,
                                                 const SceneTables& tables) {
  std::vector<plan::PlannedBuffer> rows{{"tree", tree_bytes(bvh)},
                                        {"triangles", scene.object_of_primitive.size() * sizeof(DevicePrimitive)},
                                        {"objects and lights", object_bytes(tables)},
                                        {"wavelength tables", wavelength_bytes(tables)}};
  if (tables.sky) rows.push_back({"environment as a light", sky_bytes(tables)});
  if (tables.textures) rows.push_back({"textures", texture_bytes(tables)});
  if (tables.lamps) rows.push_back({"lamps", lamp_bytes(tables)});
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
  static const SkyTables no_sky;
  static const TextureTables no_textures;
  static const LampTables no_lamps;
  const auto upload_objects = [&](const SceneTables& from) { OBJECT_TABLES(UPLOAD) TARGET_TABLES(UPLOAD) };
  const auto upload_wavelengths = [&](const WavelengthTables& from) { WAVELENGTH_TABLES(UPLOAD) COLOUR_TABLES(UPLOAD) };
  const auto upload_stretch = [&](const StretchTables& from) { STRETCH_TABLES(UPLOAD) };
  const auto upload_sky = [&](const SkyTables& from) { SKY_TABLES(UPLOAD) };
  upload_objects(tables);
  upload_wavelengths(tables.wavelengths);
  upload_stretch(tables.stretch);
  upload_sky(tables.sky ? *tables.sky : no_sky);
  const auto upload_textures = [&](const TextureTables& from) { TEXTURE_TABLES(UPLOAD) };
  upload_textures(tables.textures ? *tables.textures : no_textures);
  const auto upload_lamps = [&](const LampTables& from) { LAMP_TABLES(UPLOAD) };
  upload_lamps(tables.lamps ? *tables.lamps : no_lamps);
  return buffers;
}

World make_world(const mpi::RankContext& context, const scene::Scene& scene, const scene::Bvh& bvh,
                 const SceneTables& tables, const compute::Defines& defines, std::uint64_t seed) {
  World world{context, upload(context, scene, bvh, tables), tables.scene, defines, {}};
  world.scene.root = bvh.root;
  world.seed = seed_words(seed);
  return world;
}

} // namespace nephroid::tracing
