// SPDX-License-Identifier: Apache-2.0
// Mouse and keys as they were pressed, however seldom frames are drawn.
#pragma once

namespace nephroid::ui {

/// ImGui::NewFrame(), but a modifier that is let go after something was pressed is let go in the next frame. Where Ctrl was held before,
/// and Z is pressed and Ctrl let go within one frame, Dear ImGui sees Z alone.
void new_frame();

} // namespace nephroid::ui
