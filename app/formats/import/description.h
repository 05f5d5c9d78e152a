// SPDX-License-Identifier: Apache-2.0
// What the readers of glTF, Mitsuba, PBRT and GemCad files find, in the file's own coordinates and units. import.cpp
// makes a preset of it. Intensities are colours whose luminance is in the file's unit of power.
#pragma once
#include "base/bytes.h"
#include "formats/import/described_colour.h"
#include "scene/mesh.h"

#include <cmath>
#include <map>
#include <set>

namespace nephroid::formats {

/// Names, with how many asked for each.
using TakenNames = std::map<std::string, int>;

/// What a mesh can become, and how its weight changes.
struct DescribedState {
  struct Key {
    double seconds = 0, weight = 0;
  };
  std::string mesh;      ///< a key of Description::meshes
  double weight = 0;     ///< where it does not change
  std::vector<Key> keys; ///< by rising time; straight lines between them
};

struct DescribedShape {
  Location where;
  std::string name;
  std::string mesh;                    ///< a key of Description::meshes; empty: a sphere about the origin
  std::vector<DescribedState> states;  ///< of the mesh
  double radius = 1;                   ///< the sphere's
  glm::dmat4 to_world{1};              ///< in the file's coordinates
  std::string material;                ///< a key of Description::materials
  std::optional<bool> smooth;          ///< its normals; nothing: smooth where the mesh has normals
  double crease_deg = 180;             ///< as a preset's object has it
  int priority = 0;                    ///< of a dielectric, as a preset's object has it
  bool inside_out = false;             ///< what shines is its inside; what is in a dielectric is around it
  std::optional<DescribedColour> glow; ///< radiance of its outside
  std::optional<double> glow_power;    ///< of all of it, in the file's unit, times the luminance of its glow
  bool glows_on_both_sides = false;    ///< only where it is flat
  bool glows_by_mean = false;          ///< of a picture of its light: details shine, which light no scene
  std::optional<std::string> back;     ///< the material of its back, where that has another
};

/// A dielectric of the file.
struct DescribedGlass {
  preset::Dispersion inside;           ///< on the side that normals look away from
  double outside = 1;                  ///< the index on their other side, as the file has it
  bool is_ratio = false;               ///< inside is over what is on the other side, whatever that is
  bool is_thin = false;                ///< a pane whose surfaces are one
  std::optional<DescribedColour> tint; ///< the part that passes its surface
  double roughness = 0;                ///< as a preset's material has it; not of a pane
  std::optional<preset::Texture> tint_texture, roughness_texture; ///< as a preset's material has them
  std::optional<DescribedColour> absorption;                      ///< a unit of length
};

struct DescribedLight {
  Location where;
  preset::Light::Type type = preset::Light::Type::point; ///< not area
  glm::dvec3 position{0}, direction{0, 0, 1};
  DescribedColour colour; ///< intensity; irradiance of a directional one
  double half_angle_deg = 30;
};

struct DescribedCamera {
  Location where;
  glm::dmat4 to_world{1};       ///< x to the right of the picture, y up, z forward
  double fov_deg = 40;          ///< vertical
  std::optional<double> height; ///< of an orthographic one, in the camera's own units
  glm::dvec2 shift{0};          ///< as a preset's camera has it
  double lens_radius = 0;       ///< in the camera's own units; 0: no lens
  double focus_distance = 1;    ///< likewise; of a lens
  std::array<int, 2> resolution{768, 576};
};

/// Leaves of the picture what is so far from its upper left corner and of this size, both in pixels.
void crop(DescribedCamera& camera, const glm::dvec2& corner, const glm::dvec2& size);

struct DescribedSurroundings {
  Location where;
  std::filesystem::path file; ///< latitude and longitude; empty: one colour
  bool is_equal_area = false; ///< PBRT 4's square (Clarberg 2008), its z axis towards the middle
  glm::dvec3 colour{1};
  double scale = 1;
  bool lights = true;     ///< false: only seen
  glm::dmat3 to_world{1}; ///< from the map's directions: +y is its top, +z in its centre column and
                          ///< +x to the left of that; of a square its own
  std::optional<preset::Environment> sky = {}; ///< a clear sky in place of a map, with its sun_direction
};

inline constexpr std::size_t max_shapes = 1000000; ///< of a file: instances of instances multiply

struct Description {
  std::filesystem::path source;
  preset::Preset::Unit length = preset::Preset::Unit::m; ///< of the file's coordinates
  double unit = 1; ///< luminance Y (W m^-2 sr^-1, no factor 683) of a radiance of 1 in the file, which is white there
  double exposure = 1;     ///< a picture's values over the radiance, both as the file has them
  bool fits_white = false; ///< the file has no radiance that is white: one is made of its lights
  std::optional<DescribedCamera> camera;
  std::map<std::string, scene::Mesh> meshes;               ///< by the names of their files
  std::map<std::string, std::string> swollen;              ///< keys of backs of curved meshes (backs.cpp)
  std::map<std::string, scene::MeshReport> reports;        ///< of meshes by their keys, as far as they were asked for
  std::map<std::filesystem::path, std::string> mesh_files; ///< keys by the files that they were read from
  TakenNames file_counts;                                  ///< names that own_file() was asked for
  std::map<std::string, std::string> files; ///< dispersion files and pictures by their names, which materials have
  std::map<std::string, preset::Material> materials;
  std::map<std::string, DescribedGlass> dielectrics; ///< by the keys of the materials that settle_dielectrics() makes
  std::vector<DescribedShape> shapes;
  std::vector<DescribedLight> lights;
  std::vector<preset::Light> lamps; ///< lights that are in watts already
  std::optional<DescribedSurroundings> surroundings;
  glm::dvec3 up{0, 1, 0}; ///< of a sky, a unit vector
  std::vector<std::string> notes;
  std::set<std::string> noted;

  /// A sentence on what is left out, and what is done instead; each once.
  void note(const std::string& text);
  /// FILE:LINE: the same.
  void note(const Location& where, const std::string& text) { note(where.text() + ": " + text); }
  /// Notes that a file ends paths so early that more would be seen. field: its word for their length; most: that
  /// length, below 0 where there is no limit.
  void note_length_of_paths(const Location& where, const char* field, double most);
  /// Reads a mesh, which may be packed as .gz, and returns its key. where: of the shape, for the message where the file
  /// cannot be read.
  std::string mesh_file(const std::filesystem::path& file, const Location& where);
  /// The name of a new file of the import, made of this one.
  std::string own_file(const std::string& name, const char* ending);
  /// Adds a file of the import and returns its name.
  std::string own_bytes(const std::string& name, const char* ending, const ByteStore& bytes);
  /// Adds a mesh and returns its key.
  std::string own_mesh(const std::string& name, scene::Mesh mesh);
};

/// Counts in `depth` what is being read, each inside of the one before, for as long as this lives. Throws bad_input at
/// `where` if that is more than 8: it may go round in a circle. what: "mixes".
class Nesting {
public:
  Nesting(int& depth, const char* what, const Location& where);
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  ~Nesting() { --depth_; }

private:
  int& depth_;
};

/// A new folder among the system's temporary ones, which is removed with this.
class TemporaryFolder {
public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// The file's bytes; unpacked where its name ends in .gz.
std::string read_packed_file(const std::filesystem::path& file);

/// A text of a file as the name of something: one line, without what parts paths.
std::string name_of(const std::string& text, const std::string& otherwise);
/// The same as a file's name, without blanks.
std::string file_name_of(const std::string& text, const char* ending);
/// The name, with a number behind it where it is taken. Names that are alike cost no more than others.
std::string unique(const std::string& name, TakenNames& taken);

/// A number of a file; nothing if the text is none, or one that no scene has.
std::optional<double> scene_number(std::string_view text);
/// Throws bad_input at `where` if no glass has this index of refraction.
DescribedGlass glass_of(double n, const Location& where);
/// Throws bad_input at `where` if the matrix has no inverse, which flattens what it places.
void require_inverse(const glm::dmat4& matrix, const Location& where);

/// From a viewer's coordinates, x across `up` and the line of sight, z forward. Throws bad_input at `where`.
glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up, const Location& where);
/// The matrix, then a turn about the axis. Throws bad_input at `where` if the axis has no direction.
glm::dmat4 rotated(const glm::dmat4& matrix, double degrees, const glm::dvec3& axis, const Location& where);
/// The vertical field of view of a picture where `degrees` are seen across an extent; both in pixels.
double vertical_fov_deg(double degrees, double height, double extent);

/// A flat polygon with its corners in this order, seen from outside.
scene::Mesh polygon(const std::vector<glm::vec3>& corners, const std::vector<glm::vec2>& texcoords = {});
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

/// They fill an empty description, whose notes are there even where they throw.
void describe_gltf(const std::filesystem::path& file, Description& into);
void describe_mitsuba(const std::filesystem::path& file, Description& into);
void describe_pbrt(const std::filesystem::path& file, Description& into);
void describe_gemcad(const std::filesystem::path& file, Description& into);
/// The one of them that the file's ending asks for, behind which .gz may stand.
void describe_file(const std::filesystem::path& file, Description& into);

/// In lower case with its dot, of "scene.pbrt.gz" ".pbrt".
std::string ending_of(const std::filesystem::path& file);

} // namespace nephroid::formats
