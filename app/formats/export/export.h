// SPDX-License-Identifier: Apache-2.0
// A scene for another renderer, with the light that we add to it: glTF and, for Blender, pictures of irradiance and a
// script that puts all of it together. Units there are ours: a watt is a luminous one, 683 lumens, which is also what
// Blender takes a watt of glTF's lights for.
#pragma once
#include "formats/export/receiver.h"
#include "image/image.h"
#include "job/job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::formats {

/// What falls on a receiver through glass and by way of mirrors.
struct Caustic {
  Receiver receiver;
  image::Image irradiance; ///< R, G, B: linear sRGB, Y in luminous W/m^2
  std::string file;        ///< its name in the folder: "caustic-floor.exr"
  double watts = 0;        ///< luminous, on all of it

  /// picture: of irradiance_view(). scene: that one, or the one it was made of.
  Caustic(const scene::Scene& scene, const Receiver& receiver, const job::Picture& picture);
};

/// Each folder of an export has this file.
inline constexpr const char* list_file = "caustics.json";

/// scene.glb, a picture of each caustic, surroundings.exr where the scene has some, caustics.json and blender.py, each
/// whole. white: what shows the picture well. Returns what no glTF file holds, a sentence each.
std::vector<std::string> write_export(const std::filesystem::path& folder, const scene::Scene& scene,
                                      const preset::Preset& preset, const std::vector<Caustic>& caustics, double white);

/// A script of app/formats/export/*.py.
struct ExportScript {
  const char* name;
  const char* text;
};
const std::vector<ExportScript>& export_scripts();

} // namespace nephroid::formats
