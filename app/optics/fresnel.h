// SPDX-License-Identifier: Apache-2.0
// Snell's law, Fresnel's equations and a glass ball by them, in double precision: the truth for the kernels.
#pragma once
#include <complex>
#include <optional>

namespace nephroid::optics {

/// sin(theta_t) = n_i / n_t sin(theta_i). cos_i in 0..1. Empty: total internal reflection.
std::optional<double> refracted_cosine(double cos_i, double n_i, double n_t);
/// Unpolarised reflectance 0..1; 1 at total internal reflection.
double fresnel_reflectance(double cos_i, double n_i, double n_t);

/// Unpolarised reflectance of a metal of complex index n + i k, from a medium of index n_i. cos_i in 0..1.
double conductor_reflectance(double cos_i, double n_i, std::complex<double> metal);
/// Unpolarised reflectance of an interface with one layer on it, whose thickness is in wavelengths of the vacuum; 1 at
/// total internal reflection.
double coated_reflectance(double cos_i, double n_i, double n_layer, double n_t, double thickness);

/// A ray through a glass ball of radius 1 about the origin, in parallel light along +x, in the plane of the ray.
///
/// A ray at height h = sin(i) meets the ball at the polar angle pi - i (from +x) and is bent by i - t towards the axis,
/// sin(t) = h / n. Inside, every chord spans pi - 2 t as seen from the centre, and every reflection turns the ray by as
/// much; at each end the angle is t, so the reflectance F there is that of the entry. Having left after `inner`
/// reflections the ray has been turned by 2 (i - t) + inner (pi - 2 t), and has (1 - F)^2 F^inner of its power.
struct BallRay {
  double x = 0, y = 0; ///< where it leaves the ball
  double angle = 0;    ///< its direction's, counter-clockwise from +x
  double share = 0;    ///< its part of the power that met the ball at this height
  double chord = 0;    ///< length of one way through the ball
};
/// inner: reflections inside before it leaves; -1: reflected outside at once.
BallRay ball_ray(double h, double n, int inner);

} // namespace nephroid::optics
