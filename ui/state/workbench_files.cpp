// SPDX-License-Identifier: Apache-2.0
// What the workbench does about files that change on disk, and those that are still being written at the end.
#include "ui/state/workbench.h"

#include "preset/read.h"

#include <exception>
#include <filesystem>
#include <utility>

namespace nephroid::ui {

bool Workbench::take_over_file()
{
  if (!edits_) return false;
  const std::string source = edits_->current().source;
  preset::WithSweep read = preset::read_with_sweep(source);
  const bool is_other_run = read.preset != edits_->current();
  if (!is_other_run && read.sweep == edits_->sweep()) return false; // as where this window wrote it
  edits_->push("reload " + std::filesystem::path(source).filename().string(), std::move(read.preset), std::move(read.sweep));
  edits_->mark_saved(source);
  if (is_other_run) run_.follow_edit(false);
  return true;
}

/// Another program wrote the preset's file.
void Workbench::look_at_own_file()
{
  const std::filesystem::path file = edits_->current().source;
  try {
    if (!edits_->modified()) {
      if (take_over_file()) messages_.note(file.filename().string() + " was changed on disk and is taken over");
      return;
    }
    const preset::WithSweep read = preset::read_with_sweep(file.string());
    if (read.preset != edits_->current() || read.sweep != edits_->sweep())
      messages_.error(file.string() + ": another program changed this file, and the preset has edits that are not saved; save them under "
                                      "another name, or take the preset from its file (File)");
  } catch (const std::exception& error) {
    messages_.error(error);
  }
}

void Workbench::look_at_files()
{
  if (const auto& now = edits_ ? edits_->state().entries[edits_->state().index].preset : nullptr; now != watched_) {
    watched_ = now;
    const auto opened = edits_ ? edits_->state().opened : nullptr;
    watch_.watch(now, std::exchange(watched_from_, opened) != opened);
  }
  const std::vector<std::filesystem::path> changed = watch_.take_changed();
  if (changed.empty() || !edits_) return;
  bool scene_changed = false;
  for (const std::filesystem::path& file : changed) {
    if (file == std::filesystem::path(edits_->current().source)) {
      look_at_own_file();
      continue;
    }
    scene_changed = true;
    messages_.note(file.filename().string() + " was changed on disk: the run begins again" +
                   (sweep_.active() ? " when the sweep is over" : ""));
  }
  if (scene_changed) run_.start_with_new_files(*edits_);
}

void Workbench::finish_files()
{
  files_.wait();
  files_.collect(
      messages_, [](const PinnedRun&) {}, [](const std::filesystem::path&) {});
}

} // namespace nephroid::ui
