// SPDX-License-Identifier: Apache-2.0
#include "spectral/clusters/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace nephroid::spectral {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Gauss-Legendre nodes and weights on 0..1. The integrands are analytic up to a distance of about 1 degree from the end of the
/// interval, so that 64 nodes leave an error below 1e-8 of the integral at n next to 1, and rounding elsewhere.
struct Quadrature {
  static constexpr int count = 64;
  std::array<double, count> node{}, weight{};

  Quadrature()
  {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 0;
      for (int newton = 0; newton < 8; ++newton) {
        double p = 1, previous = 0;
        for (int k = 1; k <= count; ++k) previous = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * previous) / k);
        slope = count * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      const auto index = static_cast<std::size_t>(i);
      node[index] = (1 + x) / 2;
      weight[index] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

/// The integral over u = 0..end (radians) of asin(ratio sin u), in square radians.
double arc_integral(double ratio, double end)
{
  static const Quadrature quadrature;
  double sum = 0;
  for (std::size_t i = 0; i < quadrature.node.size(); ++i)
    sum += quadrature.weight[i] * std::asin(std::min(1.0, ratio * std::sin(end * quadrature.node[i])));
  return sum * end;
}

} // namespace

double refraction_integral_deg2(double n)
{
  constexpr double end = last_angle_deg * degree;
  if (n >= 1) return arc_integral(1 / n, end) / (degree * degree);
  // Below 1 the integrand has an infinite slope at the critical angle and stays at 90 degrees beyond it. Integrating by parts
  // exchanges the axes, and the inverse theta1 = asin(n sin theta2) is smooth.
  const double theta2_end = std::asin(std::min(1.0, std::sin(end) / n));
  return (end * theta2_end - arc_integral(n, theta2_end)) / (degree * degree);
}

std::vector<double> theta_exact(std::span<const double> n)
{
  std::vector<double> theta(n.size() - 1);
  double before = refraction_integral_deg2(n[0]);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double after = n[i + 1] == n[i] ? before : refraction_integral_deg2(n[i + 1]);
    theta[i] = std::max(0.0, after - before);
    before = after;
  }
  return theta;
}

} // namespace nephroid::spectral
