// SPDX-License-Identifier: Apache-2.0
// A scale of colours with its numbers, along the right edge of the picture.
#pragma once
#include "ui/view/placement.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::ui {

/// sRGB-encoded bytes of a position of 0 (the foot) .. 1.
using ScaleColour = std::function<std::array<unsigned char, 3>(float position)>;
/// A text at the left of a position.
using ScaleMark = std::pair<double, std::string>;
/// A colour beside the scale and what it means, below it.
using ScaleKey = std::pair<std::array<unsigned char, 3>, std::string>;

/// title: above; may be empty.
void draw_scale(const Canvas& canvas, const std::string& title, std::span<const ScaleMark> marks, const ScaleColour& colour_at,
                std::span<const ScaleKey> keys = {});

} // namespace nephroid::ui
