// SPDX-License-Identifier: Apache-2.0
#include "ui/state/tone.h"

#include "base/error.h"
#include "measure/difference.h"
#include "measure/lab.h"
#include "run/display.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nephroid::ui {
namespace {

/// Positive floats sort like their bits. Without the last bits they are steps of 0.4 % at most.
constexpr int left_out_bits = 15;

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// The colour of a pixel whose luminance is not a number above 0.
Rgb8 odd_colour(const float* rgb, double luminance, const LuminanceRange& range) {
  if (std::any_of(rgb, rgb + 3, [](float v) { return std::isnan(v); })) return nan_colour;
  if (std::any_of(rgb, rgb + 3, [](float v) { return std::isinf(v); })) return infinite_colour;
  return luminance < 0 ? negative_colour : luminance_colour(luminance, range);
}

std::uint32_t step_of(double value) { return bits(static_cast<float>(value)) >> left_out_bits; }

void false_colour_pixels(std::span<const float> rgb, const Tone& tone, std::span<unsigned char> rgba8) {
  const LuminanceRange& range = *tone.false_colour;
  const std::uint32_t first = step_of(range.low), last = std::max(step_of(range.high), first);
  std::vector<Rgb8> colour_of_step;
  for (std::uint32_t i = first; i <= last; ++i)
    colour_of_step.push_back(luminance_colour(
        static_cast<double>(std::bit_cast<float>((i << left_out_bits) + (1u << (left_out_bits - 1)))), range));
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    const float* pixel = &rgb[3 * i];
    const double luminance = tone.white * measure::luminance(pixel);
    const bool ordinary = luminance > 0 && luminance <= static_cast<double>(std::numeric_limits<float>::max());
    const Rgb8 colour = ordinary ? colour_of_step[std::clamp(step_of(luminance), first, last) - first]
                                 : odd_colour(pixel, luminance, range);
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

image::Display display_of(const preset::Preset& preset) {
  try {
    return run::display_of(preset);
  } catch (const Error&) {
    preset::Preset daylight = preset;
    daylight.display.white_balance = preset::Display::WhiteBalance::d65;
    return run::display_of(daylight);
  }
}

Tone tone_of(const ViewSettings& view_settings, const image::Display& display, double white,
             std::span<const float> rgb) {
  if (!view_settings.false_colour) return {image::showing_of(display, view_settings.exposure_stops, rgb), {}, 1};
  return {{}, view_settings.range ? *view_settings.range : automatic_range(rgb, white), white};
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
  if (tone.false_colour) return false_colour_pixels(rgb, tone, rgba8);
  image::show(rgb, tone.showing, rgba8);
}

} // namespace nephroid::ui
