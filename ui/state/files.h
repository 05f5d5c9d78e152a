// SPDX-License-Identifier: Apache-2.0
// Which files a person may open, drop and save, how they are written, and what a dropped mesh becomes.
#pragma once
#include "job/job.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "ui/state/commands.h"
#include "ui/state/comparing.h"
#include "ui/state/tasks.h"

#include <filesystem>
#include <memory>
#include <string>

namespace nephroid::ui {

/// What a file is by the ending of its name.
enum class FileKind {
  other,      ///< a preset, perhaps
  dispersion, ///< YAML of refractiveindex.info
  scene,      ///< glTF: a whole scene, which becomes a preset
  mesh,
  map,     ///< a picture of surroundings, which has a range that no screen has
  picture, ///< as screens show it
  kernel
};
FileKind kind_of(const std::filesystem::path& file);

/// Throws bad_input in one line where `name` is a file of a kind that is no preset: a mesh, dispersion data, a picture,
/// a kernel, anything that does not begin as a JSON object. Presets, broken ones too, and names of no file pass:
/// reading them says the rest.
void refuse_other_kinds(const std::string& name);
/// Where "save" writes without asking: the file that was opened, unless it is one of the shipped presets. Empty: ask.
/// preset may be null.
std::filesystem::path save_target(const preset::Preset* preset);
/// What a saved preset may be written over, as preset::file_text takes it: the parent that its file names, or the
/// shipped preset that it is. Empty: it has none.
std::string parent_to_keep(const preset::Preset& preset);
/// A proposal for a file's name in the current folder: the preset's own with another ending.
std::string proposed_name(const preset::Preset* preset, const std::string& ending);

/// The path, or where something is there already, may be edited since, the first of PATH-2, PATH-3, ... where nothing
/// is.
std::filesystem::path free_name(const std::filesystem::path& path);
/// Makes a folder that nobody had, the free_name() of this one, which is returned. Throws failed where it cannot be
/// made.
std::filesystem::path make_new_folder(const std::filesystem::path& path);

/// The View's picture, for a file.
struct PictureToSave {
  HeldPicture picture;
  std::shared_ptr<const ShownDifference> map; ///< in place of the picture; null: none
  ViewSettings view_settings;
  double white = 1;    ///< preset::Preset::white
  std::string why_not; ///< there is none: a sentence without a full stop
};

/// By the extension of file: .png as shown, .exr the picture, linear with every layer. What there is to say of it, a
/// sentence.
std::string save_picture(const std::filesystem::path& file, const job::Picture& picture, const PictureToSave& shown);
/// The files of a run into a new folder, the free_name() of this one, which is returned.
std::filesystem::path save_files(const std::filesystem::path& folder, const job::Snapshot& of, TaskControl& control);

/// A mesh file that is dropped on the window.
struct DroppedMesh {
  std::filesystem::path file; ///< absolute
  scene::Bounds box;          ///< in the file's coordinates
  bool closed = true;         ///< every edge is shared by exactly two triangles
};

/// Throws bad_input naming the file where there is no mesh in it that could be rendered.
DroppedMesh read_dropped_mesh(const std::filesystem::path& file);

/// The preset with the mesh as its last object, and what was done, a sentence. The material is the first dielectric,
/// else the first of all, else new glass. The longest edge of the mesh's box becomes 0.4 of what the camera sees at its
/// target, where the box' middle goes. Throws bad_input where the preset refuses dielectrics that are not closed and
/// this would be one.
struct WithMesh {
  preset::Preset preset;
  std::string note;
};
WithMesh with_mesh(preset::Preset preset, const DroppedMesh& mesh);

} // namespace nephroid::ui
