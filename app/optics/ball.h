// SPDX-License-Identifier: Apache-2.0
// Geometrical optics of a glass ball in parallel light, from Snell's law: where each ray goes and what it carries. Radius 1, about the
// origin; light along +x; everything in the plane of one ray.
//
// A ray at height h = sin(i) meets the ball at the polar angle pi - i (from +x) and is bent by i - t towards the axis, sin(t) = h / n.
// Inside, every chord spans pi - 2 t as seen from the centre, and every reflection turns the ray by as much; at each end the angle is t,
// so the reflectance F there is that of the entry. Having left after `inner` reflections the ray has been turned by
// 2 (i - t) + inner (pi - 2 t), and has (1 - F)^2 F^inner of its power.
#pragma once
#include "optics/fresnel.h"

#include <cmath>
#include <numbers>

namespace nephroid::optics {

struct BallRay {
  double x = 0, y = 0; ///< where it leaves the ball
  double angle = 0;    ///< of its direction, counter-clockwise from +x
  double share = 0;    ///< of the power that met the ball at this height
  double chord = 0;    ///< length of one way through the ball
};

/// inner: reflections inside before it leaves; -1: reflected outside at once.
inline BallRay ball_ray(double h, double n, int inner)
{
  const double i = std::asin(h), t = std::asin(h / n), f = fresnel_reflectance(std::cos(i), 1, n);
  if (inner < 0) return {-std::cos(i), h, std::numbers::pi - 2 * i, f, 0};
  const double chord_angle = std::numbers::pi - 2 * t, exit = std::numbers::pi - i - (inner + 1) * chord_angle;
  return {std::cos(exit), std::sin(exit), -2 * (i - t) - inner * chord_angle, (1 - f) * (1 - f) * std::pow(f, inner), 2 * std::cos(t)};
}

/// Height at which it meets a screen across the axis at x; NAN: it goes the other way.
inline double height_on_screen(const BallRay& ray, double x)
{
  return std::cos(ray.angle) > 0 ? ray.y + (x - ray.x) * std::tan(ray.angle) : NAN;
}

} // namespace nephroid::optics
