// SPDX-License-Identifier: Apache-2.0
// For work on pictures on the host: the surface in the middle of a pixel, where a ray from the camera ends, through
// glass and by way of mirrors (kernels/transport/eye_path.h does so for pictures); and the pixels that may show glass
// or a mirror.
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace nephroid::photons {

struct PixelSurfaces {
  struct Surface {
    glm::vec3 position{0}, normal{0}; ///< scene units; unit vector, the triangle's
    int object = -1;                  ///< -1: the ray meets none
    std::uint32_t primitive = 0;      ///< as in Scene::object_of_primitive
  };
  Surface first;     ///< the first one; glass without a texture that bends nothing does not count
  Surface last;      ///< the diffuse one at the end; `first` where there is none
  glm::vec3 way{0};  ///< unit vector: direction of the ray that meets `last`
  float spacing = 0; ///< distance of neighbouring pixels' places there, across `way`, if glass and mirrors were flat
};

/// camera is the scene's, or one of the same view with other pixels. The ray follows mirrors and glass. Glass refracts
/// it as the middle wavelength, and reflects it where it reflects all light.
PixelSurfaces surfaces_of_pixel(const scene::Scene& scene, const scene::Bvh& bvh, const scene::Camera& camera,
                                int column, int row, int most_surfaces = 32);

/// The pixels, row after row, whose square the outline of a triangle or ellipsoid of glass or of a mirror may touch,
/// whatever stands before it. For a camera inside glass, or with a lens, a shift or parallel rays, all pixels.
std::vector<std::uint32_t> glass_pixels(const scene::Scene& scene);

} // namespace nephroid::photons
