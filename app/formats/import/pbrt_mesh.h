// SPDX-License-Identifier: Apache-2.0
// Triangles that a PBRT file lists itself.
#pragma once
#include "formats/import/pbrt_tokens.h"
#include "scene/mesh.h"

namespace nephroid::formats {

/// type: trianglemesh or bilinearmesh, whose patches become two triangles. Throws bad_input where an index names no
/// point.
scene::Mesh pbrt_mesh(const std::string& type, const PbrtParameters& p);

} // namespace nephroid::formats
