// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 scene as a preset of engine 1: its meshes, camera, lights and materials. What has no counterpart is left
// out and said.
//
// glTF is in metres, +y up, cameras look along -z: as here. Its meshes become PLY files, each once, in the frame of its
// node. Extensions: KHR_lights_punctual, KHR_materials_ior, _transmission, _dispersion; of _volume that glass is solid.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::formats {

struct Imported {
  std::filesystem::path preset;
  std::size_t objects = 0, meshes = 0, lights = 0;
  std::vector<std::string> notes; ///< a sentence each: what was left out, what was put in its place

  /// One line: what was made, and how much was left out.
  std::string summary() const;
};

/// Reads FILE.gltf or FILE.glb and writes `preset` and, in the folder NAME-meshes beside it, its meshes; makes folders
/// where needed. Nothing is there where it fails. Throws bad_input naming the file and the place in it: cut or no glTF,
/// an index out of range, nodes in a circle, a buffer that is missing or too short, no triangle at all.
Imported import_gltf(const std::filesystem::path& file, const std::filesystem::path& preset);

/// The same of a Mitsuba scene (.xml), a PBRT scene (.pbrt), or else glTF.
Imported import_scene(const std::filesystem::path& file, const std::filesystem::path& preset);

} // namespace nephroid::formats
