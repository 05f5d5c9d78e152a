// SPDX-License-Identifier: Apache-2.0
// Heights on a grid as a smooth surface: a bicubic spline through them. Its second derivatives are continuous, and so
// is the light that it sends, whose density follows from them.
#pragma once
#include "inverse/poisson.h"

namespace nephroid::inverse {

/// A cubic spline through a value at each node, along columns and rows; quadratic at the rim. Lengths are in nodes.
class Spline {
public:
  /// `values` has at least two nodes either way.
  explicit Spline(const Grid& values);

  struct At {
    double value = 0;
    glm::dvec2 gradient{0};  ///< along columns and along rows
    glm::dvec3 curvature{0}; ///< second derivatives: twice along columns, once along each, twice along rows
  };
  /// p is a column and row; beside the nodes the pieces at the rim go on.
  At at(const glm::dvec2& p) const;
  const Grid& bells() const { return parts_; }

private:
  Grid parts_; ///< heights of the spline's bells, one more on each side than nodes
};

/// z over the facets' side of an object, from a grid of heights at the facets' corners.
class Surface {
public:
  /// `size` is the object's. `corners` has z, row by row from the top, one more across and down than facets.
  Surface(const glm::dvec2& size, const Grid& corners)
      : spline_(corners), size_(size), facet_(size / glm::dvec2(corners.cols() - 1, corners.rows() - 1)) {}

  struct At {
    double z = 0;
    glm::dvec2 gradient{0};
    glm::dmat2 curvature{0}; ///< second derivatives
  };
  At at(const glm::dvec2& p) const {
    const Spline::At found = spline_.at({(p.x + size_.x / 2) / facet_.x, (size_.y / 2 - p.y) / facet_.y});
    const glm::dvec3 c =
        found.curvature / glm::dvec3(facet_.x * facet_.x, -facet_.x * facet_.y, facet_.y * facet_.y); // rows go down
    return {found.value, found.gradient / glm::dvec2(facet_.x, -facet_.y), {c.x, c.y, c.y, c.z}};
  }

  /// Heights of the spline's bells, which stand at the corners and one step beside them.
  const Grid& bells() const { return spline_.bells(); }

private:
  Spline spline_;
  glm::dvec2 size_, facet_;
};

} // namespace nephroid::inverse
