// SPDX-License-Identifier: Apache-2.0
// Meshes that were read before. While an object is moved its scene is loaded again and again, and reading a mesh takes longest of that.
#pragma once
#include "scene/mesh.h"

#include <filesystem>
#include <memory>

namespace nephroid::scene {

/// Whether the mesh's data may be in other files, which this one names: a .gltf's.
bool has_further_files(const std::filesystem::path& file);

/// As load_mesh, but a file with the same bytes as before is not read again, as far as the last meshes take no more than 256 MiB together.
/// Safe from several threads. One that has further files is read each time.
std::shared_ptr<const Mesh> load_mesh_once(const std::filesystem::path& file);

} // namespace nephroid::scene
