// SPDX-License-Identifier: Apache-2.0
#include "tracing/world.h"

#include <span>
#include <utility>

namespace nephroid::tracing {
namespace {

/// The bytes that a table takes in its block.
template <class T>
std::uint64_t block_bytes(const std::vector<T>& table) {
  return (bytes_of(table) + TABLE_STEP - 1) / TABLE_STEP * TABLE_STEP;
}

/// Tables that become one block. They must live until it is uploaded.
class TableBlock {
public:
  /// Returns where the table begins, in steps.
  template <class T>
  std::uint32_t add(const std::vector<T>& table) {
    const std::uint64_t begin = bytes_;
    parts_.push_back({begin, {reinterpret_cast<const std::uint8_t*>(table.data()), bytes_of(table)}});
    bytes_ += block_bytes(table);
    return static_cast<std::uint32_t>(begin / TABLE_STEP);
  }

  compute::Buffer<std::uint8_t> upload(const compute::Context& context, const char* name) const {
    compute::Buffer<std::uint8_t> block(context, name, bytes_);
    for (const auto& [begin, bytes] : parts_)
      if (!bytes.empty()) block.write(bytes, begin);
    return block;
  }

private:
  std::vector<std::pair<std::uint64_t, std::span<const std::uint8_t>>> parts_;
  std::uint64_t bytes_ = 0;
};

#define ADD_BYTES(type, name, words) bytes += block_bytes(from.name);
#define ADD_TO_BLOCK(type, name, words) buffers.first.name = block.add(from.name);

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

std::uint64_t meter_bytes(const SceneTables& tables) {
  if (!tables.meter) return 0;
  const MeterTables& from = *tables.meter;
  std::uint64_t bytes = from.meter_chances.size() * sizeof(DevicePrimitive);
  METER_TABLES(ADD_BYTES)
  return bytes;
}

std::uint64_t tree_bytes(const scene::Bvh& bvh) { return block_bytes(bvh.nodes) + block_bytes(bvh.blocks); }

std::vector<plan::PlannedBuffer> planned_buffers(const scene::Scene& scene, const scene::Bvh& bvh,
                                                 const SceneTables& tables) {
  std::vector<plan::PlannedBuffer> rows{
      {"tree", tree_bytes(bvh)},
      {"triangles",
       (scene.object_of_primitive.size() * sizeof(DevicePrimitive) + TABLE_STEP - 1) / TABLE_STEP * TABLE_STEP},
      {"objects and lights", object_bytes(tables)},
      {"wavelength tables", wavelength_bytes(tables)}};
  if (tables.sky) rows.push_back({"environment as a light", sky_bytes(tables)});
  if (tables.textures) rows.push_back({"textures", texture_bytes(tables)});
  if (tables.lamps) rows.push_back({"lamps", lamp_bytes(tables)});
  if (tables.meter) rows.push_back({"meter", meter_bytes(tables)});
  return rows;
}

void upload_surfaces(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh,
                     SceneBuffers& buffers) {
  const struct {
    const std::vector<float>&nodes, &blocks;
    std::vector<DevicePrimitive> primitives;
  } from{bvh.nodes, bvh.blocks, device_primitives(scene)};
  TableBlock block;
  GEOMETRY_TABLES(ADD_TO_BLOCK)
  buffers.geometry = block.upload(context, "tree and triangles");
}

SceneBuffers upload(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh,
                    const SceneTables& tables) {
  SceneBuffers buffers;
  upload_surfaces(context, scene, bvh, buffers);
  static const SkyTables no_sky;
  static const TextureTables no_textures;
  static const LampTables no_lamps;
  static const MeterTables no_meter;
  TableBlock block;
  const auto add_objects = [&](const SceneTables& from) { OBJECT_TABLES(ADD_TO_BLOCK) TARGET_TABLES(ADD_TO_BLOCK) };
  const auto add_wavelengths = [&](const WavelengthTables& from) {
    WAVELENGTH_TABLES(ADD_TO_BLOCK) COLOUR_TABLES(ADD_TO_BLOCK)
  };
  const auto add_stretch = [&](const StretchTables& from) { STRETCH_TABLES(ADD_TO_BLOCK) };
  const auto add_sky = [&](const SkyTables& from) { SKY_TABLES(ADD_TO_BLOCK) };
  const auto add_textures = [&](const TextureTables& from) { TEXTURE_TABLES(ADD_TO_BLOCK) };
  const auto add_lamps = [&](const LampTables& from) { LAMP_TABLES(ADD_TO_BLOCK) };
  const auto add_meter = [&](const MeterTables& from) { METER_TABLES(ADD_TO_BLOCK) };
  add_objects(tables);
  add_wavelengths(tables.wavelengths);
  add_stretch(tables.stretch);
  add_sky(tables.sky ? *tables.sky : no_sky);
  add_textures(tables.textures ? *tables.textures : no_textures);
  add_lamps(tables.lamps ? *tables.lamps : no_lamps);
  add_meter(tables.meter ? *tables.meter : no_meter);
  buffers.tables = block.upload(context, "the scene's tables");
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
