// SPDX-License-Identifier: Apache-2.0
// How the window looks: one font, neutral greys (a coloured surround would change how a picture's colours are seen), one accent.
#pragma once
#include <imgui.h>

namespace nephroid::ui {

namespace colour {
inline constexpr ImU32 surround = IM_COL32(38, 38, 38, 255);
inline constexpr ImU32 frame = IM_COL32(72, 72, 72, 255);
inline constexpr ImU32 overlay = IM_COL32(18, 18, 18, 215);
inline constexpr ImU32 text = IM_COL32(228, 228, 228, 255);
inline constexpr ImU32 quiet_text = IM_COL32(165, 165, 165, 255);
inline constexpr ImU32 error = IM_COL32(240, 128, 112, 255);
inline constexpr ImU32 note = IM_COL32(222, 190, 120, 255);
inline constexpr ImU32 accent = IM_COL32(92, 142, 196, 255);
inline constexpr ImU32 outline = IM_COL32(20, 20, 20, 255); ///< about lines and points that lie on any colour
} // namespace colour

/// alpha: 0 (not seen) .. 1.
constexpr ImU32 with_alpha(ImU32 colour, float alpha)
{
  return (colour & ~IM_COL32_A_MASK) | (static_cast<ImU32>(255 * alpha) << IM_COL32_A_SHIFT);
}

/// Adds the font to the current context. Once, before the first frame.
void add_font();
/// Sets every size and colour for a display of this scale (1: 96 dots an inch). Again whenever the scale changes.
void set_theme(float scale);
/// The scale that was set: sizes in pixels are multiplied by it.
inline float scale() { return ImGui::GetStyle().FontScaleDpi; }

} // namespace nephroid::ui
