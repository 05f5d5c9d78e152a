// SPDX-License-Identifier: Apache-2.0
// A stone on its own: one polished body of glass or crystal of a scene, and what a cutter says of its shape.
#pragma once
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::gems {

/// Facets that lean alike.
struct Tier {
  double angle_deg = 0; ///< from the table's plane: 0 the table or a culet, 90 the girdle
  int facets = 0;
};

/// Its table looks up, along +y; the picture's right is +x.
struct Shape {
  double width_mm = 0, depth_mm = 0, height_mm = 0; ///< along x, z, y
  double volume_mm3 = 0;
  int facets = 0;                            ///< triangles in one plane that touch are one
  std::vector<Tier> crown, girdle, pavilion; ///< steepest first; empty where there are more than 1000 facets
  std::optional<double> table_share;         ///< the widest facet that looks up, along x, over the width; empty: none
};

struct Stone {
  std::string name;     ///< the object's
  std::string material; ///< its key in the preset
  scene::Scene scene;   ///< with this object alone
  scene::Bvh bvh;
  double n_d = 1, n_c = 1, n_f = 1; ///< indices of refraction at Fraunhofer's lines
  optics::Spectrum n{}, loss{};     ///< exp(-loss s) is left of a wavelength's light after s scene units
  double loss_d = 0;                ///< at the line d
  Shape shape;
  scene::Sphere bounds; ///< encloses it

  /// Total reflection inside begins at this angle from the normal, in degrees; 90 where n_d is not above 1.
  double critical_deg() const;
  bool disperses() const { return n_f != n_c; }
};

/// object: its name; empty: the only body of glass. Light and everything else of the preset is left out. Throws
/// bad_input: no such object, none or several bodies of glass, one that is open, rough, tinted or coated; and as
/// scene::load_scene does.
Stone load_stone(const preset::Preset& preset, const std::string& object = {});

} // namespace nephroid::gems
