// SPDX-License-Identifier: Apache-2.0
// Which files a person may open, drop and save, how they are written, and how a dropped mesh is added.
#pragma once
#include "image/display.h"
#include "job/job.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "ui/state/comparing.h"

namespace nephroid::ui {

/// A file's kind, by its extension.
enum class FileKind {
  other,      ///< perhaps a preset
  dispersion, ///< YAML of refractiveindex.info
  scene,      ///< glTF: a whole scene, which becomes a preset
  mesh,
  map,     ///< a picture of the surroundings, with a range that no screen has
  picture, ///< a picture as screens show it
  kernel
};
FileKind kind_of(const std::filesystem::path& file);

/// Throws bad_input in one line where `name` is a file of another kind: a mesh, dispersion data, a picture, a kernel,
/// anything that does not begin as a JSON object. Presets, even broken ones, and names without a file pass: the reader
/// reports the rest.
void refuse_other_kinds(const std::string& name);
/// Where "save" writes without asking: the opened file, unless it is a shipped preset. Empty: ask. preset may be null.
std::filesystem::path save_target(const preset::Preset* preset);
/// The parent that a saved preset is written against, as preset::file_text takes it: the one that its file names, or
/// the shipped preset that it is. Empty: none.
std::string parent_to_keep(const preset::Preset& preset);
/// A file name in the current folder: the preset's own, with another ending.
std::string proposed_name(const preset::Preset* preset, const std::string& ending);

/// The path where it is free; else the first free one of PATH-2, PATH-3, ...
std::filesystem::path free_name(const std::filesystem::path& path);
/// Makes a new folder, the free_name() of this path, and returns it. Throws failed where it cannot be made.
std::filesystem::path make_new_folder(const std::filesystem::path& path);

struct PictureToSave {
  HeldPicture picture;
  std::shared_ptr<const ShownDifference> map; ///< shown in place of the picture; null: none
  ViewSettings view_settings;
  image::Display display; ///< the preset's
  double white = 1;       ///< preset::Preset::white
  std::string why_not;    ///< why there is no picture: a sentence without a full stop
};

/// Saves by the extension of file: .png as shown, .exr the picture, linear with every layer. Returns a sentence for the
/// person.
std::string save_picture(const std::filesystem::path& file, const job::Picture& picture, const PictureToSave& shown);
/// Writes a run's files into a new folder, the free_name() of this one, and returns that.
std::filesystem::path save_files(const std::filesystem::path& folder, const job::Snapshot& of, TaskControl& control);

/// A mesh file that was dropped on the window.
struct DroppedMesh {
  std::filesystem::path file; ///< absolute
  scene::Bounds box;          ///< in the file's coordinates
  bool closed = true;         ///< every edge is shared by exactly two triangles
};

/// Throws bad_input naming the file where it has no mesh that could be rendered.
DroppedMesh read_dropped_mesh(const std::filesystem::path& file);

/// The preset with the mesh as its last object, and a sentence about it. The material is the first dielectric, else the
/// first of all, else new glass. The longest edge of the mesh's box becomes 0.4 of what the camera sees at its target;
/// it stands at free_place(). Throws bad_input where the preset refuses open dielectrics and the mesh would be one.
struct WithMesh {
  preset::Preset preset;
  std::string note;
};
WithMesh with_mesh(preset::Preset preset, const DroppedMesh& mesh);

} // namespace nephroid::ui
