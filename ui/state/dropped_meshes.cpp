// SPDX-License-Identifier: Apache-2.0
#include "ui/state/files.h"

#include "base/error.h"
#include "preset/read.h"
#include "scene/mesh.h"
#include "ui/state/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::ui {
namespace {

constexpr double part_of_view = 0.4; ///< the new object's longest edge, as a part of what the camera sees at its target

/// The shorter side of the visible rectangle in the plane of the camera's target.
double view_at_target(const preset::Camera& camera) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) square += std::pow(camera.target[i] - camera.position[i], 2);
  const double height = 2 * std::sqrt(square) * std::tan(camera.fov_deg / 2 * std::numbers::pi / 180);
  return height * std::min(1.0, static_cast<double>(camera.resolution[0]) / camera.resolution[1]);
}

std::string material_for(preset::Scene& scene) {
  preset::Preset of;
  of.scene = scene;
  if (std::string glass = shown_dielectric(of, {}); !glass.empty()) return glass;
  if (scene.materials.empty()) scene.materials["glass"].type = preset::Material::Type::dielectric;
  return scene.materials.begin()->first;
}

} // namespace

DroppedMesh read_dropped_mesh(const std::filesystem::path& file) {
  std::error_code ignored;
  DroppedMesh dropped;
  dropped.file = std::filesystem::absolute(file, ignored);
  const scene::Mesh mesh = scene::load_mesh(dropped.file);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 p = mesh.positions[triangle[corner]];
      dropped.box = scene::enclosing(dropped.box, {p, p});
    }
  dropped.closed = scene::inspect(mesh).closed();
  return dropped;
}

WithMesh with_mesh(preset::Preset preset, const DroppedMesh& mesh) {
  preset::Scene& scene = preset.scene;
  preset::Object object;
  object.name = untaken_name(mesh.file.stem().string(), [&](const std::string& name) {
    return std::ranges::find(scene.objects, name, &preset::Object::name) != scene.objects.end();
  });
  object.mesh = mesh.file.string();
  object.material = material_for(scene);
  const bool dielectric = scene.materials.at(object.material).type == preset::Material::Type::dielectric;
  if (dielectric && !mesh.closed && scene.damaged_meshes == preset::Scene::DamagedMeshes::refuse)
    throw bad_input(mesh.file.string(), "is not closed, so it cannot be of '" + object.material + "', a dielectric",
                    "a closed mesh, as the preset's damaged_meshes is \"refuse\"",
                    "mend it, or set damaged_meshes to \"report\"");
  const glm::dvec3 edges = mesh.box.high - mesh.box.low;
  const double longest = std::max({edges.x, edges.y, edges.z});
  const double factor = with_digits(part_of_view * view_at_target(scene.camera) / longest, 3);
  const glm::dvec3 middle = 0.5 * mesh.box.low + 0.5 * mesh.box.high;
  const double size = factor * longest;
  const int decimals = size > 0 && std::isfinite(size) ? 3 - static_cast<int>(std::floor(std::log10(size)))
                                                       : 0; // a thousandth of the size
  for (std::size_t i = 0; i < 3; ++i) {
    object.transform.scale[i] = factor;
    object.transform.translate[i] = rounded(scene.camera.target[i] - factor * middle[static_cast<int>(i)], decimals);
  }
  std::string note =
      fmt::format("{} is the object '{}' of '{}', scaled by {:g} to {:.3g} {}, at the camera's target",
                  mesh.file.filename().string(), object.name, object.material, factor, size, unit_word(preset));
  if (dielectric && !mesh.closed) note += "; it is not closed: light that enters may never leave";
  scene.objects.push_back(std::move(object));
  preset::check(preset, [&](const std::string& pointer) { return Place(mesh.file.string(), pointer); });
  return {std::move(preset), std::move(note)};
}

} // namespace nephroid::ui
