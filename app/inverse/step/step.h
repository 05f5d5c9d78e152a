// SPDX-License-Identifier: Apache-2.0
// The solid as a STEP file (AP214, millimetres), by OpenCascade.
#pragma once
#include "inverse/facets/solid.h"
#include "inverse/step/seam.h"

namespace nephroid::inverse {

/// Throws bad_input where the module is not installed that writes STEP. `where` is the setting that asks for it.
void require_step(const Location& where);

/// The planes of facets, walls, sides and front as one face each, in the mesh's vertices. Walls that lean are faces of
/// three corners. Throws failed where a face has not one ring.
StepSolid step_faces(const Layout& layout, const Solid& solid);

struct StepFile {
  std::string bytes;
  std::size_t faces = 0;
  double volume = 0; ///< mm^3, as OpenCascade finds it in what it read back
};

/// The volumes of the file and of the solid may differ by this part of them.
inline constexpr double step_volume_error = 1e-4;

/// Facets become planar faces. A lens becomes one bicubic B-spline surface, which is its surface itself. The file is
/// read back. Throws failed where it has another volume, where OpenCascade does not do it, or without the module.
StepFile step_file(const Layout& layout, const Solid& solid, const std::string& name);

} // namespace nephroid::inverse
