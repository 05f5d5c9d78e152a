// SPDX-License-Identifier: Apache-2.0
// A binary glTF 2.0 file, which is JSON and one chunk of bytes that it points into; and a scene as one: what
// formats/import/gltf_scene.h reads, the other way round.
#pragma once
#include "formats/export/export.h"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace nephroid::formats {

/// As glTF and caustics.json have three numbers.
inline nlohmann::ordered_json three_numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

class Glb {
public:
  using Json = nlohmann::ordered_json;
  Json json;

  /// What they add is named by its index in the file's list. Nothing is empty.
  std::size_t positions(const std::vector<glm::vec3>& values); ///< with the bounds that these need
  std::size_t normals(const std::vector<glm::vec3>& values);
  std::size_t places(const std::vector<glm::vec2>& values); ///< in a texture
  std::size_t corners(const std::vector<glm::uvec3>& triangles);
  std::size_t png(std::string_view bytes); ///< an image

  std::size_t add(const char* list, Json item);
  void use(const char* extension); ///< each is named once

  /// The file. Throws failed where it would be larger than the format can be: 4 GiB.
  std::string bytes() const;

private:
  std::size_t accessor(const void* bytes, std::size_t count, int component, const char* type,
                       Json bounds = Json::object());
  std::size_t view(const void* bytes, std::size_t count);

  std::string bin_;
};

/// Linear sRGB, 0..1, under D65.
std::array<double, 3> colour_of_reflectance(const optics::Spectrum& reflectance);

/// The colour of a light's spectrum.
struct GltfColour {
  std::array<double, 3> rgb{};  ///< linear sRGB, the largest is 1
  double luminous_per_watt = 0; ///< over the luminance of rgb
};
GltfColour colour_of_light(const optics::Spectrum& spectrum);

/// Preset coordinates in metres, y up. Area lights and the surroundings have no counterpart; the caustics are light
/// that the receivers' materials send out, in cd/m^2.
Glb gltf_of(const scene::Scene& scene, const preset::Preset& preset, const std::vector<Caustic>& caustics);

} // namespace nephroid::formats
