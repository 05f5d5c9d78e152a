// SPDX-License-Identifier: Apache-2.0
// What surfaces can do, on the host: a loaded material, the flags by which everybody else asks for it, and the verbs
// that its own file has (app/scatter/NAME.cpp, by kind.h). LOBE_* of its type are in kernels/scatter/material_types.h.
#pragma once
#include "base/files.h"
#include "kernels/tracing/shared_types.h"
#include "optics/coat.h"
#include "preset/preset.h"
#include "scatter/texture.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::scatter {

struct Material {
  using Type = preset::Material::Type;
  std::string name;
  Type type = Type::diffuse;
  optics::Spectrum n{};           ///< of what light refracts into, or of a metal
  optics::Spectrum k{};           ///< the same; all zero where light passes and nothing absorbs
  bool absorbs = false;           ///< inside, where light passes
  optics::Spectrum reflectance{}; ///< of its base or, where that depends on the angle, straight on in air
  std::shared_ptr<const Texture>
      texture; ///< what its reflectance or, where light passes, tint is multiplied by; null: 1
  std::shared_ptr<const Texture> roughness_texture; ///< whose green its roughness is multiplied by; null: 1
  std::shared_ptr<const Texture> normal_map;        ///< (1 + normal) / 2, of any length; null: none
  double coat_n = 1;                                ///< index of refraction of the clear coat above its base
  optics::Coat coat;                                ///< the same coat
  optics::Spectrum tint{};                          ///< the part of the light that passes its surface
  bool thin = false;                                ///< a pane without thickness
  double alpha = 0;                                 ///< of GGX, where no texture makes it less; 0: polished
  optics::SpectralRange range = optics::SpectralRange::visible; ///< of its spectra
  double coating_nm = 0;                                        ///< thickness of a film with interference; 0: none
  optics::Spectrum coating_n{};
  /// What passes and is reflected by angle and wavelength, as kernels/scatter/glazing.h reads it; empty: by the rest.
  std::vector<double> by_angle;
};

/// Whether a clear coat reflects a part of the light above a matt base: a path takes one of both.
inline bool has_coat(const Material& material) { return is_matt(material.type) && is_specular(material.type); }

/// Whether an object of it is a body that fills space, which light is inside or outside of.
inline bool is_body(const Material& material) { return is_refractive(material.type) && !material.thin; }

inline bool is_thin(const Material& material) { return material.thin; }

inline bool is_rough(const Material& material) { return material.alpha > 0; }

inline bool is_textured(const Material& material) { return material.texture != nullptr; }

inline bool has_rough_texture(const Material& material) { return material.roughness_texture != nullptr; }

inline bool has_normal_map(const Material& material) { return material.normal_map != nullptr; }

/// Whether a texture colours the light that passes.
inline bool has_tint_texture(const Material& material) { return is_refractive(material.type) && is_textured(material); }

/// Whether what it sends to an eye is the light on it times its texture, but for a coat's reflection.
inline bool is_light_times_texture(const Material& material) {
  return is_matt(material.type) && is_textured(material) && !has_normal_map(material);
}

/// Whether it looks up places by u, v.
inline bool has_pictures(const Material& material) {
  return is_textured(material) || has_rough_texture(material) || has_normal_map(material);
}

/// Whether its surface reflects each wavelength of a cluster otherwise, so that a path has to have one.
inline bool is_coated(const Material& material) { return material.coating_nm > 0; }

/// Whether light passes its surface in other directions by wavelength.
bool disperses(const Material& material);

/// Whether a table says what it reflects and lets pass of each wavelength at each angle.
inline bool is_tabulated(const Material& material) { return !material.by_angle.empty(); }

/// Whether its surface bends or reflects each wavelength otherwise, which splits a path.
inline bool splits_wavelengths(const Material& material) { return disperses(material) || is_coated(material); }

/// Whether light that passes its surface may go on in another direction, or is reflected.
bool bends(const Material& material);

/// Whether a part of the light that passes its surface is lost there.
bool is_tinted(const Material& material);

/// [401]: the coefficient a >= 0 by which exp(-a s) of a wavelength's light is left; empty where nothing is lost.
/// In glass (Beer and Lambert) a = 4 pi k / lambda in 1/m, and s is in metres.
std::vector<double> loss_inside(const Material& material);
/// At a surface a = -ln of what is left at normal incidence, and s counts reflections, or ways through tinted glass.
std::vector<double> loss_at_surface(const Material& material);

/// where: the material's. Throws bad_input for what its type cannot be, each in its file. Adds a warning where n is
/// wanted outside the data's range, and for what a texture does not say.
Material make_material(const std::string& name, const preset::Material& material, const FileFinder& finder,
                       const Location& where, std::vector<std::string>& warnings,
                       optics::SpectralRange range = optics::SpectralRange::visible);

/// What materials put into the tables of a scene (kernels/tracing/scene_table_types.h).
struct DeviceMaterials {
  std::vector<shared::DeviceMaterial> materials; ///< [material]
  std::vector<float> coefficient, reflectance;   ///< rows of 401
  std::vector<float> surface_data;
  bool takes_light = false;   ///< whether any light is lost in or at one
  bool colours_light = false; ///< whether by wavelength
};

/// used: which materials get rows. Their textures are numbered one after the other, in the order texture,
/// roughness_texture, normal_map.
DeviceMaterials device_materials(const std::vector<Material>& materials, const std::vector<bool>& used);

/// A surface in the words of glTF 2.0 (metallic-roughness), and its extensions for what light passes.
struct GltfSurface {
  optics::Spectrum base_colour{};
  double metallic = 0, roughness = 1;
  bool transmits = false;         ///< by its Material's n, k and thin
  std::string_view left_out = {}; ///< what glTF cannot say of it, for a person; empty: nothing
};
GltfSurface gltf_surface(const Material& material);

} // namespace nephroid::scatter
