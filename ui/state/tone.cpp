// SPDX-License-Identifier: Apache-2.0
#include "ui/state/tone.h"

#include "image/image.h"
#include "measure/difference.h"
#include "measure/lab.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nephroid::ui {
namespace {

/// Positive floats sort like their bits. Without the last bits they are steps of 0.4 % at most. A step holds the end of
/// one byte at most, because those of sRGB are 0.9 % apart.
constexpr int left_out_bits = 15;

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// A rising curve from floats to bytes, by a table: the window needs it for every channel of every snapshot. exact:
/// maps a float of 0..end to its byte; rises by one byte at most within 0.4 % of a value. Values above the end become
/// 255, values not above 0 become exact(0).
template <unsigned char (*exact)(float)>
class ByteTable {
public:
  explicit ByteTable(float end) : end_(end), bytes_((bits(end) >> left_out_bits) + 1) {
    for (std::uint32_t i = 0; i < bytes_.size(); ++i) bytes_[i] = exact(std::bit_cast<float>(i << left_out_bits));
    for (std::uint32_t byte = 0; byte < 256; ++byte) least_[byte] = least_shown_as(byte);
    least_[256] = std::numeric_limits<float>::infinity();
  }

  unsigned char operator()(float value) const {
    value = std::min(std::max(0.0f, value), end_); // NaN becomes 0
    const unsigned char byte = bytes_[bits(value) >> left_out_bits];
    // No branch: neighbours in a noisy picture differ.
    return static_cast<unsigned char>(byte + (value >= least_[byte + 1u]));
  }

private:
  /// The first float of 0..end whose byte is this one or a greater one; the end, where there is none.
  float least_shown_as(std::uint32_t byte) const {
    std::uint32_t low = 0, high = bits(end_);
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (exact(std::bit_cast<float>(middle)) >= byte)
        high = middle;
      else
        low = middle + 1;
    }
    return std::bit_cast<float>(low);
  }

  float end_;
  std::vector<unsigned char> bytes_; ///< the byte of each step's first float
  std::array<float, 257> least_{};   ///< [byte]: the first float with this byte
};

constexpr double brightening = 2, white_point = 11.2; ///< constants of the filmic curve, as published

double hable(double x) {
  constexpr double a = 0.15, b = 0.5, c = 0.1, d = 0.2, e = 0.02, f = 0.3;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

unsigned char exact_srgb(float value) { return image::shown(value, 1); }
unsigned char exact_filmic(float value) {
  return image::shown(static_cast<float>(filmic(static_cast<double>(value))), 1);
}

template <unsigned char (*exact)(float)>
const ByteTable<exact>& table(float end) {
  static const ByteTable<exact> bytes(end);
  return bytes;
}

template <class Bytes>
void pixels_by(const Bytes& bytes, std::span<const float> rgb, double exposure_stops, std::span<unsigned char> rgba8) {
  const float scale = static_cast<float>(std::exp2(exposure_stops));
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba8[4 * i + c] = bytes(rgb[3 * i + c] * scale);
    rgba8[4 * i + 3] = 255;
  }
}

/// The colour of a pixel whose luminance is not a number above 0.
Rgb8 odd_colour(const float* rgb, double luminance, const LuminanceRange& range) {
  if (std::any_of(rgb, rgb + 3, [](float v) { return std::isnan(v); })) return nan_colour;
  if (std::any_of(rgb, rgb + 3, [](float v) { return std::isinf(v); })) return infinite_colour;
  return luminance < 0 ? negative_colour : luminance_colour(luminance, range);
}

std::uint32_t step_of(double value) { return bits(static_cast<float>(value)) >> left_out_bits; }

void false_colour_pixels(std::span<const float> rgb, const Tone& tone, std::span<unsigned char> rgba8) {
  const std::uint32_t first = step_of(tone.range.low), last = std::max(step_of(tone.range.high), first);
  std::vector<Rgb8> colour_of_step;
  for (std::uint32_t i = first; i <= last; ++i)
    colour_of_step.push_back(luminance_colour(
        static_cast<double>(std::bit_cast<float>((i << left_out_bits) + (1u << (left_out_bits - 1)))), tone.range));
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    const float* pixel = &rgb[3 * i];
    const double luminance = tone.white * measure::luminance(pixel);
    const bool ordinary = luminance > 0 && luminance <= static_cast<double>(std::numeric_limits<float>::max());
    const Rgb8 colour = ordinary ? colour_of_step[std::clamp(step_of(luminance), first, last) - first]
                                 : odd_colour(pixel, luminance, tone.range);
    std::copy(colour.begin(), colour.end(), &rgba8[4 * i]);
    rgba8[4 * i + 3] = 255;
  }
}

/// The nearest 1, 2 or 5 times a power of ten that is not below (up) or not above the value, which is above 0.
double round_number(double value, bool up) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  const double tolerance = 1 + 1e-6; // powers of ten from 5e-324 to 1e308 are not all exact
  double best = up ? 10 * decade : decade;
  for (const double factor : {5.0, 2.0, 1.0})
    if (up ? factor * decade * tolerance >= value : factor * decade <= value * tolerance) {
      best = factor * decade;
      if (!up) break;
    }
  return best;
}

} // namespace

double filmic(double linear) {
  if (!(linear > 0)) return 0;
  return std::min(hable(brightening * std::min(linear, white_point)) / hable(white_point), 1.0);
}

Tone tone_of(const ViewSettings& view_settings, double white, std::span<const float> rgb) {
  if (view_settings.tone != ToneCurve::false_colour) return {view_settings.tone, view_settings.exposure_stops, {}, 1};
  return {view_settings.tone, 0, view_settings.false_colour ? *view_settings.false_colour : automatic_range(rgb, white),
          white};
}

LuminanceRange automatic_range(std::span<const float> rgb, double white) {
  constexpr int bits_left_out = 20; // eight steps per octave
  std::vector<std::size_t> counts((std::size_t{1} << (31 - bits_left_out)), 0);
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    if (const double y = white * measure::luminance(&rgb[i]);
        y > 0 && y <= static_cast<double>(std::numeric_limits<float>::max()))
      ++counts[std::bit_cast<std::uint32_t>(static_cast<float>(y)) >> bits_left_out];
  const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  if (all == 0) return {0.01, 1};
  const auto step_with = [&](double part) {
    std::size_t sum = 0;
    std::uint32_t step = 0;
    while (static_cast<double>(sum += counts[step]) < part * static_cast<double>(all)) ++step;
    return step;
  };
  const auto value = [](std::uint32_t step) {
    return static_cast<double>(std::bit_cast<float>(step << bits_left_out));
  };
  const double high = round_number(std::clamp(value(step_with(0.999) + 1), 1e-20, 1e30), true);
  const double low = round_number(std::clamp(value(step_with(0.01)), 1e-8 * high, 0.1 * high), false);
  return {low, high};
}

std::optional<LuminanceRange> valid_range(const LuminanceRange& range) {
  if (!std::isfinite(range.low) || !std::isfinite(range.high) || !(range.high > 0)) return std::nullopt;
  const double high = std::clamp(range.high, 2e-30, 1e30);
  return LuminanceRange{std::clamp(range.low, 1e-30, high / 1.01), high};
}

Rgb8 luminance_colour(double luminance, const LuminanceRange& range) {
  if (!(luminance > 0)) return measure::map_colour(0);
  return measure::map_colour(std::log(luminance / range.low) / std::log(range.high / range.low));
}

void toned_pixels(std::span<const float> rgb, const Tone& tone, std::span<unsigned char> rgba8) {
  switch (tone.curve) {
  case ToneCurve::standard: return pixels_by(table<exact_srgb>(1), rgb, tone.exposure_stops, rgba8);
  case ToneCurve::filmic:
    return pixels_by(table<exact_filmic>(static_cast<float>(white_point / brightening)), rgb, tone.exposure_stops,
                     rgba8);
  case ToneCurve::false_colour: return false_colour_pixels(rgb, tone, rgba8);
  }
}

unsigned char shown_byte(float linear) { return table<exact_srgb>(1)(linear); }

} // namespace nephroid::ui
