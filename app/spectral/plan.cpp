// SPDX-License-Identifier: Apache-2.0
// What engine 1 runs for a preset and what it leaves out.
#include "spectral/device_scene.h"
#include "spectral/effort.h"
#include "spectral/engine.h"
#include "spectral/omissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::spectral {
namespace {

/// A layer that the preset does not ask for.
plan::Pass not_asked_for(const std::string& name, const std::string& field)
{
  return {name, false, fmt::format("spectral.{} is false", field), "/spectral/" + field, true};
}

std::string no_light_reason(const scene::Scene& scene)
{
  if (scene.lights.empty()) return "the scene has no light";
  return std::any_of(scene.lights.begin(), scene.lights.end(), has_power) ? "" : "no light has power";
}

plan::Pass direct_pass(const preset::Spectral& settings, const scene::Scene& scene, const ObjectCounts& objects)
{
  if (!settings.direct) return not_asked_for("direct", "direct");
  const std::string none = objects.diffuse == 0 ? "the scene has no diffuse surface" : no_light_reason(scene);
  if (!none.empty()) return omission("direct", settings.leave_out.direct, false, none);
  return omission("direct", settings.leave_out.direct, true,
                  fmt::format("{} lit by {}, {} a pixel", counted(objects.diffuse, "diffuse object", "diffuse objects"),
                              counted(std::count_if(scene.lights.begin(), scene.lights.end(), has_power), "light", "lights"),
                              counted(settings.pixel_samples, "sample", "samples")));
}

plan::Pass photon_pass(const preset::Spectral& settings, const scene::Scene& scene, const ObjectCounts& objects, const DeviceTables& tables)
{
  if (!settings.caustic) return not_asked_for("photons", "caustic");
  // No field brings these back: there is nothing to send.
  if (const std::string none = no_light_reason(scene); !none.empty()) return {"photons", false, none, "", false};
  const std::string none = objects.dielectrics + objects.mirrors == 0 ? "no object is of glass or a mirror"
                           : objects.diffuse == 0                     ? "no diffuse surface can receive a caustic"
                                                                      : "";
  if (!none.empty()) return omission("photons", settings.leave_out.photons, false, none);
  if (tables.emitters.empty()) return {"photons", false, "no light shines on glass or a mirror", "", false};
  return omission("photons", settings.leave_out.photons, true,
                  fmt::format("{} photons a pass in {}", tables.photons_per_pass,
                              counted(std::ssize(tables.wavelengths.clusters), "wavelength cluster", "wavelength clusters")));
}

plan::Pass stray_photons_pass(const preset::LeaveOut& leave_out, const DeviceTables& tables)
{
  return omission("stray_photons", leave_out.stray_photons, false,
                  leave_out.stray_photons ? fmt::format("photons start towards {} about glass and mirrors only",
                                                        counted(std::ssize(tables.spheres), "sphere", "spheres"))
                                          : "photons need not start where there is no glass and no mirror");
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
  const DeviceTables tables = make_device_tables(preset, scene, bvh);
  const ObjectCounts objects = count_objects(scene);
  const int attenuators = tables.wavelengths.attenuator_count;
  const preset::LeaveOut& leave_out = preset.spectral.leave_out;
  plan::Plan plan;
  plan.engine = "spectral";
  const plan::Pass direct = direct_pass(preset.spectral, scene, objects), photons = photon_pass(preset.spectral, scene, objects, tables);
  plan.passes = {direct, photons};
  if (photons.runs) {
    plan.passes.push_back(effort_pass(preset.spectral, tables.importance));
    plan.passes.push_back(stray_photons_pass(leave_out, tables));
  }
  const std::vector<plan::Pass> code = code_omissions(leave_out, scene, attenuators);
  for (const std::vector<plan::Pass>& passes : {data_omissions(leave_out, scene, tables.spheres), code})
    plan.passes.insert(plan.passes.end(), passes.begin(), passes.end());
  plan.passes.push_back(
      {"photon maps", false,
       "caustics are splatted where the camera sees the surface directly; those seen through glass or in a mirror are not rendered yet"});
  plan.passes.push_back({"indirect", false, "diffuse interreflection is not rendered yet"});
  plan.passes.push_back({"background", false, "there is no environment: what meets nothing is black"});
  const int halves = preset.measure.estimate ? 2 : 1;
  plan.passes.push_back({"error estimate", preset.measure.estimate,
                         preset.measure.estimate ? "every film is kept in two independent halves" : "measure.estimate is false",
                         "/measure/estimate", true});
  plan.buffers = buffers(scene, bvh, tables, direct.runs, photons.runs, halves);
  plan.defines = omission_defines(code, scene, attenuators);
  plan.defines["NEPHROID_FILM_HALVES"] = std::to_string(halves);
  plan.defines["NEPHROID_MAX_SURFACES"] = std::to_string(preset.spectral.max_surfaces);
  plan.defines["NEPHROID_BVH_STACK"] = std::to_string(std::max(bvh.stack, 1));
  plan.notes = scene.warnings;
  if (photons.runs && tables.photons_per_pass > static_cast<unsigned>(preset.spectral.photons_per_pass))
    plan.notes.push_back(fmt::format("spectral.photons_per_pass: raised from {} to {}, one for each cluster of each light",
                                     preset.spectral.photons_per_pass, tables.photons_per_pass));
  return plan;
}

} // namespace nephroid::spectral
