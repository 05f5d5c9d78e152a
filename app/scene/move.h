// SPDX-License-Identifier: Apache-2.0
// Objects that move in a scene that is loaded already: no file is read and no surface is checked again.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <optional>

namespace nephroid::scene {

/// The scene with objects and camera where another preset has them. loaded: of `before`, from which `now` differs by the turns and
/// translations of objects and by the camera. Scene::origin stays, so places differ from those of load_scene(now) by what single precision
/// leaves; so do those of the gaps between things that touch. Nothing where objects go so far that load_scene would have to choose another
/// origin: beyond twice the distance that they had. Throws bad_input as make_camera.
std::optional<Scene> move_objects(const Scene& loaded, const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::scene
