// SPDX-License-Identifier: Apache-2.0
// The window's theme: one font, neutral greys (a coloured surround would change how a picture's colours are seen), one
// accent.
#pragma once
#include "ui/state/commands.h"

#include <imgui.h>

namespace nephroid::ui {

namespace colour {
// Pictures and plots have a dark ground in every theme, so that pictures and curves appear in the same colours.
inline constexpr ImU32 surround = IM_COL32(38, 38, 38, 255);
inline constexpr ImU32 frame = IM_COL32(72, 72, 72, 255);
inline constexpr ImU32 overlay = IM_COL32(18, 18, 18, 215);
inline constexpr ImU32 on_dark = IM_COL32(228, 228, 228, 255); ///< text and lines on a dark ground
inline constexpr ImU32 quiet_on_dark = IM_COL32(165, 165, 165, 255);
inline constexpr ImU32 note_on_dark = IM_COL32(222, 190, 120, 255);
inline constexpr ImU32 accent = IM_COL32(92, 142, 196, 255);
inline constexpr ImU32 outline = IM_COL32(20, 20, 20, 255); ///< outlines lines and points on any colour
// Colours of the theme that set_theme set last. They belong to Dear ImGui's context as its style does.
inline ImU32 text = on_dark, quiet_text = quiet_on_dark, error = IM_COL32(240, 128, 112, 255), note = note_on_dark;
} // namespace colour

/// alpha: 0 (invisible) .. 1.
constexpr ImU32 with_alpha(ImU32 colour, float alpha) {
  return (colour & ~IM_COL32_A_MASK) | (static_cast<ImU32>(255 * alpha) << IM_COL32_A_SHIFT);
}

/// Adds the font to the current context; called once, before the first frame.
void add_font();
/// Sets all sizes and colours for a display of this scale (1: 96 dots an inch); called again when one of them changes.
void set_theme(float scale, Theme theme = Theme::dark);
/// The scale of set_theme; sizes in pixels are multiplied by it.
inline float scale() { return ImGui::GetStyle().FontScaleDpi; }

inline ImVec2 vec(const std::array<double, 2>& at) { return {static_cast<float>(at[0]), static_cast<float>(at[1])}; }

} // namespace nephroid::ui
