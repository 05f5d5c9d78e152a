// SPDX-License-Identifier: Apache-2.0
// A mesh file that is dropped on the window becomes an object of the scene: made as large as the scene asks for, and put where
// the camera looks.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace nephroid::ui {

struct DroppedMesh {
  std::filesystem::path file; ///< absolute
  scene::Bounds box;          ///< in the file's coordinates
  bool closed = true;         ///< every edge is shared by exactly two triangles
};

/// Throws bad_input naming the file where there is no mesh in it that could be rendered.
DroppedMesh read_dropped_mesh(const std::filesystem::path& file);

/// The preset with the mesh as its last object, and what was done, a sentence. The material is the first dielectric, else the first of all,
/// else new glass. The longest edge of the mesh's box becomes 0.4 of what the camera sees at its target, where the box' middle goes. Throws
/// bad_input where the preset refuses dielectrics that are not closed and this would be one.
struct WithMesh {
  preset::Preset preset;
  std::string note;
};
WithMesh with_mesh(preset::Preset preset, const DroppedMesh& mesh);

} // namespace nephroid::ui
