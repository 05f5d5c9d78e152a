// SPDX-License-Identifier: Apache-2.0
// What PBRT's materials, media, lights and shapes are here, wherever its directives put them.
#pragma once
#include "formats/import/description.h"
#include "formats/import/pbrt_file.h"

namespace nephroid::formats {

/// A type and parameters, as the file has them.
struct PbrtThing {
  std::string type;
  PbrtParameters parameters;
};

struct PbrtScene {
  Description& d;
  const PbrtFile& file;
  std::map<std::string, PbrtParameter> textures{}; ///< the values of those that are constant
  std::map<std::string, PbrtThing> pictures{};     ///< the other textures of colours
  std::map<std::string, PbrtThing> numbers{};      ///< the other textures of numbers
  std::map<std::string, PbrtThing> materials{};    ///< those without a name have a number
  std::map<std::string, PbrtThing> media{};
  bool is_version_3 = false;
  int nested = 0; ///< how many mixes and textures are being read, each in the one before
};

/// A note for each parameter that nothing has asked for and that changes a picture.
void note_unasked(PbrtScene& scene, const PbrtParameters& p);

/// The parameter of this name; where it is no colour, a note says that a grey of `standard` takes its place.
DescribedColour pbrt_colour(PbrtScene& scene, const PbrtParameters& p, const std::string& name, double standard);
/// The same of a light: version 4 gives spectra a luminance of 1.
DescribedColour pbrt_light_colour(PbrtScene& scene, const PbrtParameters& p, const std::string& name);
/// Adds a light or the surroundings.
void add_pbrt_light(PbrtScene& scene, const std::string& type, const PbrtParameters& p, const glm::dmat4& to_world);

/// Adds the material or dielectric under this key. medium: what is in it. False for what is no surface.
bool add_pbrt_material(PbrtScene& scene, const std::string& key, const PbrtThing& material, const PbrtThing* medium);

/// Without a material. Nothing where a note says that the shape is left out.
std::optional<DescribedShape> pbrt_shape(PbrtScene& scene, const std::string& type, const PbrtParameters& p,
                                         const glm::dmat4& to_world);
/// The limit of Loop's subdivision of a closed or open mesh (Loop 1987), as its triangles after so many levels.
scene::Mesh subdivided(const scene::Mesh& mesh, int levels);

} // namespace nephroid::formats
