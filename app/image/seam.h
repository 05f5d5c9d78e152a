// SPDX-License-Identifier: Apache-2.0
// The seam between image.cpp and the module that knows OpenImageIO (oiio/module.cpp), which is built with the program
// and loaded late. Not for others: include image/image.h.
#pragma once
#include "image/image.h"

#include <algorithm>

namespace nephroid::image {

/// A picture to encode, lent for the time of a call. Exactly one of floats, bytes and words is set: floats become a
/// 32-bit EXR (zip), the others a PNG.
struct Samples {
  int width, height;
  const std::vector<std::string>& channels; ///< interleaved, row 0 at the top
  const std::map<std::string, std::string>& attributes;
  const float* floats = nullptr;
  const unsigned char* bytes = nullptr;
  const std::uint16_t* words = nullptr;
};

/// What OpenImageIO does not do, and why.
struct Refused {
  std::string reason;
};

/// Rows of a band that have 16 MiB.
inline int rows_of_band(int width, std::size_t channels) {
  constexpr std::size_t values = std::size_t{1} << 22;
  return static_cast<int>(std::max<std::size_t>(1, values / (static_cast<std::size_t>(width) * channels)));
}

/// A file can say that it has more than any memory.
inline void require_at_most(int most_log2, int width, int height, std::size_t channels) {
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels > std::size_t{1} << most_log2)
    throw Refused{"it has " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                  std::to_string(channels) + " channels, and at most 2^" + std::to_string(most_log2) +
                  " values are read"};
}
/// The largest picture that is read in bands: what a minute reads.
inline constexpr int most_band_values_log2 = 32;

/// What image.h says of these. They throw Refused.
struct Module {
  void (*read_bands)(const std::string& file, const std::function<void(const Band&)>& use);
  /// The bytes of the file.
  std::vector<unsigned char> (*encode)(const Samples& picture);
  Image (*text)(const std::string& words, int height, const std::string& font);
  /// Encoded colours of integers, three values each, become linear sRGB as Image::profile says.
  void (*apply_profile)(const std::string& profile, std::vector<float>& rgb);
};

inline constexpr const char *module_name = "libnephroid_image_io.so", *module_symbol = "nephroid_image_module";

} // namespace nephroid::image
