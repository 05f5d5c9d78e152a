// SPDX-License-Identifier: Apache-2.0
// The preset in hand: its history, the edits, and the run that follows each of them.
#pragma once
#include "preset/read.h"
#include "ui/state/files.h"
#include "ui/state/view_state.h"

namespace nephroid::ui {

class Document {
public:
  /// run, view_state and services outlive the object.
  Document(RunInHand& run, ViewState& view_state, Services& services)
      : run_(run), view_state_(view_state), services_(services) {}

  /// Both are null where no preset is open.
  const UndoStack* edits() const { return edits_ ? &*edits_ : nullptr; }
  const preset::Preset* preset() const { return edits_ ? &edits_->current() : nullptr; }
  bool modified() const { return edits_ && edits_->modified(); }
  bool reads_mesh() const { return services_.tasks.busy(meshes_); }

  /// Takes the preset and starts its run; the one before must be closed.
  void open(UndoStack edits);
  /// Drops the preset and everything chosen in it.
  void close();
  void mark_saved(const std::filesystem::path& file) { edits_->mark_saved(file.string()); }
  /// Makes the file's present contents an edit that counts as saved. False where the preset is the same already.
  bool take_over(preset::WithSweep read);
  /// Gives a picture's file to the preset's engine. Throws bad_input where the engine has no use for it.
  void take_picture(const std::string& file);
  /// Makes it the texture of the selected object's material. False where no matt object is selected.
  bool take_texture(const std::string& file);
  void read_mesh(const std::filesystem::path& file);
  /// Called once a frame, after RunInHand::update: the fitted white replaces "auto".
  void update();

  void carry_out(const command::Edit& c);
  void carry_out(const command::SetSweep& c);
  void carry_out(const command::Undo&) { step(&UndoStack::undo); }
  void carry_out(const command::Redo&) { step(&UndoStack::redo); }
  void carry_out(const command::ShowFrame& c);
  void carry_out(const command::Restart&);
  void carry_out(const command::Select& c);
  void carry_out(const command::InspectPixel& c);
  void carry_out(const command::OpenMap& c);
  void carry_out(const command::AddMesh& c);
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
  std::uint64_t refused_edit_ = 0; ///< the message about the last refused edit
  TaskKey meshes_;
};

} // namespace nephroid::ui
