// SPDX-License-Identifier: Apache-2.0
// What the readers of glTF, Mitsuba and PBRT files find, in the file's own coordinates and units. import.cpp makes a
// preset of it. Intensities are colours whose luminance is in the file's unit of power.
#pragma once
#include "base/location.h"
#include "preset/preset.h"
#include "scene/mesh.h"

#include <glm/glm.hpp>

#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace nephroid::formats {

struct DescribedShape {
  Location where;
  std::string name;
  std::string mesh;               ///< a key of Description::meshes; empty: a sphere about the origin
  double radius = 1;              ///< the sphere's
  glm::dmat4 to_world{1};         ///< in the file's coordinates
  std::string material;           ///< a key of Description::materials
  std::optional<glm::dvec3> glow; ///< radiance of its outside
};

struct DescribedLight {
  Location where;
  preset::Light::Type type = preset::Light::Type::point; ///< not area
  glm::dvec3 position{0}, direction{0, 0, 1};
  glm::dvec3 colour{1}; ///< intensity; irradiance of a directional one
  double half_angle_deg = 30;
};

struct DescribedCamera {
  Location where;
  glm::dmat4 to_world{1}; ///< x to the right of the picture, y up, z forward
  double fov_deg = 40;    ///< vertical
  std::array<int, 2> resolution{768, 576};
};

struct DescribedSurroundings {
  Location where;
  std::filesystem::path file; ///< latitude and longitude; empty: one colour
  glm::dvec3 colour{1};
  double scale = 1;
  glm::dvec3 centre{0, 0, 1}; ///< where the map's centre column looks, y up
};

struct Description {
  std::filesystem::path source;
  double unit = 1; ///< luminance Y (W m^-2 sr^-1, no factor 683) of a radiance of 1 in the file, which is white there
  bool fits_white = false; ///< the file has no radiance that is white: one is made of its lights
  std::optional<DescribedCamera> camera;
  std::map<std::string, scene::Mesh> meshes;  ///< by the names of their files
  std::map<std::string, std::string> glasses; ///< dispersion files by their names, which materials have
  std::map<std::string, preset::Material> materials;
  std::vector<DescribedShape> shapes;
  std::vector<DescribedLight> lights;
  std::vector<preset::Light> lamps; ///< lights that are in watts already
  std::optional<DescribedSurroundings> surroundings;
  std::vector<std::string> notes;
  std::set<std::string> noted;
  std::map<std::string, int> names_of_meshes; ///< the last number of each, less one

  /// A sentence on what is left out, and what is done instead; each once.
  void note(const std::string& text);
  /// FILE:LINE: the same.
  void note(const Location& where, const std::string& text) { note(where.text() + ": " + text); }
  /// Reads a mesh and returns its key. where: of the shape, for the message where the file cannot be read.
  std::string mesh_file(const std::filesystem::path& file, const Location& where);
  /// Adds a mesh and returns its key.
  std::string own_mesh(const std::string& name, scene::Mesh mesh);
};

/// A text of a file as the name of something: one line, without what parts paths.
std::string name_of(const std::string& text, const std::string& otherwise);
/// The same as a file's name, without blanks.
std::string file_name_of(const std::string& text, const char* ending);
/// The name, with a number behind it where it is taken. taken: the last number of each.
std::string unique(const std::string& name, std::map<std::string, int>& taken);

/// A number of a file; nothing if the text is none, or one that no scene has.
std::optional<double> scene_number(std::string_view text);
/// Throws bad_input at `where` if no glass has this index of refraction.
preset::Material glass_of(double n, const Location& where);

/// From a viewer's coordinates, x across `up` and the line of sight, z forward. Throws bad_input at `where`.
glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up, const Location& where);
/// The matrix, then a turn about the axis. Throws bad_input at `where` if the axis has no direction.
glm::dmat4 rotated(const glm::dmat4& matrix, double degrees, const glm::dvec3& axis, const Location& where);
/// The vertical field of view of a picture where `degrees` are seen across an extent; both in pixels.
double vertical_fov_deg(double degrees, double height, double extent);

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
  double part = 0; // solid angle over 2 pi
  for (int i = 0; i < steps; ++i) {
    const double a = glm::radians(outer_deg) * (i + 0.5) / steps;
    part += fade(a) * std::sin(a) * glm::radians(outer_deg) / steps;
  }
  return glm::degrees(std::acos(1 - part));
}

Description describe_gltf(const std::filesystem::path& file);
Description describe_mitsuba(const std::filesystem::path& file);
Description describe_pbrt(const std::filesystem::path& file);

} // namespace nephroid::formats
