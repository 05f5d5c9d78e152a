// SPDX-License-Identifier: Apache-2.0
// Scales of colours with their numbers, over the right edge of what they explain.
#pragma once
#include <imgui.h>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace nephroid::ui {

/// position: from 0 (the foot) to 1. The colour is sRGB-encoded.
using ScaleColour = std::function<std::array<unsigned char, 3>(float position)>;
using ScaleMark = std::pair<double, std::string>; ///< a position and what is written there
using ScaleKey = std::pair<std::array<unsigned char, 3>, std::string>;

/// area, size: of what the scale explains, on the screen. title: above it; may be empty. keys: below it, of colours
/// that are not on it.
void draw_scale(const ImVec2& area, const ImVec2& size, const std::string& title, std::span<const ScaleMark> marks,
                const ScaleColour& colour_at, std::span<const ScaleKey> keys = {});
/// The colours of measure::map_colour from 0 to high, or from -high.
void draw_linear_scale(const ImVec2& area, const ImVec2& size, const std::string& title, double high,
                       bool is_signed = false);

} // namespace nephroid::ui
