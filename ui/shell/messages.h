// SPDX-License-Identifier: Apache-2.0
// Errors and notes above the status line: the whole line, wrapped, with what can be done about it.
#pragma once
#include "ui/state/context.h"

namespace nephroid::ui {

/// The height that the messages take at this width; 0 where there are none.
float messages_height(const std::vector<Message>& messages, float width);
void draw_messages(const std::vector<Message>& messages, const Context& context);

} // namespace nephroid::ui
