// SPDX-License-Identifier: Apache-2.0
#include "inverse/sheet.h"

#include <algorithm>
#include <numeric>

namespace nephroid::inverse {
namespace {

/// Into a rectangle of pixels, each by the cell that it shows.
void paste(const job::Picture& from, job::Picture& into, int left, int top, int width, int height)
{
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int u = x * from.width / width, v = y * from.height / height;
      const float* const pixel = from.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(v) * from.width + u);
      std::copy_n(pixel, 3, into.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(top + y) * into.width + left + x));
    }
}

} // namespace

std::shared_ptr<const job::Picture> grey_picture(std::span<const double> values, double scale, const glm::ivec2& size)
{
  auto picture = std::make_shared<job::Picture>();
  picture->width = size.x;
  picture->height = size.y;
  for (const double value : values) picture->rgb.insert(picture->rgb.end(), 3, static_cast<float>(scale * value));
  return picture;
}

std::shared_ptr<const job::Picture> received_picture(std::span<const double> light, double most, const Layout& layout)
{
  const double sum = std::accumulate(light.begin(), light.end(), 0.0);
  return grey_picture(light, sum > 0 ? 1 / (sum * most) : 0, layout.cells);
}

std::shared_ptr<const job::Picture> difference_picture(const job::Picture& wanted, const job::Picture& received)
{
  auto picture = std::make_shared<job::Picture>(wanted);
  for (std::size_t i = 0; i < wanted.rgb.size(); i += 3) {
    const float over = received.rgb[i] - wanted.rgb[i];
    picture->rgb[i] = std::max(over, 0.0f);
    picture->rgb[i + 1] = 0;
    picture->rgb[i + 2] = std::max(-over, 0.0f);
  }
  return picture;
}

std::shared_ptr<const job::Picture> slopes_picture(std::span<const glm::dvec2> slopes, std::span<const double> heights,
                                                   const Layout& layout)
{
  auto picture = std::make_shared<job::Picture>();
  picture->width = layout.facets.x;
  picture->height = layout.facets.y;
  for (std::size_t i = 0; i < slopes.size(); ++i)
    for (const double value : {slopes[i].x, slopes[i].y, heights[i]}) picture->rgb.push_back(static_cast<float>(value));
  return picture;
}

std::shared_ptr<const job::Picture> sheet(const std::vector<std::vector<std::shared_ptr<const job::Picture>>>& columns, int width,
                                          int height)
{
  auto picture = std::make_shared<job::Picture>();
  picture->width = width;
  picture->height = height;
  picture->rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.02f); // a grey that parts black pictures
  const int across = static_cast<int>(columns.size()), down = static_cast<int>(columns.front().size());
  const job::Picture& first = *columns.front().front();
  const int gap = std::max(1, std::min(width / across, height / down) / 32);
  const double fits =
      std::min((static_cast<double>(width) / across - gap) / first.width, (static_cast<double>(height) / down - gap) / first.height);
  const double scale = fits >= 1 ? static_cast<int>(fits) : std::max(fits, 0.0);
  const int w = static_cast<int>(scale * first.width), h = static_cast<int>(scale * first.height);
  for (int column = 0; column < across; ++column)
    for (int row = 0; row < down; ++row) {
      const int left = (2 * column + 1) * width / (2 * across) - w / 2, top = (2 * row + 1) * height / (2 * down) - h / 2;
      paste(*columns[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)], *picture, std::max(left, 0), std::max(top, 0), w, h);
    }
  return picture;
}

} // namespace nephroid::inverse
