// SPDX-License-Identifier: Apache-2.0
// The seam between image.cpp and the module that knows OpenImageIO (oiio/module.cpp). Plain C, so that the two can be
// compiled apart and the module be loaded late. Not for others: include image/image.h.
#pragma once
#include <cstddef>

extern "C" {

struct NephroidAttribute {
  const char* name;
  const char* value;
};

/// A picture lent for the time of a call. Interleaved channels, row 0 at the top; exactly one of floats, bytes and
/// words is set.
struct NephroidPicture {
  int width, height, channel_count;
  const char* const* channels;
  const float* floats;
  const unsigned char* bytes;
  const NephroidAttribute* attributes;
  std::size_t attribute_count;
  bool integers = false; ///< read: the file's samples are integers
  const unsigned short* words = nullptr;
};

/// Rows of a picture that is read piece by piece; `picture` has their height.
struct NephroidBand {
  NephroidPicture picture;
  int first, height; ///< the first of them, and how many the whole has
  int orientation;   ///< as Exif counts them, 1..8
};

/// Calls take(context, band) for one band after the other from the top, as long as it returns true. Null or the reason,
/// as below.
using NephroidReadBands = const char* (*)(const char* file, bool (*take)(void* context, const NephroidBand* band),
                                          void* context);
/// Calls take(context, picture) once and returns null, or returns the reason in words (valid until the thread's next
/// call).
using NephroidRead = const char* (*)(const char* file, void (*take)(void* context, const NephroidPicture* picture),
                                     void* context);
/// Encodes floats as 32-bit EXR (zip), bytes and words as PNG, and calls take(context, data, size) once. Null or the
/// reason, as above.
using NephroidEncode = const char* (*)(const NephroidPicture* picture,
                                       void (*take)(void* context, const void* data, std::size_t size), void* context);
/// Draws text, letters so many pixels high, with the named font: one channel, 0..1, no wider and higher than the text.
/// Null or the reason.
using NephroidText = const char* (*)(const char* text, int height, const char* font,
                                     void (*take)(void* context, const NephroidPicture* picture), void* context);
}

namespace nephroid::image {
inline constexpr const char* module_name = "libnephroid_image_io.so";
inline constexpr const char* read_symbol = "nephroid_image_read";
inline constexpr const char* read_bands_symbol = "nephroid_image_read_bands";
inline constexpr const char* encode_symbol = "nephroid_image_encode";
inline constexpr const char* text_symbol = "nephroid_image_text";
} // namespace nephroid::image
