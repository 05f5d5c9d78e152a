// SPDX-License-Identifier: Apache-2.0
// Mouse and keys as they were pressed, however seldom frames are drawn.
#pragma once

namespace nephroid::ui {

/// ImGui::NewFrame(), but a modifier that is let go after something was pressed is let go in the next frame. Of Ctrl, Z and both let go
/// within a slow frame Dear ImGui would else see a Z alone: what was let go counts at once.
void new_frame();

} // namespace nephroid::ui
