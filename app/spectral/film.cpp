// SPDX-License-Identifier: Apache-2.0
#include "spectral/film.h"

#include "optics/colour.h"

namespace nephroid::spectral {

job::Layer develop(std::string name, std::span<const std::int64_t> sums, int width, const std::function<double(int row)>& factor,
                   double white)
{
  job::Layer layer{std::move(name), std::vector<float>(sums.size())};
  const std::size_t row_length = 3 * static_cast<std::size_t>(width);
  double scale = 0;
  for (std::size_t i = 0; i < sums.size(); i += 3) {
    if (i % row_length == 0) scale = factor(static_cast<int>(i / row_length)) / white;
    const optics::Colour rgb = optics::xyz_to_linear_srgb(
        {static_cast<double>(sums[i]) * scale, static_cast<double>(sums[i + 1]) * scale, static_cast<double>(sums[i + 2]) * scale});
    for (std::size_t c = 0; c < 3; ++c) layer.rgb[i + c] = static_cast<float>(rgb[c]);
  }
  return layer;
}

} // namespace nephroid::spectral
