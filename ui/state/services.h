// SPDX-License-Identifier: Apache-2.0
// What every part of the workbench uses: messages, background tasks, and commands that follow a command.
#pragma once
#include "ui/state/commands.h"
#include "ui/state/messages.h"
#include "ui/state/tasks.h"

namespace nephroid::ui {

struct Services {
  Messages messages;
  TaskQueue tasks;
  Commands follow_ups; ///< commands that a command or a finished task leads to; carried out next
};

} // namespace nephroid::ui
