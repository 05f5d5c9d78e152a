// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 scene: in metres, +y up, cameras and lights look along -z, as here.
#include "formats/import/description.h"
#include "formats/import/gltf_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nephroid::formats {
namespace {

class GltfReader {
public:
  GltfReader(const GltfFile& file, Description& into) : root_(file.json, file.where()), meshes_(file), d_(into) {
    d_.source = file.file;
    d_.fits_white = true;
    for (const GltfNode& node : nodes_of(file)) {
      if (node.value.has("mesh")) add_mesh(node);
      if (node.value.has("skin")) d_.note("skins are left out: meshes are as they rest");
      if (node.value.has("camera")) add_camera(node);
      if (node.value.object("extensions").has("KHR_lights_punctual")) add_light(node);
    }
    if (!root_.list("animations").empty()) d_.note("animations are left out");
  }

private:
  void add_mesh(const GltfNode& node) {
    const std::size_t index = node.value.index("mesh", root_, "meshes");
    const GltfValue mesh = root_.item("meshes", index);
    const std::string name =
        name_of(node.value.text("name"), name_of(mesh.text("name"), fmt::format("mesh {}", index)));
    const std::vector<GltfValue> primitives = mesh.list("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (primitives[p].count("mode", 4) < 4) {
        d_.note(fmt::format("points and lines of '{}' are left out", name));
        continue;
      }
      if (primitives[p].has("targets")) d_.note("morph targets are left out");
      DescribedShape& shape = d_.shapes.emplace_back();
      shape.where = primitives[p].where();
      shape.name = name;
      shape.to_world = node.to_world;
      shape.material = material(primitives[p]);
      const auto [key, is_new] = keys_.try_emplace({index, p});
      if (is_new) key->second = d_.own_mesh(name, meshes_.read(primitives[p]));
      shape.mesh = key->second;
    }
  }

  std::string material(const GltfValue& primitive) {
    constexpr std::size_t none = ~std::size_t{0};
    const std::size_t index = primitive.has("material") ? primitive.index("material", root_, "materials") : none;
    const auto [found, is_new] = material_names_.try_emplace(index);
    std::string& name = found->second;
    if (!is_new) return name;
    if (index == none) {
      name = unique("plain", taken_materials_);
      d_.materials[name] = {};
      return name;
    }
    const GltfValue value = root_.item("materials", index);
    name = unique(name_of(value.text("name"), fmt::format("material {}", index)), taken_materials_);
    preset::Material& made = d_.materials[name] = material_of(value, name, d_.notes);
    if (made.type != preset::Material::Type::dielectric) return name;
    if (std::string glass = absorbing_glass_file(value, made.dispersion); !glass.empty()) {
      made.dispersion = {};
      made.dispersion.type = preset::Dispersion::Type::file;
      made.dispersion.file = file_name_of(name, ".yml");
      d_.glasses.emplace(made.dispersion.file, std::move(glass));
    }
    return name;
  }

  void add_camera(const GltfNode& node) {
    const GltfValue camera = node.value.item("camera", root_, "cameras");
    if (camera.text("type") != "perspective") return d_.note("a camera without perspective is left out");
    if (d_.camera) return d_.note("only the first camera is taken");
    const GltfValue lens = camera.object("perspective");
    const double fov = lens.number("yfov", 0.7), aspect = std::clamp(lens.number("aspectRatio", 1), 0.1, 10.0);
    DescribedCamera& made = d_.camera.emplace();
    made.where = node.value.where();
    made.fov_deg = glm::degrees(fov);
    made.resolution = aspect >= 1 ? std::array{static_cast<int>(std::lround(512 * aspect)), 512}
                                  : std::array{512, static_cast<int>(std::lround(512 / aspect))};
    const glm::dvec3 up(node.to_world[1]), forward = -glm::dvec3(node.to_world[2]);
    made.to_world = {glm::dvec4(glm::cross(forward, up), 0), glm::dvec4(up, 0), glm::dvec4(forward, 0),
                     node.to_world[3]};
  }

  void add_light(const GltfNode& node) {
    const GltfValue lights = root_.extension("KHR_lights_punctual");
    const GltfValue light = node.value.extension("KHR_lights_punctual").item("light", lights, "lights");
    d_.lamps.push_back(light_of(light, node.to_world,
                                name_of(light.text("name"), name_of(node.value.text("name"), "light")), d_.notes));
  }

  GltfValue root_;
  GltfMeshes meshes_;
  Description& d_;
  std::map<std::pair<std::size_t, std::size_t>, std::string> keys_; ///< keys of meshes by mesh and primitive
  std::map<std::size_t, std::string> material_names_;
  TakenNames taken_materials_;
};

} // namespace

void describe_gltf(const std::filesystem::path& file, Description& into) {
  const GltfFile gltf = read_gltf(file);
  GltfReader(gltf, into);
}

} // namespace nephroid::formats
