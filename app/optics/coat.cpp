// SPDX-License-Identifier: Apache-2.0
#include "optics/coat.h"

#include "optics/fresnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::optics {
namespace {

/// The mean of 1 - R over the microfacets that a direction sees, drawn as in kernels/scatter/microfacet.h.
double passing_part(double cos_view, double n, double alpha) {
  if (alpha == 0) return 1 - fresnel_reflectance(cos_view, 1, n);
  constexpr int heights = 128, azimuths = 16;
  const double sin_view = std::sqrt((1 - cos_view) * (1 + cos_view));
  const double length = std::hypot(alpha * sin_view, cos_view), x = alpha * sin_view / length, z = cos_view / length;
  double sum = 0, weights = 0;
  for (int i = 0; i < heights; ++i) {
    const double t = (i + 0.5) / heights, u = t * t * (3 - 2 * t), weight = t * (1 - t); // more steps at both ends
    const double height = (1 - u) * (1 + z) - z, radius = std::sqrt(std::max(0.0, (1 - height) * (1 + height)));
    for (int j = 0; j < azimuths; ++j) {
      const double phi = std::numbers::pi * (j + 0.5) / azimuths; // both halves are alike
      const double facet_x = alpha * (x + radius * std::cos(phi)), facet_y = alpha * radius * std::sin(phi),
                   facet_z = z + height;
      const double cosine = (sin_view * facet_x + cos_view * facet_z) / std::hypot(facet_x, facet_y, facet_z);
      sum += weight * (1 - fresnel_reflectance(std::clamp(cosine, 0.0, 1.0), 1, n));
      weights += weight;
    }
  }
  return sum / weights;
}

} // namespace

Coat make_coat(double n, double alpha) {
  Coat coat;
  const double step = 1.0 / (coat_cosines - 1);
  for (std::size_t i = 0; i < coat_cosines; ++i) coat.passes[i] = passing_part(static_cast<double>(i) * step, n, alpha);
  double passes = 0; // the integral of 2 c times the part, which is linear between the cosines
  for (std::size_t i = 0; i + 1 < coat_cosines; ++i) {
    const double c = static_cast<double>(i) * step, a = coat.passes[i], b = coat.passes[i + 1];
    passes += step * (c * (a + b) + step * (a + 2 * b) / 3);
  }
  coat.mean = passes;
  return coat;
}

double seen_below_coat(const Coat& coat, double n, double reflectance) {
  const double inner = 1 - coat.mean / (n * n);
  return reflectance * (1 - inner) / (1 - inner * reflectance);
}

} // namespace nephroid::optics
