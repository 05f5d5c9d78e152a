// SPDX-License-Identifier: Apache-2.0
// What the workbench does about things of the scene: what is selected, bookmarks of cameras, meshes that become objects.
#include "ui/state/workbench.h"

#include "base/error.h"
#include "base/files.h"
#include "engine/engine.h"

#include <utility>

namespace nephroid::ui {

void Workbench::take_picture(const std::string& file)
{
  if (!is_there(file)) throw bad_input(file, "there is no such picture");
  preset::Preset edited = edits_->current();
  engine::Taken taken = engine::engine_of(edited).take_picture(edited, file);
  carry_out(command::Edit{std::move(taken.edit), std::move(edited)});
  messages_.note(std::move(taken.note));
}

void Workbench::carry_out(const command::Select& c)
{
  chosen_.selection = in_preset(c.selection, preset());
  chosen_.nudged.at_s = command::Nudged{}.at_s; // another thing is another entry to undo
}

void Workbench::carry_out(const command::AddBookmark&)
{
  if (!edits_) return;
  const std::string name = new_bookmark_name(edits_->current(), chosen_.bookmarks);
  chosen_.bookmarks.push_back({name, edits_->current().scene.camera});
  messages_.note("bookmarked the camera as \"" + name + "\"");
}

void Workbench::carry_out(const command::GoToBookmark& c)
{
  if (!edits_ || c.index >= chosen_.bookmarks.size()) return;
  const Bookmark& bookmark = chosen_.bookmarks[c.index];
  preset::Preset edited = edits_->current();
  edited.scene.camera = seen_from(bookmark, edited.scene.camera);
  if (edited.scene.camera == edits_->current().scene.camera) return;
  carry_out(command::Edit{"go to " + bookmark.name, std::move(edited)});
}

void Workbench::carry_out(const command::RenameBookmark& c)
{
  if (c.index < chosen_.bookmarks.size() && !c.name.empty()) chosen_.bookmarks[c.index].name = c.name;
}

void Workbench::carry_out(const command::DeleteBookmark& c)
{
  if (c.index < chosen_.bookmarks.size()) chosen_.bookmarks.erase(chosen_.bookmarks.begin() + static_cast<std::ptrdiff_t>(c.index));
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
