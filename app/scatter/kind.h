// SPDX-License-Identifier: Apache-2.0
// What the file of a type of material says of it: a constant Kind by the type's word, which the list MATERIALS
// (kernels/scatter/material_types.h) finds. Here are also the words that several of these files share.
#pragma once
#include "optics/dispersion.h"
#include "preset/describe.h"
#include "scatter/material.h"

#include <functional>
#include <optional>
#include <span>

namespace nephroid::scatter {

/// A preset's material on its way to a loaded one.
struct Loading {
  const preset::Material& from;
  const FileFinder& finder;
  const Location& where;
  optics::SpectralRange range;
  std::string owner; ///< "material 'wall'"
  std::vector<std::string>& warnings;

  void warn(const std::string& note) const;
  /// Warns where the range reaches beyond the data of a field, whose ends are held.
  void known_from(const std::string& field, double low_nm, double high_nm) const;
  /// Calls sample(curve, what to do outside of its range), at the field, and warns of what is outside.
  void curve(const preset::Dispersion& dispersion, const Location& field,
             const std::function<void(const optics::DispersionCurve&, optics::Extrapolation)>& sample) const;
  optics::Spectrum spectrum(const preset::Reflectance& reflectance, const char* field) const;
  std::shared_ptr<const Texture> picture(const std::optional<preset::Texture>& texture, Texels texels,
                                         const char* field) const;
  /// Loads the roughness and its texture.
  void roughness(Material& material) const;
  /// Loads n and k of the field "metal".
  void metal(Material& material) const;
  /// Loads the index of the field "dispersion" at 588 nm, as a coat's.
  void coat_index(Material& material) const;
};

/// A material's row on its way into the tables.
struct Rows {
  DeviceMaterials& tables;
  shared::DeviceMaterial& row;
  optics::SpectralRange range;

  /// Adds a row of losses and returns its number; -1 for none.
  int loss(std::span<const double> coefficients);
  /// Says that the material takes light, as loss() says of its row; by_wavelength: and colours it.
  void takes_light(bool by_wavelength = false);
  /// The same by what is left of the light: alike at all wavelengths, or not.
  void takes_light_of(const optics::Spectrum& left);
  /// Adds the rows of a surface that a texture may lie on, and returns the first one's number. factor: of its colour.
  int colour(const optics::Spectrum& colour, double factor, bool is_textured);
  /// Adds items to the table surface_data, and returns where the first one stands.
  int data(std::span<const double> values);
};

struct Kind {
  std::string_view sentence; ///< for the schema and the window
  void (*describe)(preset::Fields& v, preset::Material& m);
  void (*load)(const Loading& loading, Material& material);
  void (*add_rows)(const Material& material, Rows& rows);
  GltfSurface (*gltf)(const Material& material);
};

namespace kinds {
#define NEPHROID_MATERIAL_KIND(word, NAME, lobes) extern const Kind word;
MATERIALS(NEPHROID_MATERIAL_KIND)
#undef NEPHROID_MATERIAL_KIND
} // namespace kinds

const Kind& kind_of(preset::Material::Type type);

// Fields that several types have.
void describe_reflectance(preset::Fields& v, preset::Material& m);
void describe_texture(preset::Fields& v, preset::Material& m);
void describe_metal(preset::Fields& v, preset::Material& m);
void describe_coat_index(preset::Fields& v, preset::Material& m);
void describe_tint(preset::Fields& v, preset::Material& m);
void describe_roughness(preset::Fields& v, preset::Material& m);
void describe_roughness_texture(preset::Fields& v, preset::Material& m);

/// Of a polished or rough metal.
GltfSurface gltf_metal(const Material& material);

} // namespace nephroid::scatter
