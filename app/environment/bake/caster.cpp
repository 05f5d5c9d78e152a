// SPDX-License-Identifier: Apache-2.0
#define GLM_ENABLE_EXPERIMENTAL
#include "environment/bake/caster.h"

#include "base/error.h"
#include "base/hashed_bytes.h"
#include "base/nearest.h"
#include "scene/bvh.h"
#include "scene/ray.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtx/euler_angles.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>

namespace nephroid::environment {
namespace {

Location objects_location(const std::string& source) { return Location(source) / "environment" / "objects"; }

[[noreturn]] void refuse_name(const preset::Preset& preset, const std::string& name, const Location& where) {
  std::vector<std::string> candidates;
  for (const preset::Object& object : preset.scene.objects)
    if (casts(preset, object) && !object.name.empty()) candidates.push_back(object.name);
  const bool exists =
      std::ranges::any_of(preset.scene.objects, [&](const preset::Object& o) { return o.name == name; });
  const std::string near = nearest(name, candidates);
  throw bad_input(where,
                  fmt::format("'{}' is {}", name, exists ? "neither of glass nor a mirror" : "no object of the scene"),
                  candidates.empty() ? "expected an object of glass or a mirror with a name"
                                     : fmt::format("expected one of {}", fmt::join(candidates, ", ")),
                  near.empty() ? "" : fmt::format("did you mean '{}'?", near));
}

std::size_t index_of(const preset::Preset& preset, const std::string& name, const Location& where) {
  const auto& objects = preset.scene.objects;
  const auto found = std::ranges::find_if(
      objects, [&](const preset::Object& o) { return !name.empty() && o.name == name && casts(preset, o); });
  if (found == objects.end()) refuse_name(preset, name, where);
  return static_cast<std::size_t>(found - objects.begin());
}

/// The value without rounding errors and -0, so that objects turned and moved together keep their bits.
double rounded(double value) { return std::round(value * 1e9) * 1e-9 + 0.0; }

/// An object's transform in the frame of the first: rotation R and translation T become R1^-1 R and R1^-1 (T - T1).
preset::Transform in_frame(const preset::Transform& object, const preset::Transform& first) {
  const glm::dmat3 back = glm::transpose(scene::rotation(first.rotate_deg));
  const auto vector = [](const preset::Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
  const glm::dvec3 translate = back * (vector(object.translate) - vector(first.translate));
  glm::dmat3 turn = back * scene::rotation(object.rotate_deg);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) turn[column][row] = rounded(turn[column][row]);
  // Turns are about x, then y, then z. So the matrix is Z Y X, and glm names the angles in this product's order.
  glm::dvec3 angles(0);
  glm::extractEulerAngleZYX(glm::dmat4(turn), angles.z, angles.y, angles.x);
  preset::Transform result = object;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<glm::length_t>(k);
    result.rotate_deg[k] = rounded(angles[axis] * 180 / std::numbers::pi);
    result.translate[k] = rounded(translate[axis]);
  }
  return result;
}

/// A preset of these objects alone. Photons have the wavelengths of D65; white_light() gives the weight of each.
preset::Preset alone(const preset::Preset& preset, const std::vector<std::size_t>& objects) {
  preset::Preset alone;
  alone.source = preset.source;
  alone.unit = preset.unit;
  alone.scene.damaged_meshes = preset.scene.damaged_meshes;
  for (const std::size_t index : objects) {
    preset::Object object = preset.scene.objects[index];
    object.transform = in_frame(object.transform, preset.scene.objects[objects.front()].transform);
    alone.scene.materials[object.material] = preset.scene.materials.at(object.material);
    alone.scene.objects.push_back(object);
  }
  preset::Light sun;
  sun.type = preset::Light::Type::directional;
  alone.scene.lights = {sun};
  return alone;
}

std::string name_of(const preset::Preset& preset, const std::vector<std::size_t>& objects) {
  std::vector<std::string> names;
  for (const std::size_t index : objects) {
    const std::string& name = preset.scene.objects[index].name;
    names.push_back(name.empty() ? fmt::format("object {}", index) : fmt::format("object '{}'", name));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

template <class T>
std::uint64_t hash_items(const T& items, std::uint64_t hash) {
  using Item = std::remove_cvref_t<decltype(items[0])>;
  static_assert(std::is_standard_layout_v<Item>);
  return hash_of({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)}, hash);
}

std::uint64_t hash_texture(const scatter::Texture& t, std::uint64_t hash) {
  hash = hash_of(fmt::format("{} {} {} {} {} {} {} {} {} {}", t.width, t.height, static_cast<int>(t.wrap), t.nearest,
                             t.linear[0].x, t.linear[0].y, t.linear[1].x, t.linear[1].y, t.offset.x, t.offset.y),
                 hash);
  return hash_items(*t.rgb, hash);
}

/// The point of a triangle nearest to the origin: in its plane where the foot lies inside, else on an edge.
glm::dvec3 nearest_point(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const auto beyond = [&](const glm::dvec3& p, const glm::dvec3& q) {
    return glm::dot(glm::cross(q - p, -p), normal) < 0;
  };
  if (glm::dot(normal, normal) > 0 && !beyond(a, b) && !beyond(b, c) && !beyond(c, a))
    return glm::dot(a, normal) / glm::dot(normal, normal) * normal;
  const auto nearest_on_edge = [](const glm::dvec3& p, const glm::dvec3& q) {
    const glm::dvec3 way = q - p;
    const double length2 = glm::dot(way, way),
                 along = length2 > 0 ? std::clamp(-glm::dot(p, way) / length2, 0.0, 1.0) : 0;
    return p + along * way;
  };
  const auto nearer = [](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(q, q) < glm::dot(p, p) ? q : p; };
  return nearer(nearer(nearest_on_edge(a, b), nearest_on_edge(b, c)), nearest_on_edge(c, a));
}

struct Piece {
  double nearest = 0; ///< no point of it is nearer to the middle
  std::uint32_t object = 0, primitive = 0;
};

std::array<glm::dvec3, 3> corners(const scene::Scene& scene, std::uint32_t triangle) {
  const glm::uvec3& t = scene.geometry.triangles[triangle];
  return {scene.geometry.positions[t.x], scene.geometry.positions[t.y], scene.geometry.positions[t.z]};
}

/// The middle in coordinates in which the ellipsoid is the unit sphere.
glm::dvec3 middle_from(const scene::Ellipsoid& ellipsoid) {
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::dvec3 way = -glm::dvec3(ellipsoid.centre);
  return {glm::dot(rows[0], way), glm::dot(rows[1], way), glm::dot(rows[2], way)};
}

/// A lower bound: a point |u| - 1 off the unit sphere is at least so many shortest half axes off the ellipsoid.
double nearest_of(const scene::Ellipsoid& ellipsoid) {
  return scene::shortest_half_axis(ellipsoid) * std::abs(glm::length(middle_from(ellipsoid)) - 1);
}

/// Points of the ellipsoid, the one towards the middle first.
std::vector<glm::dvec3> points_of(const scene::Ellipsoid& ellipsoid) {
  constexpr int count = 256;
  std::vector<glm::dvec3> points;
  const auto add = [&](const glm::dvec3& unit) {
    glm::dvec3 point = ellipsoid.centre;
    for (int k = 0; k < 3; ++k) point += unit[k] * glm::dvec3(ellipsoid.half_axes[static_cast<std::size_t>(k)]);
    points.push_back(point);
  };
  const glm::dvec3 middle = middle_from(ellipsoid);
  if (middle != glm::dvec3(0)) add(glm::normalize(middle));
  for (int i = 0; i < count; ++i) add(scene::even_direction(i, count));
  return points;
}

/// Some points of the piece, the one nearest to the middle first.
std::vector<glm::dvec3> points_of(const scene::Scene& scene, const Piece& piece) {
  const std::size_t triangles = scene.geometry.triangles.size();
  if (piece.primitive >= triangles) return points_of(scene.geometry.ellipsoids[piece.primitive - triangles]);
  const auto [a, b, c] = corners(scene, piece.primitive);
  return {nearest_point(a, b, c), a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0};
}

/// Whether a closed object encloses p: a ray from there meets its surface an odd number of times.
bool encloses(const scene::Scene& scene, const scene::Bvh& bvh, std::size_t object, const glm::dvec3& p) {
  if (glm::distance(p, glm::dvec3(scene.objects[object].bounds.centre)) > scene.objects[object].bounds.radius)
    return false;
  static const glm::dvec3 direction =
      glm::normalize(glm::dvec3(0.4713, 0.7921, -0.3877)); // not along an edge that people draw
  const scene::CountsPrimitive of_object = [&](std::uint32_t primitive) {
    return scene.object_of_primitive[primitive] == object;
  };
  bool inside = false;
  glm::dvec3 from = p;
  std::uint32_t leaves = scene::no_primitive;
  while (const std::optional<scene::RayHit> hit =
             closest_hit(bvh, from, direction, of_object, std::numeric_limits<double>::infinity(), leaves)) {
    inside = !inside;
    from += hit->t * direction;
    leaves = hit->primitive;
  }
  return inside;
}

/// The least distance of pieces that are not inside other glass; of all pieces where every one is.
double nearest_outside(const scene::Scene& scene, std::vector<Piece> pieces) {
  if (scene.objects.size() == 1) return std::ranges::min(pieces, {}, &Piece::nearest).nearest;
  std::ranges::sort(pieces, {}, &Piece::nearest);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const auto is_buried = [&](const glm::dvec3& p, std::size_t object) {
    for (std::size_t other = 0; other < scene.objects.size(); ++other)
      if (other != object && scene.objects[other].closed && is_body(material_of(scene, scene.objects[other])) &&
          encloses(scene, bvh, other, p))
        return true;
    return false;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces) {
    if (piece.nearest >= nearest) break;
    const std::vector<glm::dvec3> points = points_of(scene, piece);
    if (!is_buried(points.front(), piece.object)) return piece.nearest;
    for (const glm::dvec3& point : points)
      if (glm::length(point) < nearest && !is_buried(point, piece.object)) nearest = glm::length(point);
  }
  return std::isinf(nearest) ? pieces.front().nearest : nearest;
}

} // namespace

bool casts(const preset::Preset& preset, const preset::Object& object) {
  const auto material = preset.scene.materials.find(object.material);
  return material != preset.scene.materials.end() && !is_matt(material->second.type);
}

std::vector<std::size_t> caster_objects(const preset::Preset& preset) {
  const std::vector<std::string>& wanted = settings(preset).objects;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Location where = objects_location(preset.source) / i;
    const std::size_t index = index_of(preset, wanted[i], where);
    if (std::ranges::count(found, index))
      throw bad_input(where, fmt::format("'{}' is named twice", wanted[i]), "expected each name once");
    found.push_back(index);
  }
  if (wanted.empty())
    for (std::size_t i = 0; i < preset.scene.objects.size(); ++i)
      if (casts(preset, preset.scene.objects[i])) found.push_back(i);
  if (found.empty())
    throw bad_input(objects_location(preset.source),
                    "no object of the scene is of glass or a mirror, so there are no caustics",
                    "expected such an object", "add one, or give an object another material");
  std::ranges::sort(found);
  return found;
}

Caster make_caster(const preset::Preset& preset) {
  Caster caster;
  caster.objects = caster_objects(preset);
  caster.name = name_of(preset, caster.objects);
  caster.scene = scene::load_scene(alone(preset, caster.objects));
  scene::Bounds box;
  for (std::size_t i = 0; i < caster.objects.size(); ++i) {
    const scene::Object& object = caster.scene.objects[i];
    if (is_empty(object))
      throw bad_input(Location(preset.source) / "scene" / "objects" / caster.objects[i], "has no surface",
                      "expected one to bake");
    box = enclosing(box, bounds_of(caster.scene, object));
  }
  const glm::dvec3 sides = box.high - box.low;
  caster.size = std::max({sides.x, sides.y, sides.z});
  caster.extent = extent_of(caster.scene);
  return caster;
}

std::vector<BakedShape> baked_shapes(const preset::Preset& preset) {
  constexpr std::size_t most = 8;
  const int steps = settings(preset).weight_steps;
  std::vector<BakedShape> shapes{{preset}};
  if (steps == 0) return shapes;
  for (const std::size_t object : caster_objects(preset))
    for (std::size_t state = 0; state < preset.scene.objects[object].states.size(); ++state) {
      const double place = preset.scene.objects[object].states[state].weight * steps, lower = std::floor(place + 1e-9),
                   part = place - lower;
      if (part < 1e-9) continue;
      if (shapes.size() == most)
        throw bad_input(Location(preset.source) / "environment" / "weight_steps",
                        fmt::format("is {}, and more than 3 states have weights between such steps", steps),
                        fmt::format("expected at most {} shapes to bake, two for each such weight, multiplied", most),
                        "put weights on steps; or choose a weight_steps of 0, and each weight has a bake of its own");
      std::vector<BakedShape> corners;
      for (const BakedShape& shape : shapes)
        for (const bool up : {false, true}) {
          BakedShape& corner = corners.emplace_back(shape);
          corner.preset.scene.objects[object].states[state].weight = (lower + (up ? 1 : 0)) / steps;
          corner.weight *= up ? part : 1 - part;
        }
      shapes = std::move(corners);
    }
  return shapes;
}

bool mixes_alike(const preset::Preset& a, const preset::Preset& b) {
  try {
    return std::ranges::equal(baked_shapes(a), baked_shapes(b), {}, &BakedShape::preset, &BakedShape::preset);
  } catch (const Error&) {
    return false; // whoever begins with it says why
  }
}

std::vector<double> sphere_radii(const Settings& settings, const Caster& caster, const std::string& source) {
  const double largest = settings.reach * caster.size,
               smallest = std::max(1.001 * caster.extent.nearest, 0.05 * caster.size);
  if (largest < 1.001 * caster.extent.farthest)
    throw bad_input(
        Location(source) / "environment" / "reach",
        fmt::format("is {}: a sphere of radius {:.4g} does not enclose {}, which reaches {:.4g} from its middle",
                    settings.reach, largest, caster.name, caster.extent.farthest),
        fmt::format("expected at least {:.3g}", std::ceil(1001 * caster.extent.farthest / caster.size) / 1000));
  std::vector<double> radii;
  for (int i = 0; i < settings.spheres; ++i) {
    const double part = static_cast<double>(i) / (settings.spheres - 1);
    radii.push_back(smallest +
                    (largest - smallest) * (settings.radii == Settings::Radii::quadratic ? part * part : part));
  }
  return radii;
}

std::uint64_t bake_key(const preset::Preset& preset, const Caster& caster) {
  const Settings& s = settings(preset);
  std::uint64_t hash =
      hash_of(fmt::format("{} {} {} {} {} {} {} {} {}", s.directions, s.spheres, static_cast<int>(s.radii), s.reach,
                          s.resolution, s.photons, preset.seed, preset.leave_out, caster.scene.metres_per_unit));
  const scene::Mesh& mesh = caster.scene.geometry;
  hash = hash_items(mesh.positions, hash);
  hash = hash_items(mesh.triangles, hash);
  for (const scene::Ellipsoid& e : mesh.ellipsoids) {
    hash = hash_items(e.half_axes, hash);
    hash = hash_of(fmt::format("{} {} {} {}", e.centre.x, e.centre.y, e.centre.z, e.inwards), hash);
  }
  if (std::ranges::any_of(caster.scene.objects, &scene::Object::smooth)) hash = hash_items(mesh.normals, hash);
  for (const scene::Object& object : caster.scene.objects) {
    const scatter::Material& material = material_of(caster.scene, object);
    // Only the order of priorities matters.
    const auto rank = std::ranges::count_if(caster.scene.objects,
                                            [&](const scene::Object& o) { return o.priority < object.priority; });
    hash = hash_of(fmt::format("{} {} {} {} {} {} {} {} {} {}", object.triangle_count, object.ellipsoid_count,
                               static_cast<int>(material.type), object.smooth, material.absorbs, rank, material.thin,
                               material.coating_nm, material.alpha, material.coat_n),
                   hash);
    for (const optics::Spectrum* spectrum :
         {&material.n, &material.k, &material.reflectance, &material.tint, &material.coating_n})
      hash = hash_items(*spectrum, hash);
    hash = hash_items(material.by_angle, hash);
    if (material.texture) hash = hash_texture(*material.texture, hash_of("texture", hash));
    if (material.roughness_texture) hash = hash_texture(*material.roughness_texture, hash_of("roughness", hash));
  }
  return mesh.texcoords.empty() ? hash : hash_items(mesh.texcoords, hash);
}

// A point that the object has at p without its rotation R and its translation T is at R p + T in the preset.
Placement placement(const preset::Preset& preset, const Caster& caster, const scene::Scene& scene) {
  const preset::Transform& transform = preset.scene.objects.at(caster.objects.front()).transform;
  const glm::dmat3 turn = scene::rotation(transform.rotate_deg);
  const glm::dvec3 translate(transform.translate[0], transform.translate[1], transform.translate[2]);
  return {turn, turn * caster.scene.origin + translate - scene.origin};
}

Extent extent_of(const scene::Scene& scene) {
  Extent extent{.middle_inside = false};
  std::vector<Piece> pieces;
  const auto triangles = static_cast<std::uint32_t>(scene.geometry.triangles.size());
  for (std::uint32_t i = 0; i < scene.object_of_primitive.size(); ++i) {
    Piece piece{0, scene.object_of_primitive[i], i};
    if (i < triangles) {
      const auto [a, b, c] = corners(scene, i);
      piece.nearest = glm::length(nearest_point(a, b, c));
      extent.farthest = std::max({extent.farthest, glm::length(a), glm::length(b), glm::length(c)});
    } else {
      const scene::Ellipsoid& ellipsoid = scene.geometry.ellipsoids[i - triangles];
      piece.nearest = nearest_of(ellipsoid);
      extent.farthest =
          std::max(extent.farthest, glm::length(glm::dvec3(ellipsoid.centre)) + scene::longest_half_axis(ellipsoid));
      extent.middle_inside = extent.middle_inside || contains(ellipsoid, glm::dvec3(0));
    }
    pieces.push_back(piece);
  }
  for (const scene::Object& object : scene.objects)
    if (scene::winding_number(scene.geometry, object.first_triangle, object.triangle_count, glm::dvec3(0)) > 0.5)
      extent.middle_inside = true;
  extent.nearest = nearest_outside(scene, std::move(pieces));
  return extent;
}

} // namespace nephroid::environment
