// SPDX-License-Identifier: Apache-2.0
#include "tracing/lamp_tables.h"

#include <map>
#include <utility>

namespace nephroid::tracing {
namespace {

lights::Surfaces surfaces_of(const scene::Scene& scene, const scene::Object& object) {
  const bool ellipsoid = object.triangle_count == 0;
  lights::Surfaces surfaces;
  surfaces.first = ellipsoid ? scene.geometry.triangles.size() + object.first_ellipsoid : object.first_triangle;
  for (std::size_t i = 0; i < (ellipsoid ? object.ellipsoid_count : object.triangle_count); ++i)
    surfaces.primitives.push_back(device_primitive(scene, surfaces.first + i));
  return surfaces;
}

} // namespace

std::shared_ptr<const LampTables> make_lamp_tables(const scene::Scene& scene,
                                                   const std::vector<const scene::Light*>& from,
                                                   std::vector<shared::DeviceLight>& lights) {
  LampTables tables;
  tables.surfaces.resize(lights.size());
  std::map<const void*, int> places; // of tables that lights share
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const scene::Light& light = *from[i];
    const void* const shared = light.photometry.get();
    if (shared && places.contains(shared)) {
      lights[i].table = places[shared];
      continue;
    }
    if (light.object >= 0)
      tables.surfaces[i] = surfaces_of(scene, scene.objects[static_cast<std::size_t>(light.object)]);
    const std::vector<float> table = lights::model(light).table(light, tables.surfaces[i], lights[i]);
    if (table.empty()) continue;
    if (tables.lamp_tables.size() + table.size() > std::size_t{1} << 30)
      throw bad_input(Location(scene.source) / "scene" / "lights", "have tables of more than 4 GiB", {},
                      "make their pictures or meshes smaller");
    lights[i].table = static_cast<int>(tables.lamp_tables.size());
    if (shared) places[shared] = lights[i].table;
    tables.lamp_tables.insert(tables.lamp_tables.end(), table.begin(), table.end());
  }
  return tables.lamp_tables.empty() ? nullptr : std::make_shared<const LampTables>(std::move(tables));
}

glm::dvec3 lamp_place(const SceneTables& tables, int light, float x, float y) {
  const auto index = static_cast<std::size_t>(light);
  const shared::DeviceLight& row = tables.lights[index];
  const lights::Model& model = lights::model(row.type);
  if (row.table < 0) return model.place(row, nullptr, {}, {x, y});
  return model.place(row, tables.lamps->lamp_tables.data() + row.table, tables.lamps->surfaces[index], {x, y});
}

} // namespace nephroid::tracing
