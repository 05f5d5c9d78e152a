// SPDX-License-Identifier: Apache-2.0
// What is written over the View's picture: a few words, and scales of colours with their numbers along its right edge.
#pragma once
#include "ui/state/comparing.h"
#include "ui/state/tone.h"
#include "ui/view/placement.h"
#include "ui/widgets/theme.h"

namespace nephroid::ui {

/// Lines of text on a dark ground, its upper left corner at `at`.
void draw_overlay(const ImVec2& at, const std::string& text);
/// Luminance in W/m^2/sr, and the colours of what is no luminance.
void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas);
/// Of a map of differences.
void draw_difference_scale(const ShownDifference& map, const Canvas& canvas);

} // namespace nephroid::ui
