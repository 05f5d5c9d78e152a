// SPDX-License-Identifier: Apache-2.0
// Boxes whose top is a height over a grid: water with waves, and the relief of a picture. Private to scene/.
#pragma once
#include "base/files.h"
#include "base/location.h"
#include "preset/preset.h"
#include "scene/mesh.h"

namespace nephroid::scene {

/// The surface of a shape of type water or relief, closed, with normals and texcoords. The box that is below rest, or
/// below black, is centred on the origin. Waves are at least 4 squares long: shorter ones are left out. warnings: of
/// waves that are left out for that, and what make_texture() says, after `label`. where:
/// FILE#/scene/objects/INDEX/shape. Throws bad_input there: waves deeper than the water, no such picture.
Mesh make_heights(const preset::Shape& shape, double metres_per_unit, const FileFinder& finder, const Location& where,
                  const std::string& label, std::vector<std::string>& warnings);

/// Whether it is one of these.
inline bool has_heights(const preset::Shape& shape) {
  return shape.type == preset::Shape::Type::water || shape.type == preset::Shape::Type::relief;
}

} // namespace nephroid::scene
