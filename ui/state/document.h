// SPDX-License-Identifier: Apache-2.0
// The preset that is edited: its history, what changes it, and the run that follows each edit.
#pragma once
#include "preset/read.h"
#include "ui/state/files.h"
#include "ui/state/run_in_hand.h"
#include "ui/state/services.h"
#include "ui/state/undo.h"
#include "ui/state/view_state.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace nephroid::ui {

class Document {
public:
  /// All outlive it.
  Document(RunInHand& run, ViewState& view_state, Services& services)
      : run_(run), view_state_(view_state), services_(services) {}

  /// Both are null where no preset is open.
  const UndoStack* edits() const { return edits_ ? &*edits_ : nullptr; }
  const preset::Preset* preset() const { return edits_ ? &edits_->current() : nullptr; }
  bool modified() const { return edits_ && edits_->modified(); }
  /// Whether a mesh is being read that will be an object.
  bool reads_mesh() const { return services_.tasks.busy(meshes_); }

  /// The preset and its run from now on; another one was closed before.
  void open(UndoStack edits);
  /// Lets the preset go, and what was chosen of it.
  void close();
  void mark_saved(const std::filesystem::path& file) { edits_->mark_saved(file.string()); }
  /// What its file has now becomes an edit that counts as saved. False where it is what is there already.
  bool take_over(preset::WithSweep read);
  /// What the preset's engine makes of a picture's file. Throws bad_input where it has no place for it.
  void take_picture(const std::string& file);
  /// The mesh becomes an object once it is read.
  void read_mesh(const std::filesystem::path& file);
  /// Once a frame, after RunInHand::update: the white that was fitted takes the place of "auto".
  void update();

  void carry_out(const command::Edit& c);
  void carry_out(const command::SetSweep& c);
  void carry_out(const command::Undo&) { step(&UndoStack::undo); }
  void carry_out(const command::Redo&) { step(&UndoStack::redo); }
  void carry_out(const command::Restart&);
  void carry_out(const command::Select& c);
  void carry_out(const command::InspectPixel& c);
  void carry_out(const command::OpenMap& c);
  void carry_out(const command::LoadDispersion& c);

private:
  void edit(const command::Edit& c);
  void note_left_out(std::string_view engine);
  void step(bool (UndoStack::*by)());
  void add_object(const DroppedMesh& mesh);

  RunInHand& run_;
  ViewState& view_state_;
  Services& services_;
  std::optional<UndoStack> edits_;
  std::uint64_t refused_edit_ = 0; ///< the message about the last edit that was refused
  TaskKey meshes_;
};

} // namespace nephroid::ui
