// SPDX-License-Identifier: Apache-2.0
// The preset's camera on the screen, in the preset's coordinates and double precision, without Dear ImGui. It maps
// points to the screen and back to rays, finds the object under a point, and is moved by the mouse.
#pragma once
#include "preset/preset.h"
#include "run/prepare.h"
#include "scene/scene.h"
#include "ui/state/run_in_hand.h"
#include "ui/view/placement.h"

#include <glm/glm.hpp>

namespace nephroid::ui {

inline glm::dvec3 to_vector(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }
inline preset::Vec3 to_stored(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

struct Ray {
  glm::dvec3 origin{0}, direction{0, 0, -1}; ///< the direction has any length except 0
};

/// The map p -> linear p + offset, from an object's own coordinates to the preset's.
struct Affine {
  explicit Affine(const preset::Transform& transform);
  glm::dmat3 linear;
  glm::dvec3 offset;
};

/// A camera through the middle of its lens, as scene::make_camera has it, and the place of its picture.
struct Pinhole {
  glm::dvec3 position{0}, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1}; ///< the last three are orthonormal
  double tan_x = 1, tan_y = 1; ///< tangents of half the fields of view; orthographic: half the picture's edges, units
  double shift_x = 0, shift_y = 0; ///< added to these places, in units of tan_x and tan_y
  bool orthographic = false;
  Point corner{0, 0}, size{1, 1}; ///< the whole picture on the screen

  /// The distance in front of the camera; not above 0 behind it.
  double depth(const glm::dvec3& p) const { return glm::dot(p - position, forward); }
  /// The screen position of a point in front of the camera, perhaps outside of the picture.
  std::optional<Point> to_screen(const glm::dvec3& p) const;
  Ray ray(const Point& screen) const;
};

/// shown: the size in pixels of the picture that `placement` places; it may still differ from the camera's. Nothing for
/// a camera that sees nothing: at its own target, or looking along its up.
std::optional<Pinhole> make_pinhole(const preset::Camera& camera, const Placement& placement,
                                    const std::array<int, 2>& shown);

struct ViewedScene {
  std::shared_ptr<const run::LoadedScene> loaded;
  std::vector<preset::Object> objects; ///< as in the preset when it was loaded
  std::vector<scene::Bounds> boxes;    ///< the box of each object before its transform

  static void take(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded,
                   SceneFacts& facts);
};

/// The first object that the ray hits, an index into scene.objects. An object that was moved, turned or scaled since
/// the scene was loaded is found in its present place. A new object, or one with another shape or mesh, is not found
/// until the scene is loaded again.
std::optional<std::size_t> object_at(const ViewedScene& seen, const preset::Preset& preset, const Ray& ray);

/// The box about an object before its transform; nothing where the loaded scene has another object there.
std::optional<scene::Bounds> local_box(const ViewedScene* seen, const preset::Preset& preset, std::size_t object);

/// What an object turns about and is scaled from, before its transform: a shape's own middle, or the middle of a mesh's
/// box, because a mesh's origin may lie anywhere.
glm::dvec3 pivot_of(const ViewedScene* seen, const preset::Preset& preset, std::size_t object);

/// Moves the camera round its target: right_deg about the camera's up (positive: the camera goes to its right), then
/// up_deg towards up. It stops 1 degree short of looking along up, where left and right would swap.
preset::Camera orbit(const preset::Camera& camera, double right_deg, double up_deg);

/// Multiplies the distance to the target, and an orthographic picture's height; the target stays. factor > 0.
preset::Camera dolly(const preset::Camera& camera, double factor);

/// Shifts position and target together, in parts of the picture's height at the target's distance: what is at the
/// target moves by (right, down) in the picture.
preset::Camera pan(const preset::Camera& camera, double right, double down);

/// The camera as JSON in a preset's scene: {"camera": {...}}.
std::string camera_json(const preset::Preset& preset);
/// The camera as options, quoted for a shell: "--set 'scene.camera.position=[0,0,4]' --set ...", one per field.
std::string camera_settings(const preset::Preset& preset);

} // namespace nephroid::ui
