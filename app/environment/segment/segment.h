// SPDX-License-Identifier: Apache-2.0
// The environment as few directional lights: its cube map cut into rectangles, each with one direction and its whole
// flux (Kartasasmita, Algorithm 3.3; Viriyothai and Debevec 2009, "Variance minimization light probe sampling").
#pragma once
#include "environment/segment/cube.h"

#include <optional>
#include <vector>

namespace nephroid::environment {

/// variance: with a region's radiance M0 and the sum M1 of its radiance times direction, one direction leaves out M0 -
/// |M1|^2 / M0. The region with most of that is cut where least of it is left. thesis: the region of most radiance is
/// cut into halves of equal radiance, in the direction that gives the squarer rectangles (3.2).
enum class SegmentMethod { variance, thesis };

/// How much a texel's radiance counts: by its solid angle, or, as printed in the thesis, as much as any other texel's.
/// This decides the cuts and the directions; the flux is exact either way.
enum class SegmentWeights { solid_angle, texel };

struct SegmentSettings {
  int lights = 24; ///< q, at least 6
  SegmentMethod method = SegmentMethod::variance;
  SegmentWeights weights = SegmentWeights::solid_angle;
  double threshold = 1e-7; ///< a region with no more than this part of all radiance is no light; 0..1
  bool operator==(const SegmentSettings&) const = default;
};

struct Region {
  int face = 0; ///< index into face_names
  Rect rect;
  glm::dvec3 direction{0}; ///< unit; where its light comes from: the mean of its directions, weighted by radiance
  glm::dvec3 flux{0};      ///< radiance times solid angle, linear sRGB, W/m^2 of Y on a plane that faces it
  double solid_angle_sr = 0;
};

struct Segmentation {
  int cube_size = 0;
  glm::dvec3 total_flux{0};    ///< the flux of the cube map, and of all lights together
  std::vector<Region> lights;  ///< ordered by face, row and column of their first texel
  std::vector<Region> dropped; ///< regions below the threshold, black or with their flux added to the nearest light's;
                               ///< with the lights they tile the cube
};

/// Radiance is luminance here. A region of one texel is not cut, so there are fewer lights where fewer texels are lit,
/// and none where the map is black. Throws bad_input at "q" for fewer than 6.
Segmentation segment(const CubeMap& cube, const SegmentSettings& settings);

/// The lights of a map of one colour all around, without a search for cuts: each face has as many parts across as down,
/// at equal angles, as few as make `lights`. For 6 and 24 they are those of segment().
Segmentation even_segments(const CubeMap& cube, int lights);

/// Sums of weights and of weights times unit direction, in the face's own axes s, t and outwards.
struct Moments {
  double m0 = 0;
  glm::dvec3 m1{0};

  Moments& operator+=(const Moments& other) {
    m0 += other.m0;
    m1 += other.m1;
    return *this;
  }
  /// M0 - |M1|^2 / M0: the sum of weights times squared distances from the mean. 0 where rounding is larger.
  double variance() const;
};

/// The weight and the direction of each texel.
class WeighedCube {
public:
  WeighedCube(const CubeMap& cube, SegmentWeights weights);
  int size() const { return size_; }
  Moments of(int face, int x, int y) const {
    const double weight = weights_[(static_cast<std::size_t>(face) * side_ + static_cast<std::size_t>(y)) * side_ +
                                   static_cast<std::size_t>(x)];
    const double scaled = weight * outwards_[static_cast<std::size_t>(y) * side_ + static_cast<std::size_t>(x)];
    return {weight, {scaled * middle(x, size_), scaled * middle(y, size_), scaled}};
  }
  Moments sum(int face, const Rect& rect) const;

private:
  int size_;
  std::size_t side_;
  std::vector<double> weights_;
  std::vector<double> outwards_; ///< for one face: the component of a texel's unit direction along the face's axis
};

struct Cut {
  Rect first, second;
  Moments first_moments, second_moments;
};

/// thesis: of the most equal halves across and along, those with the smaller Dev (3.2) are taken. variance: the two
/// parts have the least variance together. Equally good cuts: the one nearest to the middle. Nothing for one texel.
std::optional<Cut> best_cut(const WeighedCube& cube, int face, const Rect& rect, SegmentMethod method);

} // namespace nephroid::environment
