// SPDX-License-Identifier: Apache-2.0
// What the readers of Mitsuba and PBRT scenes find, in the file's own coordinates and units, and how it becomes a
// preset: in one place, for both. Intensities are colours whose luminance is in the file's unit of power.
#pragma once
#include "base/place.h"
#include "formats/import/import.h"
#include "preset/preset.h"
#include "scene/mesh.h"

#include <glm/glm.hpp>

#include <cmath>
#include <map>
#include <optional>

namespace nephroid::formats {

struct DescribedShape {
  Place where;
  std::string name;
  std::string mesh;               ///< a key of Description::meshes; empty: a sphere about the origin
  double radius = 1;              ///< of the sphere
  glm::dmat4 to_world{1};         ///< in the file's coordinates
  std::string material;           ///< a key of Description::materials
  std::optional<glm::dvec3> glow; ///< radiance of its outside
};

struct DescribedLight {
  Place where;
  preset::Light::Type type = preset::Light::Type::point; ///< not area
  glm::dvec3 position{0}, direction{0, 0, 1};
  glm::dvec3 colour{1}; ///< intensity; irradiance of a directional one
  double half_angle_deg = 30;
};

struct DescribedCamera {
  glm::dmat4 to_world{1}; ///< x to the right of the picture, y up, z forward
  double fov_deg = 40;    ///< vertical
  std::array<int, 2> resolution{768, 576};
};

struct DescribedSurroundings {
  Place where;
  std::filesystem::path file; ///< latitude and longitude; empty: one colour
  glm::dvec3 colour{1};
  double scale = 1;
  glm::dvec3 centre{0, 0, 1}; ///< where the map's centre column looks, y up
};

struct Description {
  std::filesystem::path source;
  double unit = 1; ///< luminance Y (W m^-2 sr^-1, no factor 683) of a radiance of 1 in the file, which is white there
  std::optional<DescribedCamera> camera;
  std::map<std::string, scene::Mesh> meshes;
  std::map<std::string, preset::Material> materials;
  std::vector<DescribedShape> shapes;
  std::vector<DescribedLight> lights;
  std::optional<DescribedSurroundings> surroundings;
  std::vector<std::string> notes;

  /// FILE:LINE: what is left out, and what is done instead; each once.
  void note(const Place& where, const std::string& text);
  /// Its key. where: of the shape, for the message where the file cannot be read.
  std::string mesh_file(const std::filesystem::path& file, const Place& where);
  std::string own_mesh(const std::string& name, scene::Mesh mesh);
};

/// A text of a file as the name of something: one line, without what parts paths.
std::string name_of(const std::string& text, const std::string& otherwise);

/// A flat polygon with its corners in this order, seen from outside.
scene::Mesh polygon(const std::vector<glm::vec3>& corners);
scene::Mesh cube();              ///< from -1 to 1
scene::Mesh disk(double radius); ///< faces +z
scene::Mesh open_cylinder(const glm::dvec3& from, const glm::dvec3& to, double radius);

/// The half angle of a cone of constant intensity with the power of one that fades: fade(angle) is its intensity over
/// that of its axis.
template <class Fade>
double same_power_half_angle_deg(double outer_deg, const Fade& fade) {
  constexpr int steps = 4096;
  double part = 0; // of the solid angle over 2 pi
  for (int i = 0; i < steps; ++i) {
    const double a = glm::radians(outer_deg) * (i + 0.5) / steps;
    part += fade(a) * std::sin(a) * glm::radians(outer_deg) / steps;
  }
  return glm::degrees(std::acos(1 - part));
}

/// Throws bad_input where there is nothing to see.
Imported write_described(Description description, const std::filesystem::path& preset);
/// Writes the meshes, then the preset that names them.
Imported write_imported(const preset::Preset& made, const std::filesystem::path& preset,
                        const std::map<std::string, scene::Mesh>& meshes,
                        const std::map<std::string, std::string>& glasses, std::vector<std::string> notes);

Description read_mitsuba(const std::filesystem::path& file);
Description read_pbrt(const std::filesystem::path& file);

} // namespace nephroid::formats
