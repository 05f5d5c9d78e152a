// SPDX-License-Identifier: Apache-2.0
// How well a segmentation lights a diffuse surface.
#pragma once
#include "environment/segment/segment.h"

#include <vector>

namespace nephroid::environment {

/// The irradiance of all texels of the cube on planes whose normals lie evenly on the sphere, linear sRGB, W/m^2 of Y. normals: 1 or more.
std::vector<glm::dvec3> irradiances(const CubeMap& cube, int normals = 256);

/// Of the lights against the truth, which irradiances() gave: the norm of the difference, of all normals and channels, over the norm of the
/// truth. 0 where the truth is black.
double irradiance_error(const std::vector<glm::dvec3>& truth, const Segmentation& segmentation);

} // namespace nephroid::environment
