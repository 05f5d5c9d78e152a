// SPDX-License-Identifier: Apache-2.0
// From loaded materials to the rows that kernels read.
#include "optics/primary_reflectances.h"
#include "optics/spectrum.h"
#include "scatter/kind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::scatter {
namespace {

/// The coefficient of a mirror that reflects nothing: exp(-200) is 0 in single precision.
constexpr double blackest = 200;

int rows_of(const std::vector<float>& table) { return static_cast<int>(table.size()) / optics::wavelength_count; }

} // namespace

std::vector<double> loss_inside(const Material& material) {
  std::vector<double> a;
  if (!material.absorbs) return a;
  for (std::size_t w = 0; w < optics::wavelength_count; ++w)
    a.push_back(4 * std::numbers::pi * material.k[w] / (optics::cells(material.range).nm[w] * 1e-9));
  return a;
}

std::vector<double> loss_at_surface(const Material& material) {
  std::vector<double> a;
  if (!is_specular(material.type)) return a;
  const optics::Spectrum& left = is_refractive(material.type) ? material.tint : material.reflectance;
  if (std::ranges::all_of(left, [](double part) { return part == 1; })) return a;
  for (const double part : left) a.push_back(part > 0 ? std::min(-std::log(part), blackest) : blackest);
  return a;
}

int Rows::loss(std::span<const double> coefficients) {
  if (coefficients.empty()) return -1;
  for (const double a : coefficients) tables.coefficient.push_back(static_cast<float>(a));
  takes_light(std::ranges::any_of(coefficients, [&](double a) { return a != coefficients.front(); }));
  return rows_of(tables.coefficient) - 1;
}

void Rows::takes_light(bool by_wavelength) {
  tables.takes_light = true;
  tables.colours_light = tables.colours_light || by_wavelength;
}

void Rows::takes_light_of(const optics::Spectrum& left) {
  takes_light(std::ranges::any_of(left, [&](double part) { return part != left[0]; }));
}

int Rows::colour(const optics::Spectrum& colour, double factor, bool is_textured) {
  const auto add = [&](const optics::Spectrum& primary) {
    for (std::size_t w = 0; w < colour.size(); ++w)
      tables.reflectance.push_back(static_cast<float>(primary[w] * (colour[w] * factor)));
  };
  const int first = rows_of(tables.reflectance);
  add(optics::constant_spectrum(1));
  if (is_textured) std::ranges::for_each(optics::primary_reflectances(range), add);
  return first;
}

int Rows::data(std::span<const double> values) {
  const auto first = static_cast<int>(tables.surface_data.size());
  for (const double value : values) tables.surface_data.push_back(static_cast<float>(value));
  return first;
}

DeviceMaterials device_materials(const std::vector<Material>& materials, const std::vector<bool>& used) {
  DeviceMaterials tables;
  tables.materials.assign(materials.size(), {MATERIAL_DIFFUSE, 0, -1, -1, -1, 0, 0, -1, -1, -1, 0});
  int textures = 0;
  const auto number = [&](const std::shared_ptr<const Texture>& texture) { return texture ? textures++ : -1; };
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Material& material = materials[i];
    shared::DeviceMaterial& row = tables.materials[i];
    row.type = static_cast<int>(material.type); // both are of the list MATERIALS
    if (!used[i]) continue;
    row.alpha = static_cast<float>(material.alpha);
    row.texture = number(material.texture);
    row.roughness_texture = number(material.roughness_texture);
    row.normal_map = number(material.normal_map);
    row.splits_wavelengths = splits_wavelengths(material);
    Rows rows{tables, row, material.range};
    kind_of(material.type).add_rows(material, rows);
  }
  return tables;
}

} // namespace nephroid::scatter
