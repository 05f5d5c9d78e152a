// SPDX-License-Identifier: Apache-2.0
#include "optics/fresnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::optics {

std::optional<double> refracted_cosine(double cos_i, double n_i, double n_t) {
  const double ratio = n_i / n_t;
  const double sin2_t = ratio * ratio * std::max(0.0, 1 - cos_i * cos_i);
  if (sin2_t > 1) return std::nullopt;
  return std::sqrt(1 - sin2_t);
}

double fresnel_reflectance(double cos_i, double n_i, double n_t) {
  const std::optional<double> cos_t = refracted_cosine(cos_i, n_i, n_t);
  if (!cos_t) return 1;
  // Amplitudes for light polarised across (s) and in (p) the plane of incidence; unpolarised light is the mean of both
  // powers. At grazing incidence between equal media both quotients are 0 / 0, and nothing is reflected.
  const double s_sum = n_i * cos_i + n_t * *cos_t, p_sum = n_i * *cos_t + n_t * cos_i;
  if (s_sum <= 0 || p_sum <= 0) return n_i == n_t ? 0 : 1;
  const double s = (n_i * cos_i - n_t * *cos_t) / s_sum, p = (n_i * *cos_t - n_t * cos_i) / p_sum;
  return std::min(1.0, (s * s + p * p) / 2);
}

BallRay ball_ray(double h, double n, int inner) {
  const double i = std::asin(h), t = std::asin(h / n), f = fresnel_reflectance(std::cos(i), 1, n);
  if (inner < 0) return {-std::cos(i), h, std::numbers::pi - 2 * i, f, 0};
  const double chord_angle = std::numbers::pi - 2 * t, exit = std::numbers::pi - i - (inner + 1) * chord_angle;
  return {std::cos(exit), std::sin(exit), -2 * (i - t) - inner * chord_angle, (1 - f) * (1 - f) * std::pow(f, inner),
          2 * std::cos(t)};
}

} // namespace nephroid::optics
