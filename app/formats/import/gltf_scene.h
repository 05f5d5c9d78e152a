// SPDX-License-Identifier: Apache-2.0
// Parts of a glTF scene as a preset has them: nodes with their places in the world; materials, of which a preset knows
// glass, mirrors and matt surfaces and nothing between; lights of KHR_lights_punctual. glTF says what an eye sees of
// these (candela, lux), we say watts: both units meet here and nowhere else.
#pragma once
#include "formats/import/gltf_file.h"
#include "optics/wavelength.h"
#include "preset/preset.h"
#include "scene/mesh.h"

#include <glm/glm.hpp>

#include <map>

namespace nephroid::formats {

struct GltfNode {
  GltfValue value;
  std::size_t index = 0; ///< in the file's list
  glm::dmat4 to_world;
  bool is_visible = true; ///< by KHR_node_visibility, of it and of all its parents
};

/// The nodes of the file's scene, parents before children, in the order of the file. Throws bad_input where nodes go
/// round in a circle, one has two parents, or there is no scene.
std::vector<GltfNode> nodes_of(const GltfFile& file);

/// The same as scale, turn and shift; nothing where the matrix shears or flattens.
std::optional<preset::Transform> transform_of(const glm::dmat4& matrix);

/// KHR_materials_dispersion gives 20 / V with the Abbe number V = (n_d - 1) / (n_F - n_C). Cauchy's n = a + b / l^2
/// with that n_d and V.
preset::Dispersion dispersion_of(double ior, double dispersion);

/// Where glass absorbs: a dispersion file in the form of refractiveindex.info, with the n of `clear` (a result of
/// dispersion_of) and the k of KHR_materials_volume: after attenuationDistance the smoothest spectrum of
/// attenuationColor is left, at least 1e-4 of the light. Empty for clear glass and for what is thin in the file.
std::string absorbing_glass_file(const GltfValue& material, const preset::Dispersion& clear);

/// A reflectance of this linear sRGB colour; one number where it is grey.
preset::Reflectance reflectance_of(const std::array<double, 3>& rgb);

/// Whether a texture of its roughness makes a difference that is seen here.
bool takes_roughness_texture(const preset::Material& material);

/// name: for notes, which say what has no counterpart.
preset::Material material_of(const GltfValue& value, const std::string& name, std::vector<std::string>& notes);

inline constexpr double most_lumens = 683; ///< a watt at 555 nm, by the definition of the candela

/// Lumens a watt of 380..780 nm: most_lumens times the mean of the eye's luminosity, weighted by the spectrum.
double lumens_per_watt(const optics::Spectrum& spectrum);

/// A light's spectrum and how its figures become watts.
struct LightColour {
  preset::LightSpectrum spectrum;
  double watts_per_lumen = 0; ///< times the luminance of the colour, which the file's intensity is multiplied by
};
/// Linear sRGB. White is D65, as in sRGB; a colour has the smoothest spectrum that shows it.
LightColour light_colour(const std::array<double, 3>& rgb);

/// What a material's surface shines with, linear sRGB whose luminance is in candela per square metre; black of what
/// does not shine here.
std::array<double, 3> emission_of(const GltfValue& material);

/// The light of a node, which shines along its -z axis. light: an item of the extension's list. Intensities in candela,
/// of "directional" in lux.
preset::Light light_of(const GltfValue& value, const glm::dmat4& to_world, const std::string& name,
                       std::vector<std::string>& notes);

/// What the light gives a surface that faces it at this point, in luminous watts a square metre: lux / 683.
double luminous_irradiance(const preset::Light& light, const glm::dvec3& at);

/// What the file's accessors hold: the triangles of its primitives, the places of instances. file outlives this.
class GltfMeshes {
public:
  explicit GltfMeshes(const GltfFile& file);

  /// In the mesh's own frame, as the file has it, with normals and texcoords (the first set) where it has them; a
  /// normal without direction is (0, 0, 0). primitive: of meshes/I/primitives. Throws bad_input, at the primitive or at
  /// what it uses: data that are missing, shorter than the file says or no numbers, indices out of range.
  scene::Mesh read(const GltfValue& primitive) const;

  /// The same mesh at one of the primitive's "targets". Throws as read().
  scene::Mesh target(const scene::Mesh& own, const GltfValue& primitive, const GltfValue& target) const;

  /// The mesh as the primitive's joints and weights have it. joints: what each does to the mesh, into the world. Throws
  /// bad_input at the primitive where they do not fit together. Returns how many vertices have no weights: the first
  /// joint moves them.
  std::size_t move_by_joints(scene::Mesh& mesh, const GltfValue& primitive,
                             const std::vector<glm::dmat4>& joints) const;

  /// Of the accessor whose index is from[key]; width: how many an item has to have, 16 of a matrix. Throws bad_input at
  /// what is missing.
  std::vector<double> numbers(const GltfValue& from, const char* key, std::size_t width) const;

  /// The file's own bytes of a picture, in a buffer or in its URI; else where the file is that it names.
  struct Picture {
    std::string bytes;
    std::filesystem::path file;
  };
  Picture picture(const GltfValue& image) const;

  /// From the node's frame to each of its instances, where EXT_mesh_gpu_instancing has them; else one that stays.
  std::vector<glm::dmat4> instances(const GltfValue& node) const;

private:
  struct Items {
    const char* first;
    std::uint64_t stride; ///< bytes from one to the next
  };
  const std::string& buffer(std::size_t index) const;
  Items items(const GltfValue& value, std::uint64_t count, std::size_t item) const;

  const GltfFile& file_;
  GltfValue root_;
  mutable std::map<std::size_t, std::string> buffers_; ///< those that were used
};

} // namespace nephroid::formats
