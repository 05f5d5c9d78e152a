// SPDX-License-Identifier: Apache-2.0
// A reference: the picture that others are measured against, and how far it is off itself. run/reference.h finds or renders one.
#pragma once
#include "job/job.h"
#include "measure/metrics.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::measure {

struct Reference {
  int width = 0, height = 0;
  std::vector<float> rgb;                    ///< linear sRGB, 3 a pixel
  std::string origin;                        ///< the file, also that of a recipe in the cache
  std::optional<Metrics> noise_floor;        ///< of a recipe: one of its two seeds against the mean of both, which `rgb` is
  std::optional<Metrics> masked_noise_floor; ///< the same of the mask's pixels
  std::vector<unsigned char> mask;           ///< one a pixel, or empty
  std::vector<job::Layer> layers = {};       ///< where it is a picture of a run, which has them; else empty
  std::vector<float> error_draw = {};        ///< of a recipe: one seed minus the mean of both, laid out like `rgb`; else empty

  Pixels pixels() const { return {width, height, rgb, origin}; }
};

} // namespace nephroid::measure
