// SPDX-License-Identifier: Apache-2.0
// What the workbench does about files that change on disk, and those that are read and written beside the frames.
#include "ui/state/workbench.h"

#include "preset/read.h"
#include "run/import/import.h"

#include <ctime>
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

void Workbench::save(const std::filesystem::path& file, std::function<std::string()> write)
{
  tasks_.start(writes_, {"saving " + file.string(), TaskKind::write}, std::move(write), [this](const std::string& note) {
    if (!note.empty()) messages_.note(note);
  });
}

void Workbench::add_recent(const std::filesystem::path& file)
{
  recent_.add(file, std::time(nullptr));
  tasks_.start(recent_writes_, {.name = "writing the list of recent files", .kind = TaskKind::write, .replaces = true}, recent_.writer(),
               [] {});
}

void Workbench::pin(const std::filesystem::path& path, const std::optional<Session::Pin>& like)
{
  tasks_.start(
      pins_, {"reading " + path.string(), TaskKind::request}, [path] { return read_pin(path); },
      [this, like](PinnedRun run) {
        if (like) {
          run.name = like->name;
          run.colour = like->colour;
          run.shown = like->shown;
        }
        comparing_.pin(std::move(run));
      });
}

/// In a folder of its own beside the file.
void Workbench::import_scene(const std::filesystem::path& file)
{
  tasks_.start(
      writes_, {"importing " + file.string(), TaskKind::write},
      [file] {
        const std::string stem = file.stem().string();
        return run::import_gltf(file, free_name(file.parent_path() / (stem + "-scene")) / (stem + ".json"));
      },
      [this](const run::Imported& scene) {
        messages_.note(scene.summary());
        carry_out(command::Open{scene.preset.string()});
      });
}

void Workbench::read_mesh(const std::filesystem::path& file)
{
  tasks_.start(
      meshes_, {"reading " + file.string(), TaskKind::request}, [file] { return read_dropped_mesh(file); },
      [this](const DroppedMesh& mesh) { add_object(mesh); });
}

} // namespace nephroid::ui
