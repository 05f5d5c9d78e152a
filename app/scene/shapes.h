// SPDX-License-Identifier: Apache-2.0
// The shapes of a preset as meshes.
#pragma once
#include "preset/preset.h"
#include "scene/mesh.h"

namespace nephroid::scene {

/// The surface of a shape of preset.h, centred by its bounds on the origin, y up, with normals. Flat facets have
/// vertices of their own, so their normals are exact; curved sides share theirs. quad: open, size x by z in the plane y
/// = 0, facing +y. box, plate: size x, y, z. sphere: an exact one, not of triangles. cylinder: about the y axis, flat
/// ends, a sharp rim. prism: stands along y; the apex edge at +z, the third side at -z, facing -z. brilliant: the round
/// brilliant cut, table up: 57 facets and 16 of the girdle.
Mesh make_shape(const preset::Shape& shape);

} // namespace nephroid::scene
