// SPDX-License-Identifier: Apache-2.0
#include "photons/seen_places.h"

#include "base/parallel.h"
#include "photons/pixel_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::photons {
namespace {

/// A surface that is seen along itself: pixels there are at most so many times farther apart.
constexpr float least_of_way = 0.05f;

/// Where a place of `now` was in the scene before. Triangles are numbered before ellipsoids.
glm::dvec3 position_before(const SeenPlace& place, const SeenPlaces& now, const scene::Mesh& geometry,
                           const SeenPlaces& before) {
  const glm::dvec3 at(place.position);
  if (place.primitive >= geometry.triangles.size()) {
    const std::size_t e = place.primitive - geometry.triangles.size();
    const scene::Ellipsoid &ellipsoid = now.ellipsoids[e], &then = before.ellipsoids[e];
    glm::dvec3 position(then.centre);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const glm::dvec3 half(ellipsoid.half_axes[axis]);
      position +=
          glm::dot(at - glm::dvec3(ellipsoid.centre), half) / glm::dot(half, half) * glm::dvec3(then.half_axes[axis]);
    }
    return position;
  }
  const glm::uvec3 corner = geometry.triangles[place.primitive];
  const glm::dvec3 a(now.positions[corner.x]), b(now.positions[corner.y]), c(now.positions[corner.z]),
      across = glm::cross(b - a, c - a);
  const double area = glm::dot(across, across), u = glm::dot(glm::cross(a - c, at - c), across) / area,
               v = glm::dot(glm::cross(b - a, at - a), across) / area;
  return (1 - u - v) * glm::dvec3(before.positions[corner.x]) + u * glm::dvec3(before.positions[corner.y]) +
         v * glm::dvec3(before.positions[corner.z]);
}

/// The column and row, from the middle of the first pixel. Not finite, or outside of the picture, where the camera does
/// not see the place. Rounded, so that a picture that stands still is taken as it is.
glm::dvec2 pixel_of(const scene::Camera& camera, const glm::dvec3& position) {
  const glm::dvec3 way = position - glm::dvec3(camera.position);
  const double depth = glm::dot(way, glm::dvec3(camera.forward)), scale = camera.orthographic ? 1 : depth;
  if (!(depth > 0)) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  const double x = (glm::dot(way, glm::dvec3(camera.right)) / scale - camera.shift.x) / camera.tan_x,
               y = (glm::dot(way, glm::dvec3(camera.up)) / scale - camera.shift.y) / camera.tan_y;
  constexpr double steps = 256;
  return glm::round(steps * glm::dvec2((x + 1) / 2 * camera.width - 0.5, (1 - y) / 2 * camera.height - 0.5)) / steps;
}

bool shows(const SeenPlace& then, const SeenPlace& now, const glm::dvec3& position) {
  return then.object == now.object && then.by_way_of == now.by_way_of &&
         glm::distance(glm::dvec3(then.position), position) <= 2.0 * then.reach;
}

Taps taps_of(const SeenPlace& place, std::uint32_t pixel, const glm::dvec3& position, const SeenPlaces& before) {
  Taps taps;
  const scene::Camera& camera = before.camera;
  if (place.object != place.by_way_of) {
    if (shows(before.places[pixel], place, position)) taps.pixels[0] = pixel, taps.weights[0] = 1;
    return taps;
  }
  const glm::dvec2 at = pixel_of(camera, position), corner = glm::floor(at);
  if (!(corner.x >= -1 && corner.y >= -1 && corner.x < camera.width && corner.y < camera.height)) return taps;
  double sum = 0;
  std::array<double, 4> weights{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto x = static_cast<int>(corner.x) + static_cast<int>(i % 2),
               y = static_cast<int>(corner.y) + static_cast<int>(i / 2);
    if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
    const auto other = static_cast<std::uint32_t>(y * camera.width + x);
    if (!shows(before.places[other], place, position)) continue;
    taps.pixels[i] = other;
    sum += weights[i] = (1 - std::abs(at.x - x)) * (1 - std::abs(at.y - y));
  }
  if (sum < 0.25) return taps; // the nearest pixel shows something else
  for (std::size_t i = 0; i < 4; ++i) taps.weights[i] = static_cast<float>(weights[i] / sum);
  return taps;
}

} // namespace

void SeenPlaces::serialize(Archive& archive) {
  for (glm::vec3* const way : {&camera.position, &camera.right, &camera.up, &camera.forward})
    archive.items(std::span(way, 1));
  archive.value(camera.tan_x);
  archive.value(camera.tan_y);
  archive.items(std::span(&camera.shift, 1));
  archive.value(camera.orthographic);
  archive.value(camera.width);
  archive.value(camera.height);
  archive.list(positions);
  archive.list(object_of_primitive);
  std::vector<std::array<glm::vec3, 4>> axes; // without the padding of Ellipsoid
  for (const scene::Ellipsoid& e : ellipsoids)
    axes.push_back({e.centre, e.half_axes[0], e.half_axes[1], e.half_axes[2]});
  archive.list(axes);
  ellipsoids.resize(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    ellipsoids[i].centre = axes[i][0], ellipsoids[i].half_axes = {axes[i][1], axes[i][2], axes[i][3]};
  archive.list(places);
}

namespace {

/// way_to: the object of the place that a pixel shows and the first one on the way there, as SeenPlace has them.
template <class WayTo>
SeenPlaces places_of(const scene::Scene& scene, const scene::Bvh& bvh, const scene::Camera& camera, int most_surfaces,
                     const WayTo& way_to) {
  SeenPlaces seen{camera, scene.geometry.positions, scene.object_of_primitive, scene.geometry.ellipsoids,
                  std::vector<SeenPlace>(camera.pixels())};
  if (camera.receiver >= 0) return seen;
  const auto width = static_cast<std::size_t>(camera.width);
  for_ranges(seen.places.size(), width, [&](std::size_t row, Range pixels) {
    for (std::size_t i = pixels.begin; i < pixels.end; ++i) {
      const PixelSurfaces surfaces = surfaces_of_pixel(scene, bvh, camera, static_cast<int>(i - pixels.begin),
                                                       static_cast<int>(row), most_surfaces);
      const float cosine = std::abs(glm::dot(surfaces.last.normal, surfaces.way));
      const auto [object, first] = way_to(surfaces);
      seen.places[i] = {surfaces.last.position, surfaces.spacing / std::max(cosine, least_of_way),
                        surfaces.last.primitive, object, first};
    }
  });
  return seen;
}

} // namespace

SeenPlaces seen_places(const scene::Scene& scene, const scene::Bvh& bvh) {
  return places_of(scene, bvh, scene.camera, 32, [](const PixelSurfaces& surfaces) {
    return std::pair(surfaces.last.object, surfaces.first.object);
  });
}

SeenPlaces matt_places(const scene::Scene& scene, const scene::Bvh& bvh, const scene::Camera& camera) {
  const auto objects = static_cast<int>(scene.objects.size());
  return places_of(scene, bvh, camera, 1, [&](const PixelSurfaces& surfaces) {
    int object = surfaces.first.object;
    if (object < 0 ||
        material_of(scene, scene.objects[static_cast<std::size_t>(object)]).type != preset::Material::Type::diffuse)
      object = -1;
    else if (glm::dot(surfaces.last.normal, surfaces.way) > 0)
      object += objects; // its other side
    return std::pair(object, object);
  });
}

bool has_parts_of(const scene::Scene& scene, const SeenPlaces& before) {
  return scene.camera.width == before.camera.width && scene.camera.height == before.camera.height &&
         scene.geometry.positions.size() == before.positions.size() &&
         scene.geometry.ellipsoids.size() == before.ellipsoids.size() &&
         scene.object_of_primitive == before.object_of_primitive;
}

std::vector<Taps> taps_before(const SeenPlaces& now, const scene::Mesh& geometry, const SeenPlaces& before) {
  std::vector<Taps> taps(now.places.size());
  for_ranges(taps.size(), std::size_t{1} << 12, [&](std::size_t, Range pixels) {
    for (std::size_t i = pixels.begin; i < pixels.end; ++i)
      if (const SeenPlace& place = now.places[i]; place.object >= 0)
        taps[i] = taps_of(place, static_cast<std::uint32_t>(i), position_before(place, now, geometry, before), before);
  });
  return taps;
}

std::vector<float> moved(const std::vector<float>& picture, const std::vector<Taps>& taps) {
  std::vector<float> now(3 * taps.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < taps.size(); ++i)
    for (std::size_t c = 0; c < 3 && taps[i].weights != std::array<float, 4>{}; ++c) {
      float sum = 0;
      for (std::size_t tap = 0; tap < 4; ++tap)
        if (const float weight = taps[i].weights[tap]; weight > 0)
          sum += weight * picture[std::size_t{3} * taps[i].pixels[tap] + c];
      now[3 * i + c] = sum;
    }
  return now;
}

} // namespace nephroid::photons
