// SPDX-License-Identifier: Apache-2.0
#include "ui/state/workbench.h"

#include "engine/engine.h"

#include <algorithm>

namespace nephroid::ui {
namespace {

template <class Part, class C>
concept Takes = requires(Part& part, const C& c) {
  part.carry_out(c);
};

template <class C, class... Parts>
void hand_over(const C& c, Parts&... parts) {
  static_assert((int{Takes<Parts, C>} + ...) == 1, "a command is for exactly one part");
  const auto hand_to = [&c](auto& part) {
    if constexpr (Takes<decltype(part), C>) part.carry_out(c);
  };
  (hand_to(parts), ...);
}

} // namespace

void Workbench::carry_out_with_follow_ups(const Command& command) {
  try {
    std::visit(
        [this](const auto& c) {
          hand_over(c, *this, document_, document_files_, run_, sweep_, playback_, film_, comparing_, view_state_,
                    files_, questions_, setup_, services_.messages);
        },
        command);
  } catch (const std::exception& error) {
    services_.messages.error(error);
  }
  carry_out_follow_ups();
}

void Workbench::carry_out_follow_ups() {
  for (const Command& command : std::exchange(services_.follow_ups, {})) carry_out_with_follow_ups(command);
}

void Workbench::apply(const Commands& commands) {
  last_before_commands_ = services_.messages.newest();
  for (const Command& command : commands) carry_out_with_follow_ups(command);
  if (edits()) run_.start_if_wanted(*edits());
}

bool Workbench::open(const std::string& name, const preset::Overrides& overrides) {
  std::optional<preset::WithSweep> read;
  try {
    refuse_other_kinds(name);
    read = preset::read_with_sweep(name, overrides);
  } catch (const std::exception& error) {
    services_.messages.error(error);
    return false;
  }
  for (const std::string& note : read->preset.provenance.notes) services_.messages.note(note);
  begin(std::move(*read));
  files_.add_recent(preset()->source);
  return true;
}

/// Replaces what is open without asking.
void Workbench::begin(preset::WithSweep preset) {
  let_go();
  document_.open(UndoStack(std::move(preset.preset), std::move(preset.sweep)));
}

void Workbench::let_go() {
  document_.close();
  sweep_.stop();
  services_.messages.dismiss_errors_until(last_before_commands_);
  comparing_.forget();
  questions_.close();
}

void Workbench::restore(Session session, const std::filesystem::path& folder) {
  let_go();
  view_state_ = std::move(session.view_state);
  document_.carry_out(command::InspectPixel{view_state_.pixel});
  for (const Session::Pin& pin : session.pins)
    comparing_.carry_out(
        command::PinFile{.path = folder / pin.folder, .like = command::ChangePin{0, pin.name, pin.colour, pin.shown}});
  if (session.edits) document_.open(UndoStack(std::move(*session.edits)));
  carry_out_follow_ups();
}

void Workbench::carry_out(const command::Open& c) {
  const std::string& file = c.name;
  if (is_history(file)) {
    // Nothing is open that the run could be compared with: its own preset is.
    if (const std::string preset_file = preset_of_run(file); !preset() && !preset_file.empty()) open(preset_file);
    return comparing_.carry_out(command::PinFile{file});
  }
  if (preset() && take(file)) return questions_.close();
  if (kind_of(file) == FileKind::scene) return files_.import_scene(file);
  if (!c.sure && document_.modified()) { // a file that cannot be opened is reported at once, before any question
    refuse_other_kinds(file);
    preset::read_with_sweep(file);
  }
  if (!questions_.asks_first(c)) open(file);
}

bool Workbench::take(const std::string& file) {
  switch (kind_of(file)) {
  case FileKind::dispersion: document_.carry_out(command::LoadDispersion{file}); return true;
  case FileKind::map: document_.carry_out(command::OpenMap{file}); return true;
  case FileKind::picture:
    if (engine::engine_of(*preset()).take_picture)
      document_.take_picture(file);
    else if (!document_.take_texture(file))
      comparing_.carry_out(command::PinFile{file, true});
    return true;
  case FileKind::mesh:
    if (!has_scene(*preset())) return false;
    document_.carry_out(command::AddMesh{file});
    return true;
  default: return false;
  }
}

void Workbench::carry_out(const command::New& c) {
  if (questions_.asks_first(c)) return;
  preset::Preset preset = preset::parse_preset(c.preset, "untitled");
  preset.source.clear(); // otherwise a file with this name would count as its own
  begin({std::move(preset), {}});
}

std::vector<std::string> Workbench::notes() const {
  std::vector<std::string> all = program_notes_;
  if (run_.plan()) all.insert(all.end(), run_.plan()->notes.begin(), run_.plan()->notes.end());
  return all;
}

void Workbench::update(Clock::time_point now) {
  document_files_.update();
  run_.update(edits());
  document_.update();
  balls_.update(preset(), run_);
  sweep_.update();
  playback_.update(now);
  film_.update();
  files_.update();
  services_.tasks.collect(services_.messages);
  carry_out_follow_ups();
  services_.messages.expire(now);
  comparing_.update(now);
}

} // namespace nephroid::ui
