// SPDX-License-Identifier: Apache-2.0
#include "formats/import/import.h"

#include "base/counted.h"
#include "base/lower_case.h"
#include "formats/import/description.h"
#include "formats/import/gltf_scene.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

using std::numbers::pi;

/// The name, with a number behind it where it is taken.
std::string unique(const std::string& name, std::set<std::string>& taken) {
  std::string free = name;
  for (int n = 2; !taken.insert(free).second; ++n) free = fmt::format("{} {}", name, n);
  return free;
}

class Import {
public:
  Import(const GltfFile& file, fs::path preset)
      : root_(file.json, file.where()), meshes_(file), preset_file_(std::move(preset)) {
    for (const GltfNode& node : nodes_of(file)) {
      if (node.value.has("mesh")) add_mesh(node);
      if (node.value.has("skin")) note("skins are left out: meshes are as they rest");
      if (node.value.has("camera")) add_camera(node);
      if (node.value.object("extensions").has("KHR_lights_punctual")) add_light(node);
    }
    if (root_.has("animations") && !root_.list("animations").empty()) note("animations are left out");
    if (made_.scene.objects.empty())
      throw bad_input(root_.where(), "has no triangles in its scene", "expected meshes of triangles");
    made_.name = preset_file_.stem().string();
    made_.description = "Imported from " + name_of(file.file.filename().string(), "glTF");
    if (!has_camera_) look_at_all();
    if (made_.scene.lights.empty()) light_all();
    expose();
  }

  Imported write() { return write_imported(made_, preset_file_, files_, glasses_, notes_); }

private:
  void note(std::string text) {
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(std::move(text));
  }

  /// Encloses a place that can be seen.
  void see(const glm::dvec3& p) { bounds_ = scene::enclosing(bounds_, {p, p}); }
  glm::dvec3 middle() const { return 0.5 * (bounds_.low + bounds_.high); }
  double size() const { return std::max(glm::length(bounds_.high - bounds_.low), 1e-3); }

  void add_mesh(const GltfNode& node) {
    const std::size_t index = node.value.index("mesh", root_.list("meshes").size(), "meshes");
    const GltfValue mesh = root_.item("meshes", index);
    const std::string name =
        name_of(node.value.text("name"), name_of(mesh.text("name"), fmt::format("mesh {}", index)));
    const auto transform = transform_of(node.to_world);
    const std::vector<GltfValue> primitives = mesh.list("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (const auto mode = primitives[p].count("mode", 4); mode < 4) {
        note(fmt::format("points and lines of '{}' are left out", name));
        continue;
      }
      if (primitives[p].has("targets")) note("morph targets are left out");
      preset::Object object;
      object.name = unique(name, object_names_);
      object.material = material(primitives[p]);
      // A mesh that is sheared or flattened by its node is written as it stands in the world.
      const std::string file = mesh_file({index, p, transform ? 0 : object_names_.size()}, primitives[p], object.name,
                                         transform ? glm::dmat4(1) : node.to_world);
      object.mesh = preset_file_.stem().string() + "-meshes/" + file;
      if (transform) object.transform = *transform;
      if (!files_.at(file).normals.empty()) object.normals = preset::Object::Normals::smooth;
      for (const glm::vec3& v : files_.at(file).positions)
        see(transform ? glm::dvec3(node.to_world * glm::dvec4(glm::dvec3(v), 1)) : glm::dvec3(v));
      made_.scene.objects.push_back(std::move(object));
    }
  }

  /// Mesh, primitive, and 0 or a number of its own.
  using MeshKey = std::array<std::size_t, 3>;

  std::string mesh_file(const MeshKey& key, const GltfValue& primitive, const std::string& name,
                        const glm::dmat4& baked) {
    const auto [found, is_new] = names_.try_emplace(key);
    if (!is_new) return found->second;
    scene::Mesh mesh = meshes_.read(primitive);
    if (baked != glm::dmat4(1)) {
      mesh.normals.clear(); // those of the triangles follow the shear
      for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(baked * glm::dvec4(glm::dvec3(p), 1)));
      if (glm::determinant(glm::dmat3(baked)) < 0)
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    }
    std::string file = name + ".ply";
    std::replace(file.begin(), file.end(), ' ', '-');
    for (int n = 2; files_.contains(file); ++n) file = fmt::format("{}-{}.ply", name, n);
    files_.emplace(file, std::move(mesh));
    return found->second = file;
  }

  std::string material(const GltfValue& primitive) {
    constexpr std::size_t none = ~std::size_t{0};
    const std::size_t index =
        primitive.has("material") ? primitive.index("material", root_.list("materials").size(), "materials") : none;
    const auto [found, is_new] = material_names_.try_emplace(index);
    if (!is_new) return found->second;
    if (index == none) {
      found->second = unique("plain", taken_materials_);
      made_.scene.materials[found->second] = {};
      return found->second;
    }
    const GltfValue value = root_.item("materials", index);
    found->second = unique(name_of(value.text("name"), fmt::format("material {}", index)), taken_materials_);
    preset::Material& made = made_.scene.materials[found->second] = material_of(value, found->second, notes_);
    if (made.type != preset::Material::Type::dielectric) return found->second;
    if (std::string glass = absorbing_glass_file(value, made.dispersion); !glass.empty()) {
      std::string file = found->second + ".yml";
      std::replace(file.begin(), file.end(), ' ', '-');
      made.dispersion = {};
      made.dispersion.type = preset::Dispersion::Type::file;
      made.dispersion.file = preset_file_.stem().string() + "-meshes/" + file;
      glasses_.emplace(std::move(file), std::move(glass));
    }
    return found->second;
  }

  void add_camera(const GltfNode& node) {
    const GltfValue camera = root_.item("cameras", node.value.index("camera", root_.list("cameras").size(), "cameras"));
    if (camera.text("type") != "perspective") return note("a camera without perspective is left out");
    if (std::exchange(has_camera_, true)) return note("only the first camera is taken");
    const GltfValue lens = camera.object("perspective");
    const double fov = lens.number("yfov", 0.7), aspect = std::clamp(lens.number("aspectRatio", 1), 0.1, 10.0);
    preset::Camera& made = made_.scene.camera;
    made.fov_deg = std::clamp(glm::degrees(fov), 0.001, 179.9);
    made.resolution = aspect >= 1 ? std::array{static_cast<int>(std::lround(512 * aspect)), 512}
                                  : std::array{512, static_cast<int>(std::lround(512 / aspect))};
    const glm::dvec3 position(node.to_world[3]), forward = -glm::dvec3(node.to_world[2]), up(node.to_world[1]);
    if (!(glm::length(forward) > 0) || !(glm::length(up) > 0))
      throw bad_input(node.value.where(), "the camera has no direction");
    made.position = scene::to_vec3(position);
    made.up = scene::to_vec3(glm::normalize(up));
    forward_ = glm::normalize(forward);
  }

  void add_light(const GltfNode& node) {
    const GltfValue lights = root_.extension("KHR_lights_punctual");
    const GltfValue own = node.value.extension("KHR_lights_punctual");
    const GltfValue light = lights.item("lights", own.index("light", lights.list("lights").size(), "lights"));
    made_.scene.lights.push_back(
        light_of(light, node.to_world, name_of(light.text("name"), name_of(node.value.text("name"), "light")), notes_));
  }

  /// The file's camera looks along a line; ours at a point, about which the window turns it.
  void aim() {
    preset::Camera& camera = made_.scene.camera;
    const glm::dvec3 position = scene::to_dvec3(camera.position);
    const double ahead = glm::dot(middle() - position, forward_);
    camera.target = scene::to_vec3(position + forward_ * (ahead > 1e-3 * size() ? ahead : size()));
  }

  void look_at_all() {
    note("the file has no camera with perspective: one that sees everything takes its place");
    made_.scene.camera.target = scene::to_vec3(middle());
    made_.scene.camera.position = scene::to_vec3(middle() + size() * glm::dvec3(0.3, 0.7, 1.2));
  }

  void light_all() {
    note("the file has no lights: a lamp above everything takes their place");
    preset::Light lamp;
    lamp.position = scene::to_vec3(middle() + size() * glm::dvec3(-0.5, 1, 0.4));
    lamp.power_w = 10 * size() * size();
    made_.scene.lights.push_back(lamp);
  }

  /// White is a white surface in the middle of everything that faces every light.
  void expose() {
    if (has_camera_) aim();
    double irradiance = 0;
    for (const preset::Light& light : made_.scene.lights) irradiance += luminous_irradiance(light, middle());
    made_.white = irradiance > 0 ? std::clamp(irradiance / pi, 1e-12, 1e12) : 1;
  }

  GltfValue root_;
  GltfMeshes meshes_;
  fs::path preset_file_;
  preset::Preset made_;
  std::vector<std::string> notes_;
  std::map<std::string, scene::Mesh> files_;   ///< by their names
  std::map<std::string, std::string> glasses_; ///< dispersion files by their names
  std::map<MeshKey, std::string> names_;       ///< of meshes that were read
  std::map<std::size_t, std::string> material_names_;
  std::set<std::string> object_names_, taken_materials_;
  scene::Bounds bounds_;
  bool has_camera_ = false;
  glm::dvec3 forward_{0, 0, -1};
};

} // namespace

std::string Imported::summary() const {
  std::string text = fmt::format("{}: {}, {}, {}", preset.string(), counted(objects, "object"),
                                 counted(meshes, "mesh", "meshes"), counted(lights, "light"));
  for (const std::string& note : notes) text += "; " + note;
  return text;
}

Imported import_scene(const fs::path& file, const fs::path& preset) {
  const std::string kind = lower_case(file.extension().string());
  if (kind == ".xml") return write_described(read_mitsuba(file), preset);
  if (kind == ".pbrt") return write_described(read_pbrt(file), preset);
  return import_gltf(file, preset);
}

Imported import_gltf(const fs::path& file, const fs::path& preset) {
  const GltfFile gltf = read_gltf(file);
  return Import(gltf, preset).write();
}

} // namespace nephroid::formats
