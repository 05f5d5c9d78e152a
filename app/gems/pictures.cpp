// SPDX-License-Identifier: Apache-2.0
#include "gems/pictures.h"

#include "image/image.h"
#include "measure/difference.h"
#include "optics/colour.h"

#include <algorithm>

namespace nephroid::gems {
namespace {

constexpr float ground = 0.0144f; ///< beside the stone, linear

void write_grey(const std::filesystem::path& file, const GemPictures& pictures, const std::vector<float>& values) {
  std::vector<float> rgb;
  for (std::size_t i = 0; i < values.size(); ++i)
    rgb.insert(rgb.end(), 3, values[i] + (1 - pictures.outline[i]) * ground);
  image::write_png(file, pictures.side, pictures.side, rgb);
}

void write_colours(const std::filesystem::path& file, const GemPictures& pictures) {
  std::vector<float> rgb;
  for (std::size_t i = 0; i < pictures.outline.size(); ++i)
    for (const double channel :
         optics::xyz_to_linear_srgb({pictures.xyz[3 * i], pictures.xyz[3 * i + 1], pictures.xyz[3 * i + 2]}))
      rgb.push_back(static_cast<float>(channel) + (1 - pictures.xyz_outline[i]) * ground);
  image::write_png(file, pictures.side, pictures.side, rgb);
}

void write_spreads(const std::filesystem::path& file, const GemPictures& pictures) {
  const double scale = measure::colour_scale(pictures.spread_deg);
  const measure::ColourBar bar = measure::colour_bar(pictures.side, scale, false);
  measure::Bitmap bitmap(pictures.side + bar.width, std::max(pictures.side, bar.height));
  measure::draw(bitmap, pictures.side, bar);
  for (int y = 0; y < pictures.side; ++y)
    for (int x = 0; x < pictures.side; ++x) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(pictures.side) + static_cast<std::size_t>(x);
      if (pictures.outline[i] > 0) bitmap.set(x, y, measure::map_colour(pictures.spread_deg[i] / scale));
    }
  image::write_png_bytes(file, bitmap.width, bitmap.height, bitmap.rgba);
}

} // namespace

void write_pictures(const std::filesystem::path& folder, const GemPictures& pictures, bool spreads) {
  write_grey(folder / "iso.png", pictures, pictures.iso);
  write_grey(folder / "cos.png", pictures, pictures.cosine);
  write_grey(folder / "head.png", pictures, pictures.head);
  write_colours(folder / "colour.png", pictures);
  if (spreads) write_spreads(folder / "fire.png", pictures);
}

} // namespace nephroid::gems
