// SPDX-License-Identifier: Apache-2.0
// Which place each pixel of a frame shows, and where in the picture of the frame before that place was.
//
// A place is a primitive and coordinates on it: so it goes with an object that moves, turns or deforms, as long as that
// keeps its primitives.
#pragma once
#include "base/bytes.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::photons {

struct SeenPlace {
  glm::vec3 position{0};       ///< scene units
  float reach = 0;             ///< distance of places there that are a pixel apart
  std::uint32_t primitive = 0; ///< Scene::object_of_primitive
  std::int32_t object = -1;    ///< -1: nothing is seen there
  std::int32_t by_way_of =
      -1; ///< the first object on the way, such as glass; `object` itself where it is seen directly
};

/// A frame as the next one needs it.
struct SeenPlaces {
  scene::Camera camera;
  std::vector<glm::vec3> positions; ///< the scene's vertices
  std::vector<std::uint32_t> object_of_primitive;
  std::vector<scene::Ellipsoid> ellipsoids;
  std::vector<SeenPlace> places; ///< [pixel]

  void serialize(Archive& archive);
};

/// Sends one ray through the middle of every pixel, on every core, through glass and by way of mirrors.
SeenPlaces seen_places(const scene::Scene& scene, const scene::Bvh& bvh);

/// The same of matt surfaces that a camera sees directly; elsewhere nothing is seen. camera: any in the scene. The two
/// sides of an object count as two.
SeenPlaces matt_places(const scene::Scene& scene, const scene::Bvh& bvh, const scene::Camera& camera);

/// Whether a scene has a picture of the same size, and the same objects with as many vertices and primitives, moved or
/// not.
bool has_parts_of(const scene::Scene& scene, const SeenPlaces& before);

/// The pixels of a picture between which a place lies, with weights whose sum is 1; all 0: the picture does not show
/// it.
struct Taps {
  std::array<std::uint32_t, 4> pixels{};
  std::array<float, 4> weights{};
};

/// [pixel] of `now`: where its place is in the picture of `before`, between the pixels there that show the same object
/// near that place. What is seen in glass or mirrors is looked for in the same pixel only. geometry: of `now`, with the
/// parts of `before`.
std::vector<Taps> taps_before(const SeenPlaces& now, const scene::Mesh& geometry, const SeenPlaces& before);

/// A picture of the frame before, [pixel][3], as the frame now sees it; NaN where it does not show the place.
std::vector<float> moved(const std::vector<float>& picture, const std::vector<Taps>& taps);

} // namespace nephroid::photons
