// SPDX-License-Identifier: Apache-2.0
// The metrics of what a person sees.
//
// FLIP, the difference a person sees when flipping between two pictures, by its authors' own code (FLIP.h 1.7, BSD-3-Clause) at
// 67.02 pixels a degree. Andersson et al.: FLIP, HPG 2020; Visualizing Errors in Rendered High Dynamic Range Images, Eurographics 2021.
#pragma once
#include "measure/metrics.h"

#include <array>
#include <cstddef>
#include <vector>

namespace nephroid::measure {

/// The exposures (powers of two, in stops) at which HDR-FLIP looks: `count` of them from start to stop, both included.
struct Exposures {
  float start = 0, stop = 0;
  int count = 2;
};
/// From the reference: the first shows its largest luminance, the last its median, just below white. Both luminances count as at
/// least 2^-23 (the authors have that for the median only, and a black reference is undefined).
Exposures hdr_exposures(std::span<const float> reference_rgb);

/// LDR-FLIP of the clipped pictures, 0..1 a pixel. The pictures have the same size and finite values.
std::vector<float> flip_map(const Pixels& picture, const Pixels& reference);
/// HDR-FLIP: the largest error over the exposures, 0..1 a pixel. Negative values count as 0, as in the authors' program.
std::vector<float> hdr_flip_map(const Pixels& picture, const Pixels& reference);

/// The colour map magma (Smith and van der Walt, CC0) that FLIP's maps are shown in: position 0..1, sRGB-encoded, 0..1.
std::array<float, 3> magma(double position);

// IW-SSIM: structural similarity over five scales, each place weighted by the information a person takes from it.
// Wang and Li: Information Content Weighting for Perceptual Image Quality Assessment, IEEE Trans. Image Processing 20 (5), 2011.

/// Below so many pixels a side the coarsest of the five scales is smaller than SSIM's window of 11.
inline constexpr int iw_ssim_smallest_side = 161;

/// For each mask 0..1, 1 for equal pictures, of the luma (.299 .587 .114) of the sRGB-encoded, clipped pictures. Not symmetric. None where
/// a side is below iw_ssim_smallest_side or where no window of a scale is in the mask. The pictures have the same size and finite values.
///
/// What the authors leave open: similarities below 0 count as 0; a reference that is flat (or whose covariance is singular) has no
/// strength where it does not vary; where all weights of a scale are 0 its windows count alike. With a mask, windows count whose
/// centre is in it (at coarser scales: the pixel that lies there); covariances are of the whole picture.
std::vector<std::optional<double>> iw_ssim_each(const Pixels& picture, const Pixels& reference, std::span<const Mask> masks);

// The Laplacian pyramid of Burt and Adelson (1983) as IW-SSIM takes it: the conventions are those of Simoncelli's matlabPyrTools.

/// One channel, double precision, row by row.
struct Plane {
  std::size_t width = 0, height = 0;
  std::vector<double> values;

  Plane() = default;
  Plane(std::size_t w, std::size_t h) : width(w), height(h), values(w * h) {}
  double* row(std::size_t y) { return values.data() + y * width; }
  const double* row(std::size_t y) const { return values.data() + y * width; }
};

/// `levels` planes: level 0 has the picture's size, each further one half of it, rounded up; the last is the low pass that is left.
/// Every level but the last is its low pass minus what the next level tells of it. Sides of at least 2 at every level.
std::vector<Plane> laplacian_pyramid(Plane picture, int levels);

/// The parent of a level as large as twice itself, cropped to width x height: bilinear between pixel centres to 4 n - 3, a border
/// extrapolated linearly, every second sample (imenlarge2 of Wang and Li).
Plane enlarged_parent(const Plane& parent, std::size_t width, std::size_t height);

} // namespace nephroid::measure
