// SPDX-License-Identifier: Apache-2.0
// The loaded scene: what a preset's scene section becomes once every file is read and checked. Host side only, no
// OpenCL. Positions are in the preset's unit, moved so that the caustic objects are at the origin (see Scene::origin),
// which keeps single precision good far from the preset's own origin.
#pragma once
#include "base/location.h"
#include "preset/preset.h"
#include "scatter/material.h"
#include "scene/environment.h"
#include "scene/mesh.h"
#include "scene/photometry.h"

#include <limits>
#include <memory>

namespace nephroid::scene {

inline shared::float4 to_float4(const glm::dvec3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

inline glm::dvec3 to_dvec3(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }
inline preset::Vec3 to_vec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// A box along the axes. Without a point in it, as it is made here, low is above high.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
};

Bounds enclosing(const Bounds& a, const Bounds& b);
Bounds bounds_of(const Ellipsoid& ellipsoid);

/// How much light the places of a rectangle send.
struct LightPicture {
  int width = 0, height = 0;
  std::vector<float> luminance; ///< a texel, of any unit, row 0 at the top; not negative, not all 0
};

struct Object {
  std::string name;
  int material = 0; ///< index into Scene::materials
  int priority = 0;
  bool smooth = false;                              ///< interpolate vertex normals
  std::uint32_t first_vertex = 0, vertex_count = 0; ///< of its triangles, and of no other object's
  std::uint32_t first_triangle = 0, triangle_count = 0;
  std::uint32_t first_ellipsoid = 0, ellipsoid_count = 0;
  Sphere bounds;                     ///< encloses all of it
  bool closed = true;                ///< every edge is shared by exactly two triangles of opposite direction
  std::uint32_t first_texcoords = 0; ///< with pictures: its first triangle's in Mesh::texcoords
};

struct Light {
  preset::Light::Type type = preset::Light::Type::point;
  glm::vec3 position{0};
  glm::vec3 direction{0, -1, 0};  ///< unit, the way the light goes
  glm::vec3 edge_u{0}, edge_v{0}; ///< area: the full edges; edge_u x edge_v points along direction. photometry: unit,
                                  ///< the ways to C = 0 and C = 90 degrees
  double cos_half_angle = -1;     ///< spot
  double power_w = 0;             ///< all but directional
  double irradiance_w_m2 = 0;     ///< directional
  double one_minus_cos = 0;       ///< directional: of half its disc's angle; 0: a point
  optics::Spectrum spectrum{};    ///< sums to 1
  std::vector<int> inside;        ///< dielectric objects that contain it, outermost first
  /// The environment's three parts. It is directional light of many directions and colours (environment.h): what a
  /// photon's red, green and blue part each carry at every wavelength; `spectrum` is what photons are allocated by.
  /// Empty for a lamp.
  std::vector<optics::Spectrum> primaries;
  std::shared_ptr<const Photometry> photometry; ///< point: its intensity by direction; null: even
  std::shared_ptr<const LightPicture> picture;  ///< area: its emission by place; null: even
  int object = -1;                              ///< mesh: index into Scene::objects

  bool operator==(const Light&) const = default;
};

/// W, or of directional light W m^-2: what its type does not have is 0.
inline double radiometric(const Light& light) { return light.power_w + light.irradiance_w_m2; }

/// Whether directional light comes from more than a point.
inline bool has_disc(const Light& light) { return light.one_minus_cos > 0; }

inline bool is_environment(const Light& light) { return !light.primaries.empty(); }

struct MeterSurface;

/// right, up, forward: orthonormal. With a = (2 (x + .5) / width - 1) tan_x, b = (1 - 2 (y + .5) / height) tan_y a
/// pixel centre (x, y) looks along forward + (a + shift.x) right + (b + shift.y) up. An orthographic one looks along
/// forward, from position + a right + b up. A lens is the disc of lens_radius about that, across forward; the whole
/// disc sees the same place at the depth `focus`.
struct Camera {
  glm::vec3 position{0}, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  double tan_x = 1, tan_y = 1;       ///< orthographic: half the picture's width and height, units
  glm::dvec2 shift{0};               ///< 0 where it is orthographic: position has it
  double lens_radius = 0, focus = 1; ///< units
  bool orthographic = false;
  int width = 0, height = 0;
  std::vector<int> inside; ///< dielectric objects that contain it, outermost first
  int receiver = -1;       ///< an object whose light alone is seen, through whatever is before it (formats/export)
  std::shared_ptr<const MeterSurface> meter; ///< its pixels are a meter's cells (meter.h); null: it is an eye

  /// Whether its rays meet in one point, and its axis is in the middle of the picture.
  bool is_plain() const { return !orthographic && lens_radius == 0 && shift == glm::dvec2(0); }
  /// Where the ray of a place of the picture begins, and its way, of any length: through the middle of the lens. x, y:
  /// from -1 to 1, to the right and up.
  std::array<glm::dvec3, 2> ray(double x, double y) const {
    const glm::dvec3 to_right(right), upwards(up), from = orthographic ? glm::dvec3(position) : glm::dvec3(forward),
                                                   to = from + x * tan_x * to_right + y * tan_y * upwards;
    if (orthographic) return {to, glm::dvec3(forward)};
    return {glm::dvec3(position), to + shift.x * to_right + shift.y * upwards};
  }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

struct Scene {
  std::string source; ///< the preset's file, for messages
  double metres_per_unit = 1;
  optics::SpectralRange range = optics::SpectralRange::visible; ///< of all its spectra
  glm::dvec3 origin{0};                                         ///< preset coordinates of the scene's (0, 0, 0)
  Camera camera;
  std::vector<scatter::Material> materials;
  std::vector<Object> objects;
  std::vector<Light> lights; ///< the preset's; after them the sun of a sky, then the environment, where they are
  std::optional<Environment> environment;
  Mesh geometry; ///< every object's triangles, one after the other; normals for every vertex; texcoords of objects
                 ///< with pictures alone
  std::vector<std::uint32_t> object_of_primitive; ///< the triangles', then the ellipsoids'
  std::vector<std::string> warnings; ///< one line each: open meshes, dropped triangles, extrapolated dispersion
};

inline bool is_empty(const Object& object) { return object.triangle_count + object.ellipsoid_count == 0; }

inline const scatter::Material& material_of(const Scene& scene, const Object& object) {
  return scene.materials[static_cast<std::size_t>(object.material)];
}

/// Whether the material of any object is so.
bool any_material(const Scene& scene, bool (*is)(const scatter::Material&));

/// Reads every file and checks every reference. A scene without lights or objects is legal: the plan says what is left
/// out then. Triangles are turned so that a mirroring transform (a negative scale) keeps them outwards; triangles
/// without area and duplicates are dropped with a warning. A dielectric that is inside out, or has holes, is told of in
/// a warning (the former is turned round) or refused, as Scene::damaged_meshes of the preset says. Throws bad_input at
/// FILE#/pointer or at the mesh file, interrupted where `watch` asks for it.
Scene load_scene(const preset::Preset& preset, const Watch& watch = {});

/// Whether a light of the preset has power beyond 380..780 nm, as far as it is known: the sun, glowing bodies, lines
/// and tables. What is known by its colour alone, and an illuminant, is taken to have none.
bool reaches_beyond_visible(const preset::Preset& preset);
/// The scene of the preset in another range: its materials, lights and environment are loaded anew, with the warnings
/// that they give; meshes are not.
Scene in_range(const Scene& scene, const preset::Preset& preset, optics::SpectralRange range);

/// The sun of a sky (sky.h, clear_sky.h): a disc of `sun_angular_diameter_deg`. Nothing where the environment has none,
/// and at night.
std::optional<Light> make_sun(const preset::Environment& environment,
                              optics::SpectralRange range = optics::SpectralRange::visible);

/// Directional light of all directions together: its irradiance is that on a sphere, over the area of the sphere's
/// shadow.
Light make_environment_light(const Environment& environment);

/// The dielectric objects that contain p (scene coordinates), largest volume first: where they are nested, outermost
/// first.
std::vector<int> dielectrics_around(const Scene& scene, const glm::dvec3& p);

/// Throws failed where the scene does not hold them: a scene of materials and objects alone has no geometry.
std::span<const glm::uvec3> triangles_of(const Scene& scene, const Object& object);

/// Throws as triangles_of.
std::span<const Ellipsoid> ellipsoids_of(const Scene& scene, const Object& object);

/// The corners of its triangles. Throws as triangles_of.
std::span<const glm::vec3> vertices_of(const Scene& scene, const Object& object);

/// Calls visit(glm::dvec3) for every vertex, and for the corners of a box about every ellipsoid along its axes: points
/// whose convex hull holds all of the object. In the scene's coordinates. Throws as triangles_of.
template <class Visit>
void for_each_corner(const Scene& scene, const Object& object, const Visit& visit) {
  for (const glm::vec3& p : vertices_of(scene, object)) visit(glm::dvec3(p));
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object))
    for (unsigned i = 0; i < 8; ++i) {
      glm::dvec3 corner = ellipsoid.centre;
      for (unsigned axis = 0; axis < 3; ++axis)
        corner += (i >> axis & 1 ? 1.0 : -1.0) * glm::dvec3(ellipsoid.half_axes[axis]);
      visit(corner);
    }
}

/// The smallest along the axes, in the scene's coordinates. Throws as triangles_of.
Bounds bounds_of(const Scene& scene, const Object& object);

/// The matrix of preset::Transform::rotate_deg: about x, then y, then z, each counter-clockwise seen from the axis'
/// positive end.
glm::dmat3 rotation(const preset::Vec3& rotate_deg);

/// The camera alone, for a view that changes while everything else stays. Throws bad_input at FILE#/scene/camera/...
Camera make_camera(const preset::Camera& camera, const Scene& scene);

/// Adds a light, and warnings of it. scene: with its objects. where: FILE#/scene/lights/INDEX. Throws bad_input there:
/// no direction, power, size or angle out of range, unknown spectrum, an object without a surface; and at a file that
/// is not there or no photometry or picture. app/lights has this and the next one.
void add_light(const preset::Light& light, const FileFinder& finder, const Location& where, Scene& scene);

/// Of what is much fainter than the strongest light.
void warn_of_faint_lights(Scene& scene);

/// The surface of a shape of preset.h, centred by its bounds on the origin, y up, with normals. Flat facets have
/// vertices of their own, so their normals are exact; curved sides share theirs. quad: open, size x by z in the plane y
/// = 0, facing +y. box, plate: size x, y, z. sphere: an exact one, not of triangles. cylinder: about the y axis, flat
/// ends, a sharp rim. prism: stands along y; the apex edge at +z, the third side at -z, facing -z. brilliant: the round
/// brilliant cut, table up: 57 facets and 16 of the girdle. curtain_wall: panes that face +z,
/// whose front is hollow where arc_deg is above 0. Of water and relief nothing: those are in heights.h.
Mesh make_shape(const preset::Shape& shape);

/// The plane of a flat object, in the scene's coordinates.
struct Plane {
  glm::dvec3 point{0};
  glm::dvec3 normal{0}; ///< unit, of the triangles' front
  double tolerance = 0; ///< what rounding the corners to single precision may add to a height
  /// The distance from the plane, in scene units; positive before the front.
  double height(const glm::dvec3& p) const { return glm::dot(p - point, normal); }
};

/// Nothing where the object is not flat. Throws as triangles_of.
std::optional<Plane> plane_of(const Scene& scene, const Object& object);

} // namespace nephroid::scene
