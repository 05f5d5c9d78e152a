// SPDX-License-Identifier: Apache-2.0
// A pinhole camera that looks straight at a plane shows all of it at one scale, and a white surface of irradiance E the
// radiance E / pi. So the map is the picture of such a camera, for which nothing stands before the receiver
// (scene::Camera::receiver).
#include "formats/export/export.h"

#include "optics/spectrum.h"
#include "scene/meter.h"

#include <algorithm>
#include <cmath>

namespace nephroid::formats {
namespace {

constexpr double distance = 2; ///< from the camera to the receiver, over the receiver's longer edge

Receiver rectangle(const scene::Scene& scene, int index, const scene::Plane& plane) {
  Receiver receiver;
  receiver.object = index;
  receiver.is_front = plane.height({0, 0, 0}) >= 0; // where the glass and mirrors are: Scene::origin
  const scene::Rectangle about = rectangle_about(scene, scene.objects[static_cast<std::size_t>(index)], plane,
                                                 receiver.is_front ? plane.normal : -plane.normal);
  receiver.centre = about.centre;
  receiver.right = about.right;
  receiver.up = about.up;
  receiver.width = about.width;
  receiver.height = about.height;
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
