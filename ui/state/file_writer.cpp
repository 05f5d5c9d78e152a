// SPDX-License-Identifier: Apache-2.0
#include "ui/state/file_writer.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "formats/import/import.h"
#include "preset/differences.h"
#include "ui/state/run_record.h"

#include <fmt/format.h>

#include <ctime>

namespace nephroid::ui {

/// Writes a file after the earlier ones. The text that write() returns becomes a note.
void FileWriter::save(const std::filesystem::path& file, std::function<std::string()> write) {
  services_.tasks.start(writes_, {"saving " + file.string(), TaskKind::write}, std::move(write),
                        [this](const std::string& note) {
                          if (!note.empty()) services_.messages.note(note);
                        });
}

void FileWriter::add_recent(const std::filesystem::path& file) {
  recent_.add(file, std::time(nullptr));
  services_.tasks.start(recent_writes_,
                        {.name = "writing the list of recent files", .kind = TaskKind::write, .replaces = true},
                        recent_.writer(), [] {});
}

void FileWriter::import_scene(const std::filesystem::path& file) {
  services_.tasks.start(
      writes_, {"importing " + file.string(), TaskKind::write},
      [file] {
        const std::string stem = file.stem().string();
        return formats::import_scene(file, free_name(file.parent_path() / (stem + "-scene")) / (stem + ".json"));
      },
      [this](const formats::Imported& scene) {
        services_.messages.note(scene.summary());
        services_.follow_ups.push_back(command::Open{scene.preset.string()});
      });
}

void FileWriter::update() {
  if (std::string note = recent_.take_note(); !note.empty()) services_.messages.note(std::move(note));
}

void FileWriter::carry_out(const command::SavePreset& c) {
  const UndoStack* edits = document_.edits();
  if (!edits) return;
  const bool is_new = edits->current().name == "untitled"; // then it is called as its file
  preset::Preset saved = *edits->in_file();
  if (is_new) saved.name = preset::stem_of(c.file);
  const std::string parent = c.keep_parent ? parent_to_keep(saved) : std::string();
  const preset::FileText text = preset::file_text(saved, parent, c.file, edits->sweep());
  write_file_whole(c.file, text.json);
  if (is_new) {
    preset::Preset named = edits->current();
    named.name = saved.name;
    document_.carry_out(command::Edit{"name", std::move(named)});
  }
  document_.mark_saved(c.file);
  services_.messages.note("saved " + c.file.string());
  if (!text.note.empty()) services_.messages.note(text.note);
  add_recent(c.file);
  save_thumbnail(c.file);
  questions_.go_on();
}

/// Shipped presets have shipped thumbnails.
void FileWriter::save_thumbnail(const std::filesystem::path& preset) {
  const std::filesystem::path file = thumbnail_of(preset, recent_.thumbnails());
  if (!run_.snapshot() || file.empty() || !preset::shipped_name(preset).empty()) return;
  save(file, [file, picture = run_.snapshot()->picture, display = display_of(document_.edits()->current()),
              exposure_stops = view_state_.view_settings.exposure_stops] {
    try {
      write_thumbnail(file, *picture, display, exposure_stops);
      return std::string();
    } catch (const Error& error) { // the preset itself is saved
      return "the preset is saved without its small picture: " + error.line();
    }
  });
}

void FileWriter::carry_out(const command::SavePicture& c) {
  const auto picture = comparing_.source();
  if (!picture) return;
  questions_.close();
  save(c.file, [file = c.file, picture, shown = shown_picture()] { return save_picture(file, *picture, shown); });
}

PictureToSave FileWriter::shown_picture() const {
  const Comparison& comparison = comparing_.comparison();
  PictureToSave shown{
      .picture = {}, .map = {}, .view_settings = view_state_.view_settings, .display = {}, .why_not = {}};
  if (const preset::Preset* preset = document_.preset()) {
    shown.white = preset->white.value_or(1);
    shown.display = display_of(*preset);
  }
  if (comparison.flip || !comparison.difference) {
    shown.picture = comparison.flip ? comparing_.other_picture() : comparing_.picture();
    shown.why_not = comparison.flip ? comparing_.why_not() : comparing_.why_no_picture();
    return shown;
  }
  shown.map = comparing_.difference();
  if (shown.map) shown.picture = shown.map->of.picture;
  shown.why_not = shown.map ? shown.map->error : "the difference is not computed yet";
  return shown;
}

void FileWriter::carry_out(const command::OpenResult& c) {
  if (!run_.snapshot() || !document_.preset()) return;
  const std::filesystem::path beside = save_target(document_.preset()).parent_path();
  const std::filesystem::path wanted = beside / proposed_name(document_.preset(), "-object");
  services_.tasks.start(
      writes_, {"saving " + wanted.string(), TaskKind::write},
      [wanted, of = run_.snapshot()](TaskControl& control) { return save_files(wanted, *of, control); },
      [this, open = c.file, count = run_.snapshot()->files.size()](const std::filesystem::path& folder) {
        services_.messages.note(fmt::format("saved {} in {}", counted(count, "file"), folder.string()));
        services_.follow_ups.push_back(command::Open{(folder / open).string()});
      });
}

void FileWriter::carry_out(const command::WriteReport& c) {
  questions_.close();
  save(c.file, [file = c.file, runs = runs_of_table(comparing_, run_)] { return write_report(file, runs); });
}

} // namespace nephroid::ui
