// SPDX-License-Identifier: Apache-2.0
// The colours of a picture file among its channels.
#pragma once
#include "image/image.h"

#include <string>
#include <vector>

namespace nephroid::image {

struct Rgb {
  std::vector<float> values; ///< 3 a pixel, row 0 at the top, as the file has them
  bool grey = false;         ///< the file has one channel, here thrice
};

/// The channels R, G, B or, alone or with alpha, Y; alpha and further layers are left out. name: of the file, for messages.
/// Throws bad_input where there are others.
Rgb rgb_of(const Image& picture, const std::string& name);

} // namespace nephroid::image
