// SPDX-License-Identifier: Apache-2.0
// The preset: the whole state of a run as plain structs. Fields, units, ranges, defaults and sentences are described
// once, in describe.h; reading, writing, --set, the schema, the editor and the docs are visitors over that description.
#pragma once
#include "kernels/lights/light_types.h"
#include "kernels/scatter/material_types.h"
#include "preset/settings.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

namespace nephroid::preset {

using Vec3 = std::array<double, 3>;

/// What n(wavelength) does outside the data's own range.
enum class Extrapolation { automatic, hold, extrapolate, refuse };

/// Index of refraction. JSON: a number (constant n), a string (a refractiveindex.info file), or an object with "type".
struct Dispersion {
  enum class Type { constant, file, sellmeier, cauchy, table, points };
  Type type = Type::constant;
  double n = 1.5;                           ///< constant
  std::string file;                         ///< file: refractiveindex.info YAML
  std::vector<double> b, c_um2;             ///< sellmeier
  std::vector<double> coefficients;         ///< cauchy
  std::vector<std::array<double, 2>> table; ///< table: (nm, n) linear; points: control points (nm, n), monotone cubic
  Extrapolation outside = Extrapolation::automatic;
  bool operator==(const Dispersion&) const = default;
};

/// A light's spectrum. JSON: a string (CIE illuminant: A, D50, D65, E, F1..F12) or an object with "type".
struct LightSpectrum {
  enum class Type { illuminant, blackbody, lines, table };
  Type type = Type::illuminant;
  std::string illuminant = "D65";
  double temperature_k = 6500;              ///< blackbody
  std::vector<std::array<double, 2>> table; ///< table, lines: (nm, relative power)
  bool operator==(const LightSpectrum&) const = default;
};

/// 0..1. JSON: a number, a string (ColorChecker patch, "blue sky"), or an object {"type":"table"}.
struct Reflectance {
  enum class Type { constant, patch, table };
  Type type = Type::constant;
  double value = 0.8;
  std::string patch;
  std::vector<std::array<double, 2>> table; ///< (nm, reflectance), linear, held outside
  bool operator==(const Reflectance&) const = default;
};

/// A picture on a surface, by the surface's own u, v. JSON: a string (a picture file) or an object with "type".
/// (0, 0) is its lower left and (1, 1) its upper right corner; where it looks is offset + rotate(scale * (u, v)).
struct Texture {
  enum class Type { file, checkerboard };
  /// What is beyond the picture's edges.
  enum class Wrap { repeat, mirror, clamp };
  Type type = Type::file;
  std::string file;            ///< file
  Wrap wrap = Wrap::repeat;    ///< file
  Vec3 colour0{0.4, 0.4, 0.4}; ///< checkerboard: linear sRGB of the lower left and upper right quarter
  Vec3 colour1{0.2, 0.2, 0.2}; ///< checkerboard: of the other two
  std::array<double, 2> scale{1, 1};
  double rotate_deg = 0; ///< counterclockwise, of u, v
  std::array<double, 2> offset{0, 0};
  bool operator==(const Texture&) const = default;
};

/// One thin layer on a dielectric's surface, with its interference.
struct Coating {
  Dispersion dispersion;
  double thickness_nm = 100;
  bool operator==(const Coating&) const = default;
};

/// A pane of a glazing, from its front, which its surface's normal looks to, to its back. JSON: a number (mm of clear
/// glass), a string (a file of measured parts) or an object with "type".
struct Pane {
  enum class Type { glass, measured, file };
  Type type = Type::glass;
  double thickness_mm = 4; ///< glass
  /// glass: n, and k where the data have it
  Dispersion dispersion{Dispersion::Type::file, 1.5, "soda-lime-clear", {}, {}, {}, {}, Extrapolation::automatic};
  Reflectance tint{Reflectance::Type::constant, 1, {}, {}}; ///< glass: what a straight way through leaves besides
  std::vector<Coating> front_films, back_films;             ///< glass: on its faces, each from the front to the back
  Reflectance transmittance{Reflectance::Type::constant, 0.8, {}, {}};     ///< measured, straight on, as the next two
  Reflectance front_reflectance{Reflectance::Type::constant, 0.1, {}, {}}; ///< measured: of light from the front
  Reflectance back_reflectance{Reflectance::Type::constant, 0.1, {}, {}};  ///< measured: of light from the back
  std::string file;     ///< file: rows of wavelength, transmittance, front and back reflectance
  bool flipped = false; ///< measured, file: what is said of its front is of its back
  bool coated = true;   ///< measured, file: a face has a coating
  bool operator==(const Pane&) const = default;
};

struct Material {
#define NEPHROID_MATERIAL_WORD(word, NAME, lobes) word,
  enum class Type { MATERIALS(NEPHROID_MATERIAL_WORD) };
#undef NEPHROID_MATERIAL_WORD
  Type type = Type::diffuse;
  Reflectance reflectance;        ///< diffuse, mirror; plastic: of its base, as seen in even light
  std::optional<Texture> texture; ///< diffuse, plastic: what the reflectance is multiplied by
  Dispersion dispersion;          ///< dielectric; plastic, varnished_metal: of the coat, at 588 nm
  std::string metal = "gold";     ///< conductor, varnished_metal: a file with n and k, or a shipped metal
  bool absorption = true;         ///< dielectric: use k where the dispersion file has it
  /// dielectric: the part of the light that passes its surface, each time; varnished_metal: its varnish, each way
  Reflectance tint{Reflectance::Type::constant, 1, {}, {}};
  double roughness = 0;                     ///< not of diffuse, thin, varnished_metal: the root of the alpha of GGX
  bool thin = false;                        ///< dielectric: a pane without thickness, not a body
  std::optional<Texture> roughness_texture; ///< what is rough, but plastic: its green is a factor of the roughness
  std::optional<Texture> tint_texture;      ///< dielectric: what the tint is multiplied by
  std::optional<Texture> normal_map;        ///< diffuse: red, green, blue are (1 + the normal's part along x, y, z) / 2
  double normal_scale = 1;                  ///< diffuse: of the map's x and y
  std::optional<Coating> coating;           ///< dielectric, not thin
  std::vector<Pane> panes{Pane{}};          ///< glazing: from its front to its back
  bool operator==(const Material&) const = default;
};

/// LOBE_* and IS_PANE of kernels/scatter/material_types.h.
constexpr unsigned lobes(Material::Type type) {
#define NEPHROID_MATERIAL_LOBES(word, NAME, lobes) lobes,
  constexpr unsigned of_type[] = {MATERIALS(NEPHROID_MATERIAL_LOBES)};
#undef NEPHROID_MATERIAL_LOBES
  return of_type[static_cast<std::size_t>(type)];
}

/// Whether a surface sends a path on in one direction or about it, all of it or a part.
constexpr bool is_specular(Material::Type type) { return (lobes(type) & (LOBE_REFLECTION | LOBE_TRANSMISSION)) != 0; }

/// Whether a surface scatters a path to all sides, all of it or a part: what caustics fall on.
constexpr bool is_matt(Material::Type type) { return (lobes(type) & LOBE_DIFFUSE) != 0; }

/// Whether light passes the surface.
constexpr bool is_refractive(Material::Type type) { return (lobes(type) & LOBE_TRANSMISSION) != 0; }

/// Whether a closed object of it is a body that fills space.
constexpr bool is_body(const Material& m) { return is_refractive(m.type) && !m.thin && (lobes(m.type) & IS_PANE) == 0; }

/// Applied in the order scale, rotate (about x, then y, then z), translate.
struct Transform {
  Vec3 scale{1, 1, 1};
  Vec3 rotate_deg{0, 0, 0};
  Vec3 translate{0, 0, 0};
  bool operator==(const Transform&) const = default;
};

/// Shapes are centred on the origin; y is up. Every closed shape's triangles face outwards.
struct Shape {
  enum class Type { quad, box, sphere, cylinder, prism, plate, brilliant, curtain_wall, water, relief };
  Type type = Type::sphere;
  /// Edge lengths: quad (x by z, facing +y), box, plate (x by z, y thick); water at rest, relief where it is black;
  /// curtain_wall: x along its arc.
  Vec3 size{1, 1, 1};
  double radius = 0.5;            ///< sphere, cylinder; brilliant: girdle radius
  double height = 1;              ///< cylinder and prism: length along y; relief: how much higher white is than black
  double apex_deg = 60;           ///< prism: angle between the two equal sides, whose edge is at +z
  double side = 1;                ///< prism: length of the two equal sides
  int segments = 256;             ///< cylinder: facets around; water, relief: squares along the longer edge
  double arc_deg = 0;             ///< curtain_wall: it bends as much from edge to edge; above 0 its front is hollow
  std::array<int, 2> panes{4, 3}; ///< curtain_wall: along x and y
  double gap = 0;                 ///< curtain_wall: between panes
  double pillow = 0;              ///< curtain_wall: how far the middle of a pane stands out, or below 0 is dented
  double wind_m_s = 3;            ///< water: ten metres above it; 0: it is at rest
  double wind_deg = 0;            ///< water: where the wind goes to, counterclockwise from +x as seen from above
  double fetch_m = 100;           ///< water: how long the wind has blown over it
  double time_s = 0;              ///< water
  std::uint64_t seed = 1;         ///< water: which waves of those that this wind may raise
  std::string picture = {};       ///< relief: a picture file, whose green is the height; its top is at -z
  bool inwards = false;           ///< turn every triangle round, e.g. for a room
  bool operator==(const Shape&) const = default;
};

/// What an object's mesh can become, and how far it has: a morph target.
struct State {
  std::string mesh;  ///< a mesh file with the same triangles, elsewhere
  double weight = 0; ///< 0: the object's own mesh; 1: this one
  bool operator==(const State&) const = default;
};

struct Object {
  enum class Normals { given, faceted, smooth };
  std::string name;
  std::optional<std::string> mesh; ///< a mesh file; exactly one of mesh and shape is given
  std::vector<State> states;       ///< of the mesh: each moves its vertices by its weight's part of the way
  std::optional<Shape> shape;
  std::string material; ///< a key of Scene::materials
  Transform transform;
  Normals normals = Normals::given;
  double crease_deg = 40; ///< smooth, of a mesh without normals: an edge that bends more is sharp
  int priority = 0; ///< nested dielectrics: where two overlap the higher one is there; equal: the one entered last
  bool operator==(const Object&) const = default;
};

struct Light {
#define NEPHROID_LIGHT_WORD(word, NAME, Row, has, sentence) word,
  enum class Type { LIGHTS(NEPHROID_LIGHT_WORD) };
#undef NEPHROID_LIGHT_WORD
  Type type = Type::point;
  LightSpectrum spectrum;
  double power_w = 1;               ///< all but directional: radiant power of 380..780 nm
  double irradiance_w_m2 = 1;       ///< directional: on a plane that faces it
  Vec3 position{0, 0, 0};           ///< point, spot, area (its centre)
  Vec3 direction{0, -1, 0};         ///< spot, directional, area (its facing side): the way the light goes; photometry
  double half_angle_deg = 30;       ///< spot: constant intensity inside, 0 outside
  std::array<double, 2> size{1, 1}; ///< area: a rectangle's edge lengths
  Vec3 up{0, 0, 1};                 ///< area: along the rectangle's second edge (projected); photometry: C = 0
  double angular_diameter_deg = 0;  ///< directional: of the even disc that it comes from; 0: a point
  std::optional<std::string> photometry; ///< point: an IES or EULUMDAT file; its gamma = 0 is along `direction`
  bool file_lumens = false;              ///< photometry: the file's own lumens, in place of power_w
  std::optional<std::string> picture;    ///< area: a picture file, of how much light each place sends
  std::string object;                    ///< mesh: the name of the object whose surface shines
  bool operator==(const Light&) const = default;
};

/// Whether a light has one of HAS_* of kernels/lights/light_types.h.
constexpr bool has(Light::Type type, unsigned what) {
#define NEPHROID_LIGHT_HAS(word, NAME, Row, has, sentence) has,
  constexpr unsigned of_type[] = {LIGHTS(NEPHROID_LIGHT_HAS)};
#undef NEPHROID_LIGHT_HAS
  return (of_type[static_cast<std::size_t>(type)] & what) != 0;
}

inline bool is_directed(const Light& l) { return has(l.type, LIGHT_HAS_DIRECTION) || l.photometry; }

/// Whether it also has an `up`.
inline bool is_framed(const Light& l) { return has(l.type, LIGHT_HAS_EDGES) || l.photometry; }

/// W, or W m^-2.
inline double radiometric(const Light& l) { return has(l.type, LIGHT_HAS_IRRADIANCE) ? l.irradiance_w_m2 : l.power_w; }

struct Camera {
  enum class Projection { perspective, orthographic };
  Vec3 position{0, 1, 4};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};
  Projection projection = Projection::perspective;
  double fov_deg = 40;                  ///< vertical
  std::optional<double> height;         ///< orthographic only: what the picture shows; else height_at_target
  std::array<double, 2> shift{0, 0};    ///< to the right and up, in widths and heights of the picture
  double aperture = 0;                  ///< the lens's diameter; 0: a pinhole
  std::optional<double> focus_distance; ///< along the view; else the target's
  std::array<int, 2> resolution{512, 512};
  bool operator==(const Camera&) const = default;
};

/// Whether it is a pinhole with its axis in the middle of the picture.
inline bool is_plain(const Camera& c) {
  return c.projection == Camera::Projection::perspective && c.aperture == 0 && c.shift == std::array<double, 2>{0, 0};
}

/// From the camera to its target, units.
inline double target_distance(const Camera& c) {
  return std::hypot(c.target[0] - c.position[0], c.target[1] - c.position[1], c.target[2] - c.position[2]);
}

/// The height of what the picture shows in the plane of the target, units.
inline double height_at_target(const Camera& c) {
  if (c.projection == Camera::Projection::orthographic && c.height) return *c.height;
  return 2 * target_distance(c) * std::tan(c.fov_deg / 2 * std::numbers::pi / 180);
}

/// Where and when the sun is seen: scene/sky.h says where that is.
struct PlaceAndTime {
  double latitude_deg = 0;  ///< north is positive
  double longitude_deg = 0; ///< east is positive
  std::string date = {};    ///< YYYY-MM-DD, 1950 to 2050
  double hour = 12;         ///< by the place's clock: 14.5 is half past two
  /// What the clock is ahead of UTC, summer time included; nothing: what its time zone says, or 0 (preset/place.h).
  std::optional<double> utc_offset_h = {};
  std::optional<std::string> time_zone = {}; ///< IANA's name, such as "Europe/London"; only one of the two is given
  bool operator==(const PlaceAndTime&) const = default;
};

/// Days from 2000-01-01 to a date as PlaceAndTime has it. Nothing where that is no day of 1950 to 2050.
std::optional<int> days_since_2000(const std::string& date);

/// What is behind everything, infinitely far: the camera sees it, directly and through glass.
/// JSON: a string (a picture file) or an object with "type".
struct Environment {
  enum class Type { file, constant, sky };
  Type type = Type::file;
  std::string file;      ///< file: its centre column looks along -z, its top row along +y
  Vec3 colour{1, 1, 1};  ///< constant: linear sRGB
  double radiance = 1;   ///< the luminance Y (W m^-2 sr^-1, no factor 683) of the colour (1, 1, 1)
  double rotate_deg = 0; ///< file, sky: about +y, counterclockwise as seen from above
  bool lights = false;   ///< engine 1: false: a backdrop, as where lamps light a scene before a picture
  double turbidity = 3;  ///< sky: 2 is very clear, 10 is haze
  std::optional<PlaceAndTime> place = {}; ///< sky: only one of place and sun_direction is given
  /// sky: to the sun, before rotate_deg; north is -z, east is +x. Without it and place: (0, 1, 1).
  std::optional<Vec3> sun_direction = {};
  double sun_scale = 1; ///< sky: factor of the sun's light, which is a directional light; 0: none
  double albedo = 0.2;  ///< sky: of the ground below the horizon
  bool operator==(const Environment&) const = default;
};

/// A box along the axes.
struct Box {
  Vec3 low{-1, -1, -1}, high{1, 1, 1};
  bool operator==(const Box&) const = default;
};

/// Measures the light that falls on a surface, in cells. Light takes no notice of it.
struct Meter {
  enum class Type { surface, plane, point, goniometer };
  enum class Unit { watts, kilowatts, lux, kilolux, suns, candela, watts_per_steradian };
  Type type = Type::plane;
  std::string name;
  std::string object;         ///< surface: the name of the object, whose front it measures
  std::optional<Vec3> facing; ///< surface: only what faces this way, to 45 degrees
  std::optional<Box> within;  ///< surface: only what is in here
  Vec3 position{0, 0, 0};     ///< plane: its centre; point; goniometer: where directions are counted from
  Vec3 normal{0, 1, 0};       ///< plane, point: the side that light is measured on
  std::optional<Vec3> up;     ///< plane: the top of its map, null: +y, or -z if level; goniometer: C = 0, null: +z
  Vec3 direction{0, -1, 0};   ///< goniometer: gamma = 0
  double step_deg = 2.5;      ///< goniometer: between directions
  std::array<double, 2> size{1, 1};     ///< plane: its width and its height along `up`
  double diameter = 0.01;               ///< point: the edge of a square with the area of the meter's window
  std::optional<double> cell;           ///< surface, plane: the edge of a cell; else a 64th of the longest edge
  Unit unit = Unit::watts;              ///< of its map; it says whether watts or lux decide peak and end
  std::optional<std::string> threshold; ///< with its unit: "2500 W/m^2"
  std::optional<double> until_percent;  ///< the interval of mean and peak at which it has measured enough
  bool operator==(const Meter&) const = default;
};

struct Scene {
  /// What is done about a dielectric's mesh that has a hole or is inside out. report: say which, and go on.
  enum class DamagedMeshes { report, refuse };
  Camera camera;
  std::map<std::string, Material> materials;
  std::vector<Object> objects;
  std::vector<Light> lights;
  std::optional<Environment> environment;
  std::vector<Meter> meters;
  DamagedMeshes damaged_meshes = DamagedMeshes::report;
  bool operator==(const Scene&) const = default;
};

/// How many passes a run has where its preset has no stop at all.
inline constexpr int default_passes = 64;

/// The most passes a run may be given: the sums of its films stay exact that long.
inline constexpr int max_passes = 1 << 20;

/// When a run is done: at the first of those given, else after default_passes.
struct Stop {
  /// The errors a run can stop at (measure/metrics.h defines each).
  enum class Metric { lab_mean, lab_rms, mse, rel_mse, rel_l2 };
  std::optional<double> seconds; ///< work only
  std::optional<int> passes;
  std::optional<double> error; ///< against the reference where there is one, else as the run estimates it
  Metric metric = Metric::lab_mean;
  bool operator==(const Stop&) const = default;
};

/// What the picture is measured against. JSON: a string (a picture file) or an object with "type".
struct Reference {
  enum class Type { file, recipe };
  Type type = Type::file;
  std::string file; ///< file: a picture of the run's size, linear sRGB with 1 = white (8-bit files are decoded)
  std::optional<Settings> settings; ///< recipe: the engine's; without: the run's own, made exact
  int passes = 256;                 ///< recipe: for each of its two seeds
  std::uint64_t seed = 1000000007;  ///< recipe: the first of its two seeds; the other is the next
  std::optional<double> seconds;    ///< recipe: refuse to begin where it would take longer
  bool operator==(const Reference&) const = default;
};

/// What a run notes about its error while it works.
struct Measure {
  bool estimate = true;            ///< from two independent halves of every film
  bool perceptual = false;         ///< iw_ssim, flip and hdr_flip against the reference too
  std::optional<std::string> mask; ///< a picture of the run's size
  bool operator==(const Measure&) const = default;
};

/// How linear light becomes the bytes of a display (image/display.h). It changes no light: no picture is computed anew.
struct Display {
  enum class Gamut { oklch, clip };
  enum class Tone { reinhard, filmic, clip };
  enum class WhiteBalance { d65, light };
  Gamut gamut = Gamut::oklch;
  Tone tone = Tone::reinhard;
  WhiteBalance white_balance = WhiteBalance::d65;
  bool operator==(const Display&) const = default;
};

/// A value of a field at a frame.
struct Key {
  int frame = 0;
  std::vector<double> value; ///< as many numbers as the field has
  bool operator==(const Key&) const = default;
};

/// How one field changes over the frames. Before its first key and after its last one it is held.
struct Track {
  enum class Interpolation { linear, smooth };
  std::string path; ///< the field, as for --set: "scene.objects.0.transform.translate"
  Interpolation interpolation = Interpolation::linear;
  std::vector<Key> keys; ///< by rising frame, each frame once
  bool operator==(const Track&) const = default;
};

/// The most frames an animation may have.
inline constexpr int max_frames = 10000;

/// Frames of one scene that changes (animation.h). The preset's own fields are those of frame 0.
struct Animation {
  int frames = 24; ///< frame 0 to frame frames - 1
  double fps = 24; ///< frames a second
  std::vector<Track> tracks;
  bool operator==(const Animation&) const = default;
};

class Origins;

/// Where a preset came from, for messages (origins.h). It changes no picture: any two are equal.
struct Provenance {
  std::shared_ptr<const Origins> origins; ///< who gave each value; null where nothing was read
  std::string run;                        ///< its name as one of a sweep's runs; empty where there is no sweep
  std::string varies;       ///< the part of it that is its own, fit for a folder's name: "threshold_deg=0.1,seed=2"
  std::optional<int> frame; ///< which one of an animation it is (animation.h)
  std::vector<std::string> notes; ///< what a change of the engine left out, a line each (change_engine.h)
  bool operator==(const Provenance&) const { return true; }
};

struct Preset {
  enum class Unit { mm, cm, m };
  std::string name;
  std::string description;
  std::vector<std::string> not_imported; ///< what the file that this was imported from has and this has not
  Unit unit = Unit::m;
  std::uint64_t seed = 1;
  /// The luminance Y (W m^-2 sr^-1, no factor 683) that becomes 1 in the picture; nothing: "auto", which is a number
  /// once a run is ready (run::fitted_white), and 1 before.
  std::optional<double> white;
  Display display;
  Scene scene;
  Settings settings;
  Stop stop;
  std::optional<Reference> reference;
  Measure measure;
  std::optional<Animation> animation;
  bool leave_out = true; ///< false: everything is computed, which takes longer and changes no picture

  std::string source;    ///< the file it came from, for messages and look-ups; not a field of the JSON
  Provenance provenance; ///< not a field of the JSON either
  bool operator==(const Preset&) const = default;
};

/// The length of one unit, in metres.
constexpr double metres(Preset::Unit unit) {
  return unit == Preset::Unit::mm ? 1e-3 : unit == Preset::Unit::cm ? 1e-2 : 1;
}

} // namespace nephroid::preset
