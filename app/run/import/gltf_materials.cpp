// SPDX-License-Identifier: Apache-2.0
#include "run/import/gltf_materials.h"

#include "optics/colour.h"
#include "optics/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::run {
namespace {

// Fraunhofer's lines F, d and C, in micrometres.
constexpr double line_f = 0.4861327, line_d = 0.5875618, line_c = 0.6562725;

bool is_textured(const GltfValue& material)
{
  const GltfValue pbr = material.object("pbrMetallicRoughness");
  return pbr.has("baseColorTexture") || pbr.has("metallicRoughnessTexture") || material.has("normalTexture") ||
         material.extension("KHR_materials_transmission").has("transmissionTexture");
}

preset::Material glass(const GltfValue& material, const std::string& name, std::vector<std::string>& notes)
{
  preset::Material glass;
  glass.type = preset::Material::Type::dielectric;
  double ior = material.extension("KHR_materials_ior").number("ior", 1.5);
  if (ior < 1 || ior > 100) {
    notes.push_back(fmt::format("material '{}': an index of refraction of {} means nothing here; 1.5 takes its place", name, ior));
    ior = 1.5;
  }
  glass.dispersion = dispersion_of(ior, material.extension("KHR_materials_dispersion").number("dispersion", 0));
  const GltfValue volume = material.extension("KHR_materials_volume");
  if (volume.number("thicknessFactor", 0) == 0)
    notes.push_back(fmt::format("material '{}' is a thin film in the file and solid glass here", name));
  if (material.object("pbrMetallicRoughness").number("roughnessFactor", 1) > 0.1)
    notes.push_back(fmt::format("material '{}' is rough in the file and polished here", name));
  return glass;
}

} // namespace

preset::Dispersion dispersion_of(double ior, double dispersion)
{
  preset::Dispersion glass;
  if (!(dispersion > 0)) {
    glass.n = ior;
    return glass;
  }
  const double abbe = 20 / dispersion;
  const double b = (ior - 1) / (abbe * (1 / (line_f * line_f) - 1 / (line_c * line_c)));
  glass.type = preset::Dispersion::Type::cauchy;
  glass.coefficients = {ior - b / (line_d * line_d), b};
  return glass;
}

std::string absorbing_glass_file(const GltfValue& material, const preset::Dispersion& clear)
{
  const GltfValue volume = material.extension("KHR_materials_volume");
  const double distance = volume.number("attenuationDistance", 0);
  const auto colour = volume.numbers<3>("attenuationColor", {1, 1, 1});
  if (!(distance > 0) || volume.number("thicknessFactor", 0) == 0 || colour == std::array<double, 3>{1, 1, 1}) return {};
  const bool bends = clear.type == preset::Dispersion::Type::cauchy;
  const std::string n = bends ? fmt::format("{} {} -2", clear.coefficients[0], clear.coefficients[1]) : fmt::format("{}", clear.n);
  std::string text = "COMMENTS: |\n    n as KHR_materials_ior and KHR_materials_dispersion say it, k as KHR_materials_volume does\nDATA:\n";
  text += fmt::format("  - type: formula 5\n    wavelength_range: 0.38 0.78\n    coefficients: {}\n", n);
  text += "  - type: tabulated k\n    data: |\n";
  const preset::Reflectance kept = reflectance_of(colour);
  constexpr double least = 1e-4; // black glass has no k
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10) {
    const double transmittance = kept.table.empty() ? kept.value : kept.table[static_cast<std::size_t>((nm - optics::first_nm) / 10)][1];
    const double absorbed = std::log(1 / std::max(transmittance, least)) / distance; // in 1/m: the file's lengths are metres
    text += fmt::format("        {:.2f} {:.6g}\n", nm * 1e-3, absorbed * nm * 1e-9 / (4 * std::numbers::pi));
  }
  return text;
}

preset::Reflectance reflectance_of(const std::array<double, 3>& rgb)
{
  preset::Reflectance reflectance;
  std::array<double, 3> colour = rgb;
  for (double& c : colour) c = std::clamp(c, 0.0, 1.0);
  reflectance.value = colour[1];
  if (std::abs(colour[0] - colour[1]) < 1e-3 && std::abs(colour[2] - colour[1]) < 1e-3) return reflectance;
  // sRGB's primaries add up to D65, under which a reflectance of 1 is white.
  const optics::Spectrum d65 = optics::illuminant("D65");
  const double white = optics::to_xyz(d65)[1];
  reflectance.type = preset::Reflectance::Type::table;
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += 10) {
    const auto i = static_cast<std::size_t>(nm - optics::first_nm);
    double power = 0;
    for (std::size_t c = 0; c < 3; ++c) power += colour[c] * optics::primary_spectra()[c][i];
    reflectance.table.push_back({static_cast<double>(nm), std::clamp(power * white / d65[i], 0.0, 1.0)});
  }
  return reflectance;
}

preset::Material material_of(const GltfValue& value, const std::string& name, std::vector<std::string>& notes)
{
  if (is_textured(value)) notes.push_back(fmt::format("material '{}': textures are left out", name));
  if (value.numbers<3>("emissiveFactor", {0, 0, 0}) != std::array<double, 3>{0, 0, 0})
    notes.push_back(fmt::format("material '{}' does not shine here", name));
  if (value.extension("KHR_materials_transmission").number("transmissionFactor", 0) >= 0.5) return glass(value, name, notes);
  const GltfValue pbr = value.object("pbrMetallicRoughness");
  const auto base = pbr.numbers<4>("baseColorFactor", {1, 1, 1, 1});
  preset::Material material;
  material.reflectance = reflectance_of({base[0], base[1], base[2]});
  const bool metal = pbr.number("metallicFactor", 1) >= 0.5, rough = pbr.number("roughnessFactor", 1) >= 0.5;
  if (metal && !rough) material.type = preset::Material::Type::mirror;
  if (metal && rough) notes.push_back(fmt::format("material '{}' is rough metal in the file and matt here", name));
  if (base[3] < 1 && value.text("alphaMode") == "BLEND") notes.push_back(fmt::format("material '{}' is opaque here", name));
  return material;
}

} // namespace nephroid::run
