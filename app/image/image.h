// SPDX-License-Identifier: Apache-2.0
// Pictures in and out, and words as pictures. OpenImageIO is behind a library that is loaded at the first call (it
// costs 0.24 s and 130 MB at start), so including this costs nothing.
#pragma once
#include "base/bytes.h"
#include "base/error.h"
#include "image/display.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::image {

/// x and y of red, green, blue and white, in CIE 1931: what the colours of a file are made of.
using Chromaticities = std::array<float, 8>;

/// Float channels, interleaved, row 0 at the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels; ///< "R", "G", "B", "caustic.R", ...
  std::vector<float> data;           ///< width * height * channels.size(), as the file has them
  std::map<std::string, std::string> attributes{};
  /// Read from 0..1 of integers (PNG, JPEG): encoded, and not multiplied by alpha. Floats are linear, and multiplied.
  bool integers = false;
  double gamma = 0;                               ///< of integers: the exponent that makes them linear; 0: sRGB's curve
  std::optional<Chromaticities> chromaticities{}; ///< where they are not Rec. 709's, which are sRGB's
  std::string profile{};                          ///< of integers: the bytes of a profile (ICC) other than sRGB's
  double white_cd_m2 = 0;                         ///< luminance of (1, 1, 1), where the file says it (EXR)
  std::vector<std::string> notes{};               ///< what the file says and is not obeyed
};

/// An EXR's pixels lie where they are in its display window: what is beyond is left out, the rest is black. Of several
/// parts the first is taken that has colours. Values of a Radiance map are divided by its EXPOSURE and COLORCORR.
/// Throws bad_input naming the file and what is wrong with it.
Image read_image(const std::filesystem::path& file);

/// How the pixels of a file come: column u and row v of it are column v and row u of the picture where `transposed`,
/// counted from the other end where they go back.
struct PixelOrder {
  bool transposed = false, columns_back = false, rows_back = false;
  bool operator==(const PixelOrder&) const = default;
};

/// Of a camera's orientation: where the file's first row and first column are in what was seen (Exif; others are 1).
constexpr PixelOrder pixel_order(int orientation) {
  constexpr PixelOrder orders[] = {
      {false, false, false}, // 1: top, left
      {false, true, false},  // 2: top, right
      {false, true, true},   // 3: bottom, right
      {false, false, true},  // 4: bottom, left
      {true, false, false},  // 5: left, top
      {true, false, true},   // 6: right, top
      {true, true, true},    // 7: right, bottom
      {true, true, false},   // 8: left, bottom
  };
  return orders[orientation >= 1 && orientation <= 8 ? orientation - 1 : 0];
}
/// The same of the picture with left and right exchanged, and of the picture turned by 90 degrees counterclockwise.
PixelOrder mirrored(PixelOrder order);
PixelOrder turned_left(PixelOrder order);

/// Some rows of a picture, as the file has them.
struct Band {
  Image rows;
  int first = 0;  ///< the first row's number, from the file's top
  int height = 0; ///< the whole picture's
  PixelOrder order{};
  double pixel_aspect = 1; ///< a pixel's width in the file over its height
};

/// The same piece by piece from the top, 16 MiB at a time: a large picture takes little memory. Rows are not turned.
/// Throws as read_image, and what `use` throws.
void read_bands(const std::filesystem::path& file, const std::function<void(const Band&)>& use);

/// The words in a bold font, white on black: one channel, 0..1, cut to the words; height: of a letter, about, in
/// pixels. Throws bad_input at `where` if the font is missing or there is nothing to draw.
Image text_picture(const std::string& text, int height, const Location& where);

struct Rgb {
  std::vector<float> values; ///< linear sRGB, 3 a pixel, row 0 at the top; below 0 for colours that sRGB does not have
  std::vector<float> alpha;  ///< one a pixel, or none
  bool grey = false;         ///< the file has one channel, here thrice
};

/// The picture's channels R, G, B or, alone or with alpha, Y; further layers are left out. Integers are not multiplied
/// by alpha, floats are. A file's white becomes (1, 1, 1), other colours follow by the Bradford transform; XYZ stays
/// what it is. name: of the file, for messages. Throws bad_input where there are other channels.
Rgb rgb_of(const Image& picture, const std::string& name);

/// 32-bit float EXR with every channel and attribute. The same image gives the same bytes:
/// no date goes in. NaN and infinities are kept.
void write_exr(const std::filesystem::path& file, const Image& image);
void write_exr(ByteSink& to, const Image& image);
/// Values as they are, row 0 at the top, and what they mean.
void write_png16(ByteSink& to, int width, int height, const std::vector<std::uint16_t>& grey,
                 const std::string& description);
/// rgb: linear sRGB, 3 a pixel, row 0 at the top; an 8-bit PNG of what show() gives.
/// All writers write whole (write_file_whole) and throw failed: a size that does not fit, OpenImageIO's or the system's
/// reason.
void write_png(const std::filesystem::path& file, int width, int height, const std::vector<float>& rgb,
               const Showing& showing = {});
/// rgba8: 4 bytes a pixel, e.g. a screenshot.
void write_png_bytes(const std::filesystem::path& file, int width, int height, const std::vector<unsigned char>& rgba8);

/// The linear value of an sRGB-encoded one, 0..1 (IEC 61966-2-1).
double decoded_srgb(double encoded);
/// The bytes of the file that write_png makes.
std::string png(int width, int height, const std::vector<float>& rgb, const Showing& showing = {});
/// The same of 8-bit values, 3 a pixel.
std::string png_of_bytes(int width, int height, const std::vector<unsigned char>& rgb8);

} // namespace nephroid::image
