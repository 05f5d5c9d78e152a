// SPDX-License-Identifier: Apache-2.0
#include "measure/read_picture.h"

#include "base/parallel.h"
#include "image/image.h"
#include "measure/metrics.h"

#include <utility>

namespace nephroid::measure {
namespace {

void decode(std::vector<float>& rgb)
{
  for_ranges(rgb.size(), std::size_t{1} << 15, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) rgb[i] = static_cast<float>(image::decoded_srgb(rgb[i]));
  });
}

} // namespace

LinearPicture read_linear_rgb(const std::filesystem::path& file)
{
  image::Image picture = image::read_image(file);
  image::Rgb rgb = image::rgb_of(picture, file.string());
  if (picture.integers) decode(rgb.values);
  return {picture.width, picture.height, std::move(rgb.values), file.string(), rgb.grey, std::move(picture.attributes)};
}

std::vector<unsigned char> read_mask(const std::filesystem::path& file, int width, int height)
{
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
