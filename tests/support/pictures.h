// SPDX-License-Identifier: Apache-2.0
// Pictures made by formula, so that another program can make the same ones: the figures of authors' programs in the
// tests of the metrics were printed for these.
#pragma once
#include "measure/metrics.h"
#include "tests/support/test.h"

namespace nephroid::test {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb; ///< linear, 3 a pixel

  /// of(x, y, channel) gives each value.
  template <class Of>
  Picture(int w, int h, const Of& of) : width(w), height(h) {
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(of(x, y, c)));
  }
  measure::Pixels pixels(const std::string& name = "picture") const { return {width, height, rgb, name}; }
  float& at(int x, int y, int c) { return rgb[index(x, y, c)]; }
  float at(int x, int y, int c) const { return rgb[index(x, y, c)]; }

private:
  std::size_t index(int x, int y, int c) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) +
           static_cast<std::size_t>(c);
  }
};

inline Picture flat(int width, int height, double value) {
  return {width, height, [=](int, int, int) { return value; }};
}

/// 0..1 from integers alone, by multiplications and shifts of 32 bits.
inline double hashed(int x, int y, int c, unsigned seed) {
  const auto u = [](int i) { return static_cast<std::uint32_t>(i); };
  std::uint32_t v = (u(x) * 73856093u) ^ (u(y) * 19349663u) ^ (u(c) * 83492791u) ^ (seed * 40503u);
  v = (v ^ (v >> 16)) * 0x7feb352du;
  v = (v ^ (v >> 15)) * 0x846ca68bu;
  return (v ^ (v >> 16)) / 4294967296.0;
}

/// Smooth colours of 0.05 to 0.9 with a fine texture of +-0.05.
inline Picture textured(int width, int height) {
  return {width, height, [](int x, int y, int c) {
            const double smooth = c == 0   ? 0.5 + 0.35 * std::sin(0.11 * x + 0.03 * y)
                                  : c == 1 ? 0.4 + 0.3 * std::cos(0.07 * y - 0.05 * x)
                                           : 0.35 + 0.25 * std::sin(0.0005 * x * y);
            return smooth + 0.1 * (hashed(x, y, c, 1) - 0.5);
          }};
}

/// Plus uniform noise of -amplitude / 2 to amplitude / 2.
inline Picture with_noise(const Picture& picture, double amplitude, unsigned seed = 2) {
  return {picture.width, picture.height,
          [&](int x, int y, int c) { return picture.at(x, y, c) + amplitude * (hashed(x, y, c, seed) - 0.5); }};
}

/// Moved left; the last column is repeated.
inline Picture shifted(const Picture& picture, int columns) {
  return {picture.width, picture.height,
          [&](int x, int y, int c) { return picture.at(std::min(x + columns, picture.width - 1), y, c); }};
}

/// The mean of 3 x 3 pixels, those at the edge repeated.
inline Picture blurred(const Picture& picture) {
  return {picture.width, picture.height, [&](int x, int y, int c) {
            double sum = 0;
            for (int row = y - 1; row <= y + 1; ++row)
              for (int column = x - 1; column <= x + 1; ++column)
                sum += picture.at(std::clamp(column, 0, picture.width - 1), std::clamp(row, 0, picture.height - 1), c);
            return sum / 9;
          }};
}

/// Green for red, blue for green, red for blue.
inline Picture hue_turned(const Picture& picture) {
  return {picture.width, picture.height, [&](int x, int y, int c) { return picture.at(x, y, (c + 1) % 3); }};
}

inline Picture scaled(const Picture& picture, double factor) {
  return {picture.width, picture.height, [&](int x, int y, int c) { return picture.at(x, y, c) * factor; }};
}

/// Times 2^-5 to 2^5.
inline Picture high_range(const Picture& picture) {
  return {picture.width, picture.height, [&](int x, int y, int c) {
            return picture.at(x, y, c) * std::exp2(5 * std::sin(0.02 * x) * std::cos(0.03 * y));
          }};
}

/// Distortions of a picture for which authors' programs were run.
struct Pair {
  std::string name;
  Picture picture, reference;
  double sum; ///< of the picture's values: is it the one that the figures were printed for?
};

inline std::vector<Pair> distorted_pairs() {
  const Picture even = textured(192, 176), odd = textured(171, 203);
  return {{"noise", with_noise(even, 0.3), even, 43921.690567},
          {"weak noise", with_noise(even, 0.02), even, 43882.747642},
          {"blur", blurred(even), even, 43879.966008},
          {"shift", shifted(even, 2), even, 43860.611386},
          {"hue", hue_turned(even), even, 43879.966006},
          {"half as bright", scaled(even, 0.5), even, 21939.983003},
          {"high dynamic range", high_range(with_noise(even, 0.3)), high_range(even), 101657.186513},
          {"odd sides", with_noise(odd, 0.3), odd, 45405.167301}};
}

} // namespace nephroid::test
