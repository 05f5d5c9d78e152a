// SPDX-License-Identifier: Apache-2.0
// Triangle meshes: the plain data, reading them from files, checks. Shapes made by the program are in shapes.h.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::scene {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;     ///< one a position, unit; or empty
  std::vector<glm::uvec3> triangles;  ///< counter-clockwise seen from outside
};

/// OBJ, PLY, STL, glTF, 3DS and whatever else Assimp reads; all its meshes as one, vertices at equal positions joined.
/// Throws bad_input naming the file: unreadable, no triangles, a coordinate that is not finite.
Mesh load_mesh(const std::filesystem::path& file);

struct MeshReport {
  std::uint32_t degenerate = 0;      ///< triangles without area
  std::uint32_t duplicated = 0;      ///< triangles with the same three positions as an earlier one
  std::uint32_t open_edges = 0;      ///< edges with one triangle
  std::uint32_t crowded_edges = 0;   ///< edges with more than two triangles, or two of the same direction
  double signed_volume = 0;          ///< negative: inside out
  bool closed() const { return open_edges == 0 && crowded_edges == 0; }
};
MeshReport inspect(const Mesh& mesh);

/// Area-weighted vertex normals over triangles that meet within crease_deg of each other are left to the loader; this gives
/// every vertex the angle-weighted mean of its triangles' normals (positions joined).
void compute_smooth_normals(Mesh& mesh);

/// How much solid angle the mesh subtends at p, over 4 pi: 1 inside, 0 outside, for closed meshes (van Oosterom and Strackee 1983).
double winding_number(const Mesh& mesh, std::uint32_t first_triangle, std::uint32_t count, const glm::dvec3& p);

} // namespace nephroid::scene
