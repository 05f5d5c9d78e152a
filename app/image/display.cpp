// SPDX-License-Identifier: Apache-2.0
#include "image/display.h"

#include "base/parallel.h"
#include "image/image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::image {
namespace {

using Gamut = preset::Display::Gamut;
using ToneCurve = preset::Display::Tone;
using Rgb3 = std::array<float, 3>;

constexpr std::size_t block_pixels = std::size_t{1} << 15; ///< a block of work: about a millisecond

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// sRGB bytes by a table: the window needs them for every channel of every snapshot. Positive floats sort like their
/// bits. Without the last 15 they are steps of 0.4 % at most. A step holds the end of one byte at most, because those
/// of sRGB are 0.9 % apart.
class Encoding {
public:
  Encoding() : bytes_((bits(1) >> left_out_bits) + 1) {
    for (std::size_t i = 0; i + 1 < 256; ++i) // halfway between two codes: as rounding the encoding
      least_[i + 1] = static_cast<float>(decoded_srgb((static_cast<double>(i) + 0.5) / 255));
    least_[256] = std::numeric_limits<float>::infinity();
    for (std::uint32_t i = 0; i < bytes_.size(); ++i) {
      const float first = std::bit_cast<float>(i << left_out_bits);
      bytes_[i] = static_cast<unsigned char>(std::upper_bound(least_.begin() + 1, least_.begin() + 256, first) -
                                             least_.begin() - 1);
    }
  }

  unsigned char operator()(float value) const {
    value = std::min(std::max(0.0f, value), 1.0f); // NaN becomes 0
    const unsigned char byte = bytes_[bits(value) >> left_out_bits];
    // No branch: neighbours in a noisy picture differ.
    return static_cast<unsigned char>(byte + (value >= least_[byte + 1u]));
  }

private:
  static constexpr int left_out_bits = 15;
  std::vector<unsigned char> bytes_; ///< the byte of each step's first float
  std::array<float, 257> least_{};   ///< [byte]: the first float with this byte
};

const Encoding& encoding() {
  static const Encoding table;
  return table;
}

constexpr float knee = 0.6f;
/// Half of the first byte's least value: what is so little outside of 0..1 shows no other byte for it.
constexpr float margin = 0.5f / 255 / 12.92f;

/// W: the peak as the curve has it.
float reinhard(float x, float peak) {
  const float l = (x - knee) / (1 - knee), w = (peak - knee) / (1 - knee);
  return knee + (1 - knee) * (l * (1 + l / (w * w)) / (1 + l));
}

float filmic(float x) {
  constexpr float brightening = 2, white_point = 11.2f;
  const auto hable = [](float v) {
    constexpr float a = 0.15f, b = 0.5f, c = 0.1f, d = 0.2f, e = 0.02f, f = 0.3f;
    return (v * (a * v + c * b) + d * e) / (v * (a * v + b) + d * f) - e / f;
  };
  return hable(brightening * std::min(x, white_point)) / hable(white_point);
}

float largest(const Rgb3& rgb) { return std::max({rgb[0], rgb[1], rgb[2]}); }

void apply_tone(Rgb3& rgb, ToneCurve tone, float peak) {
  const float most = largest(rgb);
  if (tone == ToneCurve::clip || most <= (tone == ToneCurve::reinhard ? knee : margin)) return;
  if (tone == ToneCurve::reinhard && peak <= 1 && most <= 1) return;
  const float factor = std::min(tone == ToneCurve::reinhard ? reinhard(most, peak) : filmic(most), 1.0f) / most;
  for (float& value : rgb) value *= factor;
}

/// From linear sRGB to the cones of OKLab and back, and from their roots to it, with its author's digits.
constexpr float to_cones[3][3] = {{0.4122214708f, 0.5363325363f, 0.0514459929f},
                                  {0.2119034982f, 0.6806995451f, 0.1073969566f},
                                  {0.0883024619f, 0.2817188376f, 0.6299787005f}};
constexpr float from_cones[3][3] = {{4.0767416621f, -3.3077115913f, 0.2309699292f},
                                    {-1.2684380046f, 2.6097574011f, -0.3413193965f},
                                    {-0.0041960863f, -0.7034186147f, 1.7076147010f}};
constexpr float lightness_of_roots[3] = {0.2104542553f, 0.7936177850f, -0.0040720468f};

/// To 2e-6 of it. A third of the exponent gives 5 %; Newton's steps square the error.
float cube_root(float x) {
  const float size = std::abs(x) + std::numeric_limits<float>::min();
  float root = std::bit_cast<float>(bits(size) / 3 + 709921077u);
  for (int step = 0; step < 3; ++step) root -= (root - size / (root * root)) / 3;
  return std::copysign(root, x);
}

/// c0 + c1 t + c2 t^2 + c3 t^3: a channel along the way from grey (t = 0) to the colour (t = 1).
struct Cubic {
  float c0, c1, c2, c3;
  float operator()(float t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  float slope(float t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
};

/// Where it has the value between 0, where it is on one side of it, and `high`, where it is on the other: Newton's
/// steps, halved where they leave the interval.
float crossing(const Cubic& channel, float value, float high) {
  const float before_it = channel.c0 - value, beyond = channel(high) - value;
  const bool rises = beyond > 0;
  float low = 0, t = high * before_it / (before_it - beyond); // on the chord
  for (int step = 0; step < 24; ++step) {
    const float off = channel(t) - value;
    if ((off > 0) == rises)
      high = t;
    else
      low = t;
    const float before = t, next = t - off / channel.slope(t);
    t = next > low && next < high ? next : (low + high) / 2;
    if (std::abs(t - before) < 1e-5f) break;
  }
  return t;
}

/// Roots of the cones are lightness + t * deviation along the way, so that a channel is a cubic of t.
Rgb3 less_colourful(const Rgb3& rgb) {
  float deviation[3], lightness = 0;
  for (int i = 0; i < 3; ++i) {
    deviation[i] = cube_root(to_cones[i][0] * rgb[0] + to_cones[i][1] * rgb[1] + to_cones[i][2] * rgb[2]);
    lightness += lightness_of_roots[i] * deviation[i];
  }
  if (!(lightness > 0)) return {0, 0, 0};
  if (lightness >= 1) return {1, 1, 1};
  for (float& root : deviation) root -= lightness;
  Cubic channels[3];
  for (int c = 0; c < 3; ++c) {
    Cubic& channel = channels[c] = {lightness * lightness * lightness, 0, 0, 0};
    for (int i = 0; i < 3; ++i) {
      const float part = from_cones[c][i] * deviation[i];
      channel.c1 += 3 * lightness * lightness * part;
      channel.c2 += 3 * lightness * part * deviation[i];
      channel.c3 += part * deviation[i] * deviation[i];
    }
  }
  float t = 1;
  // Towards blue a channel that is inside may be outside nearer to grey, so all are looked at again.
  for (int round = 0; round < 3; ++round)
    for (const Cubic& channel : channels)
      if (const float there = channel(t); there < -margin / 4 || there > 1 + margin / 4)
        t = crossing(channel, there < 0 ? 0 : 1, t);
  return {channels[0](t), channels[1](t), channels[2](t)};
}

bool is_identity(const std::array<float, 9>& matrix) { return matrix == Display().white_balance; }

/// The white balance and the exposure. NaN becomes 0, and no infinity is left.
class Exposure {
public:
  explicit Exposure(const Showing& showing)
      : matrix_(showing.display.white_balance), balances_(!is_identity(matrix_)), scale_(showing.scale) {}

  /// Nothing where the white balance asks for more.
  std::optional<Rgb3> plain(const float* pixel) const {
    if (balances_) return std::nullopt;
    return Rgb3{pixel[0] * scale_, pixel[1] * scale_, pixel[2] * scale_};
  }
  Rgb3 operator()(const float* pixel) const {
    Rgb3 rgb{finite(pixel[0]), finite(pixel[1]), finite(pixel[2])};
    if (balances_) {
      const Rgb3 v = rgb;
      for (std::size_t i = 0; i < 3; ++i)
        rgb[i] = matrix_[3 * i] * v[0] + matrix_[3 * i + 1] * v[1] + matrix_[3 * i + 2] * v[2];
    }
    for (float& value : rgb) value *= scale_;
    return rgb;
  }

private:
  static float finite(float value) {
    constexpr float most = 1e25f; // times 2^20 and a white balance
    return std::min(std::max(value == value ? value : 0.0f, -most), most);
  }

  std::array<float, 9> matrix_;
  bool balances_;
  float scale_;
};

float smallest(const Rgb3& rgb) { return std::min({rgb[0], rgb[1], rgb[2]}); }

/// Colours that keep their values: most pixels of most pictures. What the encoding does to the others is the same.
struct Kept {
  float low = -std::numeric_limits<float>::infinity(), high = std::numeric_limits<float>::infinity();
  explicit Kept(const Showing& showing) {
    if (showing.display.gamut == Gamut::oklch) low = -margin, high = 1;
    if (showing.display.tone == ToneCurve::filmic) high = 0;
    if (showing.display.tone == ToneCurve::reinhard) high = showing.peak > 1 ? knee : 1;
  }
  bool contains(const Rgb3& rgb) const { return smallest(rgb) >= low && largest(rgb) <= high; }
};

void tone_and_gamut(Rgb3& rgb, const Showing& showing) {
  apply_tone(rgb, showing.display.tone, showing.peak);
  if (showing.display.gamut == Gamut::oklch && (smallest(rgb) < -margin || largest(rgb) > 1 + margin))
    rgb = less_colourful(rgb);
}

} // namespace

Showing showing_of(const Display& display, double exposure_stops, std::span<const float> rgb) {
  Showing showing{display, static_cast<float>(std::exp2(exposure_stops)), 1};
  if (display.tone != ToneCurve::reinhard) return showing;
  // Steps of 1.6 % at most, counted from 1 on.
  constexpr int left_out = 17;
  const std::uint32_t first = bits(1) >> left_out;
  const std::size_t pixels = rgb.size() / 3, steps = (bits(std::numeric_limits<float>::max()) >> left_out) - first + 1;
  const std::size_t blocks = (pixels + block_pixels - 1) / block_pixels;
  std::vector<std::vector<std::uint32_t>> counts(blocks);
  const Exposure exposed(showing);
  for_ranges(pixels, block_pixels, [&](std::size_t block, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto plain = exposed.plain(&rgb[3 * i]);
      if (plain && largest(*plain) <= 1) continue;
      const float most = largest(exposed(&rgb[3 * i]));
      if (!(most > 1)) continue;
      if (counts[block].empty()) counts[block].resize(steps);
      ++counts[block][(bits(most) >> left_out) - first];
    }
  });
  std::vector<std::size_t> sums(steps, 0);
  for (const auto& of_block : counts)
    for (std::size_t step = 0; step < of_block.size(); ++step) sums[step] += of_block[step];
  std::size_t above = 0;
  for (std::size_t step = steps; step-- > 0;)
    if ((above += sums[step]) > pixels / 10000) {
      showing.peak = std::bit_cast<float>((first + static_cast<std::uint32_t>(step) + 1) << left_out);
      break;
    }
  return showing;
}

void show(std::span<const float> rgb, const Showing& showing, std::span<unsigned char> bytes) {
  const std::size_t pixels = rgb.size() / 3, channels = pixels == 0 ? 3 : bytes.size() / pixels;
  const Exposure exposed(showing);
  const Kept kept(showing);
  const Encoding& encode = encoding();
  for_ranges(pixels, block_pixels, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      Rgb3 pixel;
      if (const auto plain = exposed.plain(&rgb[3 * i]); plain && kept.contains(*plain)) {
        pixel = *plain;
      } else {
        pixel = exposed(&rgb[3 * i]);
        tone_and_gamut(pixel, showing);
      }
      for (std::size_t c = 0; c < 3; ++c) bytes[channels * i + c] = encode(pixel[c]);
      if (channels == 4) bytes[4 * i + 3] = 255;
    }
  });
}

std::array<float, 3> displayed(std::array<float, 3> rgb, const Showing& showing) {
  Rgb3 pixel = Exposure(showing)(rgb.data());
  tone_and_gamut(pixel, showing);
  for (float& value : pixel) value = std::clamp(value, 0.0f, 1.0f);
  return pixel;
}

unsigned char shown(float linear) { return encoding()(linear); }

} // namespace nephroid::image
