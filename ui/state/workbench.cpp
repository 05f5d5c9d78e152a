// SPDX-License-Identifier: Apache-2.0
#include "ui/state/workbench.h"

#include "base/counted.h"
#include "base/files.h"
#include "engine/engine.h"
#include "preset/change_engine.h"
#include "preset/differences.h"
#include "ui/state/run_record.h"
#include "ui/state/selection.h"
#include "ui/state/tone.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// With a map in place of its environment, as bright and as turned as that was. Whether the map can be read the run finds out.
preset::Preset surrounded(preset::Preset preset, const std::string& map)
{
  std::error_code ignored;
  preset::Environment environment;
  if (const auto& before = preset.scene.environment) {
    environment.radiance = before->radiance;
    environment.rotate_deg = before->rotate_deg;
    environment.lights = before->lights;
  }
  environment.file = std::filesystem::absolute(map, ignored).string();
  preset.scene.environment = environment;
  return preset;
}

} // namespace

void Workbench::apply(const Commands& commands)
{
  last_before_commands_ = messages_.newest();
  for (const Command& command : commands) {
    try {
      std::visit([this](const auto& c) { carry_out(c); }, command);
    } catch (const std::exception& error) {
      messages_.error(error);
      if (std::holds_alternative<command::Edit>(command)) refused_edit_ = messages_.newest();
    }
  }
  if (edits_) run_.start_if_wanted(*edits_);
}

bool Workbench::open(const std::string& name, const preset::Overrides& overrides)
{
  std::optional<preset::WithSweep> read;
  try {
    refuse_other_kinds(name);
    read = preset::read_with_sweep(name, overrides);
  } catch (const std::exception& error) {
    messages_.error(error);
    return false;
  }
  for (const std::string& note : read->preset.provenance.notes) messages_.note(note);
  begin(std::move(read->preset), std::move(read->sweep));
  add_recent(edits_->current().source);
  return true;
}

/// In place of what is open, which is not asked about.
void Workbench::begin(preset::Preset preset, preset::Sweep sweep)
{
  let_go();
  edits_.emplace(std::move(preset), std::move(sweep));
  run_.start(*edits_);
}

/// What is of the preset in hand, which another one replaces.
void Workbench::let_go()
{
  sweep_.stop(run_, nullptr);
  edits_.reset();
  messages_.dismiss_errors_until(last_before_commands_);
  comparing_.forget();
  run_.forget();
  view_state_.view_settings = ViewSettings{};
  view_state_.region.reset();
  view_state_.lines.clear();
  carry_out(command::InspectPixel{});
  view_state_.selection = {};
  tasks_.forget(meshes_);
  close_question();
}

/// Without an answer: what waited for one does not come any more.
void Workbench::close_question()
{
  question_ = Question::none;
  waiting_.reset();
}

void Workbench::restore(Session session, const std::filesystem::path& folder)
{
  let_go();
  if (session.edits) edits_.emplace(std::move(*session.edits));
  view_state_ = std::move(session.view_state);
  run_.watch_spectrum(view_state_.pixel);
  for (const Session::Pin& pin : session.pins) this->pin(folder / pin.folder, pin);
  if (edits_) run_.start(*edits_);
}

void Workbench::carry_out(const command::Open& c)
{
  if (is_history(c.name)) return carry_out(command::PinFile{c.name});
  const FileKind kind = kind_of(c.name);
  if (edits_ && kind == FileKind::dispersion) return carry_out(command::LoadDispersion{c.name});
  if (edits_ && kind == FileKind::map) return carry_out(command::OpenMap{c.name});
  if (edits_ && kind == FileKind::picture) {
    if (engine::engine_of(edits_->current()).take_picture) return take_picture(c.name);
    return carry_out(command::PinFile{c.name, true});
  }
  if (kind == FileKind::scene) return import_scene(c.name);
  if (edits_ && kind == FileKind::mesh && has_scene(edits_->current())) return read_mesh(c.name);
  if (!c.sure && edits_ && edits_->modified()) { // what cannot be opened is said at once, and nothing is asked
    refuse_other_kinds(c.name);
    preset::read_with_sweep(c.name);
  }
  if (!asks_first(c)) open(c.name);
}

/// Throws bad_input where there is no such file, or one that is no map: the dialog stays open then.
void Workbench::carry_out(const command::OpenMap& c)
{
  if (!edits_) return;
  if (kind_of(c.file) != FileKind::map) throw bad_input(c.file, "is no map of an environment", "expected a file .hdr or .exr");
  if (!is_there(c.file)) throw bad_input(c.file, "there is no such file");
  const std::string name = std::filesystem::path(c.file).filename().string();
  carry_out(command::Edit{"surround with " + name, surrounded(edits_->current(), c.file)});
  messages_.note(name + " is the environment");
  close_question();
}

void Workbench::carry_out(const command::New& c)
{
  if (asks_first(c)) return;
  preset::Preset preset = preset::parse_preset(c.preset, "untitled");
  preset.source.clear(); // else a file that happens to have this name would be its own
  begin(std::move(preset));
}

/// What an edit of the engine takes away with the old one.
void Workbench::note_left_out(const preset::Preset& before, std::string_view engine)
{
  auto json = preset::Json::parse(preset::to_json(before));
  if (const auto keys = preset::take_foreign(json, engine); !keys.empty())
    messages_.note(preset::left_out_note(engine, keys) + " (Undo brings it back)");
}

/// Throws bad_input where the preset could not be read again: a number is out of its range, however it came there, or two fields
/// contradict each other.
void Workbench::carry_out(const command::Edit& c)
{
  if (!edits_) return;
  messages_.dismiss(refused_edit_); // while the mouse drags there is a new one at every move
  preset::Preset edited = c.preset;
  edited.provenance = {}; // what is wrong from now on is what was typed here, not what the file or an option gave
  preset::parse_preset(preset::to_json(edited), edited.source);
  if (edited.settings.engine() != edits_->current().settings.engine()) note_left_out(edits_->current(), edited.settings.engine());
  edits_->push(c.label, std::move(edited), c.gesture);
  run_.follow_edit(c.live);
}

void Workbench::carry_out(const command::SetSweep& c)
{
  if (!edits_ || c.sweep == edits_->sweep()) return;
  edits_->push(c.label, edits_->current(), c.sweep);
}

void Workbench::carry_out(const command::StartSweep&)
{
  if (edits_ && !sweep_.active()) sweep_.start(edits_->current(), edits_->sweep());
}

/// The run follows, but where the step was about the sweep alone.
void Workbench::step_in_edits(bool (UndoStack::*step)())
{
  if (!edits_) return;
  const preset::Preset before = edits_->current();
  if ((*edits_.*step)() && before != edits_->current()) run_.adopt_or_start(*edits_);
}

void Workbench::carry_out(const command::Cancel&)
{
  if (sweep_.active())
    sweep_.stop(run_, edits());
  else
    run_.cancel();
}

void Workbench::carry_out(const command::SetViewSettings& c)
{
  view_state_.view_settings = c.view_settings;
  if (c.view_settings.false_colour) view_state_.view_settings.false_colour = valid_range(*c.view_settings.false_colour);
  view_state_.view_settings.exposure_stops = std::clamp(c.view_settings.exposure_stops, -20.0, 20.0);
}

void Workbench::carry_out(const command::InspectPixel& c)
{
  view_state_.pixel = c.pixel;
  if (c.pixel) view_state_.selection = {}; // the arrow keys are the pixel's now
  run_.watch_spectrum(c.pixel);
}

void Workbench::carry_out(const command::SelectRegion& c)
{
  view_state_.region = c.region;
  if (c.region && (c.region->from[0] >= c.region->to[0] || c.region->from[1] >= c.region->to[1])) view_state_.region.reset();
}

void Workbench::carry_out(const command::LoadDispersion& c)
{
  if (!edits_) throw bad_input(c.file, "is dispersion data, and no preset is open", {}, "open a preset with glass, then load it");
  preset::Preset edited = edits_->current();
  const std::string material = shown_dielectric(edited, view_state_.material);
  if (material.empty())
    throw bad_input(c.file, "is dispersion data, and this preset has no dielectric", "expected a material of type \"dielectric\"");
  edited.scene.materials.at(material).dispersion = load_dispersion(c.file, edited.source);
  const std::string name = std::filesystem::path(c.file).stem().string();
  carry_out(command::Edit{"load " + name + " into " + material, std::move(edited)});
  messages_.note("loaded " + name + " into the material '" + material + "'");
}

void Workbench::carry_out(const command::Ask& c)
{
  question_ = c.question;
  if (question_ == Question::none) waiting_.reset(); // answered by "no"
}

void Workbench::carry_out(const command::SavePreset& c)
{
  if (!edits_) return;
  const std::string parent = c.keep_parent ? parent_to_keep(edits_->current()) : std::string();
  const preset::FileText text = preset::file_text(edits_->current(), parent, c.file, edits_->sweep());
  write_file_whole(c.file, text.json);
  edits_->mark_saved(c.file.string());
  question_ = Question::none;
  messages_.note("saved " + c.file.string());
  if (!text.note.empty()) messages_.note(text.note);
  add_recent(c.file);
  const std::filesystem::path thumbnail = thumbnail_of(c.file, recent_.thumbnails());
  if (run_.snapshot() && !thumbnail.empty() && preset::shipped_name(c.file).empty()) // those of shipped presets are shipped
    save(thumbnail, [thumbnail, picture = run_.snapshot()->picture, exposure_stops = view_state_.view_settings.exposure_stops] {
      try {
        write_thumbnail(thumbnail, *picture, exposure_stops);
        return std::string();
      } catch (const Error& error) { // the preset itself is saved
        return "the preset is saved without its small picture: " + error.line();
      }
    });
  if (const auto command = std::exchange(waiting_, std::nullopt)) std::visit([this](const auto& next) { carry_out(next); }, *command);
}

void Workbench::carry_out(const command::SavePicture& c)
{
  const auto picture = comparing_.source();
  if (!picture) return;
  close_question();
  save(c.file, [file = c.file, picture, shown = shown_picture()] { return save_picture(file, *picture, shown); });
}

PictureToSave Workbench::shown_picture() const
{
  const Comparison& comparison = comparing_.comparison();
  const double white = edits_ ? edits_->current().white.value_or(1) : 1;
  if (comparison.flip) return {comparing_.other_picture(), {}, view_state_.view_settings, white, comparing_.why_not()};
  if (!comparison.difference) return {comparing_.picture(), {}, view_state_.view_settings, white, comparing_.why_no_picture()};
  const auto& map = comparing_.difference();
  if (!map) return {{}, {}, {}, 1, "the difference is not computed yet"};
  return {map->of.picture, map, view_state_.view_settings, white, map->error};
}

void Workbench::carry_out(const command::OpenResult& c)
{
  if (!run_.snapshot() || !edits_) return;
  const std::filesystem::path beside = save_target(&edits_->current()).parent_path();
  const std::filesystem::path wanted = beside / proposed_name(&edits_->current(), "-object");
  tasks_.start(
      writes_, {"saving " + wanted.string(), TaskKind::write},
      [wanted, of = run_.snapshot()](TaskControl& control) { return save_files(wanted, *of, control); },
      [this, open = c.file, count = run_.snapshot()->files.size()](const std::filesystem::path& folder) {
        messages_.note(fmt::format("saved {} in {}", counted(count, "file"), folder.string()));
        carry_out(command::Open{(folder / open).string()});
      });
}

void Workbench::carry_out(const command::WriteReport& c)
{
  close_question();
  save(c.file, [file = c.file, runs = runs_of_table(comparing_, run_)] { return write_report(file, runs); });
}

/// What is kept for the presets of the engine in hand.
EngineLayout& Workbench::engine_layout() { return settings_.engines[std::string(edits_->current().settings.engine())]; }

void Workbench::carry_out(const command::ResetLayout&)
{
  engine_layout() = {};
  layout_reset_ = true;
}

void Workbench::carry_out(const command::ShowPanel& c)
{
  if (c.on) panel_to_front_ = c.name;
  if (!edits_) return; // the start page has no layout
  if (c.on)
    engine_layout().closed.erase(c.name);
  else
    engine_layout().closed.insert(c.name);
}

void Workbench::carry_out(const command::SetAppearance& c)
{
  settings_.theme = c.theme;
  settings_.text_size = std::clamp(c.text_size, Settings::smallest_text, Settings::largest_text);
}

std::vector<std::string> Workbench::notes() const
{
  std::vector<std::string> all = program_notes_;
  if (run_.plan()) all.insert(all.end(), run_.plan()->notes.begin(), run_.plan()->notes.end());
  return all;
}

void Workbench::update(Clock::time_point now)
{
  look_at_files();
  run_.update(edits());
  if (const auto white = run_.fitted_white(); white && edits_ && !edits_->current().white) {
    edits_->fit_white(*white);
    messages_.note(fmt::format("white {} fits the first picture", *white));
  }
  sweep_.update(run_, comparing_, edits());
  if (std::string note = recent_.take_note(); !note.empty()) messages_.note(std::move(note));
  tasks_.collect(messages_);
  messages_.expire(now);
  comparing_.update(now);
}

} // namespace nephroid::ui
