// SPDX-License-Identifier: Apache-2.0
// Mitsuba's own mesh files (.serialized), of versions 3 and 4 of their format: the manual of its shape plugin
// "serialized" has it.
#pragma once
#include "base/location.h"
#include "scene/mesh.h"

namespace nephroid::formats {

struct SerializedMesh {
  scene::Mesh mesh;
  bool faceted = false;
};

/// One of the file's meshes. Throws bad_input: at `where`, no file or no mesh of this number; at the file, what is cut
/// or damaged.
SerializedMesh read_serialized(const std::filesystem::path& file, double index, const Location& where);

} // namespace nephroid::formats
