// SPDX-License-Identifier: Apache-2.0
// Surfaces, which are triangle meshes and ellipsoids: the plain data, reading meshes from files, checks. Shapes that
// the program makes are declared in scene.h.
#pragma once
#include "base/watch.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace nephroid {
class ByteSink;
}

namespace nephroid::scene {

/// A sphere, or what a scale along its axes makes of it: a surface of its own, not triangles, so that hits and normals
/// are exact.
struct Ellipsoid {
  glm::vec3 centre{0};
  std::array<glm::vec3, 3> half_axes{}; ///< perpendicular to each other, from the centre to the surface
  bool inwards = false;                 ///< the normals look towards the centre
  bool operator==(const Ellipsoid&) const = default;
};

/// The places u, v of a triangle's corners in a texture. (0, 0) is its lower left, (1, 1) its upper right.
using Texcoords = std::array<glm::vec2, 3>;

struct Mesh {
  std::vector<glm::vec3> positions;  ///< from the middle; each is a corner of a triangle, but in a file's raw mesh
  glm::dvec3 middle{0};              ///< in the file's coordinates; the origin itself unless that is far away
  std::vector<glm::vec3> normals;    ///< one a position, unit; or empty
  std::vector<glm::uvec3> triangles; ///< counter-clockwise seen from outside
  std::vector<Texcoords> texcoords;  ///< one a triangle; or empty
  std::uint32_t mended_normals = 0;  ///< those that a file had on the wrong side of its triangles, or not at all
  std::vector<Ellipsoid> ellipsoids; ///< primitives of the tree, numbered after the triangles
};

/// More triangles than this are refused, for one mesh and for a scene: the tree's indices and single buffers end near
/// it.
inline constexpr std::uint64_t max_triangles = std::uint64_t{1} << 28;

/// OBJ, PLY, STL, and what Assimp reads: glTF, 3DS and others; all its meshes as one, node transforms applied, polygons
/// cut into triangles, points and lines left out. Coordinates are read in double and rounded once, from the mesh's
/// middle where they are more than four times its size. Vertices of open edges that are four roundings apart or less
/// become one. Vertices are joined where position and normal are equal, so creases stay creases; normals are the
/// file's own (not STL's, which are a facet's), mended where they oppose the triangles, or empty; so are texcoords, of
/// the first set. Degenerate triangles
/// are kept: see drop_useless(). Throws bad_input naming the file: unreadable, no triangle with an area, a coordinate
/// that is not finite, too many triangles; interrupted where `stop` asks for it.
Mesh load_mesh(const std::filesystem::path& file, const std::stop_token& stop = {});
/// The same, but a file with the same bytes as before is not read again, as far as the last meshes take no more than
/// 256 MiB together: while an object is moved its scene is loaded again and again, and reading a mesh takes longest of
/// that. Safe from several threads. One that has further files is read each time.
std::shared_ptr<const Mesh> load_mesh_once(const std::filesystem::path& file, const Watch& watch = {});
/// Whether the mesh's data may be in other files, which this one names: a .gltf's.
bool has_further_files(const std::filesystem::path& file);

/// Binary PLY, little-endian, with normals and texcoords where the mesh has them. comment: one line, or empty.
void write_ply(const Mesh& mesh, ByteSink& to, std::string_view comment = {});

/// What is wrong with a mesh. Vertices at equal positions count as one here, whatever their normals.
struct MeshReport {
  std::uint32_t degenerate = 0;    ///< triangles without area: see drop_useless()
  std::uint32_t duplicated = 0;    ///< equal to an earlier one, facing the same way; edges and volume leave them out
  std::uint32_t open_edges = 0;    ///< edges with one triangle
  std::uint32_t crowded_edges = 0; ///< edges with more than two triangles, or two of the same direction
  double signed_volume = 0;        ///< negative: inside out
  bool closed() const { return open_edges == 0 && crowded_edges == 0; }
};
/// Safe from several threads. Takes a quarter of the time where the mesh has but moved since one of the last calls.
MeshReport inspect(const Mesh& mesh);

/// Whether a triangle is left that is not degenerate.
bool has_area(const Mesh& mesh);

/// Removes the triangles that inspect() counts as degenerate or duplicated, and the vertices that no other one uses.
/// Degenerate: no higher than 2^-24 of the longest edge, which is the spacing of floats, so that its normal would be
/// made of rounding errors.
void drop_useless(Mesh& mesh);

/// Exchanges two corners of every triangle: it faces the other way.
void turn_triangles(Mesh& mesh);

/// Reverses every triangle, normal and ellipsoid.
void turn_round(Mesh& mesh);

/// Gives every vertex the mean of the normals of the triangles that meet at its position, weighted by their angles
/// there (Thürmer and Wüthrich 1998), so that the result does not depend on how the surface was cut into triangles.
/// Edges that bend by more than crease_deg, those of one triangle and those of more than two stay sharp: their vertices
/// are there once for each side. 180: none does.
void compute_smooth_normals(Mesh& mesh, double crease_deg = 180);

/// How much solid angle `count` triangles subtend at p, over 4 pi: 1 inside and 0 outside a closed surface that faces
/// outwards (van Oosterom and Strackee 1983).
double winding_number(const Mesh& mesh, std::uint32_t first_triangle, std::uint32_t count, const glm::dvec3& p);

/// Volume that `count` triangles enclose, negative where they face inwards; meaningful for closed surfaces only.
double signed_volume(const Mesh& mesh, std::uint32_t first_triangle, std::uint32_t count);

/// The vertices, and the lowest and highest corner of a box about each ellipsoid: what a box about everything has to
/// hold.
std::vector<glm::vec3> extreme_points(const Mesh& mesh);

/// What takes a point's distance from the centre to the unit sphere: the component along a half axis, in lengths of
/// that.
std::array<glm::dvec3, 3> to_unit_sphere(const Ellipsoid& ellipsoid);

bool contains(const Ellipsoid& ellipsoid, const glm::dvec3& point);

/// Half the edges of the box along the coordinate axes about it.
glm::dvec3 half_extent(const Ellipsoid& ellipsoid);

double longest_half_axis(const Ellipsoid& ellipsoid);
double shortest_half_axis(const Ellipsoid& ellipsoid);
double volume_of(const Ellipsoid& ellipsoid);

/// The unit normal where the surface is nearest to the point, to first order; outwards unless it is turned inwards.
glm::dvec3 normal_at(const Ellipsoid& ellipsoid, const glm::dvec3& point);

struct Sphere {
  glm::vec3 centre{0};
  float radius = 0;
};

/// About the middle of the bounds: encloses every vertex that these triangles of the mesh use, and these ellipsoids,
/// rounding included.
Sphere enclosing_sphere(const Mesh& mesh, std::span<const glm::uvec3> triangles,
                        std::span<const Ellipsoid> ellipsoids = {});

} // namespace nephroid::scene
