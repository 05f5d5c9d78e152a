// SPDX-License-Identifier: Apache-2.0
// The camera and the lamps of a preset in the scene.
#pragma once
#include "base/place.h"
#include "scene/scene.h"

namespace nephroid::scene {

/// The camera alone, for a view that changes while everything else stays. Throws bad_input at FILE#/scene/camera/...
Camera make_camera(const preset::Camera& camera, const Scene& scene);

/// where: FILE#/scene/lights/INDEX. Throws bad_input there: no direction, power, size or angle out of range, unknown
/// spectrum.
Light make_light(const preset::Light& light, const Scene& scene, const Place& where);

} // namespace nephroid::scene
