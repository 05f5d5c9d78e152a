// SPDX-License-Identifier: Apache-2.0
// The irradiance on a diffuse surface of an environment, or of the lights that it is cut into.
#pragma once
#include "environment/segment/segment.h"

#include <glm/glm.hpp>

#include <vector>

namespace nephroid::environment {

/// The irradiance of all texels on planes whose normals lie evenly on the sphere, linear sRGB, W/m^2 of Y.
std::vector<glm::dvec3> irradiances(const CubeMap& cube, int normals = 256);

/// The error of the lights' irradiance against the truth, which irradiances() gave: the norm of the difference over all
/// normals and channels, over the norm of the truth. 0 where the truth is black.
double irradiance_error(const std::vector<glm::dvec3>& truth, const Segmentation& segmentation);

} // namespace nephroid::environment
