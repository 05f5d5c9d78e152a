// SPDX-License-Identifier: Apache-2.0
#include "environment/segment/cube.h"

#include <cmath>

namespace nephroid::environment {
namespace {

/// Of the rectangle from the middle of a face to (s, t), with the sign of s t: the integral of (1 + s^2 + t^2)^(-3/2).
double solid_angle_to(double s, double t) { return std::atan(s * t / std::sqrt(1 + s * s + t * t)); }

} // namespace

glm::dvec3 position(const CubePoint& point)
{
  const double s = point.s, t = point.t;
  switch (point.face) {
  case 0:
    return {1, -t, -s};
  case 1:
    return {-1, -t, s};
  case 2:
    return {s, 1, t};
  case 3:
    return {s, -1, -t};
  case 4:
    return {s, -t, 1};
  default:
    return {-s, -t, -1};
  }
}

double solid_angle(const Rect& rect, int size)
{
  const double s0 = border(rect.x0, size), s1 = border(rect.x1, size), t0 = border(rect.y0, size), t1 = border(rect.y1, size);
  return solid_angle_to(s1, t1) - solid_angle_to(s0, t1) - solid_angle_to(s1, t0) + solid_angle_to(s0, t0);
}

} // namespace nephroid::environment
