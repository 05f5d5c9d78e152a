// SPDX-License-Identifier: Apache-2.0
// The Laplacian pyramid of Burt and Adelson (1983) as IW-SSIM takes it: by Simoncelli's conventions (matlabPyrTools).
#pragma once
#include <cstddef>
#include <vector>

namespace nephroid::measure {

/// One channel, double precision, row by row.
struct Plane {
  std::size_t width = 0, height = 0;
  std::vector<double> values;

  Plane() = default;
  Plane(std::size_t w, std::size_t h) : width(w), height(h), values(w * h) {}
  double* row(std::size_t y) { return values.data() + y * width; }
  const double* row(std::size_t y) const { return values.data() + y * width; }
};

/// `levels` planes: level 0 has the picture's size, each further one half of it, rounded up, at least 2. Every level is
/// its low pass minus what the next level tells of it, but the last, which is the low pass that is left.
std::vector<Plane> laplacian_pyramid(Plane picture, int levels);

/// The parent of a level as large as twice itself, cropped to width x height: bilinear between pixel centres to 4 n -
/// 3, a border extrapolated linearly, every second sample (imenlarge2 of Wang and Li).
Plane enlarged_parent(const Plane& parent, std::size_t width, std::size_t height);

} // namespace nephroid::measure
