// SPDX-License-Identifier: Apache-2.0
// Pages to print in real size: SVG in millimetres, on the smallest ISO sheet from A4 on that holds what is shown.
#pragma once
#include "inverse/facets/plate.h"
#include "inverse/layout.h"
#include "job/job.h"

namespace nephroid::inverse {

/// The object's outline, seen along the light.
std::string object_page(const Layout& layout, const std::string& name);

/// The light on a receiver, seen along the light, with the object's outline over it where both have one middle.
std::string receiver_page(const Layout& layout, std::size_t receiver, const job::Picture& cast,
                          const std::string& name);

/// The rectangles that bodies on a plate take, each with its name.
std::string plate_page(const glm::dvec2& plate, const std::vector<PlatePart>& bodies);

} // namespace nephroid::inverse
