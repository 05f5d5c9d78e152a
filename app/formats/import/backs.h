// SPDX-License-Identifier: Apache-2.0
// Surfaces that look otherwise from behind: their backs become surfaces of their own, a little behind them.
#pragma once
#include "formats/import/description.h"

#include <span>

namespace nephroid::formats {

/// The same shape behind its front, `distance` away in the preset's coordinates. What is flat moves, a sphere shrinks
/// or grows, and what is curved becomes another mesh, whose vertices move along their normals.
DescribedShape behind(const DescribedShape& shape, const glm::dmat4& to_preset, double distance, Description& from);

/// Whether the back of a shape may be seen or lit from one of these places in the preset's coordinates. Those of what
/// is closed and has its front outside are inside.
bool shows_back(const DescribedShape& shape, const glm::dmat4& to_preset, std::span<const glm::dvec3> places,
                Description& from);

} // namespace nephroid::formats
