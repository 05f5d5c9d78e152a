// SPDX-License-Identifier: Apache-2.0
// What checks of meshes (mesh.cpp), mesh files (mesh_file.cpp, mesh_raw.h) and their reader (reader/main.cpp) share.
// Private to scene/.
#pragma once
#include "scene/mesh.h"

#include <cstdio>
#include <optional>
#include <string>

namespace nephroid::scene {

/// The reader may take so many times its limit of processor time, where what a file names never answers: a pipe, say.
inline constexpr unsigned mesh_reader_patience = 5;

/// Whether no coordinate is above 2^60, some 1e18, or no number. Squares of larger ones overflow in single precision,
/// and Embree ends the program over their boxes.
bool is_within_reach(const glm::vec3& place);

/// For each vertex the first vertex with exactly the same position (0 and -0 are the same), or with the same position
/// and normal.
std::vector<std::uint32_t> first_equal_vertex(const Mesh& mesh, bool compare_normals);

/// Makes each vertex the one that `same` has for it, and removes those that no triangle uses then.
void keep_used_vertices(Mesh& mesh, const std::vector<std::uint32_t>& same);

/// Without an area that single precision can tell from 0: see drop_useless().
bool is_degenerate(const Mesh& mesh, const glm::uvec3& triangle);

/// The angle-weighted mean normal of the triangles at each vertex, unit; vertices with the same entry in `same` share
/// one mean. (0, 0, 0) where no triangle with an area meets.
std::vector<glm::vec3> mean_normals(const Mesh& mesh, const std::vector<std::uint32_t>& same);

/// What the reader's program answers (reader/main.cpp), not yet looked at.
struct MeshAnswer {
  std::string refusal; ///< why it refuses the file; empty: it does not
  Mesh mesh;           ///< but for mended_normals and middle
  std::vector<std::uint32_t> mended;
  std::vector<double> middle;
};
/// Nothing where it is cut. Throws std::runtime_error where it promises more than a mesh may have.
std::optional<MeshAnswer> take_answer(std::FILE* from);
/// Throws std::runtime_error: the refusal, or why the rest of the program could not rely on the mesh.
Mesh mesh_of(MeshAnswer answer);

/// Text from a file or its reader as one short line of printable ASCII, without a full stop at its end.
std::string printable(std::string_view text);

} // namespace nephroid::scene
