// SPDX-License-Identifier: Apache-2.0
// A scene of another program as a preset of engine 1: its meshes, camera, lights and materials. What has no counterpart
// is left out and said.
#pragma once
#include "base/watch.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::formats {

struct Imported {
  std::filesystem::path preset;
  std::size_t objects = 0, meshes = 0, lights = 0;
  std::vector<std::string> notes; ///< a sentence each: what was left out, what was put in its place

  std::string counts() const; ///< "2 objects, 1 mesh, 1 light"
  /// One line: what was made, and how much was left out.
  std::string summary() const;
};

/// Reads a Mitsuba scene (.xml), a PBRT scene (.pbrt), a stone of GemCad (.asc), or else glTF 2.0, and writes `preset`
/// and, in the folder NAME-meshes beside it, its meshes, each once; notes, if there are any, as NAME-not-imported.txt
/// and as the preset's `not_imported`. Makes folders where needed. Nothing is there where it fails. Throws bad_input
/// naming the file and the place in it: cut or of another format, an index out of range, nodes in a circle, a buffer
/// that is missing or too short, no surface at all, facets that leave a stone open; interrupted where the watch says
/// so.
Imported import_scene(const std::filesystem::path& file, const std::filesystem::path& preset, const Watch& watch = {});

} // namespace nephroid::formats
