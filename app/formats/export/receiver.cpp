// SPDX-License-Identifier: Apache-2.0
// A pinhole camera that looks straight at a plane shows all of it at one scale, and a white surface of irradiance E the
// radiance E / pi. So the map is the picture of such a camera, for which nothing stands before the receiver
// (scene::Camera::receiver).
#include "formats/export/export.h"

#include "optics/spectrum.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::formats {
namespace {

constexpr double distance = 2; ///< from the camera to the receiver, over the receiver's longer edge

/// The smallest rectangle along an edge of the first triangle: what is a rectangle has itself.
Receiver rectangle(const scene::Scene& scene, int index, const scene::Plane& plane) {
  const scene::Object& object = scene.objects[static_cast<std::size_t>(index)];
  Receiver receiver;
  receiver.object = index;
  receiver.is_front = plane.height({0, 0, 0}) >= 0; // where the glass and mirrors are: Scene::origin
  const glm::dvec3 normal = receiver.is_front ? plane.normal : -plane.normal;
  const glm::uvec3 first = scene::triangles_of(scene, object).front();
  double least = std::numeric_limits<double>::max();
  for (int edge = 0; edge < 3; ++edge) {
    const auto corner = [&](int i) { return glm::dvec3(scene.geometry.positions[first[i % 3]]); };
    const glm::dvec3 right = glm::normalize(corner(edge + 1) - corner(edge)), up = glm::cross(normal, right);
    scene::Bounds bounds;
    scene::for_each_corner(scene, object, [&](const glm::dvec3& p) {
      const glm::dvec3 place(glm::dot(p, right), glm::dot(p, up), 0);
      bounds = scene::enclosing(bounds, {place, place});
    });
    const glm::dvec3 size = bounds.high - bounds.low, middle = 0.5 * (bounds.low + bounds.high);
    if (size.x * size.y >= least * (1 - 1e-6)) continue;
    least = size.x * size.y;
    receiver.right = right;
    receiver.up = up;
    receiver.width = size.x;
    receiver.height = size.y;
    receiver.centre = middle.x * right + middle.y * up + glm::dot(plane.point, normal) * normal;
  }
  return receiver;
}

} // namespace

std::vector<Receiver> receivers_of(const scene::Scene& scene) {
  std::vector<Receiver> receivers;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (is_matt(material_of(scene, scene.objects[i]).type))
      if (const auto plane = scene::plane_of(scene, scene.objects[i]))
        receivers.push_back(rectangle(scene, static_cast<int>(i), *plane));
  return receivers;
}

scene::Scene irradiance_view(scene::Scene scene, const Receiver& receiver, int longest) {
  scatter::Material white;
  white.reflectance = optics::constant_spectrum(1);
  scene.objects[static_cast<std::size_t>(receiver.object)].material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(white);

  const double longer = std::max(receiver.width, receiver.height), away = distance * longer;
  const auto pixels = [&](double edge) { return std::max(1, static_cast<int>(std::lround(longest * edge / longer))); };
  scene::Camera camera;
  camera.position = receiver.centre + away * receiver.normal();
  camera.right = receiver.right;
  camera.up = receiver.up;
  camera.forward = -receiver.normal();
  camera.tan_x = receiver.width / 2 / away;
  camera.tan_y = receiver.height / 2 / away;
  camera.width = pixels(receiver.width);
  camera.height = pixels(receiver.height);
  camera.receiver = receiver.object;
  scene.camera = camera;
  return scene;
}

} // namespace nephroid::formats
