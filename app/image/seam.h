// SPDX-License-Identifier: Apache-2.0
// The seam between image.cpp and the module that knows OpenImageIO (oiio/module.cpp), which is built with the program
// and loaded late. Not for others: include image/image.h.
#pragma once
#include "image/image.h"

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

/// What image.h says of these. They throw Refused.
struct Module {
  Image (*read)(const std::string& file);
  void (*read_bands)(const std::string& file, const std::function<void(const Band&)>& use);
  /// The bytes of the file.
  std::vector<unsigned char> (*encode)(const Samples& picture);
  Image (*text)(const std::string& words, int height, const std::string& font);
};

inline constexpr const char *module_name = "libnephroid_image_io.so", *module_symbol = "nephroid_image_module";

} // namespace nephroid::image
