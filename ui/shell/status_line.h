// SPDX-License-Identifier: Apache-2.0
// The window's foot: a line of what the run does, how far it is, how fast, how long it still takes, and how to hold or
// end it; above it errors and notes, the whole line, wrapped, with what can be done about it.
#pragma once
#include "job/worker.h"
#include "ui/state/context.h"

namespace nephroid::ui {

/// notes: what is worth knowing and needs no answer.
void draw_status_line(const Context& context, const std::vector<std::string>& notes);

/// The height that errors take at this width; 0 where there are none.
float errors_height(std::span<const Message> errors, float width);
void draw_errors(std::span<const Message> errors, const Context& context);
/// The newest notes, wrapped at this width.
void draw_note_lines(std::span<const Message> notes, float width);

/// "running", "finished", ...
const char* name_of(job::State state);
/// "12 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

} // namespace nephroid::ui
