// SPDX-License-Identifier: Apache-2.0
// The light that a stone sends back: shares of a sky's light, by rays from an eye far above (kernels/gems/gem.cl). All
// skies are dark below the horizon, and the zenith is where the eye is. ISO is even; COS falls as the cosine from the
// zenith; HEAD is even, but dark within head_deg of the eye. A light return is the mean radiance over the stone's
// outline, over the zenith's of ISO. Numbers are of the line d.
#pragma once
#include "compute/compute.h"
#include "gems/stone.h"
#include "meters/reading.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace nephroid::gems {

struct LightOptions {
  double head_deg = 20; ///< half angle of the head's shadow, 0 to 90
  int side = 256;       ///< of the pictures, in pixels
  int rays = 100'000;   ///< from the eye, of a view; four times as many where two views are compared
  std::uint64_t seed = 1;
};

/// The three light returns.
struct Returns {
  meters::Interval iso, cosine, head;
};

struct Tilt {
  char axis = 'x'; ///< about which the stone is turned, counter-clockwise seen from the axis' positive end
  double angle_deg = 0;
  Returns returns;
};

/// Of a pixel, row 0 at the top: the picture's right is +x, its lower edge +z.
struct GemPictures {
  int side = 0;
  std::vector<float> outline;           ///< the part of the pixel that shows the stone
  std::vector<float> iso, cosine, head; ///< radiance over the zenith's, times `outline`
  std::vector<float> spread_deg;        ///< mean angle between C and F of its light; 0 where it has none
  std::vector<float> xyz;               ///< three a pixel, under the head's sky of D65, with Y of 1
  std::vector<float> xyz_outline;       ///< `outline` of the samples of xyz
};

struct GemLight {
  Returns returns;
  meters::Interval below;  ///< share of the light that leaves below the horizon
  meters::Interval window; ///< share of the outline: more than half of its light comes straight from below
  meters::Interval dark;   ///< share of the outline: more than half of its light comes from where the head is
  std::optional<meters::Interval> fire_deg; ///< empty where the material has no dispersion
  meters::Interval scintillation;           ///< mean change of HEAD by a degree of tilt
  double area_mm2 = 0;                      ///< of the outline
  double lost = 0;                          ///< share of the light that met too many surfaces, at most
  std::vector<Tilt> tilts;                  ///< -30 to 30 degrees about x, then about z
  GemPictures pictures;
};

/// advanced: is called between launches, with the part that is done; what it throws ends the work. Throws BuildError,
/// and failed where the device has no memory.
GemLight measure_light(const Stone& stone, const LightOptions& options, const compute::Context& context,
                       const std::function<void(double part)>& advanced);

} // namespace nephroid::gems
