// SPDX-License-Identifier: Apache-2.0
// What the middle of a pixel shows: the diffuse surface that a ray from the camera ends at, through glass and by way of
// mirrors. For what is done to a picture on the host; the picture itself is made by kernels/tracing/eye_path.h, which
// follows the same rules at every wavelength and with both branches of each reflection. And which pixels may show glass
// or a mirror at all.
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace nephroid::photons {

struct PixelSurfaces {
  struct Surface {
    glm::vec3 position{0}, normal{0}; ///< scene units; unit, of the triangle
    int object = -1;                  ///< -1: none is met
  };
  Surface first;    ///< glass that bends nothing is not seen
  Surface last;     ///< the diffuse one at the end; where there is none, `first`
  glm::vec3 way{0}; ///< unit: the way on which `last` is looked at
  float spacing =
      0; ///< how far apart neighbouring pixels would be there, across `way`, had glass and mirrors been flat
};

/// camera: the scene's, or one of the same view with other pixels. Mirrors are followed, and so is glass: refracted at
/// the middle of the wavelengths, reflected where all light is.
PixelSurfaces surfaces_of_pixel(const scene::Scene& scene, const scene::Bvh& bvh, const scene::Camera& camera,
                                int column, int row, int most_surfaces = 32);

/// The pixels, row after row, whose square the outline of a triangle or ellipsoid of glass or of a mirror may touch,
/// whatever stands before it; all of them for a camera inside glass. Every path that meets glass or a mirror first is
/// of one of these.
std::vector<std::uint32_t> glass_pixels(const scene::Scene& scene);

} // namespace nephroid::photons
