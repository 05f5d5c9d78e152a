// SPDX-License-Identifier: Apache-2.0
// Colours of other primaries than sRGB's. Not for others: include image/image.h.
#pragma once
#include "image/image.h"

#include <glm/mat3x3.hpp>

namespace nephroid::image {

/// From colours with these primaries to linear sRGB (SMPTE RP 177-1993): their white becomes (1, 1, 1), the others
/// follow by the Bradford transform (ICC.1:2022, annex E). XYZ itself is kept. The identity for the primaries of Rec.
/// 709 to three digits. Nothing where they span no triangle.
std::optional<glm::dmat3> matrix_to_srgb(const Chromaticities& from);

/// Three values a colour.
void convert(std::vector<float>& colours, const glm::dmat3& matrix);

} // namespace nephroid::image
