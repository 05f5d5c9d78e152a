// SPDX-License-Identifier: Apache-2.0
// Pictures in and out, words as pictures, and how a linear picture is shown. OpenImageIO is behind a library that is
// loaded at the first call (it costs 0.24 s and 130 MB at start), so including this costs nothing.
#pragma once
#include "base/bytes.h"
#include "base/error.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace nephroid::image {

/// Float channels, interleaved, row 0 at the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels; ///< "R", "G", "B", "caustic.R", ...
  std::vector<float> data;           ///< width * height * channels.size()
  std::map<std::string, std::string> attributes;
  bool integers = false; ///< read from 0..1 of integers (PNG, JPEG): by custom sRGB-encoded, as floats are linear
};

/// Colours are as the file has them, not multiplied by its alpha. Throws bad_input naming the file and OpenImageIO's
/// reason.
Image read_image(const std::filesystem::path& file);

/// Some rows of a picture, as the file has them.
struct Band {
  Image rows;          ///< without attributes
  int first = 0;       ///< the first row's number, from the file's top
  int height = 0;      ///< the whole picture's
  int orientation = 1; ///< as a camera was held (Exif, 1..8): the rows are not turned
};

/// The same piece by piece from the top, 16 MiB at a time: a large picture takes little memory. Throws as read_image,
/// and what `use` throws.
void read_bands(const std::filesystem::path& file, const std::function<void(const Band&)>& use);

/// The words in a bold font, white on black: one channel, 0..1, cut to the words; height: of a letter, about, in
/// pixels. Throws bad_input at `where` if the font is missing or there is nothing to draw.
Image text_picture(const std::string& text, int height, const Location& where);

struct Rgb {
  std::vector<float> values; ///< 3 a pixel, row 0 at the top, as the file has them
  bool grey = false;         ///< the file has one channel, here thrice
};

/// The picture's channels R, G, B or, alone or with alpha, Y; alpha and further layers are left out. name: of the file,
/// for messages. Throws bad_input where there are others.
Rgb rgb_of(const Image& picture, const std::string& name);

/// 32-bit float EXR with every channel and attribute. The same image gives the same bytes:
/// no date goes in. NaN and infinities are kept.
void write_exr(const std::filesystem::path& file, const Image& image);
void write_exr(ByteSink& to, const Image& image);
/// Values as they are, row 0 at the top, and what they mean.
void write_png16(ByteSink& to, int width, int height, const std::vector<std::uint16_t>& grey,
                 const std::string& description);
/// rgb: linear sRGB, 3 a pixel, row 0 at the top; an 8-bit PNG of what shown() gives at exposure 2^stops.
/// All writers write whole (write_file_whole) and throw failed: a size that does not fit, OpenImageIO's or the system's
/// reason.
void write_png(const std::filesystem::path& file, int width, int height, const std::vector<float>& rgb,
               double exposure_stops = 0);
/// rgba8: 4 bytes a pixel, e.g. a screenshot.
void write_png_bytes(const std::filesystem::path& file, int width, int height, const std::vector<unsigned char>& rgba8);

/// The linear value of an sRGB-encoded one, 0..1 (IEC 61966-2-1).
double decoded_srgb(double encoded);
/// The bytes of the file that write_png makes.
std::string png(int width, int height, const std::vector<float>& rgb, double exposure_stops = 0);
/// The same of 8-bit values, 3 a pixel.
std::string png_of_bytes(int width, int height, const std::vector<unsigned char>& rgb8);

/// What a display shows of one linear channel, 0..255: times the exposure, clipped to 0..1, sRGB-encoded. Infinity is
/// 255, NaN 0.
unsigned char shown(float linear, float exposure_scale);

} // namespace nephroid::image
