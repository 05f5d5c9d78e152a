// SPDX-License-Identifier: Apache-2.0
// Caustic spheres: what an object does to parallel light from each of several directions (thesis 3.1).
//
// A texel of a sphere stores the power through it over its solid angle, for light of 1 W/m^2. This is E r^2, where E is
// the irradiance on the sphere itself, that is on a surface that faces the middle. A block of texels also stores the
// mean way that their light goes. A surface with another normal gets E cos(its normal, way) / cos(the sphere's normal,
// way), which is exact where all light of a block goes one way. (The thesis takes all light to come from the middle.
// Under a low sun `environment/bunny` then has 30 % too much light on its floor.)
#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::environment {

/// The map of a caustic sphere: a square whose texels have the same solid angle, the octahedral map of Clarberg (2008,
/// "Fast equal-area mapping of the (hemi)sphere using SIMD"). kernels/environment/sphere_map.h has it too.
struct SphereMap {
  int side = 1; ///< texels across and down

  std::size_t texels() const { return static_cast<std::size_t>(side) * static_cast<std::size_t>(side); }
  /// One texel's, in steradians.
  double solid_angle() const { return 4 * std::numbers::pi / static_cast<double>(texels()); }
  /// The number of the texel in a direction, row after row. direction: any length but 0.
  std::size_t texel(const glm::dvec3& direction) const;
  /// The unit direction of a texel's middle.
  glm::dvec3 direction(std::size_t texel) const;

  /// The stored form of a map has a border of one more texel all around, which holds what is over the edge: there the
  /// square goes on at the same edge, from its other end. So lookups between texels need no branch.
  std::size_t stored_texels() const { return static_cast<std::size_t>(side + 2) * static_cast<std::size_t>(side + 2); }
  std::size_t stored_texel(std::size_t texel) const; ///< where a texel is in the stored form
  /// The texel that a texel of the stored form repeats: texel_of_stored of kernels/environment/spheres.h.
  std::size_t texel_of_stored(std::size_t stored) const;

  /// The stored form is divided into blocks, whose texels share a way, a step of brightness and a colour
  /// (kernels/environment/render_types.h).
  std::size_t blocks() const;
  std::size_t block(std::size_t stored) const; ///< the block of a texel of the stored form
};

/// What a texel of a sphere has.
struct TexelLight {
  glm::dvec3 light{0}; ///< E r^2 over size^2, linear sRGB
  glm::dvec3 way{0};   ///< the mean way of its light, as long as there is light across it
};

/// The numbers of directions that light may be baked from. These are points of a cube's surface, towards its middle
/// (thesis 3.1). Each face is a square grid whose points on edges and corners it shares with its neighbours: 3 x 3
/// points a face are 26 in all (8 corners, 12 middles of edges, 6 of faces), 5 x 5 are 98, 9 x 9 are 386.
std::span<const int> direction_counts();

/// The surface points with whole coordinates of a cube from -m to m, m = 1, 2 or 4. z changes fastest, then y.
std::vector<glm::ivec3> cube_points(int count);

/// The way the light goes from each of cube_points(count), a unit vector.
std::vector<glm::dvec3> light_directions(int count);

/// Where the light of one direction goes, as areas across it in squares of Bake::size: the light that meets the object,
/// and its parts that leave it, are absorbed, and are lost after too many surfaces.
struct BakedDirection {
  double met = 0, sent = 0, absorbed = 0, lost = 0;
};

struct Bake {
  SphereMap map;
  int channels = 1;                   ///< 3: a texel is linear sRGB under white light; 1: its three channels are equal
  double size = 1;                    ///< largest side of the box about the object
  std::vector<double> radii;          ///< the spheres' radii, ascending
  std::vector<glm::dvec3> directions; ///< all directions to bake, shape after shape: unit, the way the light goes
  std::vector<double> weights{1};     ///< how much each shape counts that the object is between; they sum to 1
  std::vector<BakedDirection> baked;  ///< for the directions done so far, the first ones

  // The layout is that of devices (Maps of kernels/environment/spheres.h): [baked direction][sphere], then
  std::vector<std::uint8_t> texels;  ///< [texel of the stored form]: its brightness, in steps of its block
  std::vector<std::uint16_t> blocks; ///< [block]: a texel of way_map, the mean way of its light; [block]: its step; of
                                     ///< 3 channels [block]: its colour

  /// The unit vectors that are ways, about 0.8 degrees apart.
  static constexpr SphereMap way_map{256};

  std::size_t map_blocks() const { return map.blocks() * (channels == 3 ? 3 : 2); } ///< numbers of a sphere in `blocks`
  std::uint64_t bytes(std::size_t direction_count) const;
  void resize(std::size_t direction_count); ///< to that many baked directions
  /// Adds another shape's baked directions from that one on. Its radii and size may be others.
  void append(const Bake& more, std::size_t first = 0);
  /// E r^2 over size^2 in a texel, linear sRGB, as it is stored.
  glm::dvec3 at(std::size_t direction, std::size_t sphere, std::size_t texel) const;
  /// light: [texel of the map].
  void store(std::size_t direction, std::size_t sphere, std::span<const TexelLight> light);
};

/// A bake kept in the folder of caches under the name of its key. It is written whole, and used only where this version
/// of the program and its kernels made it for exactly this key, and it is as long as it was.
struct BakeIdentity {
  std::uint64_t key = 0;     ///< bake_key
  std::uint64_t kernels = 0; ///< hash of the kernels' sources; 0 where they are not known yet
};

/// The bake's file; empty where the user has no folder of caches.
std::filesystem::path bake_path(std::uint64_t key);

/// Why the file cannot be used, by its first bytes and its length. "": there is no file; nothing: it can be used.
std::optional<std::string> bake_file_fault(const std::filesystem::path& file, const BakeIdentity& identity);

/// Throws bad_input, saying why, where the file cannot be used.
Bake read_bake(const std::filesystem::path& file, const BakeIdentity& identity);

/// Makes the folder and writes the file. Throws failed where that is not possible. Then removes the oldest bakes of the
/// folder until all take at most `most` bytes; the one just written stays.
void write_bake(const std::filesystem::path& file, const BakeIdentity& identity, const Bake& bake,
                std::uint64_t most = std::uint64_t{4} << 30);

} // namespace nephroid::environment
