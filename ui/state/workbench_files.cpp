// SPDX-License-Identifier: Apache-2.0
// What the workbench does about files that change on disk, those that are read and written beside the frames, and things of the scene.
#include "ui/state/workbench.h"

#include "base/error.h"
#include "base/files.h"
#include "engine/engine.h"
#include "formats/import/import.h"
#include "preset/read.h"

#include <fmt/format.h>

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
  if (const auto& now = edits_ ? edits_->shared() : nullptr; now != watched_) {
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

void Workbench::pin(const std::filesystem::path& path, const std::optional<Session::Pin>& like, bool show)
{
  tasks_.start(
      pins_, {"reading " + path.string(), TaskKind::request}, [path] { return read_pin(path); },
      [this, like, show](PinnedRun run) {
        if (like) {
          run.name = like->name;
          run.colour = like->colour;
          run.shown = like->shown;
        }
        const bool is_picture = !run.is_run();
        if (is_picture && show)
          messages_.note(fmt::format("opened {}, {} x {} ({})", run.name, run.picture->width, run.picture->height, run.read_as));
        const std::uint64_t id = comparing_.pin(std::move(run));
        if (is_picture && show) comparing_.carry_out(command::ShowPicture{id});
      });
}

/// In a folder of its own beside the file.
void Workbench::import_scene(const std::filesystem::path& file)
{
  tasks_.start(
      writes_, {"importing " + file.string(), TaskKind::write},
      [file] {
        const std::string stem = file.stem().string();
        return formats::import_scene(file, free_name(file.parent_path() / (stem + "-scene")) / (stem + ".json"));
      },
      [this](const formats::Imported& scene) {
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

void Workbench::take_picture(const std::string& file)
{
  if (!is_there(file)) throw bad_input(file, "there is no such picture");
  preset::Preset edited = edits_->current();
  engine::PictureEdit taken = engine::engine_of(edited).take_picture(edited, file);
  carry_out(command::Edit{std::move(taken.edit), std::move(edited)});
  messages_.note(std::move(taken.note));
}

void Workbench::carry_out(const command::Select& c)
{
  view_state_.selection = in_preset(c.selection, preset());
  view_state_.nudged.at_s = command::Nudged{}.at_s; // another thing is another entry to undo
}

void Workbench::add_object(const DroppedMesh& mesh)
{
  if (!edits_) return;
  WithMesh with_it = with_mesh(edits_->current(), mesh);
  const std::size_t index = with_it.preset.scene.objects.size() - 1;
  carry_out(command::Edit{"add " + mesh.file.filename().string(), std::move(with_it.preset)});
  carry_out(command::Select{{Selection::Kind::object, index}});
  messages_.note(with_it.note);
}

} // namespace nephroid::ui
