// SPDX-License-Identifier: Apache-2.0
#include "formats/export/export.h"

#include "base/build_info.h"
#include "base/files.h"
#include "formats/export/glb.h"
#include "formats/import/description.h"
#include "lights/lights.h"
#include "measure/lab.h"
#include "preset/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using namespace nlohmann::literals;

constexpr const char* surroundings_file = "surroundings.exr";

Json caustic_json(const scene::Scene& scene, const Caustic& caustic) {
  const Receiver& r = caustic.receiver;
  const double metres = scene.metres_per_unit;
  const glm::dvec3 corner = r.centre - 0.5 * r.width * r.right + 0.5 * r.height * r.up;
  return {{"object", scene.objects[static_cast<std::size_t>(r.object)].name},
          {"file", caustic.file},
          {"corner_m", three_numbers(metres * (scene.origin + corner))},
          {"across_m", three_numbers(metres * r.width * r.right)},
          {"down_m", three_numbers(-metres * r.height * r.up)},
          {"front", r.is_front},
          {"luminous_w", caustic.watts}};
}

Json area_lights(const scene::Scene& scene) {
  Json lights = Json::array();
  for (const scene::Light& light : scene.lights) {
    if (!preset::has(light.type, LIGHT_HAS_EDGES)) continue;
    const GltfColour colour = colour_of_light(light.spectrum);
    const double metres = scene.metres_per_unit;
    lights.push_back(
        {{"position_m", three_numbers(metres * (scene.origin + glm::dvec3(light.position)))},
         {"edges_m",
          {three_numbers(metres * glm::dvec3(light.edge_u)), three_numbers(metres * glm::dvec3(light.edge_v))}},
         {"direction", three_numbers(light.direction)},
         {"colour", colour.rgb},
         {"luminous_w", light.power_w * colour.luminous_per_watt}});
  }
  return lights;
}

/// The pictures of caustics of an older export.
std::vector<fs::path> caustics_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!is_there(folder / list_file)) return files;
  try {
    const Json older = Json::parse(read_file(folder / list_file));
    for (const Json& caustic : older.at("caustics"))
      files.push_back(folder /
                      fs::path(caustic.at("file").get<std::string>()).filename()); // nothing outside the folder
  } catch (const Json::exception&) {
    files.clear(); // somebody has changed it
  }
  return files;
}

image::Image picture_of(const scene::Environment& environment) {
  return {.width = environment.width,
          .height = environment.height,
          .channels = {"R", "G", "B"},
          .data = environment.rgb,
          .attributes = {}};
}

std::vector<std::string> left_out(const scene::Scene& scene) {
  std::vector<std::string> notes;
  if (!area_lights(scene).empty())
    notes.push_back("glTF has no area lights: those are in caustics.json, and blender.py makes them");
  if (scene.environment)
    notes.push_back(
        fmt::format("glTF has no surroundings: those are in {}, and blender.py takes them", surroundings_file));
  for (const scene::Object& object : scene.objects)
    if (const std::string note(gltf_surface(material_of(scene, object)).left_out);
        !note.empty() && std::ranges::find(notes, note) == notes.end())
      notes.push_back(note);
  if (any_material(scene, scatter::has_pictures))
    notes.push_back("textures are left out: their surfaces have the colour of their reflectance");
  for (const scene::Light& light : scene.lights)
    if (const std::string note(lights::model(light).left_out(light));
        !note.empty() && std::ranges::find(notes, note) == notes.end())
      notes.push_back(note);
  if (scene.camera.lens_radius > 0) notes.push_back("glTF has no lenses: the camera's aperture is left out");
  if (scene.camera.shift != glm::dvec2(0)) notes.push_back("glTF has no shift: the camera's is left out");
  if (std::ranges::any_of(scene.lights, [](const scene::Light& light) { return !light.inside.empty(); }))
    notes.push_back("a light is inside glass: another renderer may keep its light there");
  return notes;
}

} // namespace

Caustic::Caustic(const scene::Scene& scene, const Receiver& on, const job::Picture& picture)
    : receiver(on), irradiance{.width = picture.width,
                               .height = picture.height,
                               .channels = {"R", "G", "B"},
                               .data = {},
                               .attributes = {}},
      file(fmt::format("caustic-{}-{}", on.object,
                       file_name_of(scene.objects[static_cast<std::size_t>(on.object)].name, ".exr"))) {
  irradiance.attributes["nephroid:unit"] = "luminous W/m^2";
  const double area =
      on.width * on.height * scene.metres_per_unit * scene.metres_per_unit / (picture.width * picture.height);
  for (const job::Layer& layer : picture.layers)
    if (layer.name == "caustic") irradiance.data = layer.rgb;
  for (float& value : irradiance.data) value *= std::numbers::pi_v<float>;
  for (std::size_t i = 0; i < irradiance.data.size(); i += 3) watts += measure::luminance(&irradiance.data[i]) * area;
}

std::vector<std::string> write_export(const fs::path& folder, const scene::Scene& scene, const preset::Preset& preset,
                                      const std::vector<Caustic>& caustics, double white, bool indirect) {
  Json all{{"program", "Nephroid " + version()},
           {"preset", preset.name},
           {"unit", "luminous watts: of 683 lumens"},
           {"white", white},
           {"resolution", {scene.camera.width, scene.camera.height}},
           {"indirect", indirect},
           {"caustics", Json::array()},
           {"matt", Json::object()},
           {"area_lights", area_lights(scene)},
           {"surroundings", nullptr}};
  const std::string glb = gltf_of(scene, preset, caustics).bytes(); // what it throws leaves the older export
  for (const fs::path& old : caustics_in(folder)) fs::remove(old);
  fs::remove(folder / surroundings_file);
  for (const Caustic& caustic : caustics) all["caustics"].push_back(caustic_json(scene, caustic));
  for (const scene::Object& object : scene.objects)
    if (is_matt(material_of(scene, object).type))
      all["matt"][object.name] = colour_of_reflectance(material_of(scene, object).reflectance);
  if (const auto& environment = scene.environment)
    all["surroundings"] = {{"file", surroundings_file},
                           {"radiance", environment->radiance},
                           {"rotate_deg", environment->rotate_deg},
                           {"lights", environment->lights}};
  write_file_whole(folder / list_file, all.dump(2) + "\n"); // first: it says whose folder this is
  for (const Caustic& caustic : caustics) image::write_exr(folder / caustic.file, caustic.irradiance);
  if (scene.environment) image::write_exr(folder / surroundings_file, picture_of(*scene.environment));
  write_file_whole(folder / "scene.glb", glb);
  for (const ExportScript& script : export_scripts()) write_file_whole(folder / script.name, script.text);
  return left_out(scene);
}

} // namespace nephroid::formats
