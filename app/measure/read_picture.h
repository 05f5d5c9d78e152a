// SPDX-License-Identifier: Apache-2.0
// Picture files as comparisons take them: linear sRGB, and masks.
#pragma once
#include "job/job.h"
#include "measure/metrics.h"

namespace nephroid::measure {

struct LinearPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;                        ///< linear sRGB, 3 a pixel, rows from the top
  std::string name;                              ///< the file
  bool grey = false;                             ///< the file has one channel, here thrice
  bool decoded = false;                          ///< the file has integers, which were sRGB-encoded
  std::map<std::string, std::string> attributes; ///< those of the file

  Pixels pixels() const { return {width, height, rgb, name}; }
};

/// Files of floats (EXR, HDR, PFM, float TIFF) are linear; files of integers (PNG, JPEG, TIFF) are decoded from sRGB,
/// or from the gamma that they say. Other primaries become sRGB's. The channels R, G, B or, alone or with alpha, Y;
/// alpha and layers are left out. Values may be NaN or infinite:
/// comparisons refuse them. Throws bad_input naming the file: no picture, or other channels.
LinearPicture read_linear_rgb(const std::filesystem::path& file);
/// The same, and in `layers` those that the file has, as read_linear_layer reads them: NAME.R, NAME.G, NAME.B.
LinearPicture read_linear_rgb(const std::filesystem::path& file, std::vector<job::Layer>& layers);
/// One of its layers, whose channels are LAYER.R, LAYER.G, LAYER.B. Throws bad_input naming the layers there are.
LinearPicture read_linear_layer(const std::filesystem::path& file, const std::string& layer);

/// As people open what any program wrote.
struct OpenedPicture {
  LinearPicture picture;
  std::vector<job::Layer> layers; ///< those of the file
  std::string stands_in; ///< the file has no R, G, B or Y of its own: its first layer, which the picture is; else empty
};
/// As read_linear_rgb, and where the file has layers alone ("caustic.R"), the first of them.
OpenedPicture open_picture(const std::filesystem::path& file);

/// One value a pixel: 1 where any of R, G, B (or Y) is not 0, else 0. Throws bad_input naming the file: as above,
/// another size than width x height, NaN, or no pixel that counts.
std::vector<unsigned char> read_mask(const std::filesystem::path& file, int width, int height);

} // namespace nephroid::measure
