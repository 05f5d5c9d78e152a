// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/spectra/curves.h"

#include "base/error.h"
#include "base/files.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "photons/capabilities.h"
#include "photons/clusters/scene_clusters.h"
#include "photons/effort/effort.h"
#include "scatter/spectra.h"
#include "spectral/settings.h"
#include "tracing/omissions.h"
#include "tracing/wavelength_tables.h"
#include "ui/widgets/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nephroid::ui {
namespace {

using optics::Spectrum;
using optics::wavelength_count;

LightCurve make_curve(const preset::LightSpectrum& spectrum) {
  LightCurve curve;
  try {
    curve.spectrum = scatter::make_light_spectrum(spectrum, {});
    curve.largest = *std::max_element(curve.spectrum.begin(), curve.spectrum.end());
  } catch (const Error& error) {
    curve.error = error.text();
  }
  return curve;
}

/// How a light looks to (4.15): where it stands does not matter.
scene::Light without_place(const preset::Light& light, const LightCurve& curve) {
  scene::Light scene_light;
  scene_light.type = light.type;
  (preset::has(light.type, LIGHT_HAS_IRRADIANCE) ? scene_light.irradiance_w_m2 : scene_light.power_w) =
      preset::radiometric(light);
  scene_light.spectrum = curve.spectrum;
  return scene_light;
}

/// Encoded for the display; what it cannot show is clipped.
std::array<double, 3> display(const optics::Colour& linear) {
  std::array<double, 3> encoded{};
  for (std::size_t i = 0; i < 3; ++i) encoded[i] = optics::srgb_encode(std::clamp(linear[i], 0.0, 1.0));
  return encoded;
}

/// Its colour under D65 with white = 1.
std::array<double, 3> colour_of(const Spectrum& reflectance) {
  static const Spectrum d65 = optics::illuminant("D65");
  static const double white = optics::to_xyz(d65)[1];
  Spectrum reflected{};
  for (std::size_t w = 0; w < reflected.size(); ++w) reflected[w] = reflectance[w] * d65[w] / white;
  return display(optics::xyz_to_linear_srgb(optics::to_xyz(reflected)));
}

/// Materials and objects, as load_scene has them. Throws Error where a file cannot be read or a name is of no material.
void read_materials(const preset::Preset& preset, scene::Scene& outline) {
  const FileFinder finder(std::filesystem::path(preset.source).parent_path());
  std::vector<std::string> warnings; // the run's plan has them
  for (const auto& [name, material] : preset.scene.materials)
    outline.materials.push_back(
        scatter::make_material(name, material, finder, Location("scene/materials/" + name), warnings));
  for (const preset::Object& object : preset.scene.objects) {
    const auto found = preset.scene.materials.find(object.material);
    if (found == preset.scene.materials.end())
      throw bad_input({}, fmt::format("there is no material '{}'", object.material));
    scene::Object scene_object;
    scene_object.material = static_cast<int>(std::distance(preset.scene.materials.begin(), found));
    scene_object.triangle_count = scene_object.vertex_count = 1; // nobody looks at them here
    outline.objects.push_back(scene_object);
  }
}

/// What the clusters of a scene hang on.
auto grouping(const photons::Settings& settings) {
  return std::tuple(settings.method, settings.threshold_deg, settings.step_nm, settings.estimator, settings.jitter,
                    settings.relight);
}

/// The importance of each cluster, as the engine allocates its work.
std::vector<double> importance_of(const photons::Settings& settings, const Spectrum& u,
                                  const tracing::WavelengthTables& tables, const scene::Scene& outline,
                                  const std::vector<double>& watts) {
  using Effort = photons::Settings::Effort;
  if (settings.effort == Effort::importance || settings.effort == Effort::radziszewski)
    return photons::cluster_importance(u, tables.clusters, settings.importance.cluster);
  return photons::make_cluster_shares(settings, outline, {}, watts, tables).importance; // without rays
}

} // namespace

std::shared_ptr<const SeenByGlass> SeenByGlass::of(const preset::Preset& preset, const scene::Scene& scene,
                                                   const scene::Bvh& bvh) {
  auto seen = std::make_shared<SeenByGlass>();
  for (const scatter::Material& material : scene.materials) seen->materials.push_back(material.name);
  for (std::size_t i = preset.scene.lights.size(); i < scene.lights.size(); ++i)
    seen->surroundings.push_back(scene.lights[i]);
  seen->importance_geometry = photons::importance_geometry(spectral::settings(preset), scene, bvh);
  seen->settings = spectral::settings(preset);
  seen->clusters = photons::scene_clusters(photons::agree(spectral::settings(preset), scene).settings, scene);
  return seen;
}

std::int64_t Spectra::iterations() const {
  std::int64_t sum = 0;
  for (const ClusterWork& cluster : clusters) sum += cluster.iterations;
  return sum;
}

std::int64_t Spectra::brute_force() const { return wavelength_count * passes; }

std::int64_t Spectra::equal_effort() const { return std::ssize(clusters) * passes; }

const Spectra& SpectraMaker::update(const preset::Preset& preset, const std::shared_ptr<const SeenByGlass>& seen) {
  const bool saw_the_same = seen_ == seen || (seen_ && seen && *seen_ == *seen);
  seen_ = seen;
  if (preset_ && *preset_ == preset && saw_the_same) return spectra_;
  make_lights(preset.scene);
  make_materials(preset);
  make_groups(preset);
  make_importance(preset);
  make_clusters(preset);
  preset_ = preset;
  ++updates_;
  return spectra_;
}

void SpectraMaker::make_lights(const preset::Scene& now) {
  std::vector<LightCurve> curves;
  for (std::size_t i = 0; i < now.lights.size(); ++i) {
    const bool known =
        preset_ && i < preset_->scene.lights.size() && preset_->scene.lights[i].spectrum == now.lights[i].spectrum;
    curves.push_back(known ? spectra_.lights[i] : make_curve(now.lights[i].spectrum));
  }
  spectra_.lights = std::move(curves);
  outline_.lights.clear();
  for (std::size_t i = 0; i < now.lights.size(); ++i)
    outline_.lights.push_back(without_place(now.lights[i], spectra_.lights[i]));
  if (!now.environment || !seen_) return;
  for (const scene::Light& light : seen_->surroundings)
    if (now.environment->lights || !is_environment(light)) outline_.lights.push_back(light);
}

void SpectraMaker::make_materials(const preset::Preset& now) {
  if (preset_ && preset_->source == now.source && preset_->scene.materials == now.scene.materials &&
      preset_->scene.objects == now.scene.objects)
    return;
  outline_.materials.clear();
  outline_.objects.clear();
  spectra_.materials.clear();
  spectra_.reflectances.clear();
  materials_error_.clear();
  try {
    read_materials(now, outline_);
  } catch (const Error& error) {
    materials_error_ = error.line();
    outline_.materials.clear();
    outline_.objects.clear();
    return;
  }
  for (std::size_t i = 0; i < outline_.materials.size(); ++i) {
    const scatter::Material& material = outline_.materials[i];
    spectra_.materials.push_back(material.name);
    const bool used = std::any_of(outline_.objects.begin(), outline_.objects.end(),
                                  [&](const scene::Object& object) { return object.material == static_cast<int>(i); });
    if (used && !is_refractive(material.type))
      spectra_.reflectances.push_back({material.name, material.reflectance, colour_of(material.reflectance)});
  }
}

void SpectraMaker::make_groups(const preset::Preset& now) {
  if (preset_ && !spectral::settings(now).relight &&
      grouping(spectral::settings(*preset_)) == grouping(spectral::settings(now)) &&
      preset_->scene.materials == now.scene.materials && preset_->scene.objects == now.scene.objects)
    return;
  groups_.clear();
  groups_error_.clear();
  if (!materials_error_.empty()) return;
  // With relight they hang on the lengths of paths in what absorbs, which the outline does not know.
  if (spectral::settings(now).relight) {
    if (seen_ && seen_->materials == spectra_.materials &&
        grouping(seen_->settings) == grouping(spectral::settings(now)))
      groups_ = seen_->clusters;
    else
      groups_error_ = "the clusters are not known before a run of this preset is ready";
    return;
  }
  try {
    groups_ = photons::scene_clusters(spectral::settings(now), outline_);
  } catch (const Error& error) {
    groups_error_ = error.text();
  }
}

/// Whether what the glass was seen to see is what u hangs on now.
bool SpectraMaker::is_of_this_scene(const photons::Settings& settings) const {
  if (!seen_ || seen_->materials != spectra_.materials ||
      seen_->importance_geometry.towards.size() != outline_.lights.size())
    return false;
  const bool rays = settings.effort == photons::Settings::Effort::importance && settings.importance.geometry &&
                    seen_->importance_geometry.caustics;
  return !rays || !seen_->importance_geometry.seen.empty();
}

void SpectraMaker::make_importance(const preset::Preset& now) {
  spectra_.importance = {};
  spectra_.why_no_u = materials_error_.empty() ? groups_error_ : materials_error_;
  for (std::size_t i = 0; i < spectra_.lights.size(); ++i)
    if (!spectra_.lights[i].error.empty())
      spectra_.why_no_u = fmt::format("light {}: {}", i + 1, spectra_.lights[i].error);
  if (!spectra_.why_no_u.empty()) return;
  if (!is_of_this_scene(spectral::settings(now))) {
    spectra_.why_no_u = "what the glass sees is not known before a run of this preset is ready";
    return;
  }
  try {
    spectra_.importance = photons::wavelength_importance(spectral::settings(now), seen_->importance_geometry,
                                                         outline_.lights, outline_.materials, {});
  } catch (const Error& error) {
    spectra_.why_no_u = error.text();
  }
}

void SpectraMaker::make_clusters(const preset::Preset& now) {
  spectra_.passes = now.stop.passes.value_or(preset::default_passes);
  spectra_.clusters.clear();
  spectra_.cluster_of.fill(-1);
  if (!spectra_.why_no_u.empty()) return;
  // As the engine has them: without the wavelengths and lights that are left out.
  std::vector<const scene::Light*> lights;
  std::vector<double> watts;
  const std::vector<double> all_watts = photons::watts(outline_.lights, seen_->importance_geometry.towards);
  for (std::size_t i = 0; i < outline_.lights.size(); ++i)
    if (tracing::has_power(outline_.lights[i]) || !now.leave_out) {
      lights.push_back(&outline_.lights[i]);
      watts.push_back(all_watts[i]);
    }
  std::vector<bool> lit(wavelength_count, true);
  if (now.leave_out) lit = tracing::lit_wavelengths(outline_);
  std::vector<shared::DeviceMaterial> unused;
  const tracing::WavelengthTables tables = tracing::make_wavelength_tables(outline_, lights, groups_, lit, unused);
  const std::vector<double> importance =
      importance_of(spectral::settings(now), spectra_.importance.u, tables, outline_, watts);
  for (std::size_t c = 0; c < tables.clusters.size(); ++c) {
    ClusterWork work{tables.clusters[c], importance[c], photons::iterations(importance[c], spectra_.passes)};
    for (const int w : work.wavelengths) spectra_.cluster_of[static_cast<std::size_t>(w)] = static_cast<int>(c);
    spectra_.clusters.push_back(std::move(work));
  }
}

std::string to_csv(const Spectra& spectra) {
  std::string csv = "wavelength_nm";
  for (std::size_t i = 0; i < spectra.lights.size(); ++i) csv += fmt::format(",light {}", i + 1);
  csv += ",luminosity";
  for (const ReflectanceCurve& curve : spectra.reflectances)
    csv += fmt::format(",{}", in_csv("reflectance of " + curve.material));
  csv += ",u,cluster,iterations\n";
  for (std::size_t w = 0; w < wavelength_count; ++w) {
    csv += std::to_string(optics::wavelength_nm(static_cast<int>(w)));
    for (const LightCurve& light : spectra.lights) csv += fmt::format(",{}", light.spectrum[w]);
    csv += fmt::format(",{}", optics::cie_1931().y[w]);
    for (const ReflectanceCurve& curve : spectra.reflectances) csv += fmt::format(",{}", curve.reflectance[w]);
    const int cluster = spectra.cluster_of[w];
    csv += spectra.why_no_u.empty() ? fmt::format(",{}", spectra.importance.u[w]) : ",";
    csv += cluster < 0
               ? ",,\n"
               : fmt::format(",{},{}\n", cluster + 1, spectra.clusters[static_cast<std::size_t>(cluster)].iterations);
  }
  return csv;
}

std::array<double, 3> wavelength_colour(int index) {
  const auto w = static_cast<std::size_t>(index);
  const optics::ColourMatching& eye = optics::cie_1931();
  optics::Colour linear = optics::xyz_to_linear_srgb({eye.x[w], eye.y[w], eye.z[w]});
  for (double& channel : linear) channel = std::max(channel, 0.0);
  const double largest = *std::max_element(linear.begin(), linear.end());
  // As bright as can be in the middle of the spectrum; towards its ends as faint as the eye makes it, but never black.
  const double fading = std::clamp(std::sqrt((eye.x[w] + eye.y[w] + eye.z[w]) / 0.3), 0.2, 1.0);
  for (double& channel : linear) channel = largest > 0 ? fading * channel / largest : 0;
  return display(linear);
}

} // namespace nephroid::ui
