// SPDX-License-Identifier: Apache-2.0
// A scene for another renderer, with the light that we add to it: glTF and, for Blender, pictures of irradiance and a
// script that puts all of it together. Units there are ours: a watt is a luminous one, 683 lumens, which is also what
// Blender takes a watt of glTF's lights for.
#pragma once
#include "image/image.h"
#include "job/job.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::formats {

/// A rectangle about a flat matt object, seen from the side that the glass and mirrors are on. In the scene's
/// coordinates.
struct Receiver {
  int object = 0; ///< index in Scene::objects
  glm::dvec3 centre{0};
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}; ///< unit; right x up looks to that side
  double width = 0, height = 0;           ///< along right and up
  bool is_front = true;                   ///< whether the triangles' front is on that side

  glm::dvec3 normal() const { return glm::cross(right, up); }
};

/// All flat matt objects as receivers, in the order of the scene.
std::vector<Receiver> receivers_of(const scene::Scene& scene);

/// The scene with a camera for the light that a receiver gets, not for what an eye sees of it. Where engine 1 renders
/// that with a white of 1, the layer "caustic" is the irradiance in W/m^2 over pi, as linear sRGB whose Y has no factor
/// 683. longest: of the picture's edges, in pixels.
scene::Scene irradiance_view(scene::Scene scene, const Receiver& receiver, int longest);

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
/// whole. white: what shows the picture well; indirect: whether the other program has light from wall to wall. Returns
/// what no glTF file holds, a sentence each.
std::vector<std::string> write_export(const std::filesystem::path& folder, const scene::Scene& scene,
                                      const preset::Preset& preset, const std::vector<Caustic>& caustics, double white,
                                      bool indirect);

/// A script of app/formats/export/*.py.
struct ExportScript {
  const char* name;
  const char* text;
};
const std::vector<ExportScript>& export_scripts();

} // namespace nephroid::formats
