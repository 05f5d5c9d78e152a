// SPDX-License-Identifier: Apache-2.0
// Pictures that the program draws.
#pragma once
#include "inverse/settings.h"

#include <glm/glm.hpp>

namespace nephroid::inverse {

/// Where p lies in a drawing that is not turned.
glm::dvec2 turned_back(const Picture& picture, const glm::dvec2& p);

/// Brightness 0..1 of a drawing at p, without its background; p in parts of the receiver's shorter side from its middle, y up.
/// half: the receiver's half width and height in the same parts.
double brightness(const Picture& picture, const glm::dvec2& p, const glm::dvec2& half);

} // namespace nephroid::inverse
