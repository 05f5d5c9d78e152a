// SPDX-License-Identifier: Apache-2.0
// What there is to say of one pixel: its values in the run's picture, in each of its layers, in what it is compared
// with, and how far off the reference is; and its spectrum as text. And statistics of a rectangle of pixels: of the
// run's picture, of the one it is compared with, and of their difference.
#pragma once
#include "job/job.h"
#include "ui/state/context.h"

namespace nephroid::ui {

struct PixelRow {
  std::string name;            ///< "this run", "caustic", ...
  std::array<float, 3> rgb{};  ///< linear, over the preset's white
  double luminance = 0;        ///< W/m^2/sr
  std::array<double, 3> lab{}; ///< 1 is white
  bool is_colour = true;       ///< false of a difference or an error, which has no Lab
};

/// Empty where there is no picture or the pixel is not in it.
std::vector<PixelRow> pixel_rows(const Context& context, const std::array<int, 2>& pixel);
/// With tabs between, under a line of names.
std::string pixel_as_text(const Context& context, const std::array<int, 2>& pixel);
/// A wavelength a row, a layer a column, then their sum.
std::string spectrum_as_csv(const job::PixelSpectrum& spectrum);
/// The sum of the layers, one a wavelength.
std::vector<double> total_radiance(const job::PixelSpectrum& spectrum);

/// NaN where there is no value.
struct Moments {
  double mean, deviation, least, most, median; ///< deviation: the root of the mean square distance from the mean
};
/// All values are finite.
Moments moments(std::vector<double> values);

inline constexpr std::array<const char*, 4> region_quantities{"luminance", "R", "G", "B"};

struct PictureStatistics {
  std::string name;
  std::array<Moments, 4> of; ///< region_quantities: luminance in W/m^2/sr, channels linear; over finite pixels
  std::size_t pixels = 0;
  std::size_t nan = 0, infinite = 0; ///< pixels with such a channel; NaN goes first
  std::size_t dark = 0;              ///< pixels whose luminance is negative
  std::size_t coloured = 0;          ///< pixels with a negative channel: as a colour outside of sRGB has
};

struct Histogram {
  double first = 0, last = 1;              ///< log10 of W/m^2/sr: where the bins begin and end
  std::vector<std::vector<double>> counts; ///< [picture][bin]: pixels above 0
};

struct RegionRequest {
  HeldPicture picture, other; ///< other: null where there is none
  std::string other_name;
  PixelRegion region;
  double white = 1; ///< preset::Preset::white
};

struct RegionStatistics {
  RegionRequest of;                        ///< its region is cut to the picture
  std::vector<PictureStatistics> pictures; ///< the run; where there is another: that and "difference"
  Histogram histogram;                     ///< counts of the run and, where there is one, the other
};

/// The part of a region that is in a picture; nothing where none is.
std::optional<PixelRegion> cut_to(const PixelRegion& region, int width, int height);
/// The region reaches into the picture; both pictures have one size.
RegionStatistics region_statistics(RegionRequest request);
/// Once a frame: NewestResult::want(), as medians of a large picture take a tenth of a second.
void request_statistics(NewestResult<RegionStatistics>& statistics, TaskQueue& tasks, const RegionRequest& request);
/// A row a picture and quantity, under a line of names.
std::string to_csv(const RegionStatistics& statistics);

} // namespace nephroid::ui
