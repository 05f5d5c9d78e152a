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

namespace {

/// Amplitudes of reflection at a face, of light polarised across and in the plane of incidence.
struct Amplitudes {
  std::complex<double> s, p;
};

using Complex = std::complex<double>;

Complex cosine(double sine_i, double n_i, Complex n) {
  const Complex sine = n_i * sine_i / n;
  return std::sqrt(1.0 - sine * sine);
}

Amplitudes amplitudes(Complex near, Complex cos_near, Complex far, Complex cos_far) {
  return {(near * cos_near - far * cos_far) / (near * cos_near + far * cos_far),
          (near * cos_far - far * cos_near) / (near * cos_far + far * cos_near)};
}

double mean_power(Complex s, Complex p) { return (std::norm(s) + std::norm(p)) / 2; }

double sine_of(double cosine) { return std::sqrt((1 - cosine) * (1 + cosine)); }

} // namespace

double conductor_reflectance(double cos_i, double n_i, Complex metal) {
  const Amplitudes r = amplitudes(n_i, cos_i, metal, cosine(sine_of(cos_i), n_i, metal));
  return mean_power(r.s, r.p);
}

double coated_reflectance(double cos_i, double n_i, double n_layer, double n_t, double thickness) {
  const std::optional<double> cos_t = refracted_cosine(cos_i, n_i, n_t);
  if (!cos_t) return 1;
  const Complex cos_layer = cosine(sine_of(cos_i), n_i, n_layer);
  const Complex phase = std::exp(Complex(0, 4 * std::numbers::pi * thickness * n_layer) * cos_layer);
  const Amplitudes first = amplitudes(n_i, cos_i, n_layer, cos_layer),
                   second = amplitudes(n_layer, cos_layer, n_t, *cos_t);
  const auto together = [&](Complex a, Complex b) { return (a + b * phase) / (1.0 + a * b * phase); };
  return mean_power(together(first.s, second.s), together(first.p, second.p));
}

BallRay ball_ray(double h, double n, int inner) {
  const double i = std::asin(h), t = std::asin(h / n), f = fresnel_reflectance(std::cos(i), 1, n);
  if (inner < 0) return {-std::cos(i), h, std::numbers::pi - 2 * i, f, 0};
  const double chord_angle = std::numbers::pi - 2 * t, exit = std::numbers::pi - i - (inner + 1) * chord_angle;
  return {std::cos(exit), std::sin(exit), -2 * (i - t) - inner * chord_angle, (1 - f) * (1 - f) * std::pow(f, inner),
          2 * std::cos(t)};
}

} // namespace nephroid::optics
