// SPDX-License-Identifier: Apache-2.0
// Which object is under the mouse: a ray through the loaded scene, with objects where the preset has them now.
#pragma once
#include "preset/preset.h"
#include "run/run.h"
#include "scene/scene.h"
#include "ui/view/sight.h"

#include <any>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace nephroid::ui {

/// What the View keeps of a loaded scene (RunInHand::seen).
struct SeenScene {
  std::shared_ptr<const run::LoadedScene> loaded;
  std::vector<preset::Object> objects; ///< as the preset had them when it was loaded
  std::vector<scene::Bounds> boxes;    ///< of each object, before its transform

  /// A std::shared_ptr<const SeenScene>, as RunInHand::seen finds it.
  static std::any look(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded);
};

/// The first object that the ray hits, an index into scene.objects. An object that was moved, turned or scaled since the scene was
/// loaded is found where it is now; one of another shape or mesh, or a new one, is not found before the scene is loaded again.
std::optional<std::size_t> object_at(const SeenScene& seen, const preset::Preset& preset, const Ray& ray);

/// The box about an object before its transform; nothing where the scene that was loaded has another one in its place.
std::optional<scene::Bounds> local_box(const SeenScene* seen, const preset::Preset& preset, std::size_t object);

/// What an object turns about and is scaled from, before its transform: a shape's own middle, or the middle of the box about a mesh, whose
/// origin may lie anywhere.
glm::dvec3 pivot_of(const SeenScene* seen, const preset::Preset& preset, std::size_t object);

} // namespace nephroid::ui
