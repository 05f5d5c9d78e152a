// SPDX-License-Identifier: Apache-2.0
// What engine 1 runs for a preset and what it leaves out.
#include "spectral/device_scene.h"
#include "spectral/engine.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::spectral {
namespace {

struct Needs {
  int dielectrics = 0, mirrors = 0, diffuse = 0, smooth = 0; ///< objects
};

Needs count_objects(const scene::Scene& scene)
{
  Needs needs;
  for (const scene::Object& object : scene.objects) {
    const scene::Material::Type type = scene.materials[static_cast<std::size_t>(object.material)].type;
    needs.dielectrics += type == scene::Material::Type::dielectric;
    needs.mirrors += type == scene::Material::Type::mirror;
    needs.diffuse += type == scene::Material::Type::diffuse;
    needs.smooth += object.smooth;
  }
  return needs;
}

std::string no_light_reason(const scene::Scene& scene) { return scene.lights.empty() ? "the scene has no light" : ""; }

plan::Pass direct_pass(const preset::Spectral& settings, const scene::Scene& scene, const Needs& needs)
{
  const std::string reason = !settings.direct                             ? "spectral.direct is false"
                             : !scene.lights.empty() && needs.diffuse > 0 ? ""
                             : needs.diffuse == 0                         ? "the scene has no diffuse surface"
                                                                          : no_light_reason(scene);
  if (!reason.empty()) return {"direct", false, reason};
  return {"direct", true,
          fmt::format("{} diffuse {} lit by {} {}", needs.diffuse, needs.diffuse == 1 ? "object" : "objects", scene.lights.size(),
                      scene.lights.size() == 1 ? "light" : "lights")};
}

plan::Pass photon_pass(const preset::Spectral& settings, const scene::Scene& scene, const Needs& needs, const DeviceTables& tables)
{
  std::string reason;
  if (!settings.caustic)
    reason = "spectral.caustic is false";
  else if (needs.dielectrics + needs.mirrors == 0)
    reason = "no object is of glass or a mirror";
  else if (needs.diffuse == 0)
    reason = "no diffuse surface can receive a caustic";
  else if (tables.emitters.empty())
    reason = scene.lights.empty() ? no_light_reason(scene) : "no light has power at 380 to 780 nm";
  if (!reason.empty()) return {"photons", false, reason};
  return {"photons", true,
          fmt::format("{} photons a pass in {} wavelength {}, sent towards {} caustic {} only", tables.photons_per_pass,
                      tables.wavelengths.clusters.size(), tables.wavelengths.clusters.size() == 1 ? "cluster" : "clusters",
                      tables.targets.size(), tables.targets.size() == 1 ? "target" : "targets")};
}

std::uint64_t bytes_of(const auto& items) { return items.size() * sizeof(items[0]); }

std::vector<plan::PlannedBuffer> buffers(const scene::Scene& scene, const scene::Bvh& bvh, const DeviceTables& tables, bool direct,
                                         bool photons, int halves)
{
  const std::uint64_t film_bytes =
      static_cast<std::uint64_t>(halves) * 3 * sizeof(std::int64_t) * static_cast<std::uint64_t>(scene.camera.width) * scene.camera.height;
  const WavelengthTables& w = tables.wavelengths;
  std::vector<plan::PlannedBuffer> list{
      {"tree", bytes_of(bvh.nodes) + bytes_of(bvh.blocks)},
      {"triangles", bytes_of(scene.geometry.triangles) + bytes_of(scene.geometry.positions) + bytes_of(scene.geometry.normals) +
                        bytes_of(scene.object_of_triangle)},
      {"wavelength tables", bytes_of(w.index_of_refraction) + bytes_of(w.coefficient) + bytes_of(w.reflectance) + bytes_of(w.light_xyz) +
                                bytes_of(w.reflected_xyz) + bytes_of(w.reflected_xyz_all) + bytes_of(w.cluster_wavelengths)}};
  if (direct) list.push_back({"film direct", film_bytes});
  if (photons) list.push_back({"film caustic", film_bytes});
  return list;
}

} // namespace

plan::Plan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
{
  const DeviceTables tables = make_device_tables(preset, scene);
  const Needs needs = count_objects(scene);
  const int attenuators = tables.wavelengths.attenuator_count;
  plan::Plan plan;
  plan.engine = "spectral";
  const plan::Pass direct = direct_pass(preset.spectral, scene, needs), photons = photon_pass(preset.spectral, scene, needs, tables);
  plan.passes = {direct, photons};
  plan.passes.push_back(
      {"mirrors", needs.mirrors > 0, needs.mirrors > 0 ? fmt::format("{} mirror objects", needs.mirrors) : "no object is a mirror"});
  plan.passes.push_back({"attenuation", attenuators > 0,
                         attenuators > 0 ? fmt::format("{} materials take light away by wavelength", attenuators)
                                         : "no glass absorbs and no mirror is coloured"});
  plan.passes.push_back(
      {"smooth normals", needs.smooth > 0, needs.smooth > 0 ? fmt::format("{} smooth objects", needs.smooth) : "every object is faceted"});
  plan.passes.push_back(
      {"photon maps", false,
       "caustics are splatted where the camera sees the surface directly; those seen through glass or in a mirror are not rendered yet"});
  plan.passes.push_back({"indirect", false, "diffuse interreflection is not rendered yet"});
  plan.passes.push_back({"background", false, "there is no environment: what meets nothing is black"});
  const int halves = preset.measure.estimate ? 2 : 1;
  plan.passes.push_back({"error estimate", preset.measure.estimate,
                         preset.measure.estimate ? "every film is kept in two independent halves" : "measure.estimate is false"});
  plan.buffers = buffers(scene, bvh, tables, direct.runs, photons.runs, halves);
  plan.defines = {
      {"NEPHROID_FILM_HALVES", std::to_string(halves)},      {"NEPHROID_MAX_SURFACES", std::to_string(preset.spectral.max_surfaces)},
      {"NEPHROID_ATTENUATORS", std::to_string(attenuators)}, {"NEPHROID_MIRRORS", needs.mirrors > 0 ? "1" : "0"},
      {"NEPHROID_SMOOTH", needs.smooth > 0 ? "1" : "0"},     {"NEPHROID_BVH_STACK", std::to_string(std::max(bvh.stack, 1))}};
  plan.notes = scene.warnings;
  if (photons.runs && tables.photons_per_pass > static_cast<unsigned>(preset.spectral.photons_per_pass))
    plan.notes.push_back(fmt::format("spectral.photons_per_pass: raised from {} to {}, one for each cluster of each light",
                                     preset.spectral.photons_per_pass, tables.photons_per_pass));
  return plan;
}

} // namespace nephroid::spectral
