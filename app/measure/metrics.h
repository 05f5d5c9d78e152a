// SPDX-License-Identifier: Apache-2.0
// How far a picture is from a reference: the metrics that every report, history and comparison of this program speaks.
// a is the picture, b the reference, both linear sRGB with 1 = white, rows from the top.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nephroid::measure {

/// A picture, not owned.
struct Pixels {
  int width = 0, height = 0;
  std::span<const float> rgb; ///< 3 a pixel
  std::string name;           ///< what messages call it: a file, "the run"
};

/// Which pixels count: those that are not 0. Empty: all.
using Mask = std::span<const unsigned char>;

struct Metrics {
  double lab_mean = 0, lab_rms = 0, lab_max = 0; ///< a pixel's distance in CIELAB (D65), not clipped above
  double mse = 0;                                ///< mean of (a - b)^2 over pixels and channels
  double rel_mse = 0;                            ///< mean of (a - b)^2 / (b^2 + 0.01)
  double rel_l2 = 0;             ///< |a - b| / |b|; of a black reference 0 where a is black too, else infinity
  std::optional<double> psnr_db; ///< sRGB-encoded clipped pictures', peak 1; none where those are identical
  // None where only quick ones were asked for.
  std::optional<double> iw_ssim;  ///< Wang and Li 2011; none below 161 pixels a side
  std::optional<double> flip;     ///< Andersson et al. 2020, 67.02 pixels a degree
  std::optional<double> hdr_flip; ///< Andersson et al. 2021
  std::size_t pixels = 0;         ///< that were counted
};

enum class MetricSet { quick, full };

/// FLIP's maps and IW-SSIM's are of the whole pictures, averaged over the mask. Throws bad_input naming the picture:
/// sizes that differ, NaN or infinity, a mask of another size or with no pixel that counts.
Metrics compare(const Pixels& picture, const Pixels& reference, Mask mask = {}, MetricSet which = MetricSet::full);
/// The same for several masks, one after the other, at little more than the cost of one.
std::vector<Metrics> compare_each(const Pixels& picture, const Pixels& reference, std::span<const Mask> masks,
                                  MetricSet which = MetricSet::full);

struct MetricText {
  std::string label; ///< "mean CIELAB distance"
  std::string unit;  ///< "CIELAB units", "dB"; empty: a ratio without one
  /// The error of n independent samples is in proportion to n to this power; none where there is no such law.
  std::optional<double> law;
  bool falls = true;             ///< an error, drawn on a logarithmic axis; what does not fall is on a linear one
  bool larger_is_better = false; ///< as psnr_db is

  bool is_mean_square() const { return law == -1.0; }
};

/// What there is to say about a metric. Files, histories, messages, the report and the window have it from here.
struct Metric {
  std::string_view name;    ///< "lab_mean"
  std::string_view meaning; ///< what it is made of, for who compares pictures
  MetricText text;
  /// estimated: a run estimates it from its halves, as it does not hang on few pixels, as lab_max does, nor on what is
  /// right in the darkest ones, as rel_mse does. perceptual: not among the quick ones.
  enum class Kind { estimated, other, perceptual } kind;
  double (*of)(const Metrics& metrics); ///< NaN where it is none
};
/// In the order of `nephroid compare`.
const std::vector<Metric>& all_metrics();
std::vector<std::pair<std::string, double>> named(const Metrics& metrics);

/// The quick metrics again and again against one reference, whose share is done once: 20 ms a call at 512 x 512.
class QuickComparison {
public:
  /// Throws as compare does. Copies what it needs of both.
  explicit QuickComparison(const Pixels& reference, Mask mask = {});
  /// Throws bad_input where the size is another one or a value is not finite.
  Metrics against(const Pixels& picture) const;

private:
  int width_ = 0, height_ = 0;
  std::string name_;
  std::vector<float> rgb_;
  std::vector<double> lab_;     ///< CIELAB, 3 a pixel
  std::vector<double> encoded_; ///< sRGB-encoded and clipped, 3 a pixel
  std::vector<unsigned char> mask_;
};

/// Throws bad_input naming the picture and the pixel (column, row; 0, 0 is the top left) where a value is NaN or
/// infinite, and failed where the values do not fit the size.
void check_pixels(const Pixels& picture);
/// Throws bad_input where the sizes differ.
void check_same_size(const Pixels& picture, int width, int height, const std::string& reference_name);
/// Throws bad_input where the mask (its name is for messages) is of another size or no pixel counts.
void check_mask(Mask mask, int width, int height, const std::string& name = "mask");

inline bool counts(Mask mask, std::size_t pixel) { return mask.empty() || mask[pixel] != 0; }

} // namespace nephroid::measure
