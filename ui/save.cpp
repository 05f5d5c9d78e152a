// SPDX-License-Identifier: Apache-2.0
#include "ui/save.h"

#include "base/error.h"
#include "image/image.h"

namespace nephroid::ui {
namespace {

/// R, G, B and then NAME.R, NAME.G, NAME.B of every layer, interleaved.
image::Image with_layers(const job::Picture& picture)
{
  image::Image image;
  image.width = picture.width;
  image.height = picture.height;
  image.channels = {"R", "G", "B"};
  for (const job::Layer& layer : picture.layers)
    for (const char* channel : {".R", ".G", ".B"}) image.channels.push_back(layer.name + channel);
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  image.data.reserve(pixels * image.channels.size());
  for (std::size_t i = 0; i < pixels; ++i) {
    image.data.insert(image.data.end(), &picture.rgb[3 * i], &picture.rgb[3 * i] + 3);
    for (const job::Layer& layer : picture.layers) image.data.insert(image.data.end(), &layer.rgb[3 * i], &layer.rgb[3 * i] + 3);
  }
  return image;
}

} // namespace

void save_picture(const std::filesystem::path& file, const job::Picture& picture, double exposure_stops)
{
  const std::string extension = file.extension().string();
  if (extension == ".png")
    image::write_png(file, picture.width, picture.height, picture.rgb, exposure_stops);
  else if (extension == ".exr")
    image::write_exr(file, with_layers(picture));
  else
    throw bad_input(file.string(), "a picture cannot be saved as \"" + extension + "\"",
                    "expected .png (as shown) or .exr (linear, with layers)");
}

} // namespace nephroid::ui
