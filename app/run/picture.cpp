// SPDX-License-Identifier: Apache-2.0
#include "run/picture.h"

namespace nephroid::run {

image::Image with_layers(const job::Picture& picture)
{
  image::Image image;
  image.width = picture.width;
  image.height = picture.height;
  std::vector<const float*> sources;
  const auto add = [&](const std::string& prefix, const std::vector<float>& rgb) {
    for (const char* channel : {"R", "G", "B"}) image.channels.push_back(prefix + channel);
    sources.push_back(rgb.data());
  };
  add("", picture.rgb);
  for (const job::Layer& layer : picture.layers) add(layer.name + ".", layer.rgb);
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  image.data.reserve(pixels * image.channels.size());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    for (const float* source : sources) image.data.insert(image.data.end(), source + 3 * pixel, source + 3 * pixel + 3);
  return image;
}

} // namespace nephroid::run
