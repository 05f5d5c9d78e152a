// SPDX-License-Identifier: Apache-2.0
// Vectors are checked, in double, then rounded once.
#include "scene/scene.h"

#include "base/error.h"
#include "image/image.h"
#include "optics/colour.h"
#include "scatter/spectra.h"
#include "scene/object_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::scene {
namespace {

/// The unit vector along v. Throws bad_input at where: no length, not finite.
glm::dvec3 unit_direction(const glm::dvec3& v, const Location& where) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (!finite || largest == 0)
    throw bad_input(where, fmt::format("({:g}, {:g}, {:g}) has no direction", v.x, v.y, v.z), "a vector with a length");
  return glm::normalize(v / largest); // so that no square overflows or vanishes
}

/// The part of up that is perpendicular to the unit vector forward, made unit. Throws bad_input at where: parallel, no
/// length.
glm::dvec3 perpendicular_up(const preset::Vec3& up, const glm::dvec3& forward, const Location& where) {
  const glm::dvec3 unit_up = unit_direction(to_dvec3(up), where);
  const glm::dvec3 rest = unit_up - glm::dot(unit_up, forward) * forward;
  if (!(glm::length(rest) > 1e-6))
    throw bad_input(where,
                    fmt::format("({:g}, {:g}, {:g}) is parallel to the view or light direction", up[0], up[1], up[2]),
                    "another direction", "turn it away");
  return glm::normalize(rest);
}

/// A preset's position in the scene's coordinates. Throws bad_input at where: not finite, too far from the objects.
glm::dvec3 local_position(const preset::Vec3& position, const Scene& scene, const Location& where) {
  const glm::dvec3 local = to_dvec3(position) - scene.origin;
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(local[axis]) <= max_coordinate))
      throw bad_input(where, fmt::format("({:g}, {:g}, {:g}) is too far away", position[0], position[1], position[2]),
                      fmt::format("at most {:g} units from the refracting and mirroring objects", max_coordinate),
                      "choose a larger unit");
  return local;
}

/// What is not seen from one point may not begin in glass: which rays do would not be known. Throws bad_input there.
void refuse_glass_about(const Camera& camera, const Scene& scene, const Location& where) {
  const glm::dvec3 eye = camera.position;
  const double across = camera.lens_radius + (camera.orthographic ? camera.tan_x : 0),
               upwards = camera.lens_radius + (camera.orthographic ? camera.tan_y : 0);
  for (const Object& object : scene.objects) {
    if (!is_refractive(material_of(scene, object).type) || is_empty(object)) continue;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for_each_corner(scene, object, [&](const glm::dvec3& p) {
      const glm::dvec3 way = p - eye;
      const glm::dvec3 seen(glm::dot(way, glm::dvec3(camera.right)), glm::dot(way, glm::dvec3(camera.up)),
                            glm::dot(way, glm::dvec3(camera.forward)));
      low = glm::min(low, seen);
      high = glm::max(high, seen);
    });
    if (low.z <= 0 && high.z >= 0 && low.x <= across && high.x >= -across && low.y <= upwards && high.y >= -upwards)
      throw bad_input(where / (camera.orthographic ? "projection" : "aperture"),
                      fmt::format("the camera's {} may touch the glass of object '{}'",
                                  camera.orthographic ? "picture plane" : "lens", object.name),
                      "expected one in front of all glass", "move the camera away from the target");
  }
}

/// What an earlier light has of the same file; null: none has.
std::shared_ptr<const Photometry> shared_photometry(const Scene& scene, const std::filesystem::path& file) {
  for (const Light& light : scene.lights)
    if (light.photometry && light.photometry->file == file) return light.photometry;
  return nullptr;
}

/// Its luminance. A note of what is clipped goes to warnings.
std::shared_ptr<const LightPicture> load_light_picture(const std::filesystem::path& file,
                                                       std::vector<std::string>& warnings) {
  const image::Image image = scatter::read_texels(file);
  const image::Rgb colours = image::rgb_of(image, file.string());
  LightPicture picture{image.width, image.height, {}};
  double most = 0;
  bool negative = false;
  for (std::size_t i = 0; i < colours.values.size(); i += 3) {
    const double y = optics::linear_srgb_to_xyz({colours.values[i], colours.values[i + 1], colours.values[i + 2]})[1];
    if (!std::isfinite(y))
      throw bad_input(file.string(), fmt::format("texel {} has a value that is not finite", i / 3));
    negative = negative || y < 0;
    picture.luminance.push_back(static_cast<float>(std::max(y, 0.0)));
    most = std::max(most, y);
  }
  if (!(most > 0)) throw bad_input(file.string(), "is black", "expected a picture that shines somewhere");
  for (const std::string& note : image.notes) warnings.push_back(fmt::format("{}: {}", file.filename().string(), note));
  if (!colours.grey)
    warnings.push_back(fmt::format("{}: as a lamp it shines by its luminance, in the light's spectrum, without colours",
                                   file.filename().string()));
  if (negative) warnings.push_back(fmt::format("{}: negative luminance is taken as black", file.filename().string()));
  return std::make_shared<const LightPicture>(std::move(picture));
}

/// The light of a surface. where: the name of the object, which there is. Throws bad_input there for one that has no
/// surface, or more triangles than a table of chances can tell.
void set_mesh(const preset::Light& light, const Scene& scene, const Location& where, Light& result) {
  constexpr std::uint32_t most_triangles = 1U << 22;
  const auto object = std::ranges::find(scene.objects, light.object, &Object::name);
  if (object == scene.objects.end() || is_empty(*object))
    throw bad_input(where, fmt::format("object '{}' has no surface that could shine", light.object));
  if (object->triangle_count + object->ellipsoid_count > most_triangles)
    throw bad_input(where, fmt::format("object '{}' has {} triangles", light.object, object->triangle_count),
                    fmt::format("expected at most {} of one that shines", most_triangles), "make it coarser");
  result.object = static_cast<int>(object - scene.objects.begin());
  result.power_w = light.power_w;
  result.position = object->bounds.centre;
  result.inside = dielectrics_around(scene, places_of_mesh(scene, *object).front());
  std::erase(result.inside, result.object); // it shines to its outside
}

} // namespace

Camera make_camera(const preset::Camera& camera, const Scene& scene) {
  const Location where = Location(scene.source) / "scene" / "camera";
  const auto [width, height] = camera.resolution;
  Camera result;
  const glm::dvec3 position = local_position(camera.position, scene, where / "position");
  const glm::dvec3 target = to_dvec3(camera.target) - scene.origin;
  const glm::dvec3 forward = unit_direction(target - position, where / "target");
  const glm::dvec3 up = perpendicular_up(camera.up, forward, where / "up");
  result.position = position;
  result.forward = forward;
  result.up = up;
  result.right = glm::cross(forward, up);
  result.tan_y = std::tan(camera.fov_deg / 2 * std::numbers::pi / 180);
  result.tan_x = result.tan_y * width / height;
  result.width = width;
  result.height = height;
  result.orthographic = camera.projection == preset::Camera::Projection::orthographic;
  if (result.orthographic) {
    result.tan_y = preset::height_at_target(camera) / 2;
    result.tan_x = result.tan_y * width / height;
  }
  const glm::dvec2 shift(2 * camera.shift[0] * result.tan_x, 2 * camera.shift[1] * result.tan_y);
  if (result.orthographic)
    result.position = position + shift.x * glm::dvec3(result.right) + shift.y * up;
  else
    result.shift = shift;
  result.lens_radius = camera.aperture / 2;
  result.focus = camera.focus_distance.value_or(preset::target_distance(camera));
  if (result.orthographic || result.lens_radius > 0)
    refuse_glass_about(result, scene, where);
  else
    result.inside = dielectrics_around(scene, position);
  return result;
}

std::vector<glm::dvec3> places_of_mesh(const Scene& scene, const Object& object) {
  std::vector<glm::dvec3> places;
  const std::span<const glm::uvec3> triangles = triangles_of(scene, object);
  const std::size_t step = triangles.size() / 64 + 1;
  for (std::size_t i = 0; i < triangles.size(); i += step) {
    const auto corner = [&](int c) { return glm::dvec3(scene.geometry.positions[triangles[i][c]]); };
    const glm::dvec3 a = corner(0), across = glm::cross(corner(1) - a, corner(2) - a);
    const double length = glm::length(across); // twice the area
    places.push_back((a + corner(1) + corner(2)) / 3.0 + 1e-3 / std::sqrt(length) * across);
  }
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object))
    for (const double side : {1.001, -1.001})
      for (const glm::vec3& half_axis : ellipsoid.half_axes)
        places.push_back(glm::dvec3(ellipsoid.centre) + side * glm::dvec3(half_axis));
  return places;
}

Light make_light(const preset::Light& light, const Scene& scene, const FileFinder& finder, const Location& where,
                 std::vector<std::string>& warnings) {
  using Type = preset::Light::Type;
  Light result;
  result.type = light.type;
  result.spectrum = scatter::make_light_spectrum(light.spectrum, where / "spectrum");
  if (light.type == Type::mesh) {
    set_mesh(light, scene, where / "object", result);
    return result;
  }
  if (light.photometry) {
    const std::filesystem::path file = finder.find(*light.photometry, where / "photometry");
    result.photometry = shared_photometry(scene, file);
    if (!result.photometry) result.photometry = std::make_shared<const Photometry>(load_photometry(file));
    result.direction = unit_direction(to_dvec3(light.direction), where / "direction");
    result.edge_u = perpendicular_up(light.up, result.direction, where / "up");
    result.edge_v = glm::cross(result.edge_u, result.direction); // counterclockwise from C = 0, seen from behind
  }
  if (light.picture) result.picture = load_light_picture(finder.find(*light.picture, where / "picture"), warnings);
  if (light.type != Type::point) {
    const glm::dvec3 direction = unit_direction(to_dvec3(light.direction), where / "direction");
    result.direction = direction;
    if (light.type == Type::area) {
      const glm::dvec3 up = perpendicular_up(light.up, direction, where / "up");
      result.edge_u = light.size[0] * glm::cross(up, direction);
      result.edge_v = light.size[1] * up;
    }
  }
  if (light.type == Type::spot) result.cos_half_angle = std::cos(light.half_angle_deg * std::numbers::pi / 180);
  if (light.type == Type::directional) {
    result.irradiance_w_m2 = light.irradiance_w_m2;
    result.one_minus_cos = 2 * std::pow(std::sin(light.angular_diameter_deg / 4 * std::numbers::pi / 180), 2);
    return result; // comes from far away: inside nothing
  }
  result.power_w = light.power_w;
  const glm::dvec3 position = local_position(light.position, scene, where / "position");
  result.position = position;
  result.inside = dielectrics_around(scene, position);
  return result;
}

} // namespace nephroid::scene
