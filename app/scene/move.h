// SPDX-License-Identifier: Apache-2.0
// Objects that move: to where another preset has them, and apart where they touch.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace nephroid::scene {

/// The scene with objects and camera where another preset has them. loaded: of `before`, from which `now` differs by
/// the turns and translations of objects and by the camera. Scene::origin stays, so places differ from those of
/// load_scene(now) by what single precision leaves. Nothing where objects go so far that another origin is needed:
/// beyond twice the distance that they had. Throws bad_input as make_camera.
std::optional<Scene> move_objects(const Scene& loaded, const preset::Preset& before, const preset::Preset& now);

/// Where two surfaces lie in one place, light would be lost between them. Draws in every dielectric whose bounds end
/// where another object's begin or end, so that a gap of air is left which single precision can tell (some 1e-6 of the
/// larger object's coordinates), and says so in scene.warnings. An ellipsoid that touches in a point is left alone.
/// Nothing is said of copies. first_copies: of the scene's objects; empty: there is none.
void part_touching(Scene& scene, const std::vector<std::size_t>& first_copies = {});

} // namespace nephroid::scene
