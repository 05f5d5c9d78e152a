// SPDX-License-Identifier: Apache-2.0
// What PBRT's materials, lights and shapes are here, wherever its directives put them.
#pragma once
#include "formats/import/description.h"
#include "formats/import/pbrt_file.h"

namespace nephroid::formats {

struct PbrtScene {
  Description d;
  std::map<std::string, PbrtParameter> textures; ///< the values of those that are constant
};

/// The parameter of this name as a colour; where it is none, a note says that `standard` takes its place.
glm::dvec3 pbrt_colour(PbrtScene& scene, const PbrtParameters& p, const std::string& name, const glm::dvec3& standard);
preset::Material pbrt_material(PbrtScene& scene, const std::string& type, const PbrtParameters& p);
/// Adds a light or the surroundings.
void add_pbrt_light(PbrtScene& scene, const std::string& type, const PbrtParameters& p, const glm::dmat4& to_world);
/// Without a material. Nothing where a note says that the shape is left out.
std::optional<DescribedShape> pbrt_shape(PbrtScene& scene, const std::string& type, const PbrtParameters& p,
                                         const glm::dmat4& to_world);

} // namespace nephroid::formats
