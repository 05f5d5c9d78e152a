// SPDX-License-Identifier: Apache-2.0
#include "measure/read_picture.h"

#include "image/image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace nephroid::measure {
namespace {

/// "caustic", where there is a channel "caustic.R".
std::vector<std::string> layer_names(const image::Image& picture) {
  std::vector<std::string> layers;
  for (const std::string& channel : picture.channels)
    if (channel.ends_with(".R")) layers.push_back(channel.substr(0, channel.size() - 2));
  return layers;
}

/// The picture's channels of that name, as R, G, B.
image::Image layer_of(const image::Image& picture, const std::string& layer, const std::string& file) {
  const std::vector<std::string> layers = layer_names(picture);
  std::array<std::size_t, 3> at{};
  std::size_t found = 0;
  for (std::size_t c = 0; c < picture.channels.size(); ++c)
    for (std::size_t i = 0; i < at.size(); ++i)
      if (picture.channels[c] == layer + "." + "RGB"[i]) at[i] = c, ++found;
  if (found != at.size())
    throw bad_input(file, fmt::format("has no layer '{}'", layer),
                    layers.empty() ? "expected a picture with layers"
                                   : fmt::format("expected one of {}", fmt::join(layers, ", ")),
                    "compare image.exr of a run");
  const std::size_t stride = picture.channels.size();
  image::Image rgb{.width = picture.width,
                   .height = picture.height,
                   .channels = {"R", "G", "B"},
                   .data = {},
                   .attributes = picture.attributes,
                   .integers = picture.integers,
                   .gamma = picture.gamma,
                   .chromaticities = picture.chromaticities};
  for (std::size_t first = 0; first < picture.data.size(); first += stride)
    for (const std::size_t c : at) rgb.data.push_back(picture.data[first + c]);
  return rgb;
}

LinearPicture linear(image::Image picture, const std::filesystem::path& file) {
  image::Rgb rgb = image::rgb_of(picture, file.string());
  return {picture.width, picture.height,   std::move(rgb.values),        file.string(),
          rgb.grey,      picture.integers, std::move(picture.attributes)};
}

std::vector<job::Layer> layers_of(const image::Image& picture, const std::filesystem::path& file) {
  std::vector<job::Layer> layers;
  for (const std::string& name : layer_names(picture))
    if (std::ranges::count(picture.channels, name + ".G") == 1 &&
        std::ranges::count(picture.channels, name + ".B") == 1)
      layers.push_back({name, linear(layer_of(picture, name, file.string()), file).rgb});
  return layers;
}

bool has_channel(const image::Image& picture, const char* name) {
  return std::ranges::count(picture.channels, name) > 0;
}

} // namespace

LinearPicture read_linear_rgb(const std::filesystem::path& file) { return linear(image::read_image(file), file); }

LinearPicture read_linear_rgb(const std::filesystem::path& file, std::vector<job::Layer>& layers) {
  const image::Image picture = image::read_image(file);
  layers = layers_of(picture, file);
  return linear(picture, file);
}

OpenedPicture open_picture(const std::filesystem::path& file) {
  image::Image picture = image::read_image(file);
  OpenedPicture opened;
  opened.layers = layers_of(picture, file);
  const bool has_colours = has_channel(picture, "R") && has_channel(picture, "G") && has_channel(picture, "B");
  if (!has_colours && !has_channel(picture, "Y") && !opened.layers.empty()) {
    opened.stands_in = opened.layers.front().name;
    picture = layer_of(picture, opened.stands_in, file.string());
  }
  opened.picture = linear(std::move(picture), file);
  return opened;
}

LinearPicture read_linear_layer(const std::filesystem::path& file, const std::string& layer) {
  return linear(layer_of(image::read_image(file), layer, file.string()), file);
}

std::vector<unsigned char> read_mask(const std::filesystem::path& file, int width, int height) {
  const image::Image picture = image::read_image(file);
  const std::vector<float> rgb = image::rgb_of(picture, file.string()).values;
  const Pixels pixels{picture.width, picture.height, rgb, file.string()};
  check_same_size(pixels, width, height, "the pictures");
  check_pixels(pixels);
  std::vector<unsigned char> mask(rgb.size() / 3);
  for (std::size_t p = 0; p < mask.size(); ++p) mask[p] = rgb[3 * p] != 0 || rgb[3 * p + 1] != 0 || rgb[3 * p + 2] != 0;
  check_mask(mask, width, height, file.string());
  return mask;
}

} // namespace nephroid::measure
