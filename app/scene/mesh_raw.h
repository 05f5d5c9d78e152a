// SPDX-License-Identifier: Apache-2.0
// OBJ, PLY and STL files, as text or bytes, and what is made of any file's triangles. Runs in the mesh reader's
// program. What is wrong with a file is a std::runtime_error: load_mesh() adds the file's name. Private to scene/.
#pragma once
#include "scene/mesh.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::scene {

/// What a file says, in its own coordinates.
struct RawMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals; ///< one a position, unit or (0, 0, 0); or empty
  std::vector<glm::uvec3> triangles;
  std::vector<Texcoords> texcoords; ///< one a triangle; or empty
};

RawMesh read_obj(std::string text);
RawMesh read_ply(std::string_view bytes);
RawMesh read_stl(std::string_view bytes);

/// Vertices about the mesh's own middle where that is far off, seams that are open by rounding closed, equal vertices
/// joined, wrong normals mended: see load_mesh().
Mesh finished(RawMesh raw);

/// Blanks, a word, which it returns; empty at the text's end. `lines` counts what ends a line on the way.
std::string_view next_word(std::string_view& text, std::size_t* lines = nullptr);
/// The coordinate that a text file has there. Throws where it is none, or not finite. line: 0 where it is not known.
double coordinate_of(std::string_view word, std::size_t line);
/// A unit vector; (0, 0, 0) where there is no direction.
glm::vec3 direction_of(const glm::dvec3& vector);
/// Cuts a flat polygon, which may be concave, into triangles. corners: indices of mesh.positions, which there are.
/// texcoords: of the corners; none where no triangle of the mesh has any.
void add_polygon(RawMesh& mesh, std::span<const std::uint32_t> corners, std::span<const glm::vec2> texcoords = {});
/// Throws where there is no such vertex. what: "face 3", or "line 3".
std::uint32_t vertex_of(double index, const RawMesh& mesh, const std::string& what);

} // namespace nephroid::scene
