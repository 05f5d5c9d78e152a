// SPDX-License-Identifier: Apache-2.0
// A film read back from the device: fixed-point XYZ sums turned into a layer of linear sRGB.
#pragma once
#include "job/job.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::tracing {

/// The largest contribution in quanta, FILM_LIMIT of kernels/tracing/film.h. A film takes any number of contributions.
inline constexpr double film_limit = 0x1p42;

/// What a device added up.
struct Film {
  /// [half][pixel of the picture][3]: XYZ radiance in quanta, added up over samples. A meter's has replicates in the
  /// place of halves.
  std::vector<std::int64_t> sums;
  double quanta_per_unit = 1; ///< quanta of what becomes 1 in the picture
  /// How many samples, batches or passes the sums of a pixel hold, in each half. Without halves all are in one image.
  std::function<std::array<double, 2>(std::size_t pixel)> samples;
};

/// The picture's layer of that name; a black one is made where there is none yet.
job::Layer& layer_of(job::Picture& picture, const std::string& name);

/// Adds the mean of the samples, 0 where there is none, to layer_of(picture, name); a meter's in each replicate, all of
/// which have as many samples, to Layer::replicates alone. Where the film has two halves a and
/// b, also adds (a - b) sqrt(n_a n_b) / (n_a + n_b) to Picture::error_draw. It is cleared where a pixel lacks a half.
void add_layer(const std::string& name, const Film& film, job::Picture& picture);

/// How many passes or batches each half of a film has after `passes` complete ones and `part` of the next.
std::array<double, 2> halves_of(std::int64_t passes, double part);

} // namespace nephroid::tracing
