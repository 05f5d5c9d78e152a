// SPDX-License-Identifier: Apache-2.0
// The triangles of a glTF file's primitives. Each is handed to the mesh reader, a program of its own, as a glTF file that holds this
// primitive alone: so what is corrupt in it harms nobody, and nobody has to guess which of the reader's meshes is which of the file's.
#pragma once
#include "run/import/gltf_file.h"
#include "scene/mesh.h"

namespace nephroid::run {

class GltfMeshes {
public:
  /// Throws bad_input where a buffer is missing or shorter than the file says. file outlives this.
  explicit GltfMeshes(const GltfFile& file);
  ~GltfMeshes();
  GltfMeshes(const GltfMeshes&) = delete;
  GltfMeshes& operator=(const GltfMeshes&) = delete;

  /// In the mesh's own frame, with normals where the file has them. primitive: of meshes/I/primitives. Throws bad_input, at the primitive
  /// or at what it uses.
  scene::Mesh read(const GltfValue& primitive) const;

private:
  GltfJson buffer(const GltfValue& value, std::size_t index) const;

  const GltfFile& file_;
  std::filesystem::path folder_; ///< of what the reader reads; gone with this
  std::vector<GltfJson> buffers_;
};

} // namespace nephroid::run
