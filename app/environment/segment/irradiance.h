// SPDX-License-Identifier: Apache-2.0
// The irradiance on a diffuse surface of an environment, or of the lights that it is cut into.
#pragma once
#include "environment/segment/segment.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace nephroid::environment {

/// The irradiance of all texels on planes whose normals lie evenly on the sphere, linear sRGB, W/m^2 of Y.
std::vector<glm::dvec3> irradiances(const CubeMap& cube, int normals = 256);

/// The error of the lights' irradiance against the truth, which irradiances() gave: the norm of the difference over all
/// normals and channels, over the norm of the truth. 0 where the truth is black.
double irradiance_error(const std::vector<glm::dvec3>& truth, const Segmentation& segmentation);

/// The smooth part of the irradiance, for any normal at once, as a polynomial of the unit normal (x, y, z): factors of
/// 1, x, y, z, xx, yy, zz, xy, yz, zx; linear sRGB, W/m^2 of Y.
using IrradiancePolynomial = std::array<glm::dvec3, 10>;

/// Sums over all light of a map: flux, flux times its direction, and times the products of that direction's components.
struct IrradianceMoments {
  glm::dvec3 flux{0};
  std::array<glm::dvec3, 3> first{};                                             ///< by channel
  std::array<glm::dmat3, 3> second{glm::dmat3(0), glm::dmat3(0), glm::dmat3(0)}; ///< by channel
};
IrradianceMoments irradiance_moments(const CubeMap& cube);

/// The spherical harmonics of the irradiance up to the second degree, which leave out 1 % of it overall (Ramamoorthi
/// and Hanrahan 2001, "An efficient representation for irradiance environment maps"). max(t, 0) up to that degree is
/// 3/32 + t/2 + 15/32 t^2, so the irradiance is the sum of that over all light, with t its direction times the normal.
IrradiancePolynomial irradiance_polynomial(const IrradianceMoments& moments, double rotate_deg);

} // namespace nephroid::environment
