// SPDX-License-Identifier: Apache-2.0
#include "run/picture.h"

#include "base/build_info.h"
#include "preset/read.h"

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

void write_picture(const std::filesystem::path& stem, const preset::Preset& preset, const compute::DeviceInfo& device,
                   const job::Picture& picture)
{
  image::Image exr = with_layers(picture);
  exr.attributes = {{"nephroid:preset", preset::to_json(preset, stem.parent_path())},
                    {"nephroid:seed", std::to_string(preset.seed)},
                    {"nephroid:device", device.name},
                    {"nephroid:version", version()}};
  image::write_exr(stem.string() + ".exr", exr);
  image::write_png(stem.string() + ".png", picture.width, picture.height, picture.rgb);
}

} // namespace nephroid::run
