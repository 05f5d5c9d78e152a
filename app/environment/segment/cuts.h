// SPDX-License-Identifier: Apache-2.0
// Where a rectangle of a cube map is best cut in two.
#pragma once
#include "environment/segment/segment.h"

#include <optional>
#include <vector>

namespace nephroid::environment {

/// Sums of weights and of weights times unit direction, in the face's own axes s, t and outwards.
struct Moments {
  double m0 = 0;
  glm::dvec3 m1{0};

  Moments& operator+=(const Moments& other)
  {
    m0 += other.m0;
    m1 += other.m1;
    return *this;
  }
  /// M0 - |M1|^2 / M0: the weights times their squared distances from their mean, summed. 0 where it is rounding.
  double variance() const;
};

/// What each texel weighs, and its direction.
class WeighedCube {
public:
  WeighedCube(const CubeMap& cube, SegmentWeights weights);
  int size() const { return size_; }
  Moments of(int face, int x, int y) const
  {
    const double weight =
        weights_[(static_cast<std::size_t>(face) * side_ + static_cast<std::size_t>(y)) * side_ + static_cast<std::size_t>(x)];
    const double scaled = weight * outwards_[static_cast<std::size_t>(y) * side_ + static_cast<std::size_t>(x)];
    return {weight, {scaled * middle(x, size_), scaled * middle(y, size_), scaled}};
  }
  Moments sum(int face, const Rect& rect) const;

private:
  int size_;
  std::size_t side_;
  std::vector<double> weights_;
  std::vector<double> outwards_; ///< of one face: a texel's unit direction along the face's axis
};

struct Cut {
  Rect first, second;
  Moments first_moments, second_moments;
};

/// By thesis: into the most equal halves across and along, of which the one with the smaller Dev (3.2) is taken. By variance: the two parts
/// have the least variance together. Of cuts that are equally good, the one nearest to the middle, of the longer side. Nothing for one
/// texel.
std::optional<Cut> best_cut(const WeighedCube& cube, int face, const Rect& rect, SegmentMethod method);

} // namespace nephroid::environment
