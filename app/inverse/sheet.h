// SPDX-License-Identifier: Apache-2.0
// What the pictures look like: light a cell as pixels.
#pragma once
#include "inverse/layout.h"
#include "job/job.h"

namespace nephroid::inverse {

/// A grey picture: scale times the values, row by row from the top.
std::shared_ptr<const job::Picture> grey_picture(std::span<const double> values, double scale, const glm::ivec2& size);
/// A grey picture in which 1 is the brightest wanted light, at the same energy. `most` is that, as a part of all light.
std::shared_ptr<const job::Picture> received_picture(std::span<const double> light, double most, const Layout& layout);
/// received_picture() in linear sRGB, where luminance counts; colours outside sRGB have negative values.
std::shared_ptr<const job::Picture> coloured_picture(std::span<const glm::dvec3> xyz, double most,
                                                     const Layout& layout);
/// `wanted` is a grey picture. Red is too much light, blue too little, on the same scale.
std::shared_ptr<const job::Picture> difference_picture(const job::Picture& wanted, const job::Picture& received);
/// A pixel for each facet: slope along x, slope along y, and z of its middle in millimetres.
std::shared_ptr<const job::Picture> slopes_picture(std::span<const glm::dvec2> slopes, std::span<const double> heights,
                                                   const Layout& layout);

struct Captioned {
  std::shared_ptr<const job::Picture> picture;
  std::string words;
};

/// Puts all pictures into one of this size, each in the shape of a receiver. Lists are columns or rows, whichever gives
/// larger pictures; one alone may be two columns. Words too small to read, or without a font, are left out.
std::shared_ptr<const job::Picture> sheet(const std::vector<std::vector<Captioned>>& lists, const glm::dvec2& shape,
                                          int width, int height);

} // namespace nephroid::inverse
